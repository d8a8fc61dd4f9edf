//! Dormand–Prince 5(4): explicit, order 5 with embedded order 4, seven stages of which the last is the next step's first.
//!
//! J. R. Dormand, P. J. Prince, A family of embedded Runge–Kutta formulae, Journal of Computational and Applied
//! Mathematics 6:19 (1980); continuous extension of order 4 as in E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary
//! Differential Equations I, 2nd ed., Springer 1993, section II.6. The error estimate is the difference to the embedded
//! solution.
//!
//! Stable only while h |λ| < 3.3 on the negative real axis and h ω < 1 on the imaginary one, which limits the
//! steps of a mesh of stiff teeth: it is here for comparison.
//!
//! The first stage is the driver's evaluation at the start of a step for the ledger, so that the last stage need not be
//! passed on from step to step.

use super::method::combine;
use super::{ErrorNorm, Extension, Linearisation, Method, Point, SecondOrder, Statistics, Trial};

/// The method.
pub struct DormandPrince;

/// a_ij from the second stage on; the last row is the solution of order 5.
const A: [&[f64]; 6] = [
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
    &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
    &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// Weights of the solution of order 5 less those of the embedded one.
const ERROR: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Weights of the stages in the term Θ²(1−Θ)² of the continuous extension, in addition to the cubic through both ends.
const QUARTIC: [f64; 7] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// Part of the step over which the defect halfway counts, as in the implicit methods.
const DURATION: f64 = 0.2;

impl Method for DormandPrince {
    #[inline]
    fn estimate(&self) -> u32 {
        4
    }

    #[inline]
    fn is_implicit(&self) -> bool {
        false
    }

    #[inline]
    fn step<const N: usize, S: SecondOrder<N> + ?Sized>(
        &self,
        system: &S,
        (start, time): (&Point<N>, f64),
        lin: &Linearisation<N, S::Rates>,
        h: f64,
        norm: &ErrorNorm<N>,
        (counts, extension): (&mut Statistics, &mut Extension<N>),
    ) -> Option<Trial<N, S::Rates>> {
        let mut k = [Point { q: system.rates(&start.v), v: lin.acceleration }; 7];
        let mut end = *start;
        for (row, weights) in A.iter().enumerate() {
            end = *start;
            combine(&mut end, weights, h, &k);
            let place: f64 = weights.iter().sum();
            k[row + 1] = Point { q: system.rates(&end.v), v: system.evaluate_at(&end, time + place * h).0 };
        }
        counts.evaluations += A.len() as u64;

        let mut error = Point::ZERO;
        combine(&mut error, &ERROR, h, &k);
        // the cubic through both ends and their slopes, and the quartic term
        let mut quartic = Point::ZERO;
        combine(&mut quartic, &QUARTIC, h, &k);
        let mut change = end;
        combine(&mut change, &[-1.0], 1.0, &[*start]);
        let mut coefficients = [Point::ZERO; 3];
        combine(&mut coefficients[0], &[h, -1.0], 1.0, &[k[0], change]);
        combine(&mut coefficients[1], &[2.0, -h, -h, 1.0], 1.0, &[change, k[0], k[6], quartic]);
        combine(&mut coefficients[2], &[-1.0], 1.0, &[quartic]);
        let size = norm.judge(&error, &end);
        *extension = Extension { start: *start, end, coefficients };
        let trial = Trial { error, size, halfway: None };
        Some(trial.looked_into(system, (extension, time, h), norm, counts, |defect| {
            let rates = std::mem::replace(defect, Point::ZERO);
            combine(defect, &[DURATION], h, &[rates]);
        }))
    }
}
