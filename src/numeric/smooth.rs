//! Formulas that are differentiated twice: written once for values, for values with slopes, and for values with slopes
//! and curvatures by two variables.

use std::ops::{Add, Mul, Sub};

use super::scalar::Dual;

/// Operations of such formulas.
pub trait Smooth:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// A constant.
    fn constant(value: f64) -> Self;
    /// The value alone.
    fn value(self) -> f64;
    /// f(self), given f and its first two derivatives there.
    fn through(self, f: [f64; 3]) -> Self;
    /// f(a, b), given f and its derivatives there.
    fn through_both(a: Self, b: Self, f: &Partials) -> Self;

    /// 1/self.
    #[inline(always)]
    fn reciprocal(self) -> Self {
        let r = 1.0 / self.value();
        self.through([r, -r * r, 2.0 * r * r * r])
    }
}

/// A function of two variables a, b with its derivatives up to the second.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Partials {
    /// f.
    pub v: f64,
    /// ∂f/∂a, ∂f/∂b.
    pub d: [f64; 2],
    /// ∂²f/∂a², ∂²f/∂a∂b, ∂²f/∂b².
    pub dd: [f64; 3],
}

impl Smooth for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn value(self) -> f64 {
        self
    }
    #[inline(always)]
    fn through(self, f: [f64; 3]) -> Self {
        f[0]
    }
    #[inline(always)]
    fn through_both(_: Self, _: Self, f: &Partials) -> Self {
        f.v
    }
}

impl Smooth for Dual<2> {
    #[inline(always)]
    fn constant(v: f64) -> Self {
        Self { v, d: [0.0; 2] }
    }
    #[inline(always)]
    fn value(self) -> f64 {
        self.v
    }
    #[inline(always)]
    fn through(self, f: [f64; 3]) -> Self {
        Self { v: f[0], d: self.d.map(|d| f[1] * d) }
    }
    #[inline(always)]
    fn through_both(a: Self, b: Self, f: &Partials) -> Self {
        Self { v: f.v, d: [0, 1].map(|i| f.d[0] * a.d[i] + f.d[1] * b.d[i]) }
    }
}

/// A value with its first and second derivatives by two variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curved {
    /// Value.
    pub v: f64,
    /// First derivatives.
    pub d: [f64; 2],
    /// Second derivatives: by the first twice, by both, by the second twice.
    pub dd: [f64; 3],
}

impl Curved {
    /// Variable number `i` of the two.
    pub fn variable(v: f64, i: usize) -> Self {
        let mut d = [0.0; 2];
        d[i] = 1.0;
        Self { v, d, dd: [0.0; 3] }
    }
}

/// The products of first derivatives that belong to the second ones.
#[inline(always)]
fn products(a: &[f64; 2], b: &[f64; 2]) -> [f64; 3] {
    [a[0] * b[0], 0.5 * (a[0] * b[1] + a[1] * b[0]), a[1] * b[1]]
}

impl Smooth for Curved {
    #[inline(always)]
    fn constant(v: f64) -> Self {
        Self { v, d: [0.0; 2], dd: [0.0; 3] }
    }
    #[inline(always)]
    fn value(self) -> f64 {
        self.v
    }
    #[inline(always)]
    fn through(self, f: [f64; 3]) -> Self {
        let own = products(&self.d, &self.d);
        Self { v: f[0], d: self.d.map(|d| f[1] * d), dd: std::array::from_fn(|i| f[1] * self.dd[i] + f[2] * own[i]) }
    }
    #[inline(always)]
    fn through_both(a: Self, b: Self, f: &Partials) -> Self {
        let (aa, ab, bb) = (products(&a.d, &a.d), products(&a.d, &b.d), products(&b.d, &b.d));
        Self {
            v: f.v,
            d: std::array::from_fn(|i| f.d[0] * a.d[i] + f.d[1] * b.d[i]),
            dd: std::array::from_fn(|i| {
                f.d[0] * a.dd[i] + f.d[1] * b.dd[i] + f.dd[0] * aa[i] + 2.0 * f.dd[1] * ab[i] + f.dd[2] * bb[i]
            }),
        }
    }
}

impl Add for Curved {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self {
            v: self.v + o.v,
            d: std::array::from_fn(|i| self.d[i] + o.d[i]),
            dd: std::array::from_fn(|i| self.dd[i] + o.dd[i]),
        }
    }
}

impl Sub for Curved {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self {
            v: self.v - o.v,
            d: std::array::from_fn(|i| self.d[i] - o.d[i]),
            dd: std::array::from_fn(|i| self.dd[i] - o.dd[i]),
        }
    }
}

impl Mul for Curved {
    type Output = Self;
    // the product rule adds
    #[allow(clippy::suspicious_arithmetic_impl)]
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        let both = products(&self.d, &o.d);
        Self {
            v: self.v * o.v,
            d: std::array::from_fn(|i| self.d[i] * o.v + self.v * o.d[i]),
            dd: std::array::from_fn(|i| self.dd[i] * o.v + self.v * o.dd[i] + 2.0 * both[i]),
        }
    }
}

impl Add<f64> for Curved {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: f64) -> Self {
        Self { v: self.v + o, ..self }
    }
}

impl Sub<f64> for Curved {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: f64) -> Self {
        Self { v: self.v - o, ..self }
    }
}

impl Mul<f64> for Curved {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: f64) -> Self {
        Self { v: self.v * o, d: self.d.map(|d| d * o), dd: self.dd.map(|d| d * o) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn formula<T: Smooth>(x: T, y: T) -> T {
        let r = (x * y + y * y + 3.0).reciprocal();
        let (v, s, c) = ((x - y).value(), (x - y).value().sin(), (x - y).value().cos());
        let sine = (x - y).through([s, c, -s]);
        // f(a, b) = a² b³
        let (a, b) = (r.value(), sine.value());
        let both = Partials {
            v: a * a * b * b * b,
            d: [2.0 * a * b * b * b, 3.0 * a * a * b * b],
            dd: [2.0 * b * b * b, 6.0 * a * b * b, 6.0 * a * a * b],
        };
        let _ = v;
        T::through_both(r, sine, &both) + x * 2.0 * r - y * y * x
    }

    #[test]
    fn slopes_and_curvatures_agree_with_differences() {
        let (x, y, h) = (0.7, -0.4, 1e-5);
        let exact = formula(Curved::variable(x, 0), Curved::variable(y, 1));
        let slope = |x: f64, y: f64| formula(Dual::<2>::variable(x, 0), Dual::variable(y, 1)).d;
        assert_eq!(exact.v, formula(x, y));
        assert_eq!(exact.d, slope(x, y));
        let by_x = [0, 1].map(|i| (slope(x + h, y)[i] - slope(x - h, y)[i]) / (2.0 * h));
        let by_y = [0, 1].map(|i| (slope(x, y + h)[i] - slope(x, y - h)[i]) / (2.0 * h));
        for (a, b) in [(exact.dd[0], by_x[0]), (exact.dd[1], by_x[1]), (exact.dd[1], by_y[0]), (exact.dd[2], by_y[1])] {
            assert!((a - b).abs() < 1e-8, "{a} {b}");
        }
        let value = (formula(x + h, y) - formula(x - h, y)) / (2.0 * h);
        assert!((exact.d[0] - value).abs() < 1e-8);
    }
}
