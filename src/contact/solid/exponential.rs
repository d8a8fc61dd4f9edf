//! Mean of the exponential function over an interval: the integral over a piece of a contact patch.

use super::turned::Partials;
use crate::numeric::sqrt;

/// Mean of e^x for x from a to b, with its derivatives, given e^a and e^b.
#[inline(always)]
pub fn mean_exponential([a, b]: [f64; 2], [ea, eb]: [f64; 2]) -> Partials {
    // e^m f(z) with the middle m and half the difference z, f = sinh z / z
    let z = 0.5 * (b - a);
    let (f, f1, f2);
    if z.abs() < 0.5 {
        let e = sqrt(ea * eb);
        let y = z * z;
        // Taylor series, to a rounding; the ratios of their terms, times y
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
    fn the_mean_exponential_and_its_derivatives_are_exact() {
        // by Gauss-Legendre over the interval, five points on short pieces
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
