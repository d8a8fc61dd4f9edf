//! Validity range of the beam formulas: the part of the path, and of a tip corner's travel, on which both teeth are
//! beams.

use super::SectionPair;
use crate::numeric::FRAC_PI_2;
use crate::problem::Problem;

/// Smallest thickness of a tooth along the load [modules].
const MIN_DEPTH: f64 = 0.05;
/// Largest angle of the load to the chord [rad].
const STEEPEST: f64 = FRAC_PI_2 * 2.0 / 3.0;
/// The load may cross the middle of the tooth at most this far below the root section [root chords].
const BELOW_ROOT: f64 = 0.25;
/// Number of steps of the searches.
const SEARCH: usize = 128;
/// Smallest length of the range on which both teeth are beams [base pitches].
pub const MIN_RANGE: f64 = 0.02;

/// Parameters for the dedenda of planet and side gear.
pub const DEDENDUM: [&str; 2] = ["geometry.planet_dedendum", "geometry.side_dedendum"];
const ADDENDUM: [&str; 2] = ["geometry.planet_addendum", "geometry.side_addendum"];

/// Returns the parameter to change if a tooth is not a beam under a load at the roll lengths `rolls` [m].
fn parameter_at_fault(teeth: &SectionPair, rolls: [f64; 2]) -> Option<&'static str> {
    for (i, tooth) in teeth.sections.iter().enumerate() {
        let load = tooth.load(rolls[i]);
        if rolls[i] <= 0.0 {
            return Some(ADDENDUM[1 - i]);
        }
        if load.depth < MIN_DEPTH * tooth.module || load.angle.abs() > STEEPEST {
            return Some(ADDENDUM[i]);
        }
        if load.lever < -BELOW_ROOT * tooth.root_chord {
            return Some(DEDENDUM[i]);
        }
    }
    None
}

/// True if both teeth are beams under a load at the roll lengths `rolls` [m].
pub fn are_beams(teeth: &SectionPair, rolls: [f64; 2]) -> bool {
    parameter_at_fault(teeth, rolls).is_none()
}

/// Position of step `j` of a search on `range`.
fn between(range: [f64; 2], j: usize) -> f64 {
    range[0] + (range[1] - range[0]) * j as f64 / SEARCH as f64
}

/// Evenly spaced positions on `range`, including both ends.
pub fn positions(range: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..=SEARCH).map(move |j| between(range, j))
}

/// Boundary of `fits` between `inside` (true) and `outside` (false), found by bisection. `fits` is true at the result.
pub fn boundary(mut inside: f64, mut outside: f64, fits: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..50 {
        let half = 0.5 * (inside + outside);
        if fits(half) { inside = half } else { outside = half }
    }
    inside
}

/// Longest part of `path` [rad] on which both teeth are beams. Fails with the parameter to change if this part is
/// shorter than `MIN_RANGE`.
pub fn beams(teeth: &SectionPair, path: [f64; 2], outer_cone: f64, base_pitch: f64) -> Result<[f64; 2], Problem> {
    let fits = |s: f64| are_beams(teeth, teeth.rolls(s * outer_cone));
    let mut best = [0.0, 0.0];
    let mut j = 0;
    while j <= SEARCH {
        if !fits(between(path, j)) {
            j += 1;
            continue;
        }
        let first = j;
        while j < SEARCH && fits(between(path, j + 1)) {
            j += 1;
        }
        let low = if first == 0 { path[0] } else { boundary(between(path, first), between(path, first - 1), fits) };
        let high = if j == SEARCH { path[1] } else { boundary(between(path, j), between(path, j + 1), fits) };
        if high - low > best[1] - best[0] {
            best = [low, high];
        }
        j += 1;
    }
    if best[1] - best[0] < MIN_RANGE * base_pitch {
        let middle = between(path, SEARCH / 2) * outer_cone;
        return Err(problem!(
            parameter_at_fault(teeth, teeth.rolls(middle)).unwrap_or(ADDENDUM[0]),
            "the beam formulas are valid on only {:.3} base pitches of the path: \
             the teeth are pointed or touch at their roots",
            (best[1] - best[0]) / base_pitch
        ));
    }
    Ok(best)
}
