//! Numbers that depend on the angles of both gears of a pair, with exact derivatives.
//!
//! A quantity of one gear depends only on the angle of that gear, so it has one slope and one curvature. A quantity of
//! both gears has two slopes and three curvatures. Formulas are written once. `N` is the highest order of derivative
//! that is computed; values and slopes have the same bits at any order.

use std::ops::{Add, Mul, Sub};

/// A number that depends on the angle of one gear.
#[derive(Clone, Copy, Debug, Default)]
pub struct Single<const N: usize> {
    /// Value.
    pub v: f64,
    /// First derivative.
    pub d: f64,
    /// Second derivative.
    pub dd: f64,
}

/// A number that depends on two variables: the angles of planet and side gear, unless stated otherwise.
#[derive(Clone, Copy, Debug, Default)]
pub struct Both<const N: usize> {
    /// Value.
    pub v: f64,
    /// First derivatives.
    pub d: [f64; 2],
    /// Second derivatives: twice with respect to the first variable, with respect to both, twice with respect to the
    /// second.
    pub dd: [f64; 3],
}

/// Two numbers that depend on the angle of the same gear, computed together.
#[derive(Clone, Copy, Debug, Default)]
pub struct Twin<const N: usize> {
    v: [f64; 2],
    d: [f64; 2],
    dd: [f64; 2],
}

/// A function of two numbers a, b with its derivatives up to the second.
#[derive(Clone, Copy, Debug)]
pub struct Partials {
    /// f.
    pub v: f64,
    /// ∂f/∂a, ∂f/∂b.
    pub d: [f64; 2],
    /// ∂²f/∂a², ∂²f/∂a∂b, ∂²f/∂b².
    pub dd: [f64; 3],
}

impl<const N: usize> Single<N> {
    /// Returns a value with its derivatives.
    #[inline(always)]
    pub fn new(v: f64, d: f64, dd: f64) -> Self {
        Self { v, d: if N > 0 { d } else { 0.0 }, dd: if N > 1 { dd } else { 0.0 } }
    }

    /// f(self), given the values of f and its first two derivatives.
    #[inline(always)]
    pub fn through(self, f: [f64; 3]) -> Self {
        Self::new(f[0], f[1] * self.d, f[1] * self.dd + f[2] * self.d * self.d)
    }

    /// self/by, given 1/by.
    #[inline(always)]
    pub fn over(self, by: Self, per: f64) -> Self {
        let v = self.v * per;
        let d = (self.d - v * by.d) * per;
        Self::new(v, d, (self.dd - v * by.dd - 2.0 * d * by.d) * per)
    }
}

impl<const N: usize> Add for Single<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::new(self.v + o.v, self.d + o.d, self.dd + o.dd)
    }
}

impl<const N: usize> Sub for Single<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::new(self.v - o.v, self.d - o.d, self.dd - o.dd)
    }
}

impl<const N: usize> Mul for Single<N> {
    type Output = Self;
    // the product rule needs additions
    #[allow(clippy::suspicious_arithmetic_impl)]
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        let d = self.d * o.v + self.v * o.d;
        Self::new(self.v * o.v, d, self.dd * o.v + self.v * o.dd + 2.0 * self.d * o.d)
    }
}

impl<const N: usize> Twin<N> {
    /// Returns values with their derivatives.
    #[inline(always)]
    pub fn new(v: [f64; 2], d: [f64; 2], dd: [f64; 2]) -> Self {
        Self { v, d: if N > 0 { d } else { [0.0; 2] }, dd: if N > 1 { dd } else { [0.0; 2] } }
    }

    /// `sine`·sin θ + `cosine`·cos θ + `fixed`, given sine and cosine of the angle θ.
    #[inline(always)]
    pub fn turning(sine: [f64; 2], cosine: [f64; 2], fixed: [f64; 2], [s, c]: [f64; 2]) -> Self {
        let turning = plus(times(sine, s), times(cosine, c));
        Self::new(plus(turning, fixed), less(times(sine, c), times(cosine, s)), times(turning, -1.0))
    }

    /// Combines two numbers.
    #[inline(always)]
    pub fn of(a: Single<N>, b: Single<N>) -> Self {
        Self { v: [a.v, b.v], d: [a.d, b.d], dd: [a.dd, b.dd] }
    }

    /// Returns both numbers.
    #[inline(always)]
    pub fn parts(self) -> (Single<N>, Single<N>) {
        let part = |i: usize| Single { v: self.v[i], d: self.d[i], dd: self.dd[i] };
        (part(0), part(1))
    }

    /// self/by, given 1/by.
    #[inline(always)]
    pub fn over(self, by: Single<N>, per: f64) -> Self {
        let v = times(self.v, per);
        let d = times(less(self.d, times(v, by.d)), per);
        let dd = times(less(less(self.dd, times(v, by.dd)), times(d, 2.0 * by.d)), per);
        Self::new(v, d, dd)
    }

