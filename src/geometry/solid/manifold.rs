//! Surface of a whole gear: closed, of triangles that share their vertices, counter-clockwise seen from outside.
//!
//! The outline of each tooth is swept along the rays through the apex from R_i to R_e. Each end is closed down to the
//! circle of the bore in the plane z = R cosδ_f, as the solids of `geometry::mass` are; without a bore, to the axis.
//! Lengthwise crowning takes C ((R − R_m)/(b/2))² off the flanks, along their normals (ISO 21771).

use nalgebra::Vector3;

use super::outline::{Node, Outline, Part};
use crate::geometry::involute::{Gear, direction};
use crate::geometry::{GearSpec, Pair};
use crate::numeric::{cos, sin};

/// Surface of a gear in its own frame: apex at the origin, z from apex to heel, tooth 0 centred on azimuth 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GearSolid {
    /// Vertices [m].
    pub vertices: Vec<Vector3<f64>>,
    /// Triangles by the numbers of their vertices, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl GearSolid {
    /// Gear `gear` (0 planet, 1 side gear) of `pair`, made from `spec`, with `facets` per flank across the tooth and
    /// `strips` along it. The pair must be free of `geometry::checks::errors`.
    pub fn new(pair: &Pair, spec: &GearSpec, gear: usize, facets: usize, strips: usize) -> Self {
        Self::crowned(pair, spec, gear, facets, strips, 0.0)
    }

    /// The same with `crowning` [m] missing from the flanks at both ends of the face relative to its middle: little
    /// beside the tip land's width, and seen from four strips on.
    pub fn crowned(pair: &Pair, spec: &GearSpec, gear: usize, facets: usize, strips: usize, crowning: f64) -> Self {
        let bore = [spec.planet_bore, spec.side_bore][gear];
        let strips = strips.max(1);
        let gear = &pair.gears[gear];
        let outline = Outline::new(gear, spec.root_fillet * pair.module / pair.outer_cone, facets);
        let rows: Vec<Row> = (0..=strips)
            .map(|k| {
                let share = k as f64 / strips as f64;
                let cone = pair.inner_cone + (pair.outer_cone - pair.inner_cone) * share;
                Row { cone, missing: crowning * (2.0 * share - 1.0) * (2.0 * share - 1.0) }
            })
            .collect();
        build(gear, &outline, &rows, bore)
    }
}

/// Share of a pitch within which nodes, one above the other on the outline, have one vertex of the hub between them.
const UPRIGHT: f64 = 1e-5;

/// Nodes of all teeth at one cone distance.
struct Row {
    /// Cone distance R [m].
    cone: f64,
    /// What crowning takes off the flanks there [m].
    missing: f64,
}

impl Row {
    /// Place of `node` of tooth number `tooth` [m].
    fn place(&self, gear: &Gear, node: &Node, tooth: f64) -> Vector3<f64> {
        let turn = gear.tooth_pitch() * tooth;
        let point = direction(node.polar, node.azimuth + turn) * self.cone;
        if self.missing == 0.0 || node.part != Part::Flank {
            return point;
        }
        let n = gear.flank_normal(node.polar, node.azimuth.signum()) * self.missing;
        let (c, s) = (cos(turn), sin(turn));
        point - Vector3::new(c * n.x - s * n.y, s * n.x + c * n.y, n.z)
    }
}

fn build(gear: &Gear, outline: &Outline, rows: &[Row], bore: f64) -> GearSolid {
    // the last node of a tooth is the first one of the next
    let nodes = &outline.nodes[..outline.nodes.len() - 1];
    let teeth = gear.teeth as usize;
    let around = (teeth * nodes.len()) as u32;
    let mut vertices = Vec::with_capacity((rows.len() + 2) * around as usize);
    for row in rows {
        for tooth in 0..teeth {
            // a node in the middle of a gap belongs to two flanks at once and stays
            let whole = Row { missing: 0.0, ..*row };
            let place = |(i, node)| if i == 0 { &whole } else { row }.place(gear, node, tooth as f64);
            vertices.extend(nodes.iter().enumerate().map(place));
        }
    }
    // nodes on a meridian, and at the foot of an involute, would make slivers with a vertex each
    let mut azimuths: Vec<f64> = Vec::with_capacity(nodes.len());
    let hub: Vec<u32> = nodes
        .iter()
        .map(|node| {
            if azimuths.last().is_none_or(|last| node.azimuth - last > UPRIGHT * gear.tooth_pitch()) {
                azimuths.push(node.azimuth);
            }
            azimuths.len() as u32 - 1
        })
        .collect();
    let mut ring = |cone: f64| {
        let (first, z) = (vertices.len() as u32, cone * cos(gear.root));
        if bore <= 0.0 {
            vertices.push(Vector3::new(0.0, 0.0, z));
            return vec![first; around as usize];
        }
        let per_tooth = azimuths.len() as u32;
        for tooth in 0..teeth {
            let turn = gear.tooth_pitch() * tooth as f64;
            vertices.extend(azimuths.iter().map(|a| {
                let a = a + turn;
                Vector3::new(bore / 2.0 * cos(a), bore / 2.0 * sin(a), z)
            }));
        }
        (0..teeth as u32).flat_map(|tooth| hub.iter().map(move |h| first + tooth * per_tooth + h)).collect()
    };
    let [toe_hub, heel_hub] = [0, rows.len() - 1].map(|end| ring(rows[end].cone));
    let row = |k: usize| (0..around).map(|i| k as u32 * around + i).collect::<Vec<u32>>();
    let mut triangles = Vec::with_capacity(2 * (rows.len() + 2) * around as usize);
    for k in 1..rows.len() {
        band(&mut triangles, &row(k), &row(k - 1));
    }
    band(&mut triangles, &heel_hub, &row(rows.len() - 1));
    band(&mut triangles, &row(0), &toe_hub);
    if bore > 0.0 {
        band(&mut triangles, &toe_hub, &heel_hub);
    }
    GearSolid { vertices, triangles }
}

/// Triangles between two rings of as many vertices, seen from outside with `upper` above and both running to the right.
/// Where neighbours on a ring are one and the same vertex, a triangle takes the place of two.
fn band(triangles: &mut Vec<[u32; 3]>, upper: &[u32], lower: &[u32]) {
    for (i, (&u, &l)) in upper.iter().zip(lower).enumerate() {
        let next = (i + 1) % upper.len();
        let (u2, l2) = (upper[next], lower[next]);
        let [first, second] = [[l, l2, u2], [l, u2, u]];
        if l != l2 {
            triangles.push(first);
        }
        if u != u2 {
            triangles.push(second);
        }
    }
}
