//! A value with its first and second derivative with respect to one variable, used at initialisation to differentiate
//! closed forms exactly.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Scalar;
use super::elementary::atan2;

/// Second-order Taylor arithmetic: value, first and second derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// Value.
    pub v: f64,
    /// First derivative.
    pub d: f64,
    /// Second derivative.
    pub dd: f64,
}

impl Jet {
    /// The variable itself.
    pub fn variable(v: f64) -> Self {
        Self { v, d: 1.0, dd: 0.0 }
    }

    /// Angle of the point (`x`, `self`).
    pub fn atan2(self, x: Self) -> Self {
        let (y, r2) = (self, self * self + x * x);
        // d atan2 = (x dy − y dx) / r²; differentiate once more for the second derivative
        let n = x.v * y.d - y.v * x.d;
        let dn = x.v * y.dd - y.v * x.dd;
        let w = 1.0 / r2.v;
        Self { v: atan2(y.v, x.v), d: n * w, dd: dn * w - n * r2.d * w * w }
    }
}

impl Scalar for Jet {
    const HAS_SLOPES: bool = true;
    #[inline]
    fn constant(v: f64) -> Self {
        Self { v, d: 0.0, dd: 0.0 }
    }
    #[inline]
    fn value(self) -> f64 {
        self.v
    }
    #[inline]
    fn through(self, f: [f64; 3]) -> Self {
        Self { v: f[0], d: f[1] * self.d, dd: f[2] * self.d * self.d + f[1] * self.dd }
    }
}

impl Add for Jet {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Self { v: self.v + o.v, d: self.d + o.d, dd: self.dd + o.dd }
    }
}

impl Sub for Jet {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}

impl Neg for Jet {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { v: -self.v, d: -self.d, dd: -self.dd }
    }
}

impl Mul for Jet {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        Self { v: self.v * o.v, d: self.d * o.v + self.v * o.d, dd: self.dd * o.v + 2.0 * self.d * o.d + self.v * o.dd }
    }
}

impl Mul<f64> for Jet {
    type Output = Self;
    #[inline]
    fn mul(self, k: f64) -> Self {
        Self { v: self.v * k, d: self.d * k, dd: self.dd * k }
    }
}

impl Div for Jet {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let r = 1.0 / o.v;
        self * o.through([r, -r * r, 2.0 * r * r * r])
    }
}

impl Add<f64> for Jet {
    type Output = Self;
    #[inline]
    fn add(self, o: f64) -> Self {
        Self { v: self.v + o, ..self }
    }
}

impl Sub<f64> for Jet {
    type Output = Self;
    #[inline]
    fn sub(self, o: f64) -> Self {
        Self { v: self.v - o, ..self }
    }
}
