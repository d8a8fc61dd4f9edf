//! Closed surface of a whole gear: triangles that share their vertices, counter-clockwise seen from outside.
//!
//! The outline of each tooth is swept along the rays through the apex from R_i to R_e. At each end, straight lines from
//! the outline down to the root circle close the teeth. The plane z = R cosδ_f from the root circle to the bore closes
//! the body; without a bore, it extends to the axis. The result is a frustum of the root cone with the teeth on it.
//! Lengthwise crowning removes C ((R − R_m)/(b/2))² from the flanks, along their normals (ISO 21771).
//!
//! The *sector* of a tooth is cut from the gear by the planes through the axis and the middles of the gaps on both
//! sides.

use nalgebra::Vector3;

use super::outline::Part;
use super::{Node, Outline};
use crate::geometry::involute::direction;
use crate::geometry::{Gear, GearSpec, Pair};
use crate::numeric::{cos, sin};

/// Surface of a gear in its own frame: apex at the origin, z from apex to heel, tooth 0 centred on azimuth 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GearSolid {
    /// Vertices [m].
    pub vertices: Vec<Vector3<f64>>,
    /// Triangles as indices of their vertices, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Resolution and crowning of a gear's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Facets per flank across the tooth.
    pub facets: usize,
    /// Strips along the tooth.
    pub strips: usize,
    /// Material removed from the flanks at both ends of the face relative to its middle [m]. It must be small compared
    /// with the width of the tip land, and it is visible with four or more strips.
    pub crowning: f64,
}

impl GearSolid {
    /// Returns gear `gear` (0 planet, 1 side gear) of `pair`, built from `spec`, without crowning. It has `facets` per
    /// flank across the tooth and `strips` along it. The pair must be free of `geometry::checks::errors`.
    pub fn new(pair: &Pair, spec: &GearSpec, gear: usize, facets: usize, strips: usize) -> Self {
        Self::shaped(pair, spec, gear, &Shape { facets, strips, crowning: 0.0 })
    }

    /// Returns the gear with the given `shape`.
    pub fn shaped(pair: &Pair, spec: &GearSpec, gear: usize, shape: &Shape) -> Self {
        let strips = shape.strips.max(1);
        let rows: Vec<NodeRow> = (0..=strips)
            .map(|k| {
                let share = k as f64 / strips as f64;
                let cone = pair.inner_cone + (pair.outer_cone - pair.inner_cone) * share;
                NodeRow { cone, missing: shape.crowning * (2.0 * share - 1.0) * (2.0 * share - 1.0) }
            })
            .collect();
        let outline = outline(pair, spec, gear, shape.facets);
        Surface::new(&pair.gears[gear], &outline).build(&rows, bore(spec, gear))
    }

    /// Returns the sector of tooth 0 of the gear, in one strip, without crowning.
    pub fn sector(pair: &Pair, spec: &GearSpec, gear: usize, facets: usize) -> Self {
        let rows = [pair.inner_cone, pair.outer_cone].map(|cone| NodeRow { cone, missing: 0.0 });
        let outline = outline(pair, spec, gear, facets);
        Surface::sector(&pair.gears[gear], &outline).build(&rows, bore(spec, gear))
    }
}

fn outline(pair: &Pair, spec: &GearSpec, gear: usize, facets: usize) -> Outline {
    Outline::new(&pair.gears[gear], spec.root_fillet * pair.module / pair.outer_cone, facets)
}

fn bore(spec: &GearSpec, gear: usize) -> f64 {
    [spec.planet_bore, spec.side_bore][gear]
}

/// Fraction of a pitch within which nodes, one above the other on the outline, share one vertex of the hub.
const UPRIGHT: f64 = 1e-5;

/// Polar angle above the root circle up to which a node counts as on it [rad].
const ROUNDING: f64 = 1e-9;

/// Nodes of all teeth at one cone distance.
struct NodeRow {
    /// Cone distance R [m].
    cone: f64,
    /// Material that crowning removes from the flanks at this cone distance [m].
    missing: f64,
}

impl NodeRow {
    /// Position of `node` of tooth number `tooth` [m].
    fn position(&self, gear: &Gear, node: &Node, tooth: f64) -> Vector3<f64> {
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

/// Data of the surface of a gear or of a sector.
struct Surface<'a> {
    gear: &'a Gear,
    /// Nodes of a tooth. In a whole gear, the last node of the outline is omitted, because it is the first node of the
    /// next tooth.
    nodes: &'a [Node],
    /// Number of teeth, counted from tooth 0.
    teeth: usize,
    /// True if the last tooth is followed by the first.
    whole: bool,
    /// Azimuths of a tooth's vertices on the circles within the outline [rad], and the node on the root circle at each
    /// azimuth.
    columns: Vec<(f64, Option<u32>)>,
    /// Column of each node.
    column: Vec<u32>,
}

impl<'a> Surface<'a> {
    fn new(gear: &'a Gear, outline: &'a Outline) -> Self {
        let nodes = &outline.nodes[..outline.nodes.len() - 1];
        // nodes on a meridian, and at the foot of an involute, would cause slivers if each had a separate column
        let mut columns: Vec<(f64, Option<u32>)> = Vec::with_capacity(nodes.len() + 1);
        let mut column = Vec::with_capacity(nodes.len() + 1);
        for (i, node) in nodes.iter().enumerate() {
            let root = (node.polar <= gear.root + ROUNDING).then_some(i as u32);
            match columns.last_mut() {
                Some((azimuth, own))
                    if node.azimuth - *azimuth <= UPRIGHT * gear.tooth_pitch() && (own.is_none() || root.is_none()) =>
                {
                    *own = own.or(root);
                }
                _ => columns.push((node.azimuth, root)),
            }
            column.push(columns.len() as u32 - 1);
        }
        Self { gear, nodes, teeth: gear.teeth as usize, whole: true, columns, column }
    }

