//! Gap of a tip corner to the mate's flank outside the path of contact.
//!
//! Δ is the arc by which the gear with the corner has turned past the end of the path. The corner is then at the
//! azimuth χ = χ_end + Δ/sinδ_b1 about its own axis. Spherical trigonometry gives its polar angle φ₂ and azimuth η
//! about the mate's axis. The mate's flank passes through the corner if the mate is turned by θ₂ = η − inv₂(φ₂) +
//! inv₂(δ₂). The difference from the conjugate position is the gap g(Δ) = s − sinδ_b2 θ₂. It is zero with zero slope at
//! the end of the path and ≈ cΔ² beyond it.
//!
//! The closed form needs five transcendental functions. The simulation instead reads a quintic Hermite table built from
//! its values and exact derivatives. The table is twice continuously differentiable, so that it does not disturb the
//! integrator.

use std::sync::Arc;

use super::Pair;
use crate::numeric::{Jet, Scalar, acos, atan2, cos, sin, sin_cos, sqrt, tan};

/// Number of cells per doubling of Δ. Cells are finer toward the end of the path, where the mate's flank may curve
/// sharply, so that the relative error of the table is uniform. A cell is found from the exponent and leading bits of
/// Δ.
const CELLS_PER_OCTAVE: usize = 16;
/// Number of octaves of the table. Below them, one cell extends down to Δ = 0.
const OCTAVES: usize = 24;
const CELLS: usize = OCTAVES * CELLS_PER_OCTAVE + 1;
/// Number of low bits of a double that do not select the cell.
const SHIFT: u32 = 52 - CELLS_PER_OCTAVE.ilog2();

/// Distance before a base circle at which a clipped path ends, in base pitches (0.3 % of a contact ratio of one). On
/// the circle itself, the curvature of the flank is infinite.
const CLIP_MARGIN: f64 = 3e-3;
/// Steps per base pitch, and number of steps, in the search for the end of the table.
const SEARCH: (f64, i32) = (64.0, 256);

/// Start of a cell of the table, and the coefficients of its quintic. A cell fills one cache line.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(64))]
struct Cell {
    knot: f64,
    c: [f64; 6],
}

/// Gap function of one corner.
#[derive(Clone, Debug)]
pub struct CornerGap {
    /// End of the path at this corner, as an arc from the pitch point toward the corner's own tip [rad].
    pub end: f64,
    exact: CornerTravel,
    per_sin_base: f64,
    /// First cell boundary above 0, a power of two, stored as its bits shifted to count cells.
    first: u64,
    /// Reciprocal of a lower bound of g/Δ² over the table. At approach a, a corner with Δ² ≥ a·spread does not touch
    /// the flank.
    pub spread: f64,
    cells: Arc<[Cell; CELLS]>,
}

/// Contact of a corner: gap with derivatives, and polar angles about both axes.
#[derive(Clone, Copy, Debug)]
pub struct CornerContact {
    /// Gap g [rad] with its derivatives with respect to Δ.
    pub gap: Jet,
    /// Polar angle of the corner about its own axis: the tip angle [rad].
    pub own_polar: f64,
    /// Azimuth of the corner about its own axis from the plane of both axes [rad].
    pub own_azimuth: f64,
    /// Polar angle of the corner about the mate's axis [rad].
    pub mate_polar: f64,
}

/// Travel of a corner past the end of the path, in closed form.
#[derive(Clone, Copy, Debug)]
pub struct CornerTravel {
    /// End of the path at this corner, as an arc from the pitch point toward the corner's own tip [rad].
    pub end: f64,
    tip: f64,
    sin_tip: f64,
    sin_base: f64,
    azimuth_at_end: f64,
    mate_sin_base: f64,
    mate_cos_base: f64,
    mate_inv_pitch: f64,
    /// sin²φ of the tip, then a and b of cosφ₂ = a + b cosχ, with the polar angle φ₂ of the corner about the mate's
    /// axis.
    polar: [f64; 3],
    /// a and b of a − b cosχ, the component of the corner across the mate's axis in the plane of both axes.
    across: [f64; 2],
}

impl CornerTravel {
    /// Returns the closed form for the tip corner of gear `i` (0 planet, 1 side gear) of `pair`.
    pub fn new(pair: &Pair, i: usize) -> Self {
        let (own, mate) = (&pair.gears[i], &pair.gears[1 - i]);
        let natural = pair.tip_arc[i] - pair.pitch_arc[i];
        let end = natural.min(pair.pitch_arc[1 - i] - CLIP_MARGIN * pair.base_pitch);
        let sin_base = sin(own.base);
        let azimuth = |psi: f64| atan2(tan(psi), sin_base);
        let tip = own.polar_at(pair.pitch_arc[i] + end);
        let [(ss, cs), (st, ct)] = [pair.shaft_angle, tip].map(|angle| (sin(angle), cos(angle)));
        Self {
            end,
            tip,
            polar: [st * st, cs * ct, ss * st],
            across: [ss * ct, cs * st],
            sin_tip: st,
            sin_base,
            azimuth_at_end: azimuth(pair.pitch_arc[i] + end) - azimuth(pair.pitch_arc[i]),
            mate_sin_base: sin(mate.base),
            mate_cos_base: cos(mate.base),
            mate_inv_pitch: mate.inv(mate.pitch),
        }
    }

