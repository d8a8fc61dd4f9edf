//! Loaded tooth pairs of a mesh at an instant: their position on the planet's flank, force and pressure.
//!
//! A pair touches along a line from toe to heel at polar angle φ about the planet's axis. On the path of contact,
//! cosφ = cosδ_b cos(ψ_p0 + s). At the planet's tip corner, φ is the planet's tip angle. At the side gear's tip corner,
//! φ is the polar angle of this corner about the planet's axis. The height along the profile is h = R_m (φ − δ).
//!
//! The pressure is Hertz's for two cylinders under the line load w(R) with the relative radius R τ(s). An aligned pair
//! has a uniform w under IMPACT, with the resultant at R_m, and w = 2FR/(R_e² − R_i²) under a line law. With errors or
//! displacements that differ over the face, w follows from the law at the depth of each position. For solid teeth, w is
//! interpolated linearly between the loaded sections. Toward toe and heel, w is extrapolated linearly, but not below 0.

use crate::contact::shared::MAX_PAIRS;
use crate::contact::{Flank, Mesh, Spot, ToothLoad};
use crate::geometry::Pair;
use crate::integrate::Point;
use crate::model::dynamics::{Largest, MAX_SIZE};
use crate::strength::LineContact;

/// Number of pairs that are reported. With a contact ratio below 3, no mesh has more pairs on its path.
pub const TOOTH_PAIRS: usize = 3;
/// Maximum number of sections of a pair of solid teeth.
const SECTIONS: usize = 8;
/// Share of the face above which a load represents the whole face.
const WHOLE: f64 = 1.0 - 1e-9;
/// Tooth number that means no pair.
const NONE: f64 = -1.0;

/// A loaded tooth pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairLine {
    /// Number of the planet's tooth, from 0; -1 without a pair.
    pub tooth: f64,
    /// Normal force [N], negative on the coast flank.
    pub force: f64,
    /// Height along the planet's profile from the pitch circle, at the mean cone distance [m].
    pub height: f64,
    /// Hertz pressure at toe, mean cone distance and heel [Pa].
    pub pressure: [f64; 3],
}

impl Default for PairLine {
    fn default() -> Self {
        Self { tooth: NONE, force: 0.0, height: 0.0, pressure: [0.0; 3] }
    }
}

/// Loaded pairs of a mesh, from the planet's root to its tip.
pub type PairLines = [PairLine; TOOTH_PAIRS];

/// Sums over the sections of a pair.
#[derive(Clone, Copy)]
struct Gathered {
    flank: Flank,
    /// Numbers of the planet's and the side gear's tooth.
    teeth: [usize; 2],
    /// Sum of the normal forces [N].
    force: f64,
    /// Sum of force × height [N·m].
    by_height: f64,
    /// Sum of force × position on the path [N·rad].
    by_s: f64,
    /// Cone distance [m] and line load [N/m] of the sections.
    sections: [[f64; 2]; SECTIONS],
    /// Number of sections.
    count: usize,
    /// True if a single load represents the whole face.
    is_whole: bool,
    /// Line load at toe, mean cone distance and heel [N/m], if the law gives it.
    known: Option<[f64; 3]>,
}

impl Gathered {
    fn new(load: &ToothLoad, known: Option<[f64; 3]>) -> Self {
        Self {
            flank: load.flank,
            teeth: load.teeth,
            force: 0.0,
            by_height: 0.0,
            by_s: 0.0,
            sections: [[0.0; 2]; SECTIONS],
            count: 0,
            is_whole: load.share > WHOLE,
            known,
        }
    }

    fn add(&mut self, load: &ToothLoad, height: f64) {
        self.force += load.normal;
        self.by_height += load.normal * height;
        self.by_s += load.normal * load.s;
        if self.count < SECTIONS {
            self.sections[self.count] = [load.cone, load.line_load];
            self.count += 1;
        }
    }

    /// Line load at cone distance `cone` [N/m]. `grows` is true if the load of a whole face grows with the cone
    /// distance.
    fn line_load(&self, contact: &LineContact, cone: f64, grows: bool) -> f64 {
        if self.is_whole {
            let [inner, outer] = contact.cone_range;
            return if grows { contact.line_load(self.force, cone) } else { self.force / (outer - inner) };
        }
        along(&self.sections[..self.count], cone)
    }

