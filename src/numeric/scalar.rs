//! Formulas written once for plain numbers and for numbers with exact derivatives.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::elementary::{cos, pow, sin, sqrt};

/// Operations of formulas, implemented by `f64` for values only and by [`Dual`] for values with derivatives.
pub trait Scalar:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// True if values have derivatives.
    const HAS_SLOPES: bool;
    /// A constant.
    fn constant(value: f64) -> Self;
    /// The value without derivatives.
    fn value(self) -> f64;
    /// f(self), given f and its first two derivatives at this point.
    fn through(self, f: [f64; 3]) -> Self;

    /// Square root of a positive number.
    fn sqrt(self) -> Self {
        let root = sqrt(self.value());
        self.through([root, 0.5 / root, -0.25 / (root * self.value())])
    }
    /// Sine.
    fn sin(self) -> Self {
        let (s, c) = (sin(self.value()), cos(self.value()));
        self.through([s, c, -s])
    }
    /// Cosine.
    fn cos(self) -> Self {
        let (s, c) = (sin(self.value()), cos(self.value()));
        self.through([c, -s, -c])
    }
    /// Exponential.
    fn exp(self) -> Self {
        let f = libm::exp(self.value());
        self.through([f; 3])
    }
    /// Hyperbolic tangent.
    fn tanh(self) -> Self {
        let t = libm::tanh(self.value());
        let slope = 1.0 - t * t;
        self.through([t, slope, -2.0 * t * slope])
    }
    /// Arc tangent.
    fn atan(self) -> Self {
        let x = self.value();
        let slope = 1.0 / (1.0 + x * x);
        self.through([libm::atan(x), slope, -2.0 * x * slope * slope])
    }
    /// Natural logarithm of a positive number.
    fn ln(self) -> Self {
        let per = 1.0 / self.value();
        self.through([libm::log(self.value()), per, -per * per])
    }
    /// Power of a positive number with a constant exponent.
    fn powf(self, exponent: f64) -> Self {
        let f = pow(self.value(), exponent);
        let slope = exponent * f / self.value();
        self.through([f, slope, (exponent - 1.0) * slope / self.value()])
    }
    /// Magnitude; its slope at zero is defined as one.
    fn abs(self) -> Self {
        if self.value() < 0.0 { -self } else { self }
    }
}

impl Scalar for f64 {
    const HAS_SLOPES: bool = false;
    #[inline]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline]
    fn value(self) -> f64 {
        self
    }
    #[inline]
    fn through(self, f: [f64; 3]) -> Self {
        f[0]
    }
}

/// A value with its derivatives with respect to `K` variables (forward differentiation).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const K: usize> {
    /// Value.
    pub v: f64,
    /// Derivatives.
    pub d: [f64; K],
}

impl<const K: usize> Dual<K> {
    /// Variable number `i`.
    #[inline]
    pub fn variable(v: f64, i: usize) -> Self {
        let mut d = [0.0; K];
        d[i] = 1.0;
        Self { v, d }
    }

    #[inline]
    fn combine(v: f64, (a, x): (f64, &Self), (b, y): (f64, &Self)) -> Self {
        Self { v, d: std::array::from_fn(|i| a * x.d[i] + b * y.d[i]) }
    }
}

impl<const K: usize> Scalar for Dual<K> {
    const HAS_SLOPES: bool = true;
    #[inline]
    fn constant(v: f64) -> Self {
        Self { v, d: [0.0; K] }
    }
    #[inline]
    fn value(self) -> f64 {
        self.v
    }
    #[inline]
    fn through(self, f: [f64; 3]) -> Self {
        Self { v: f[0], d: self.d.map(|x| f[1] * x) }
    }
}

impl<const K: usize> Add for Dual<K> {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Self::combine(self.v + o.v, (1.0, &self), (1.0, &o))
    }
}

impl<const K: usize> Sub for Dual<K> {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        Self::combine(self.v - o.v, (1.0, &self), (-1.0, &o))
    }
}

impl<const K: usize> Mul for Dual<K> {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        Self::combine(self.v * o.v, (o.v, &self), (self.v, &o))
    }
}

impl<const K: usize> Div for Dual<K> {
    type Output = Self;
    #[inline]
    fn div(self, o: Self) -> Self {
        let (f, per) = (self.v / o.v, 1.0 / o.v);
        Self::combine(f, (per, &self), (-f * per, &o))
    }
}

impl<const K: usize> Neg for Dual<K> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl<const K: usize> Add<f64> for Dual<K> {
    type Output = Self;
    #[inline]
    fn add(self, o: f64) -> Self {
        Self { v: self.v + o, ..self }
    }
}

impl<const K: usize> Sub<f64> for Dual<K> {
    type Output = Self;
    #[inline]
    fn sub(self, o: f64) -> Self {
        Self { v: self.v - o, ..self }
    }
}

impl<const K: usize> Mul<f64> for Dual<K> {
    type Output = Self;
    #[inline]
    fn mul(self, o: f64) -> Self {
        Self { v: self.v * o, d: self.d.map(|x| x * o) }
    }
}