    /// self·x.
    #[inline(always)]
    pub fn times(self, x: Single<N>) -> Self {
        let d = plus(times(self.d, x.v), times(self.v, x.d));
        let dd = plus(plus(times(self.dd, x.v), times(self.v, x.dd)), times(self.d, 2.0 * x.d));
        Self::new(times(self.v, x.v), d, dd)
    }

    /// `at_zero` + self·x, where x belongs to the other gear. The angle of that gear is the first variable of both
    /// results.
    #[inline(always)]
    pub fn linear(self, at_zero: Self, x: Single<N>) -> (Both<N>, Both<N>) {
        let v = plus(at_zero.v, times(self.v, x.v));
        let (first, second) = (times(self.v, x.d), plus(at_zero.d, times(self.d, x.v)));
        let dd = [times(self.v, x.dd), times(self.d, x.d), plus(at_zero.dd, times(self.dd, x.v))];
        let part = |i: usize| Both::new(v[i], [first[i], second[i]], [dd[0][i], dd[1][i], dd[2][i]]);
        (part(0), part(1))
    }
}

impl<const N: usize> Sub for Twin<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::new(less(self.v, o.v), less(self.d, o.d), less(self.dd, o.dd))
    }
}

#[inline(always)]
fn plus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
fn less(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline(always)]
fn times(a: [f64; 2], x: f64) -> [f64; 2] {
    [a[0] * x, a[1] * x]
}

impl<const N: usize> Both<N> {
    /// Returns a value with its derivatives.
    #[inline(always)]
    pub fn new(v: f64, d: [f64; 2], dd: [f64; 3]) -> Self {
        Self { v, d: if N > 0 { d } else { [0.0; 2] }, dd: if N > 1 { dd } else { [0.0; 3] } }
    }

    /// Returns a number that depends only on the first variable.
    #[inline(always)]
    pub fn of_first(x: Single<N>) -> Self {
        Self::new(x.v, [x.d, 0.0], [x.dd, 0.0, 0.0])
    }

    /// Exchanges both variables.
    #[inline(always)]
    pub fn exchanged(self) -> Self {
        Self::new(self.v, [self.d[1], self.d[0]], [self.dd[2], self.dd[1], self.dd[0]])
    }

    /// self·x, where x depends on the first variable.
    #[inline(always)]
    pub fn times_first(self, x: Single<N>) -> Self {
        Self::new(
            self.v * x.v,
            [self.d[0] * x.v + self.v * x.d, self.d[1] * x.v],
            [
                self.dd[0] * x.v + self.v * x.dd + 2.0 * self.d[0] * x.d,
                self.dd[1] * x.v + self.d[1] * x.d,
                self.dd[2] * x.v,
            ],
        )
    }

    /// self + x, where x depends on the first variable.
    #[inline(always)]
    pub fn plus_first(self, x: Single<N>) -> Self {
        Self::new(self.v + x.v, [self.d[0] + x.d, self.d[1]], [self.dd[0] + x.dd, self.dd[1], self.dd[2]])
    }

    /// self − x, where x depends on the first variable.
    #[inline(always)]
    pub fn less_first(self, x: Single<N>) -> Self {
        Self::new(self.v - x.v, [self.d[0] - x.d, self.d[1]], [self.dd[0] - x.dd, self.dd[1], self.dd[2]])
    }

    /// self/by, given 1/by.
    #[inline(always)]
    pub fn over(self, by: Self, per: f64) -> Self {
        let v = self.v * per;
        let d = |i: usize| (self.d[i] - v * by.d[i]) * per;
        let d = [d(0), d(1)];
        let both = products(&d, &by.d);
        let dd = |i: usize| (self.dd[i] - v * by.dd[i] - both[i]) * per;
        Self::new(v, d, [dd(0), dd(1), dd(2)])
    }

    /// f(self), given the values of f and its first two derivatives.
    #[inline(always)]
    pub fn through(self, f: [f64; 3]) -> Self {
        let half = 0.5 * f[2];
        let own = products(&self.d, &self.d);
        let dd = |i: usize| f[1] * self.dd[i] + half * own[i];
        Self::new(f[0], [f[1] * self.d[0], f[1] * self.d[1]], [dd(0), dd(1), dd(2)])
    }

    /// f(a, b), given the values of f and its derivatives.
    #[inline(always)]
    pub fn through_both(a: Self, b: Self, f: &Partials) -> Self {
        let (aa, ab, bb) = (products(&a.d, &a.d), products(&a.d, &b.d), products(&b.d, &b.d));
        let (half_aa, half_bb) = (0.5 * f.dd[0], 0.5 * f.dd[2]);
        let d = |i: usize| f.d[0] * a.d[i] + f.d[1] * b.d[i];
        let dd = |i: usize| f.d[0] * a.dd[i] + f.d[1] * b.dd[i] + half_aa * aa[i] + f.dd[1] * ab[i] + half_bb * bb[i];
        Self::new(f.v, [d(0), d(1)], [dd(0), dd(1), dd(2)])
    }
}

