//! Gap of a tip corner to the mate's flank outside the path of contact.
//!
//! With Δ the arc by which the gear with the corner has turned past the end of the path, the corner stands at azimuth
//! χ = χ_end + Δ/sinδ_b1 about its own axis. Spherical trigonometry gives its polar angle φ₂ and azimuth η about the
//! mate's axis; the mate's flank passes through it when the mate is turned by θ₂ = η − inv₂(φ₂) + inv₂(δ₂). What is
//! left to the conjugate position is the gap g(Δ) = s − sinδ_b2 θ₂: zero with zero slope at the path's end, ≈ cΔ².
//!
//! The closed form costs five transcendental functions. The hot path reads a quintic Hermite table made from its
//! values and exact derivatives: twice continuously differentiable, so that no step of an integrator can feel it.

use super::pair::Pair;
use crate::numeric::{Jet, atan2, cos, sin, sqrt, tan};

/// Cells of the table, graded by the fourth power toward the path's end where the mate's flank may curve sharply.
const CELLS: usize = 128;

/// A path clipped at a base circle ends this far before it [rad]: on the circle itself the flank's curvature is infinite.
const CLIP_MARGIN: f64 = 1e-3;

/// Gap function of one corner.
#[derive(Clone, Debug)]
pub struct CornerGap {
    /// End of the path at this corner, as arc from the pitch point toward this corner's own tip [rad].
    pub end: f64,
    exact: ClosedForm,
    /// Largest Δ of the table [rad].
    span: f64,
    /// Lower bound of g/Δ² over the table.
    least_curvature: f64,
    cells: Box<[[f64; 6]; CELLS]>,
}

/// Where a corner touches: gap with derivatives, and the polar angles about both axes.
#[derive(Clone, Copy, Debug)]
pub struct CornerContact {
    /// Gap g [rad] with its derivatives by Δ.
    pub gap: Jet,
    /// Polar angle of the corner about its own axis: the tip angle [rad].
    pub own_polar: f64,
    /// Polar angle of the corner about the mate's axis [rad].
    pub mate_polar: f64,
}

#[derive(Clone, Copy, Debug)]
struct ClosedForm {
    end: f64,
    tip: f64,
    lever: f64,
    azimuth_at_end: f64,
    shaft_angle: f64,
    mate_base: f64,
    mate_inv_pitch: f64,
}

impl ClosedForm {
    fn at(&self, delta: f64) -> CornerContact {
        let delta = Jet::variable(delta);
        let chi = delta * (1.0 / self.lever) + Jet::constant(self.azimuth_at_end);
        let (st, ct) = (sin(self.tip), cos(self.tip));
        let (ss, cs) = (sin(self.shaft_angle), cos(self.shaft_angle));
        let (sb, cb) = (sin(self.mate_base), cos(self.mate_base));
        let cos_polar = chi.cos() * (ss * st) + Jet::constant(cs * ct);
        let eta = (chi.sin() * st).atan2(Jet::constant(ss * ct) - chi.cos() * (cs * st));
        // sinψ₂ cosδ_b2, and with it ψ₂ and inv₂
        let y = (Jet::constant(cb * cb) - cos_polar * cos_polar).sqrt();
        let inv = y.atan2(cos_polar) * (1.0 / sb) - y.atan2(cos_polar * sb);
        let turn = eta - inv + Jet::constant(self.mate_inv_pitch);
        let gap = delta + Jet::constant(self.end) - turn * sb;
        CornerContact { gap, own_polar: self.tip, mate_polar: crate::numeric::acos(cos_polar.v) }
    }
}