    fn line(&self, contact: &LineContact, grows: bool) -> PairLine {
        let (cones, s) = (cones(contact), self.by_s / self.force);
        let line_load = self.known.unwrap_or_else(|| cones.map(|cone| self.line_load(contact, cone, grows)));
        let pressure = std::array::from_fn(|i| contact.pressure_at(line_load[i], cones[i], s).unwrap_or(0.0));
        PairLine {
            tooth: self.teeth[0] as f64,
            force: if self.flank == Flank::Drive { self.force } else { -self.force },
            height: self.by_height / self.force,
            pressure,
        }
    }
}

/// Toe, mean cone distance and heel [m].
fn cones(contact: &LineContact) -> [f64; 3] {
    let [inner, outer] = contact.cone_range;
    [inner, contact.mean_cone, outer]
}

/// Linear interpolation at `x` between `points` in the order of x, extrapolated beyond both ends and at least 0.
fn along(points: &[[f64; 2]], x: f64) -> f64 {
    let [first, .., last] = points else { return points.first().map_or(0.0, |point| point[1]) };
    if first[0] == last[0] {
        return first[1];
    }
    let after = points.iter().position(|point| point[0] >= x).unwrap_or(points.len()).clamp(1, points.len() - 1);
    let ([x0, y0], [x1, y1]) = (points[after - 1], points[after]);
    let slope = if x1 > x0 { (y1 - y0) / (x1 - x0) } else { 0.0 };
    (y0 + slope * (x - x0)).max(0.0)
}

/// Height of a load along the planet's profile [m].
fn height(pair: &Pair, mesh: &Mesh, load: &ToothLoad) -> f64 {
    let planet = &pair.gears[0];
    let polar = match (load.touch, load.spot) {
        (Some(touch), _) => touch.polar[0],
        (None, Spot::Path) => planet.polar_at(pair.pitch_arc[0] + load.spot_arc),
        (None, Spot::PlanetTip) => planet.tip,
        (None, Spot::SideTip) => mesh.engagement.corner[1].exact(load.spot_arc).mate_polar,
    };
    pair.mean_cone * (polar - planet.pitch)
}

/// Loaded pairs of the mesh of planet group `g` with side gear `s`; `contact` calculates their pressure. Returns no
/// pairs if one spring replaces all teeth.
pub fn pair_lines(
    (pair, contact): (&Pair, &LineContact),
    equations: &Largest,
    at: &Point<MAX_SIZE>,
    [g, s]: [usize; 2],
) -> PairLines {
    let mesh = &equations.teeth.contact.mesh;
    let mut lines = PairLines::default();
    if mesh.is_single {
        return lines;
    }
    let mut gathered: [Option<Gathered>; MAX_PAIRS] = [None; MAX_PAIRS];
    equations.loads_over_the_face(at, g, s, |load, line_load| {
        if load.normal.is_nan() || load.normal <= 0.0 {
            return;
        }
        let is_it = |own: &Gathered| (own.flank, own.teeth) == (load.flank, load.teeth);
        let slot = gathered.iter_mut().find(|slot| slot.as_ref().is_none_or(is_it));
        if let Some(slot) = slot {
            let known = || line_load.map(|line_load| cones(contact).map(line_load));
            slot.get_or_insert_with(|| Gathered::new(load, known())).add(load, height(pair, mesh, load));
        }
    });
    // the most loaded pairs are kept, and sorted by height below
    gathered.sort_unstable_by(|a, b| {
        let force = |own: &Option<Gathered>| own.as_ref().map_or(0.0, |own| own.force);
        force(b).total_cmp(&force(a))
    });
    let grows = equations.teeth.contact.detailed.is_over_face();
    let mut count = 0;
    for (line, own) in lines.iter_mut().zip(gathered.iter().flatten()) {
        *line = own.line(contact, grows);
        count += 1;
    }
    lines[..count].sort_unstable_by(|a, b| a.height.total_cmp(&b.height));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_between_sections_follow_straight_lines_and_end_at_zero() {
        let points = [[1.0, 4.0], [2.0, 2.0], [3.0, 1.0]];
        for (x, y) in [(0.5, 5.0), (1.5, 3.0), (2.0, 2.0), (2.5, 1.5), (3.5, 0.5), (4.5, 0.0)] {
            assert_eq!(along(&points, x), y);
        }
        assert_eq!(along(&points[..1], 7.0), 4.0);
        assert_eq!(along(&[], 7.0), 0.0);
    }
}
