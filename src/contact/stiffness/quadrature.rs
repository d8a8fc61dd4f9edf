//! Gauss–Legendre quadrature with sixteen points: exact for polynomials up to degree 31.

/// Positive abscissae with their weights (Abramowitz & Stegun, table 25.4).
const NODES: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_095),
];

/// ∫ f over [a, b] of a function with `K` components.
pub fn integrate<const K: usize>(a: f64, b: f64, f: impl Fn(f64) -> [f64; K]) -> [f64; K] {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let mut sum = [0.0; K];
    for (x, weight) in NODES {
        for side in [-1.0, 1.0] {
            let values = f(middle + side * half * x);
            for (total, value) in sum.iter_mut().zip(values) {
                *total += weight * half * value;
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    #[test]
    fn polynomials_of_even_degree_are_exact() {
        for degree in [0, 2, 10, 20, 30] {
            let [integral] = super::integrate(-1.0, 1.0, |x| [x.powi(degree)]);
            assert!((integral * f64::from(degree + 1) / 2.0 - 1.0).abs() < 1e-14, "{degree}: {integral}");
        }
    }
}