impl CornerGap {
    /// Gap of the tip corner of gear `i` (0 planet, 1 side gear) of `pair`, exact up to gaps of `reach` [rad].
    pub fn new(pair: &Pair, i: usize, reach: f64) -> Self {
        let (own, mate) = (&pair.gears[i], &pair.gears[1 - i]);
        let natural = pair.tip_arc[i] - pair.pitch_arc[i];
        let end = natural.min(pair.pitch_arc[1 - i] - CLIP_MARGIN);
        let lever = sin(own.base);
        let azimuth = |psi: f64| atan2(tan(psi), lever);
        let exact = ClosedForm {
            end,
            tip: own.polar_at(pair.pitch_arc[i] + end),
            lever,
            azimuth_at_end: azimuth(pair.pitch_arc[i] + end) - azimuth(pair.pitch_arc[i]),
            shaft_angle: pair.shaft_angle,
            mate_base: mate.base,
            mate_inv_pitch: mate.inv(mate.pitch),
        };
        // the table ends where the gap exceeds every approach the model admits
        let step = pair.base_pitch / 64.0;
        let count = (1..64).find(|&j| exact.at(step * f64::from(j)).gap.v > reach).unwrap_or(64);
        let span = step * f64::from(count);
        let knot = |j: usize| span * grade(j);
        let mut cells = Box::new([[0.0; 6]; CELLS]);
        let mut least_curvature = f64::INFINITY;
        let mut left = Jet { v: 0.0, d: 0.0, dd: exact.at(0.0).gap.dd };
        for (j, cell) in cells.iter_mut().enumerate() {
            let right = exact.at(knot(j + 1)).gap;
            *cell = quintic_hermite(left, right, knot(j + 1) - knot(j));
            least_curvature = least_curvature.min(right.v / (knot(j + 1) * knot(j + 1)));
            left = right;
        }
        // g is convex and g/Δ² monotone between neighbouring knots: a small margin makes the bound safe
        Self { end, exact, span, least_curvature: 0.9 * least_curvature, cells }
    }

    /// Gap and derivatives by the closed form, with the point of contact.
    pub fn exact(&self, delta: f64) -> CornerContact {
        self.exact.at(delta)
    }

    /// Gap g [rad], g′ and g″ at Δ = `delta` ≥ 0 [rad] from the table.
    #[inline]
    pub fn at(&self, delta: f64) -> Jet {
        let u = CELLS as f64 * sqrt(sqrt(delta / self.span));
        let j = (u as usize).min(CELLS - 1);
        let x = delta - self.span * grade(j);
        let c = &self.cells[j];
        Jet {
            v: c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5])))),
            d: c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5]))),
            dd: 2.0 * c[2] + x * (6.0 * c[3] + x * (12.0 * c[4] + x * 20.0 * c[5])),
        }
    }

    /// A Δ beyond which the gap exceeds `approach` [rad].
    #[inline]
    pub fn reach(&self, approach: f64) -> f64 {
        sqrt(approach / self.least_curvature)
    }
}

/// Position of knot `j` in the table's span.
fn grade(j: usize) -> f64 {
    let u = j as f64 / CELLS as f64;
    (u * u) * (u * u)
}

/// Coefficients of the quintic in x ∈ [0, h] that takes value, slope and curvature of `a` at 0 and of `b` at h.
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
                for k in 1..500 {
                    let delta = corner.span * f64::from(k) / 500.0;
                    let (table, exact) = (corner.at(delta), corner.exact(delta).gap);
                    assert!((table.v - exact.v).abs() < 1e-12, "{z_p}/{z_s} {i} {delta}: {table:?} {exact:?}");
                    assert!(table.v >= corner.least_curvature * delta * delta);
                }
                for j in 1..CELLS {
                    let knot = corner.span * grade(j);
                    let (a, b) = (corner.at(knot * (1.0 - 1e-13)), corner.at(knot * (1.0 + 1e-13)));
                    assert!((a.d - b.d).abs() < 1e-11 * (1.0 + b.d.abs()));
                    assert!((a.dd - b.dd).abs() < 1e-7 * (1.0 + b.dd.abs()), "{z_p}/{z_s} {i} {knot}: {a:?} {b:?}");
                }
                let end = corner.exact(0.0).gap;
                assert!(end.v.abs() < 1e-14 && end.d.abs() < 1e-12, "{end:?}");
            }
        }
    }
}
