//! Outline of one tooth on the unit sphere, from the middle of one gap to the middle of the next.
//!
//! It consists of root land, fillet, meridian below the base circle, involute flank, tip land, and their mirror images.
//! Nodes of the flank are on the involute, equally spaced in the arc ψ by which the great circle rolls.

use super::Foot;
use crate::geometry::Gear;

/// Part of a tooth on which a node is. If two parts meet, the flank has precedence over the fillet, and the fillet over
/// others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The root circle.
    Root,
    /// The fillet.
    Fillet,
    /// The meridian below the base circle. A node of this part is the sharp corner between root circle and meridian.
    Meridian,
    /// The spherical involute.
    Flank,
    /// The tip circle.
    Tip,
}

/// Node of an outline on the unit sphere, in the frame of its gear with the tooth centred on azimuth 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Polar angle φ from the gear's axis [rad].
    pub polar: f64,
    /// Azimuth about the gear's axis [rad].
    pub azimuth: f64,
    /// Part of the tooth on which the node is.
    pub part: Part,
}

/// Outline of one tooth.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Foot of the tooth.
    pub foot: Foot,
    /// Nodes by rising azimuth. The first and the last node are in the middle of gaps, one pitch apart.
    pub nodes: Vec<Node>,
}

impl Outline {
    /// Returns the outline of a tooth of `gear` with `facets` ≥ 1 per flank and a fillet of the angular radius `fillet`
    /// [rad], or the largest that fits. Each fillet and the tip land have half as many facets; a fillet has at least
    /// two.
    pub fn new(gear: &Gear, fillet: f64, facets: usize) -> Self {
        let foot = Foot::new(gear, fillet);
        let left = side(gear, &foot, facets.max(1));
        let tip = left.last().map_or(0.0, |node| node.azimuth);
        let lands = facets.div_ceil(2).max(1);
        let land = (1..lands).map(|k| {
            let azimuth = tip * (2.0 * (k as f64 / lands as f64) - 1.0);
            Node { polar: gear.tip, azimuth, part: Part::Tip }
        });
        let right = left.iter().map(|node| Node { azimuth: -node.azimuth, ..*node });
        Self { foot, nodes: right.chain(land).chain(left.iter().rev().copied()).collect() }
    }
}

/// Nodes from the middle of the gap up to the corner of the tip, on the side of positive azimuth.
fn side(gear: &Gear, foot: &Foot, facets: usize) -> Vec<Node> {
    let share = |k: usize, n: usize| k as f64 / n as f64;
    let mut nodes = Vec::with_capacity(2 * facets + 4);
    if foot.centre < foot.middle {
        let lands = facets.div_ceil(4);
        nodes.extend((0..lands).map(|k| Node {
            polar: foot.floor,
            azimuth: foot.middle + (foot.centre - foot.middle) * share(k, lands),
            part: Part::Root,
        }));
    }
    let meridian = foot.has_meridian(gear);
    if foot.radius > 0.0 {
        let arcs = (facets / 2).max(2);
        nodes.extend((0..arcs).map(|k| {
            let [polar, azimuth] = foot.fillet_at(share(k, arcs));
            Node { polar, azimuth, part: Part::Fillet }
        }));
    }
    if meridian {
        let part = if foot.radius > 0.0 { Part::Fillet } else { Part::Meridian };
        nodes.push(Node { polar: foot.end[0], azimuth: foot.end[1], part });
    }
    let (start, tip) = (foot.start_arc, gear.action_arc(gear.tip));
    let base = gear.half_angle(gear.base);
    nodes.extend((0..=facets).map(|k| {
        let psi = start + (tip - start) * share(k, facets);
        let azimuth = (base - gear.inv_of_arc(psi)).min(foot.middle);
        Node { polar: gear.polar_at(psi), azimuth, part: Part::Flank }
    }));
    nodes
}