    /// Gap and point of contact at Δ = `delta` [rad].
    pub fn at(&self, delta: f64) -> CornerContact {
        let delta = Jet::variable(delta);
        let chi = delta * (1.0 / self.sin_base) + Jet::constant(self.azimuth_at_end);
        let (sb, cb) = (self.mate_sin_base, self.mate_cos_base);
        let ([_, along, by_cosine], [across, less]) = (self.polar, self.across);
        let cos_polar = chi.cos() * by_cosine + Jet::constant(along);
        let eta = (chi.sin() * self.sin_tip).atan2(Jet::constant(across) - chi.cos() * less);
        // sinψ₂ cosδ_b2, from which ψ₂ and inv₂ follow
        let y = (Jet::constant(cb * cb) - cos_polar * cos_polar).sqrt();
        let inv = y.atan2(cos_polar) * (1.0 / sb) - y.atan2(cos_polar * sb);
        let turn = eta - inv + Jet::constant(self.mate_inv_pitch);
        let gap = delta + Jet::constant(self.end) - turn * sb;
        CornerContact { gap, own_polar: self.tip, own_azimuth: chi.v, mate_polar: acos(cos_polar.v) }
    }

    /// Arc ψ of the mate's flank at the corner, at Δ = `delta` [rad], from cosφ₂ = cosδ_b2 cosψ.
    pub fn mate_arc(&self, delta: f64) -> f64 {
        let ([_, along, by_cosine], cos_base) = (self.polar, self.mate_cos_base);
        let cos_polar = along + by_cosine * cos(delta / self.sin_base + self.azimuth_at_end);
        atan2(sqrt(((cos_base - cos_polar) * (cos_base + cos_polar)).max(0.0)), cos_polar)
    }
}

impl CornerGap {
    /// Tabulates the gap of the tip corner of gear `i` (0 planet, 1 side gear) of `pair`. The table extends to gaps of
    /// `reach` [rad] or to four base pitches past the end of the path, whichever comes first. Beyond it, the gap
    /// continues quadratically.
    pub fn new(pair: &Pair, i: usize, reach: f64) -> Self {
        let exact = CornerTravel::new(pair, i);
        // the table ends where the gap exceeds every approach in the model
        let step = pair.base_pitch / SEARCH.0;
        let known = |j: &i32| exact.at(step * f64::from(*j)).gap.v.is_finite();
        let mut span = step;
        for j in (1..=SEARCH.1).take_while(known) {
            span = step * f64::from(j);
            if exact.at(span).gap.v > reach {
                break;
            }
        }
        // the power of two above the span ends the table
        let smallest = f64::from_bits(((span.to_bits() >> 52) + 1 - OCTAVES as u64) << 52);
        let first = smallest.to_bits() >> SHIFT;
        // allocated directly on the heap, because it is large for a small stack
        let mut cells = vec![Cell::default(); CELLS];
        let mut least_curvature = f64::INFINITY;
        let (mut from, mut left) = (0.0, Jet { v: 0.0, d: 0.0, dd: exact.at(0.0).gap.dd });
        for (j, cell) in cells.iter_mut().enumerate() {
            let to = f64::from_bits((first + j as u64) << SHIFT);
            // beyond the span, the gap continues quadratically
            let right = if to <= span { exact.at(to).gap } else { grow(exact.at(span).gap, to - span) };
            *cell = Cell { knot: from, c: quintic_hermite(left, right, to - from) };
            least_curvature = least_curvature.min(0.5 * right.dd);
            (from, left) = (to, right);
        }
        // g/Δ² is a mean of g″/2 over [0, Δ]; the margin covers values between knots
        Self {
            end: exact.end,
            per_sin_base: 1.0 / exact.sin_base,
            exact,
            first,
            spread: 1.0 / (0.9 * least_curvature),
            cells: Arc::<[Cell]>::from(cells).try_into().expect("a table of CELLS cells"),
        }
    }

    /// Gap and derivatives from the closed form, with the point of contact.
    pub fn exact(&self, delta: f64) -> CornerContact {
        self.exact.at(delta)
    }

    /// sin² of the corner's polar angle about its own axis, and sin² of its polar angle about the mate's axis with the
    /// slope, at Δ = `delta`.
    #[inline]
    pub fn sines_squared(&self, delta: f64) -> (f64, [f64; 2]) {
        let [own, along, across] = self.exact.polar;
        let per = self.per_sin_base;
        let (sin, cos) = sin_cos(delta * per + self.exact.azimuth_at_end);
        let cos_mate = along + across * cos;
        (own, [1.0 - cos_mate * cos_mate, 2.0 * cos_mate * sin * across * per])
    }

