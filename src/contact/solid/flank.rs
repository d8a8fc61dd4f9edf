//! Faceted flanks of one pair. Only the drive flanks are stored; the coast flanks are their mirror images.
//!
//! Directions are in the frame of a tooth of the gear: first away from the gear's axis along the middle of the tooth,
//! second in the direction in which the carrier turns forward, third along the axis from apex to heel. A facet spans
//! the angle between two neighbouring rays. All rays of a gear meet in its apex, so a section at any cone distance is
//! the same polygon.

use nalgebra::Vector3;

use crate::geometry::solid::Foot;
use crate::geometry::{Gear, Pair};
use crate::numeric::{PI, cos, sin};

/// Angle by which a flank is extended below its lowest ray [rad].
const PROLONGED: f64 = 0.1;

/// A ray of a flank.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Direction of the ray.
    pub direction: Vector3<f64>,
    /// Unit normal of the flank at the ray, from the planet into the side gear.
    pub normal: Vector3<f64>,
}

/// Flanks of a pair.
#[derive(Clone, Debug)]
pub struct Flanks {
    /// Rays of planet and side gear. Both lists end at the planet's root and the side gear's tip.
    pub rays: [Vec<Ray>; 2],
    /// Largest height of the flanks' arcs over their facets, planet and side gear [rad].
    pub sagitta: [f64; 2],
    /// Index of the ray on the path of contact, along each flank: at the pitch point, and its derivative with respect
    /// to the position s [1/rad].
    on_path: [[f64; 2]; 2],
    /// Ends of the path of contact [rad].
    path: [f64; 2],
}

impl Flanks {
    /// Returns the flanks of `pair` above root fillets of the angular radius `fillet` [rad], with `facets` on each
    /// involute.
    pub fn new(pair: &Pair, fillet: f64, facets: usize) -> Self {
        let [p, s] = &pair.gears;
        let feet = pair.gears.map(|gear| Foot::new(&gear, fillet));
        let planet: Vec<Ray> = polars(p, &feet[0], facets).map(|polar| ray(p, polar, 1.0)).collect();
        let into_side = |r: Ray| Ray { normal: -r.normal, ..r };
        let side: Vec<Ray> = polars(s, &feet[1], facets).map(|polar| into_side(ray(s, polar, -1.0))).collect();
        let [mut planet, side] = [planet, side].map(prolonged);
        planet.reverse();
        let sagitta = [0, 1].map(|i| sagitta(&pair.gears[i], &feet[i], facets));
        // rolled arcs increase along the planet's flank toward its tip, where its rays begin, and likewise on the side
        // gear
        let per_arc = [0, 1].map(|i| facets as f64 / (pair.gears[i].action_arc(pair.gears[i].tip) - feet[i].start_arc));
        let from_tip = [0, 1].map(|i| (pair.gears[i].action_arc(pair.gears[i].tip) - pair.pitch_arc[i]) * per_arc[i]);
        let last = (side.len() - 1) as f64;
        let on_path = [[from_tip[0], -per_arc[0]], [last - from_tip[1], -per_arc[1]]];
        Self { rays: [planet, side], sagitta, on_path, path: [pair.path.low, pair.path.high] }
    }

    /// Fractional indices of the rays at which exact flanks are closest at position `s` [rad]. Beyond an end of the
    /// path of contact, they are those of that end, which is nearly correct.
    pub fn closest(&self, s: f64) -> [f64; 2] {
        let s = s.max(self.path[0]).min(self.path[1]);
        self.on_path.map(|[at_pitch, per_s]| at_pitch + per_s * s)
    }
}

/// Polar angles of the rays of a flank from the end of its fillet to its tip [rad], as in the solids: equal steps of
/// roll on the involute, and one facet below the base circle.
fn polars(gear: &Gear, foot: &Foot, facets: usize) -> impl Iterator<Item = f64> {
    let below = foot.has_meridian(gear).then_some(foot.end[0]);
    let (gear, foot) = (*gear, *foot);
    below.into_iter().chain((0..=facets).map(move |i| on_involute(&gear, &foot, i as f64 / facets as f64)))
}

/// Polar angle on the involute at a fraction of its roll from the foot to the tip [rad].
fn on_involute(gear: &Gear, foot: &Foot, share: f64) -> f64 {
    gear.polar_at(foot.start_arc + (gear.action_arc(gear.tip) - foot.start_arc) * share)
}

/// Extends the lowest facet of a flank into the body of the gear, so that contact does not end where the fillet begins.
/// Fillets take no part in contact.
fn prolonged(rays: Vec<Ray>) -> Vec<Ray> {
    let [first, second, ..] = rays[..] else { return rays };
    let along = first.direction - second.direction;
    let along = (along - first.direction * along.dot(&first.direction)).normalize();
    let direction = first.direction * cos(PROLONGED) + along * sin(PROLONGED);
    let below = Ray { direction, normal: first.normal };
    std::iter::once(below).chain(rays).collect()
}

/// Ray of the forward (`side` = 1) or backward (−1) flank, with its normal out of the material.
fn ray(gear: &Gear, polar: f64, side: f64) -> Ray {
    let direction = gear.flank_point(polar, side);
    // below the base circle, the flank is a meridian
    let normal = if polar < gear.base {
        let azimuth = side * gear.half_angle(polar);
        Vector3::new(-sin(azimuth), cos(azimuth), 0.0) * side
    } else {
        gear.flank_normal(polar, side)
    };
    Ray { direction, normal }
}

/// Largest height of the involute over its facets [rad].
fn sagitta(gear: &Gear, foot: &Foot, facets: usize) -> f64 {
    let point = |i: f64| gear.flank_point(on_involute(gear, foot, i / facets as f64), 1.0);
    (0..facets)
        .map(|i| {
            let i = i as f64;
            let normal = point(i).cross(&point(i + 1.0)).normalize();
            normal.dot(&point(i + 0.5)).abs()
        })
        .fold(0.0, f64::max)
}

/// Angle from the middle of a gap to the middle of the tooth ahead [rad].
pub fn half_pitch(gear: &Gear) -> f64 {
    PI / f64::from(gear.teeth)
}