    fn sector(gear: &'a Gear, outline: &'a Outline) -> Self {
        let one = Self::new(gear, outline);
        let (nodes, Self { mut columns, mut column, .. }) = (&outline.nodes[..], one);
        // first column of the next tooth
        let last =
            columns.first().map(|(azimuth, root)| (azimuth + gear.tooth_pitch(), root.map(|_| nodes.len() as u32 - 1)));
        columns.extend(last);
        column.push(columns.len() as u32 - 1);
        Self { gear, nodes, teeth: 1, whole: false, columns, column }
    }

    fn build(&self, rows: &[NodeRow], bore: f64) -> GearSolid {
        let gear = self.gear;
        let around = (self.teeth * self.nodes.len()) as u32;
        let mut vertices = Vec::with_capacity((rows.len() + 4) * around as usize);
        for row in rows {
            for tooth in 0..self.teeth {
                // a node in the middle of a gap belongs to two flanks, so crowning does not move it
                let whole = NodeRow { missing: 0.0, ..*row };
                let position = |(i, node)| if i == 0 { &whole } else { row }.position(gear, node, tooth as f64);
                vertices.extend(self.nodes.iter().enumerate().map(position));
            }
        }
        let row = |k: usize| (0..around).map(|i| k as u32 * around + i).collect::<Vec<u32>>();
        let mut end = |k: usize| {
            let (cone, outline) = (rows[k].cone, row(k));
            let collar = self.ring(&mut vertices, cone * sin(gear.root), cone, &outline);
            [outline, collar, self.ring(&mut vertices, bore / 2.0, cone, &[])]
        };
        // rings once around a section of the body: up the toe from the hub, along the teeth, down the heel
        let ([toe, toe_collar, toe_hub], [heel, heel_collar, heel_hub]) = (end(0), end(rows.len() - 1));
        let mut section = vec![toe_hub, toe_collar, toe];
        section.extend((1..rows.len() - 1).map(row));
        section.extend([heel, heel_collar, heel_hub]);
        let mut triangles = Vec::with_capacity(2 * (section.len() + 1) * around as usize);
        for rings in section.windows(2) {
            self.band(&mut triangles, &rings[1], &rings[0]);
        }
        if bore > 0.0 {
            self.band(&mut triangles, &section[0], &section[section.len() - 1]);
        }
        if !self.whole {
            cut(&mut triangles, section.iter().map(|ring| ring[0]), false);
            cut(&mut triangles, section.iter().map(|ring| ring[ring.len() - 1]), true);
        }
        GearSolid { vertices, triangles }
    }

    /// Adds a circle of `radius` in the plane of the root circle at `cone` [m] and returns its vertex for each node.
    /// Nodes of `outline` on the root circle are reused. A circle of zero radius is one vertex.
    fn ring(&self, vertices: &mut Vec<Vector3<f64>>, radius: f64, cone: f64, outline: &[u32]) -> Vec<u32> {
        let (gear, z) = (self.gear, cone * cos(self.gear.root));
        if radius <= 0.0 {
            vertices.push(Vector3::new(0.0, 0.0, z));
            return vec![vertices.len() as u32 - 1; self.teeth * self.nodes.len()];
        }
        let mut ring = Vec::with_capacity(self.teeth * self.nodes.len());
        for tooth in 0..self.teeth {
            let turn = gear.tooth_pitch() * tooth as f64;
            let own = |node: &u32| outline.get(tooth * self.nodes.len() + *node as usize).copied();
            let numbers: Vec<u32> = self
                .columns
                .iter()
                .map(|(azimuth, root)| {
                    root.as_ref().and_then(own).unwrap_or_else(|| {
                        let a = azimuth + turn;
                        vertices.push(Vector3::new(radius * cos(a), radius * sin(a), z));
                        vertices.len() as u32 - 1
                    })
                })
                .collect();
            ring.extend(self.column.iter().map(|&c| numbers[c as usize]));
        }
        ring
    }

    /// Adds triangles between two rings with equal numbers of vertices. Seen from outside, `upper` is above and both
    /// rings run to the right. Triangles with two identical corners are omitted.
    fn band(&self, triangles: &mut Vec<[u32; 3]>, upper: &[u32], lower: &[u32]) {
        for i in 0..upper.len() - usize::from(!self.whole) {
            let next = (i + 1) % upper.len();
            let ([u, l], [u2, l2]) = ([upper[i], lower[i]], [upper[next], lower[next]]);
            push(triangles, [l, l2, u2]);
            push(triangles, [l, u2, u]);
        }
    }
}

/// Adds triangles of the plane through the axis in which a sector is cut, all from the first corner of the `section`,
/// which is on the hub. They face rising azimuth at the sector's `last` tooth, otherwise falling azimuth.
fn cut(triangles: &mut Vec<[u32; 3]>, section: impl Iterator<Item = u32>, last: bool) {
    let corners: Vec<u32> = section.collect();
    for pair in corners[1..].windows(2) {
        push(triangles, if last { [corners[0], pair[1], pair[0]] } else { [corners[0], pair[0], pair[1]] });
    }
}

fn push(triangles: &mut Vec<[u32; 3]>, corners: [u32; 3]) {
    let [a, b, c] = corners;
    if a != b && b != c && c != a {
        triangles.push(corners);
    }
}
