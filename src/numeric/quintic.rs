//! Quintic Hermite cells: value, slope and curvature given at both ends, twice continuously differentiable where they meet.

use super::jet::Jet;

/// Coefficients by rising powers of the distance from a cell's start.
pub type Quintic = [f64; 6];

/// The quintic in x ∈ [0, h] that takes value, slope and curvature of `a` at 0 and of `b` at h.
pub fn quintic_hermite(a: Jet, b: Jet, h: f64) -> Quintic {
    let (c0, c1, c2) = (a.v, a.d, 0.5 * a.dd);
    let e0 = (b.v - (c0 + h * (c1 + h * c2))) / (h * h * h);
    let e1 = (b.d - (c1 + 2.0 * h * c2)) / (h * h);
    let e2 = (b.dd - 2.0 * c2) / h;
    let c3 = 10.0 * e0 - 4.0 * e1 + 0.5 * e2;
    let c4 = (-15.0 * e0 + 7.0 * e1 - e2) / h;
    let c5 = (6.0 * e0 - 3.0 * e1 + 0.5 * e2) / (h * h);
    [c0, c1, c2, c3, c4, c5]
}

/// Value and derivatives of the quintic `c` at `x`.
#[inline(always)]
pub fn quintic(c: &Quintic, x: f64) -> Jet {
    Jet {
        v: c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5])))),
        d: c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5]))),
        dd: 2.0 * c[2] + x * (6.0 * c[3] + x * (12.0 * c[4] + x * 20.0 * c[5])),
    }
}
