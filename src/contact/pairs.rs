//! Tooth pairs in contact: their position on the path and their penetration.
//!
//! Coordinates: q = sinδ_bs·α − σ·sinδ_bp·ψ, the relative position measured from "tooth in the middle of the gap", and
//! x = σ·sinδ_bp·ψ + h, the planet's travel along the line of action. Both are arcs on the unit sphere [rad].
//! The drive flanks approach by a = −q − b_n/2, the coast flanks by a = q − b_n/2. Tooth pair k is at s = γ_p,pitch
//! sinδ_bp ± x + k p_b (+ drive, − coast) and penetrates by d = R (a − g). g is the corner gap beyond the planet's tip,
//! at Δ = s − s_hi, or beyond the side gear's tip, at Δ = s_lo − s + a. The corner of the side gear moves with the side
//! gear, whose own position is s − a.

pub use crate::geometry::action::Spot;

use std::ops::Range;

use crate::geometry::{CornerGap, Pair};

/// Loaded flank of the planet tooth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flank {
    /// Carrier drives the side gear forward.
    Drive,
    /// Side gear drives the carrier forward.
    Coast,
}

/// One loaded tooth pair, with the derivatives of its penetration arc p = d/R with respect to q and x.
#[derive(Clone, Copy, Debug)]
pub struct ToothPair {
    /// Flank in contact.
    pub flank: Flank,
    /// Kind of contact.
    pub spot: Spot,
    /// Number k of the pair, counted along the path.
    pub number: i64,
    /// Arc Δ past the end of the path, or the position s if the pair is on the path [rad].
    pub spot_arc: f64,
    /// Position s from the planet's rotation [rad]. It continues smoothly past the ends of the path.
    pub s: f64,
    /// ∂s/∂x; s does not depend on q.
    pub s_slope: f64,
    /// Penetration arc p = a − g [rad]. It is not positive if only excess material touches.
    pub depth: f64,
    /// ∂p/∂q and ∂p/∂x.
    pub slope: [f64; 2],
    /// ∂²p/∂q² = ∂²p/∂q∂x, and ∂²p/∂x² [1/rad].
    pub curvature: [f64; 2],
}

impl ToothPair {
    /// ∂a/∂q.
    #[inline(always)]
    pub fn slope_of_approach(&self) -> f64 {
        if self.flank == Flank::Drive { -1.0 } else { 1.0 }
    }

    /// The pair of a mesh with one spring, at the pitch point.
    #[inline(always)]
    pub fn single(flank: Flank, depth: f64) -> Self {
        let sign = if flank == Flank::Drive { -1.0 } else { 1.0 };
        Self {
            flank,
            spot: Spot::Path,
            number: 0,
            spot_arc: 0.0,
            s: 0.0,
            s_slope: 0.0,
            depth,
            slope: [sign, 0.0],
            curvature: [0.0; 2],
        }
    }
}

/// The tooth pairs of a planet with a side gear.
#[derive(Clone, Debug)]
pub struct Engagement {
    /// Gap functions of the planet's and the side gear's tip corner.
    pub corner: [CornerGap; 2],
    half_backlash: f64,
    base_pitch: f64,
    per_base_pitch: f64,
    /// Position s of a tooth pair whose planet tooth is centred on the plane of both axes [rad].
    centred: f64,
    /// Lower end of the path [rad].
    low: f64,
    /// Upper end of the path [rad].
    pub(super) high: f64,
    pub(super) corner_contact: bool,
    /// Ranges in which tooth pairs can touch: at working loads, and up to the largest approach.
    windows: [Window; 2],
}

/// Range of the line of action in which pairs can touch up to some approach.
#[derive(Clone, Copy, Debug)]
struct Window {
    /// Lower end [rad].
    low: f64,
    /// Number of tooth pairs that fit into the window. The fixed count bounds the work in any trial state.
    candidates: usize,
}

/// Approach [rad] up to which the narrow window is used: some tenths of a millimetre, more than at any working load.
const WORKING_APPROACH: f64 = 5e-3;

/// Margin that keeps rounding from losing a barely touching pair [base pitches].
const ROUNDING: f64 = 1e-9;

