//! Surface of the teeth of a gear for parry3d's queries: distance of a point inside or outside.
//!
//! All faces of the teeth are cones with the pitch apex as their apex. A band of these cones at the heel therefore
//! represents them all. A length at the cone distance R is R/R_e times the length at the heel. Three neighbouring teeth
//! suffice, because every azimuth is mapped into the middle tooth. The ends of the face are omitted: the whole gear
//! between R_i and R_e, including its ends, is within these cones. parry3d works in millimetres; all results are angles
//! from the apex.

use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::{TriMesh, TriMeshFlags};

use super::outline::Part;
use super::{Node, Outline};
use crate::geometry::involute::direction;
use crate::geometry::{Gear, GearSpec, Pair};
use crate::numeric::{atan2, cos, sin};

/// Millimetres per metre.
const MM: f64 = 1e3;
/// Ends of the band as fractions of R_e. The foot of a perpendicular from R_e is at R_e cos(angle), which never exceeds
/// R_e.
const BAND: [f64; 2] = [0.97, 1.01];
/// Number of teeth in the band on either side of the middle one.
const NEIGHBOURS: i32 = 1;
/// Difference of polar angles below which a node counts as on the tip circle [rad].
const ROUNDING: f64 = 1e-9;

/// The teeth of one gear.
pub struct Skin {
    /// The gear.
    pub gear: Gear,
    /// Nodes of the tooth on azimuth 0 with their parts. The corners of the tip count as tip. Each node represents a
    /// ray from the apex.
    pub nodes: Vec<Node>,
    /// Part of the tooth for the facet between each node and the next.
    facets: Vec<Part>,
    mesh: TriMesh,
    /// R_e [mm].
    radius: f64,
}

/// Nearest point of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Distance from the surface per cone distance [rad]; negative inside.
    pub gap: f64,
    /// Number of the tooth that the surface belongs to, 0 on azimuth 0, counted by rising azimuth.
    pub tooth: i32,
    /// Part of that tooth.
    pub part: Part,
}

impl Skin {
    /// Returns the teeth of gear `i` of `pair`, built from `spec`, with `facets` per flank. `None` if the surface
    /// cannot be built.
    pub fn new(pair: &Pair, spec: &GearSpec, i: usize, facets: usize) -> Option<Self> {
        let gear = pair.gears[i];
        let outline = Outline::new(&gear, spec.root_fillet * pair.module / pair.outer_cone, facets);
        let labels: Vec<Part> = outline.nodes.windows(2).map(|ends| between(&gear, &outline, ends)).collect();
        let own = &outline.nodes[..outline.nodes.len() - 1];
        let radius = pair.outer_cone * MM;
        let mut vertices = Vec::with_capacity(2 * (3 * own.len() + 1));
        for tooth in -NEIGHBOURS..=NEIGHBOURS {
            let turn = gear.tooth_pitch() * f64::from(tooth);
            // the last node of the last tooth closes the band
            let nodes = if tooth == NEIGHBOURS { &outline.nodes[..] } else { own };
            for node in nodes {
                let d = direction(node.polar, node.azimuth + turn) * radius;
                vertices.extend(BAND.map(|share| Vector::new(d.x * share, d.y * share, d.z * share)));
            }
        }
        let quads = (vertices.len() / 2 - 1) as u32;
        // counter-clockwise from outside: inner and outer vertex of a node, then those of the next node
        let triangles =
            (0..quads).flat_map(|k| [[2 * k, 2 * k + 2, 2 * k + 3], [2 * k, 2 * k + 3, 2 * k + 1]]).collect();
        let mesh = TriMesh::with_flags(vertices, triangles, TriMeshFlags::ORIENTED).ok()?;
        let tip = |node: &Node| node.polar >= gear.tip - ROUNDING;
        let nodes = own.iter().map(|node| if tip(node) { Node { part: Part::Tip, ..*node } } else { *node }).collect();
        Some(Self { gear, nodes, facets: labels, mesh, radius })
    }

    /// Point of the surface nearest to the ray along the unit vector `ray` in the gear's frame.
    pub fn nearest(&self, ray: &Vector3<f64>) -> Nearest {
        let pitch = self.gear.tooth_pitch();
        let tooth = (atan2(ray.y, ray.x) / pitch).round();
        let (s, c) = (sin(tooth * pitch), cos(tooth * pitch));
        let point = Vector::new(c * ray.x + s * ray.y, c * ray.y - s * ray.x, ray.z) * self.radius;
        let (found, (triangle, _)) = self.mesh.project_local_point_and_get_location(point, false);
        let distance = (found.point - point).length() / self.radius;
        let (facet, count) = (triangle as usize / 2, self.facets.len());
        Nearest {
            gap: if found.is_inside { -distance } else { distance },
            tooth: tooth as i32 + (facet / count) as i32 - NEIGHBOURS,
            part: self.facets[facet % count],
        }
    }

    /// Largest distance between the facets and the exact faces, per cone distance [rad].
    pub fn coarseness(&self, pair: &Pair, spec: &GearSpec, facets: usize) -> f64 {
        let fine = Outline::new(&self.gear, spec.root_fillet * pair.module / pair.outer_cone, 2 * facets);
        let off = |node: &Node| self.nearest(&direction(node.polar, node.azimuth)).gap.abs();
        fine.nodes.iter().map(off).fold(0.0, f64::max)
    }
}

/// Part of the tooth for the facet from one node to the next.
fn between(gear: &Gear, outline: &Outline, ends: &[Node]) -> Part {
    let both = |part: Part| ends.iter().all(|node| node.part == part);
    if ends.iter().all(|node| node.polar >= gear.tip - ROUNDING) {
        Part::Tip
    } else if ends.iter().any(|node| node.part == Part::Root) {
        Part::Root
    } else if both(Part::Flank) {
        Part::Flank
    } else if !both(Part::Fillet) && outline.foot.has_meridian(gear) {
        Part::Meridian
    } else {
        Part::Fillet
    }
}
