//! A value with its first and second derivative by one variable: exact derivatives of closed forms at start-up.

use std::ops::{Add, Mul, Neg, Sub};

use super::elementary::{atan2, cos, sin, sqrt};

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
    /// A constant.
    pub fn constant(v: f64) -> Self {
        Self { v, d: 0.0, dd: 0.0 }
    }

    /// The variable itself.
    pub fn variable(v: f64) -> Self {
        Self { v, d: 1.0, dd: 0.0 }
    }

    /// f(self) for a function with value `f`, derivatives `f1` and `f2` at `self.v`.
    fn chain(self, f: f64, f1: f64, f2: f64) -> Self {
        Self { v: f, d: f1 * self.d, dd: f2 * self.d * self.d + f1 * self.dd }
    }

    /// Sine.
    pub fn sin(self) -> Self {
        let (s, c) = (sin(self.v), cos(self.v));
        self.chain(s, c, -s)
    }

    /// Cosine.
    pub fn cos(self) -> Self {
        let (s, c) = (sin(self.v), cos(self.v));
        self.chain(c, -s, -c)
    }

    /// Square root of a positive number.
    pub fn sqrt(self) -> Self {
        let r = sqrt(self.v);
        self.chain(r, 0.5 / r, -0.25 / (r * self.v))
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

impl Add for Jet {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { v: self.v + o.v, d: self.d + o.d, dd: self.dd + o.dd }
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}

impl Neg for Jet {
    type Output = Self;
    fn neg(self) -> Self {
        Self { v: -self.v, d: -self.d, dd: -self.dd }
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self { v: self.v * o.v, d: self.d * o.v + self.v * o.d, dd: self.dd * o.v + 2.0 * self.d * o.d + self.v * o.dd }
    }
}

impl Mul<f64> for Jet {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        Self { v: self.v * k, d: self.d * k, dd: self.dd * k }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_agree_with_central_differences() {
        let f = |x: Jet| (x.sin() * Jet::constant(2.0) + x * x).sqrt().atan2(x.cos() + x);
        let (x, h) = (0.7, 1e-4);
        let at = |x: f64| f(Jet::variable(x));
        let (m, c, p) = (at(x - h), at(x), at(x + h));
        assert!((c.d - (p.v - m.v) / (2.0 * h)).abs() < 1e-7);
        assert!((c.dd - (p.d - m.d) / (2.0 * h)).abs() < 1e-6);
    }
}