/// Smallest whole number not below `x`, for |x| below 2⁶³. Trial states may have absurd values.
#[inline(always)]
fn ceil(x: f64) -> f64 {
    // doubles from 2⁵² to 2⁵³ are whole numbers, so the sum is rounded to the nearest, and so is the difference
    const WHOLE: f64 = 1.5 * (1u64 << 52) as f64;
    let whole = if x.abs() < WHOLE / 3.0 { (x + WHOLE) - WHOLE } else { x as i64 as f64 };
    if whole < x { whole + 1.0 } else { whole }
}

impl Engagement {
    /// Tooth pairs of `pair` for approaches up to `reach` [rad].
    pub fn new(pair: &Pair, corner_contact: bool, reach: f64) -> Self {
        let corner = [CornerGap::new(pair, 0, reach), CornerGap::new(pair, 1, reach)];
        let low = -corner[1].end;
        let high = corner[0].end;
        let window = |approach: f64| {
            let beyond = |i: usize| if corner_contact { corner[i].reach(approach) } else { 0.0 };
            let length = beyond(1) + (high - low) + beyond(0);
            Window { low: low - beyond(1), candidates: libm::ceil(length / pair.base_pitch) as usize }
        };
        Self {
            windows: [window(WORKING_APPROACH), window(reach)],
            half_backlash: pair.normal_backlash / 2.0,
            base_pitch: pair.base_pitch,
            per_base_pitch: 1.0 / pair.base_pitch,
            centred: pair.centred_position(),
            low,
            high,
            corner,
            corner_contact,
        }
    }

    /// True if tip corners touch beyond the path. Otherwise, pairs enter and leave contact abruptly.
    #[inline(always)]
    pub fn corner_contact(&self) -> bool {
        self.corner_contact
    }

    /// Kind of contact of rigid teeth at the position `s` from the planet's rotation [rad], and its arc as in
    /// [`ToothPair`].
    pub fn rigid_spot(&self, s: f64) -> (Spot, f64) {
        if s > self.high {
            (Spot::PlanetTip, s - self.high)
        } else if s < self.low {
            (Spot::SideTip, self.low - s)
        } else {
            (Spot::Path, s)
        }
    }

    /// Half the normal backlash [rad].
    #[inline(always)]
    pub fn half_backlash(&self) -> f64 {
        self.half_backlash
    }

    /// Approach of the drive flanks a_d at relative position `q` [rad].
    #[inline(always)]
    pub fn drive_approach(&self, q: f64) -> f64 {
        -q - self.half_backlash
    }

    /// Approach of the flank pair that can be loaded, negative inside the backlash [rad].
    #[inline(always)]
    pub fn approach(&self, q: f64) -> f64 {
        q.abs() - self.half_backlash
    }

