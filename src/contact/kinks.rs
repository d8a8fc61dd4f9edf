//! Kinks of a mesh's force. A kink occurs if flanks touch or separate, if a pair enters or leaves contact at a tip
//! corner, or if it passes from the corner to the path.
//!
//! A one-step method loses its order over a kink, and its error estimate does not show it. Positions are smooth, unlike
//! forces. A kink can therefore be predicted from the present rates, and a step can be made to end on it.

use super::{Engagement, Flank, Spot};
use crate::numeric::quotient;

/// Fractions of a step between which the step is cut at a kink. A kink near either end of a step does no harm.
pub const WORTHWHILE: (f64, f64) = (3e-4, 0.9997);
/// Largest number of pairs searched in a motion. A motion past more pairs is longer than a whole turn of a gear and
/// resolves no kink. At absurd speeds the search would not end.
const MAX_PAIRS: i64 = 256;
/// Fraction of the way to a touch at which a step ends. Beyond the touch, even a depth of some 1e-9 rad would be an
/// error far above the tolerance.
const BEFORE_TOUCH: f64 = 1.0 - 1e-9;
/// Number of bisections that locate a kink, to some 1e-5 of the step.
const HALVINGS: u32 = 15;

impl Engagement {
    /// Fraction of the motion from `position` to `position + change` (both (q, x)) at which the first kink occurs, or
    /// `None`. The motion is assumed to be straight. If `OPEN`, `opening` returns the gap between the flanks of a pair
    /// from the pair's number and its position on the path [rad]; excess material is negative. `opening` is not called
    /// if flanks without gaps would be separate.
    #[inline(always)]
    pub fn kink<const OPEN: bool>(
        &self,
        position: [f64; 2],
        change: [f64; 2],
        opening: impl Fn(Flank, i64, f64) -> f64,
    ) -> Option<f64> {
        let at = |t: f64| [position[0] + t * change[0], position[1] + t * change[1]];
        let approach = [self.approach(position[0]), self.approach(position[0] + change[0])];
        if approach[0].max(approach[1]) <= 0.0 {
            return None;
        }
        if approach[0].min(approach[1]) <= 0.0 || position[0] * at(1.0)[0] < 0.0 {
            return self.kink_of_touch(position[0], change[0]);
        }
        let flank = if position[0] < 0.0 { Flank::Drive } else { Flank::Coast };
        let numbers = [self.numbers(flank, position[1], approach[0]), self.numbers(flank, at(1.0)[1], approach[1])];
        let mut first: Option<f64> = None;
        let pairs = numbers[0].0.min(numbers[1].0)..numbers[0].1.max(numbers[1].1);
        if pairs.end.saturating_sub(pairs.start) > MAX_PAIRS {
            return None;
        }
        for k in pairs {
            let spot = |[q, x]: [f64; 2]| self.spot::<OPEN>(flank, x, self.approach(q), k, |s| opening(flank, k, s));
            let start = spot(position);
            if spot(at(1.0)) != start
                && let Some(t) = first_change(|t| spot(at(t)) != start)
            {
                first = Some(first.map_or(t, |found| found.min(t)));
            }
        }
        first
    }

    /// Fraction of the straight motion from `q` to `q + change` at which touching flanks separate or separate flanks
    /// touch, or `None`. Separate flanks fly without forces, so that the prediction is exact, and the step ends just
    /// before the touch.
    pub fn kink_of_touch(&self, q: f64, change: f64) -> Option<f64> {
        if self.approach(q) <= 0.0 {
            let touch = quotient(self.half_backlash().copysign(change) - q, change)?;
            return (touch > WORTHWHILE.0 && touch <= WORTHWHILE.1).then_some(touch * BEFORE_TOUCH);
        }
        first_change(|t| {
            let end = q + t * change;
            // the flanks across the backlash are different ones
            self.approach(end) <= 0.0 || end * q <= 0.0
        })
    }

    /// Calls `visit` with the fractions of the motion at which a pair of either flank, loaded or not, passes an end of
    /// the path. In meshes without corner contact, the force jumps there.
    pub fn passages_of_ends(&self, position: [f64; 2], change: [f64; 2], mut visit: impl FnMut(f64)) {
        for flank in [Flank::Drive, Flank::Coast] {
            let numbers = [position[1], position[1] + change[1]].map(|x| self.numbers(flank, x, 0.0));
            let pairs = numbers[0].0.min(numbers[1].0)..numbers[0].1.max(numbers[1].1);
            if pairs.end.saturating_sub(pairs.start) > MAX_PAIRS {
                continue;
            }
            for k in pairs {
                let [start, end] = [position[1], position[1] + change[1]].map(|x| self.past_ends(flank, x, 0.0, k));
                for (from, to) in start.into_iter().zip(end) {
                    if let Some(t) = quotient(from, from - to)
                        && t > 0.0
                        && t <= 1.0
                    {
                        visit(t);
                    }
                }
            }
        }
    }

    /// Kind of contact of pair `k` of `flank`, or `None` if the pair does not touch.
    #[inline(always)]
    fn spot<const OPEN: bool>(
        &self,
        flank: Flank,
        x: f64,
        approach: f64,
        k: i64,
        opening: impl Fn(f64) -> f64,
    ) -> Option<Spot> {
        let [past_planet_tip, past_side_tip] = self.past_ends(flank, x, approach, k);
        let depth = if OPEN { approach - opening(self.high + past_planet_tip) } else { approach };
        let touches =
            |i: usize, delta: f64| delta * delta < depth * self.corner[i].spread && self.corner[i].at(delta).v < depth;
        if past_planet_tip > 0.0 {
            (self.corner_contact && touches(0, past_planet_tip)).then_some(Spot::PlanetTip)
        } else if past_side_tip > 0.0 {
            (self.corner_contact && touches(1, past_side_tip)).then_some(Spot::SideTip)
        } else {
            (!OPEN || depth > 0.0).then_some(Spot::Path)
        }
    }
}

/// Fraction just after `changed` becomes true, or `None` if this does not happen within [`WORTHWHILE`].
#[inline(never)]
fn first_change(changed: impl Fn(f64) -> bool) -> Option<f64> {
    if changed(WORTHWHILE.0) || !changed(WORTHWHILE.1) {
        return None;
    }
    let (mut before, mut after) = WORTHWHILE;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (before + after);
        if changed(middle) { after = middle } else { before = middle }
    }
    Some(after)
}