/// Twice the products of first derivatives, in the order of the second derivatives.
#[inline(always)]
fn products(a: &[f64; 2], b: &[f64; 2]) -> [f64; 3] {
    [2.0 * a[0] * b[0], a[0] * b[1] + a[1] * b[0], 2.0 * a[1] * b[1]]
}

impl<const N: usize> Add for Both<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        let sum = |i: usize| self.dd[i] + o.dd[i];
        Self::new(self.v + o.v, [self.d[0] + o.d[0], self.d[1] + o.d[1]], [sum(0), sum(1), sum(2)])
    }
}

impl<const N: usize> Sub for Both<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        let less = |i: usize| self.dd[i] - o.dd[i];
        Self::new(self.v - o.v, [self.d[0] - o.d[0], self.d[1] - o.d[1]], [less(0), less(1), less(2)])
    }
}

impl<const N: usize> Mul for Both<N> {
    type Output = Self;
    // the product rule needs additions
    #[allow(clippy::suspicious_arithmetic_impl)]
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        let both = products(&self.d, &o.d);
        let d = |i: usize| self.d[i] * o.v + self.v * o.d[i];
        let dd = |i: usize| self.dd[i] * o.v + self.v * o.dd[i] + both[i];
        Self::new(self.v * o.v, [d(0), d(1)], [dd(0), dd(1), dd(2)])
    }
}

impl<const N: usize> Mul<f64> for Both<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: f64) -> Self {
        Self::new(self.v * o, [self.d[0] * o, self.d[1] * o], [self.dd[0] * o, self.dd[1] * o, self.dd[2] * o])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A formula of a planet's angle x and a side gear's angle y that uses every operation.
    fn formula<const N: usize>(x: f64, y: f64) -> Both<N> {
        let planet = Single::<N>::new(x * x * x, 3.0 * x * x, 6.0 * x);
        let side = Single::<N>::new(1.0 / y, -1.0 / (y * y), 2.0 / (y * y * y));
        let root = planet.v.sqrt();
        let planet = planet.through([root, 0.5 / root, -0.25 / (root * planet.v)]) * planet - planet;
        let side = side.over(side * side + side, 1.0 / (side.v * side.v + side.v));
        let (p, s) = (Both::of_first(planet), Both::of_first(side).exchanged());
        let sum = (p * s).plus_first(planet).exchanged().times_first(side).less_first(side).exchanged() - s * p * 0.3;
        let (sine, cosine) = sum.v.sin_cos();
        let ratio = sum.through([sine, cosine, -sine]).over(p + s * s, 1.0 / (p.v + s.v * s.v));
        // f(a, b) = a² b³
        let (a, b) = (ratio.v, s.v);
        let cubic = Partials {
            v: a * a * b * b * b,
            d: [2.0 * a * b * b * b, 3.0 * a * a * b * b],
            dd: [2.0 * b * b * b, 6.0 * a * b * b, 6.0 * a * a * b],
        };
        Both::through_both(ratio, s, &cubic)
    }

    #[test]
    fn slopes_and_curvatures_agree_with_differences_and_values_at_any_order() {
        for (x, y) in [(0.7, -0.4), (1.3, 0.8)] {
            let (exact, h) = (formula::<2>(x, y), 1e-4);
            let (plain, slopes) = (formula::<0>(x, y), formula::<1>(x, y));
            assert_eq!((exact.v, exact.v, exact.d), (plain.v, slopes.v, slopes.d));
            assert_eq!((plain.d, slopes.dd), ([0.0; 2], [0.0; 3]));
            let at = |x: f64, y: f64| formula::<1>(x, y);
            for i in 0..2 {
                let moved = |k: f64| if i == 0 { at(x + k * h, y) } else { at(x, y + k * h) };
                // central differences of fourth order
                let by = |f: &dyn Fn(&Both<1>) -> f64| {
                    let of = |k: f64| f(&moved(k)) - f(&moved(-k));
                    (8.0 * of(1.0) - of(2.0)) / (12.0 * h)
                };
                let size = 1.0 + exact.dd.iter().fold(0.0f64, |m, d| m.max(d.abs()));
                assert!((exact.d[i] - by(&|f| f.v)).abs() < 1e-8 * size);
                for j in 0..2 {
                    assert!(
                        (exact.dd[i + j] - by(&|f| f.d[j])).abs() < 1e-8 * size,
                        "{i} {j}: {} {}",
                        exact.dd[i + j],
                        by(&|f| f.d[j])
                    );
                }
            }
        }
    }
}