    /// The loaded tooth pairs at position (q, x).
    #[inline(always)]
    pub fn pairs(&self, [q, x]: [f64; 2]) -> LoadedPairs<'_> {
        // only one flank of a gap can be loaded
        let approach = self.approach(q);
        let flank = if q < 0.0 { Flank::Drive } else { Flank::Coast };
        let near = self.near_pairs(flank, x, approach, 0.0);
        LoadedPairs { near: if approach > 0.0 { near } else { NearPairs { left: 0..0, ..near } } }
    }

    /// First number of the pairs of `flank` that may touch, and the number after the last.
    #[inline(always)]
    pub(super) fn numbers(&self, flank: Flank, x: f64, approach: f64) -> (i64, i64) {
        let sign = if flank == Flank::Drive { -1.0 } else { 1.0 };
        let window = &self.windows[usize::from(approach > WORKING_APPROACH)];
        let first = ceil((window.low - (self.centred - sign * x)) * self.per_base_pitch - ROUNDING) as i64;
        (first, first.saturating_add(window.candidates as i64))
    }

    /// Arcs of pair `number` of `flank` past the planet's and the side gear's end of the path [rad].
    #[inline(always)]
    pub(super) fn past_ends(&self, flank: Flank, x: f64, approach: f64, number: i64) -> [f64; 2] {
        let sign = if flank == Flank::Drive { -1.0 } else { 1.0 };
        let s = self.centred - sign * x + number as f64 * self.base_pitch;
        [s - self.high, if self.corner_contact { self.low - s + approach } else { self.low - s }]
    }

    /// Calls `visit` with each tooth pair of `flank` that may touch at planet travel `x` and the given approach,
    /// including the penetrating pairs. `slack` is the part of `approach` that only excess material can close.
    #[inline(always)]
    pub fn near(&self, flank: Flank, x: f64, approach: f64, slack: f64, mut visit: impl FnMut(&ToothPair)) {
        for pair in self.near_pairs(flank, x, approach, slack) {
            visit(&pair);
        }
    }

    /// Iterator over the pairs that [`Self::near`] visits.
    #[inline(always)]
    fn near_pairs(&self, flank: Flank, x: f64, approach: f64, slack: f64) -> NearPairs<'_> {
        // sign = ∂a/∂q = −∂s/∂x
        let sign = if flank == Flank::Drive { -1.0 } else { 1.0 };
        let start = self.centred - sign * x;
        let window = &self.windows[usize::from(approach > WORKING_APPROACH)];
        let first = ceil((window.low - start) * self.per_base_pitch - ROUNDING);
        NearPairs {
            engagement: self,
            flank,
            sign,
            approach,
            slack,
            // if only excess material closes the gap, the side gear is ahead of the end of its path
            low: self.low + (approach - slack).min(0.0),
            s: start + first * self.base_pitch,
            // the pair number of an extreme trial state may be beyond the range of an integer
            first: first as i64,
            left: 0..window.candidates as i64,
        }
    }
}

/// Tooth pairs that may touch. As an iterator, it lets the compiler inline a sum over the pairs into the loop.
struct NearPairs<'a> {
    engagement: &'a Engagement,
    flank: Flank,
    sign: f64,
    approach: f64,
    slack: f64,
    low: f64,
    s: f64,
    first: i64,
    left: Range<i64>,
}

impl Iterator for NearPairs<'_> {
    type Item = ToothPair;

    #[inline(always)]
    fn next(&mut self) -> Option<ToothPair> {
        let Self { engagement, flank, sign, approach, slack, low, first, .. } = *self;
        loop {
            let i = self.left.next()?;
            let s = self.s;
            self.s += engagement.base_pitch;
            let past_planet_tip = s - engagement.high;
            let past_side_tip = engagement.low - s + (approach - slack);
            // penetration, its derivatives, and the kind of contact
            let (spot, delta, depth, slope, curvature) = if past_planet_tip > 0.0 {
                let corner = &engagement.corner[0];
                if past_planet_tip * past_planet_tip >= approach * corner.spread || !engagement.corner_contact {
                    continue;
                }
                let g = corner.at(past_planet_tip);
                (Spot::PlanetTip, past_planet_tip, approach - g.v, [sign, sign * g.d], [0.0, -g.dd])
            } else if past_side_tip > 0.0 && engagement.corner_contact {
                let corner = &engagement.corner[1];
                if past_side_tip * past_side_tip >= approach * corner.spread {
                    continue;
                }
                // Δ moves by `sign` with both q and x
                let g = corner.at(past_side_tip);
                let slope = [sign * (1.0 - g.d), -sign * g.d];
                (Spot::SideTip, past_side_tip, approach - g.v, slope, [-g.dd, -g.dd])
            } else if s >= low {
                (Spot::Path, s, approach, [sign, 0.0], [0.0; 2])
            } else {
                continue;
            };
            return Some(ToothPair {
                flank,
                spot,
                number: first.wrapping_add(i),
                spot_arc: delta,
                s,
                s_slope: -sign,
                depth: depth - slack,
                slope,
                curvature,
            });
        }
    }
}

/// The tooth pairs that are loaded.
pub struct LoadedPairs<'a> {
    near: NearPairs<'a>,
}

impl Iterator for LoadedPairs<'_> {
    type Item = ToothPair;

    #[inline(always)]
    fn next(&mut self) -> Option<ToothPair> {
        loop {
            let pair = self.near.next()?;
            if pair.depth > 0.0 {
                return Some(pair);
            }
        }
    }
}
