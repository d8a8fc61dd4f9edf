//! The exponential function, and its mean over an interval, which is the integral over a piece of a contact patch.

use super::turned::Partials;
use crate::numeric::sqrt;

/// Constant whose sum with a number below 2⁵¹ contains that number, rounded, in its lowest bits.
const WHOLE: f64 = 1.5 * (1u64 << 52) as f64;
/// ln 2 in two parts. The first part is short enough for whole multiples of it to be exact.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];
/// Number of bits of a double below its exponent.
const EXPONENT: u32 = 52;
/// Smallest exponent: e to this power is negligible, but still a normal number.
const MIN_EXPONENT: f64 = -700.0;

/// Inline e^x for x < 700, accurate to two roundings. It is 2^k e^r with whole k and |r| ≤ ln 2 / 2, and e^r is its
/// Taylor series up to r¹³. Below −700 the result is e⁻⁷⁰⁰.
#[inline(always)]
pub fn exp(x: f64) -> f64 {
    let x = if x < MIN_EXPONENT { MIN_EXPONENT } else { x };
    let whole = x * std::f64::consts::LOG2_E + WHOLE;
    let k = whole - WHOLE;
    let r = (x - k * LN_2[0]) - k * LN_2[1];
    let (r2, pair) = (r * r, |a: f64, b: f64| 1.0 / a + r * (1.0 / b));
    let r4 = r2 * r2;
    let low = (1.0 + r) + r2 * pair(2.0, 6.0);
    let middle = pair(24.0, 120.0) + r2 * pair(720.0, 5040.0);
    let high = pair(40_320.0, 362_880.0) + r2 * pair(3_628_800.0, 39_916_800.0);
    let last = pair(479_001_600.0, 6_227_020_800.0);
    let sum = low + r4 * (middle + r4 * (high + r4 * last));
    sum * f64::from_bits((whole.to_bits() << EXPONENT).wrapping_add(1f64.to_bits()))
}

/// Mean of e^x for x from a to b, with its derivatives, given e^a and e^b.
#[inline(always)]
pub fn mean_exponential([a, b]: [f64; 2], [ea, eb]: [f64; 2]) -> Partials {
    // e^m f(z) with the middle m and half the difference z, where f = sinh z / z
    let z = 0.5 * (b - a);
    let (f, f1, f2);
    if z.abs() < 0.5 {
        let e = sqrt(ea * eb);
        let y = z * z;
        // Taylor series, accurate to a rounding; the arguments are the ratios of successive terms
        let sum = |ratios: [f64; 6]| ratios.into_iter().rev().fold(1.0, |sum, ratio| 1.0 + y * ratio * sum);
        f = e * sum([1.0 / 6.0, 1.0 / 20.0, 1.0 / 42.0, 1.0 / 72.0, 1.0 / 110.0, 1.0 / 156.0]);
        f1 = e * z / 3.0 * sum([1.0 / 10.0, 1.0 / 28.0, 1.0 / 54.0, 1.0 / 88.0, 1.0 / 130.0, 1.0 / 180.0]);
        f2 = e / 3.0 * sum([0.3, 5.0 / 84.0, 7.0 / 270.0, 9.0 / 616.0, 11.0 / 1170.0, 13.0 / 1980.0]);
    } else {
        let cosh = 0.5 * (ea + eb);
        f = 0.5 * (eb - ea) / z;
        f1 = (cosh - f) / z;
        f2 = f - 2.0 * f1 / z;
    }
    Partials {
        v: f,
        d: [0.5 * (f - f1), 0.5 * (f + f1)],
        dd: [0.25 * (f - 2.0 * f1 + f2), 0.25 * (f - f2), 0.25 * (f + 2.0 * f1 + f2)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_is_exact_to_two_roundings() {
        for k in -70_000..=70_000 {
            let x = f64::from(k) * 0.01 + 1e-3 * f64::sin(f64::from(k));
            if x.abs() < 700.0 {
                let (got, exact) = (exp(x), libm::exp(x));
                assert!((got - exact).abs() <= 2.0 * f64::EPSILON * exact, "{x}: {got:e} {exact:e}");
            }
        }
        assert_eq!((exp(0.0), exp(-1e6)), (1.0, exp(-700.0)));
        assert!(exp(f64::NAN).is_nan());
    }

    #[test]
    fn the_series_is_accurate_to_a_rounding() {
        for z in [0.1, 0.3, 0.45, 0.49] {
            let mean = mean_exponential([-z, z], [libm::exp(-z), libm::exp(z)]).v;
            assert!((mean * z / libm::sinh(z) - 1.0).abs() < 1e-15, "{z}: {mean}");
        }
    }

    #[test]
    fn the_mean_exponential_and_its_derivatives_are_exact() {
        // reference: Gauss-Legendre with five points on each of many short pieces
        let points = [
            (0.0, 0.568_888_888_888_888_9),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.906_179_845_938_664, 0.236_926_885_056_189_08),
            (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
        ];
        let mean = |a: f64, b: f64, f: &dyn Fn(f64) -> f64| {
            let n = 200;
            let mut sum = 0.0;
            for piece in 0..n {
                for (x, w) in points {
                    let t = (f64::from(piece) + 0.5 * (1.0 + x)) / f64::from(n);
                    sum += 0.5 * w / f64::from(n) * f(t) * (a + t * (b - a)).exp();
                }
            }
            sum
        };
        for (a, b) in [(-1.0, -1.0), (-0.3, 0.0), (0.0, -0.99), (-1.01, 0.0), (0.0, -7.0), (-30.0, -2.0)] {
            let got = mean_exponential([a, b], [f64::exp(a), f64::exp(b)]);
            let exact = [
                mean(a, b, &|_| 1.0),
                mean(a, b, &|t| 1.0 - t),
                mean(a, b, &|t| t),
                mean(a, b, &|t| (1.0 - t) * (1.0 - t)),
                mean(a, b, &|t| t * (1.0 - t)),
                mean(a, b, &|t| t * t),
            ];
            let found = [got.v, got.d[0], got.d[1], got.dd[0], got.dd[1], got.dd[2]];
            for (x, y) in found.into_iter().zip(exact) {
                assert!((x - y).abs() < 1e-14 * exact[0].max(1e-3), "{a} {b}: {x} {y}");
            }
        }
    }
}
