//! Motion of a tooth pair with q, x, w: converts derivatives with respect to approach, opening and position to mesh
//! coordinates.

use super::opening::Opened;
use super::sums::{Approach, By};
use super::{DetailedState, LOCAL, SlidingGeometry, WITH_OTHER};
use crate::contact::ToothPair;

/// Motion of a pair. If `OPEN`, its flanks may not fit.
#[derive(Clone, Copy, Debug)]
pub struct PairMotion<const OPEN: bool> {
    /// Approach of the flanks and its rates.
    pub approach: Approach,
    /// ∂a/∂q.
    pub sign: f64,
    /// ∂A/∂(q, x).
    pub slope: [f64; 2],
    /// ∂²A/∂q² = ∂²A/∂q∂x, and ∂²A/∂x².
    pub curvature: [f64; 2],
    /// ∂s/∂x.
    pub s_slope: f64,
    /// ∂E/∂x and ∂E/∂w = ν.
    pub opening: [f64; 2],
    /// ∂²E/∂x² and ∂²E/∂x∂w.
    pub opening_twice: [f64; 2],
    /// ∂Ȧ/∂(q, x).
    rate_slope: [f64; 2],
    /// ∂Ė/∂(x, w).
    opening_rate_slope: [f64; 2],
    /// Rates of q and x [rad/s].
    rate: [f64; 2],
    /// Derivatives of the own arc with respect to q, x, w of the pair's mesh and of the planet's other mesh, if gear
    /// bodies are elastic.
    pub own: [[f64; 3]; 2],
}

impl<const OPEN: bool> PairMotion<OPEN> {
    /// Returns the motion of `pair` with the own arc `own` [rad] and the opening `opened`.
    #[inline(always)]
    pub fn new(pair: &ToothPair, own: f64, opened: &Opened, state: &DetailedState) -> Self {
        let [dq, dx, dw] = state.rate;
        let ([nu, nu_slope], even) = (opened.axial, &opened.opening.even);
        let (slope, [qq, xx], s_slope) = (pair.slope, pair.curvature, pair.s_slope);
        let by_x = even.d * s_slope;
        let twice = [even.dd * s_slope * s_slope, nu_slope * s_slope];
        Self {
            approach: Approach {
                arc: own,
                rate: slope[0] * dq + slope[1] * dx,
                opening_rate: if OPEN { by_x * dx + nu * dw } else { 0.0 },
            },
            sign: pair.slope_of_approach(),
            slope,
            curvature: pair.curvature,
            s_slope,
            opening: [by_x, nu],
            opening_twice: twice,
            rate_slope: [qq * (dq + dx), qq * dq + xx * dx],
            opening_rate_slope: [twice[0] * dx + twice[1] * dw, twice[1] * dx],
            rate: [dq, dx],
            own: [[0.0; 3]; 2],
        }
    }

    /// Derivatives with respect to q, x, w, their rates, and then q, x, w of the other mesh. The argument holds the
    /// derivatives with respect to A, E, s, Ȧ, Ė.
    #[inline(always)]
    pub fn slopes<const WIDE: usize>(&self, &[arc, even, s, rate, opening_rate]: &By) -> [f64; WIDE] {
        let ([q, x], [ex, ew]) = (self.slope, self.opening);
        let mut slopes = [0.0; WIDE];
        let is_shared = WIDE == WITH_OTHER;
        let of_arc = if is_shared { self.own[0] } else { [q, x, 0.0] };
        let local = if OPEN {
            let by_w = even * ew + opening_rate * self.opening_rate_slope[1];
            [
                arc * of_arc[0] + rate * self.rate_slope[0],
                arc * of_arc[1]
                    + even * ex
                    + s * self.s_slope
                    + rate * self.rate_slope[1]
                    + opening_rate * self.opening_rate_slope[0],
                if is_shared { by_w + arc * of_arc[2] } else { by_w },
                rate * q,
                rate * x + opening_rate * ex,
                opening_rate * ew,
            ]
        } else {
            let by_x = arc * of_arc[1] + s * self.s_slope + rate * self.rate_slope[1];
            [arc * of_arc[0] + rate * self.rate_slope[0], by_x, 0.0, rate * q, rate * x, 0.0]
        };
        slopes[..LOCAL].copy_from_slice(&local);
        if is_shared {
            for (slope, other) in slopes[LOCAL..].iter_mut().zip(self.own[1]) {
                *slope = arc * other;
            }
        }
        slopes
    }

    /// Speeds of the flanks of planet and side gear along the line of action [rad/s].
    #[inline(always)]
    fn travel_rates(&self) -> [f64; 2] {
        let [dq, dx] = self.rate;
        [-self.sign * dx, -self.sign * (dx + dq)]
    }

    /// Sliding speed over R, and the sum of both flanks' speeds over R [rad/s].
    #[inline(always)]
    pub fn speeds(&self, geometry: &SlidingGeometry) -> [f64; 2] {
        let ([p, s], [planet, side]) = (self.travel_rates(), geometry.arm);
        [planet * p - side * s, planet * p + side * s]
    }

    /// Derivatives of both speeds with respect to x, and to the rates of q and x.
    #[inline(always)]
    pub fn speed_slopes(&self, geometry: &SlidingGeometry) -> [[f64; 3]; 2] {
        let ([p, s], [planet, side], [dp, ds]) = (self.travel_rates(), geometry.arm, geometry.arm_slope);
        [
            [(dp * p - ds * s) * self.s_slope, self.sign * side, self.sign * (side - planet)],
            [(dp * p + ds * s) * self.s_slope, -self.sign * side, -self.sign * (side + planet)],
        ]
    }
}
