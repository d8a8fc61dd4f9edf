//! Kinks of a mesh's force: flanks touch or separate, a pair enters or leaves contact at a tip corner, or passes from the
//! corner to the path.
//!
//! A one-step method loses its order over a kink, and its error estimate does not show it. Positions are smooth, unlike
//! forces, so that a kink can be predicted from the present rates and a step can be made to end on it.

use super::{Engagement, Flank, Spot};

/// Fractions of a step between which it is cut at a kink: one at either end does no harm.
const WORTHWHILE: (f64, f64) = (3e-4, 0.9997);
/// Largest number of pairs searched in a motion. A motion past more of them, a whole turn of a gear and more, resolves
/// none, and at absurd speeds the search would not end.
const MOST_PAIRS: i64 = 256;
/// Bisections that locate a kink, to some hundred-thousandths of the step.
const HALVINGS: u32 = 15;

impl Engagement {
    /// The fraction of the motion from `position` to `position + change` (both (q, x)) after which the first kink lies,
    /// taken as straight; `None` if there is none. If `OPEN`, `opening` is the gap between the flanks of a pair, by its number and
    /// its place on the path [rad], negative for excess material. Where flanks that fit would be apart, it is not asked.
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
        if pairs.end.saturating_sub(pairs.start) > MOST_PAIRS {
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

    /// The fraction of the motion from `q` to `q + change`, taken as straight, after which the flanks that touch at its begin
    /// separate, or after which flanks touch if none did; `None` if they do not.
    pub fn kink_of_touch(&self, q: f64, change: f64) -> Option<f64> {
        let touching = self.approach(q) > 0.0;
        first_change(|t| {
            let end = q + t * change;
            // across the lash are other flanks
            (self.approach(end) > 0.0 && (!touching || end * q > 0.0)) != touching
        })
    }

    /// For meshes without corner contact: calls `visit` with the fractions of the motion at which a pair of either flank, loaded or
    /// not, passes an end of the path.
    pub fn jumps(&self, position: [f64; 2], change: [f64; 2], mut visit: impl FnMut(f64)) {
        for flank in [Flank::Drive, Flank::Coast] {
            let numbers = [position[1], position[1] + change[1]].map(|x| self.numbers(flank, x, 0.0));
            let pairs = numbers[0].0.min(numbers[1].0)..numbers[0].1.max(numbers[1].1);
            if pairs.end.saturating_sub(pairs.start) > MOST_PAIRS {
                continue;
            }
            for k in pairs {
                let [start, end] = [position[1], position[1] + change[1]].map(|x| self.past_ends(flank, x, 0.0, k));
                for (from, to) in start.into_iter().zip(end) {
                    let t = from / (from - to);
                    if t > 0.0 && t <= 1.0 {
                        visit(t);
                    }
                }
            }
        }
    }

    /// Where pair `k` of `flank` touches, if it does.
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

/// The fraction just past the point at which `changed` turns true, if it lies within [`WORTHWHILE`].
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