    /// Gap g [rad], g′ and g″ at Δ = `delta` ≥ 0 [rad] from the table.
    #[inline(always)]
    pub fn at(&self, delta: f64) -> Jet {
        let count = delta.to_bits() >> SHIFT;
        let j = ((count + 1).saturating_sub(self.first) as usize).min(CELLS - 1);
        let Cell { knot, c } = &self.cells[j];
        let x = delta - knot;
        Jet {
            v: c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5])))),
            d: c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5]))),
            dd: 2.0 * c[2] + x * (6.0 * c[3] + x * (12.0 * c[4] + x * 20.0 * c[5])),
        }
    }

    /// Distance Δ beyond which the gap exceeds `approach` [rad].
    #[inline]
    pub fn reach(&self, approach: f64) -> f64 {
        sqrt(approach * self.spread)
    }
}

/// Quadratic continuation of `gap` by `x`.
fn grow(gap: Jet, x: f64) -> Jet {
    Jet { v: gap.v + x * (gap.d + 0.5 * x * gap.dd), d: gap.d + x * gap.dd, dd: gap.dd }
}

/// Coefficients of the quintic in x ∈ [0, h] with the value, slope and curvature of `a` at 0 and of `b` at h.
fn quintic_hermite(a: Jet, b: Jet, h: f64) -> [f64; 6] {
    let (c0, c1, c2) = (a.v, a.d, 0.5 * a.dd);
    let e0 = (b.v - (c0 + h * (c1 + h * c2))) / (h * h * h);
    let e1 = (b.d - (c1 + 2.0 * h * c2)) / (h * h);
    let e2 = (b.dd - 2.0 * c2) / h;
    let c3 = 10.0 * e0 - 4.0 * e1 + 0.5 * e2;
    let c4 = (-15.0 * e0 + 7.0 * e1 - e2) / h;
    let c5 = (6.0 * e0 - 3.0 * e1 + 0.5 * e2) / (h * h);
    [c0, c1, c2, c3, c4, c5]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::GearSpec;

    #[test]
    fn golden_gaps_of_the_default_pair() {
        let pair = Pair::new(&GearSpec { backlash: 0.0, ..GearSpec::default() });
        let planet = CornerGap::new(&pair, 0, 0.1);
        let side = CornerGap::new(&pair, 1, 0.1);
        for (delta, p, s) in
            [(0.01, 1.993971e-4, 3.893746e-4), (0.02, 7.971583e-4, 1.324971e-3), (0.03, 1.794029e-3, 2.728913e-3)]
        {
            assert!((planet.at(delta).v - p).abs() < 1e-9, "{} {p}", planet.at(delta).v);
            assert!((side.at(delta).v - s).abs() < 1e-9, "{} {s}", side.at(delta).v);
        }
    }

    #[test]
    fn table_equals_closed_form_and_is_twice_differentiable() {
        for (z_p, z_s, alpha) in [(10, 16, 20.0f64), (9, 14, 22.5), (14, 14, 25.0), (6, 40, 20.0), (12, 15, 14.5)] {
            let spec = GearSpec {
                planet_teeth: z_p,
                side_teeth: z_s,
                pressure_angle: alpha.to_radians(),
                ..GearSpec::default()
            };
            let pair = Pair::new(&spec);
            for i in 0..2 {
                let corner = CornerGap::new(&pair, i, 0.1);
                let span = pair.base_pitch / 2.0;
                for k in 1..500 {
                    let delta = span * f64::from(k) / 500.0;
                    let contact = corner.exact(delta);
                    let (table, exact) = (corner.at(delta), contact.gap);
                    if exact.v > 0.1 {
                        break;
                    }
                    let arc = pair.gears[1 - i].action_arc(contact.mate_polar);
                    assert!((corner.exact.mate_arc(delta) / arc - 1.0).abs() < 1e-10, "{z_p}/{z_s} {i} {delta}");
                    // the rounding error of the closed form is 1e-15 in g and grows with 1/Δ in its slope
                    let rounding = 1e-14 / delta;
                    assert!((table.v - exact.v).abs() < 1e-11 * exact.v + 2e-15, "{z_p}/{z_s} {i} {delta}");
                    assert!((table.d - exact.d).abs() < 1e-9 * exact.d + rounding, "{z_p}/{z_s} {i} {delta}");
                    assert!(table.v * corner.spread >= delta * delta && corner.spread > 0.0);
                }
                for j in 0..CELLS as u64 {
                    let knot = f64::from_bits((corner.first + j) << SHIFT);
                    let (a, b) = (corner.at(f64::from_bits(knot.to_bits() - 1)), corner.at(knot));
                    assert!((a.v - b.v).abs() < 1e-15 * (1.0 + b.v));
                    assert!((a.d - b.d).abs() < 1e-13 * (1.0 + b.d.abs()), "{z_p}/{z_s} {i} {knot}: {a:?} {b:?}");
                    assert!((a.dd - b.dd).abs() < 1e-9 * (1.0 + b.dd.abs()), "{z_p}/{z_s} {i} {knot}: {a:?} {b:?}");
                }
                let end = corner.exact(0.0).gap;
                assert!(end.v.abs() < 1e-14 && end.d.abs() < 1e-12, "{end:?}");
            }
        }
    }
}
