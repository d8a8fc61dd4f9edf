//! Points over a loaded part of the face, over which loads are summed.
//!
//! Under a linear law, four Gauss points are exact.
//!
//! Under any other law, the load is smooth if it is not near zero, and eight Gauss points integrate it to 5·10⁻¹⁰. It
//! is near zero if it vanishes at an end of the part, or would vanish within a quarter of the part's length past the
//! end. There, a law such as `line_weber` behaves as x/ln(1/x). Twelve points clustered at the ends integrate such a
//! load to 10⁻⁸ for every length of the part. They use the map R = middle + half g(t), g = (15t − 10t³ + 3t⁵)/8. At the
//! ends, x varies as (1 ∓ t)³ and dR as (1 − t²)². The t are the Gauss points for that weight (Jacobi polynomials
//! P⁽²'²⁾).

use super::Slice;

/// Four Gauss–Legendre points and weights on [−1, 1] (M. Abramowitz, I. A. Stegun, table 25.4).
pub const GAUSS: [(f64, f64); POINTS] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
];
/// Number of points over the loaded part of a face under a linear law.
pub const POINTS: usize = 4;

/// Eight Gauss–Legendre points and weights on [−1, 1] (M. Abramowitz, I. A. Stegun, table 25.4).
pub const GAUSS_EIGHT: [(f64, f64); EIGHT] = [
    (-0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
    (-0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (-0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (-0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];
/// Number of points over a face whose load is far from zero.
pub const EIGHT: usize = 8;

/// Twelve points clustered at the ends: g and its weights at the zeros t of P₁₂⁽²'²⁾.
pub const CROWDED: [(f64, f64); MAX_NODES] = [
    (-0.999_419_541_897_761_4, 0.002_228_893_991_661_38),
    (-0.990_150_086_695_945, 0.021_049_674_820_056_04),
    (-0.943_761_930_424_009_3, 0.080_007_531_037_234_99),
    (-0.813_705_964_245_024_4, 0.186_861_689_141_318_19),
    (-0.563_589_241_954_168_3, 0.311_993_103_696_458_4),
    (-0.202_934_027_166_751_85, 0.397_859_107_313_271),
    (0.202_934_027_166_751_85, 0.397_859_107_313_271),
    (0.563_589_241_954_168_3, 0.311_993_103_696_458_4),
    (0.813_705_964_245_024_4, 0.186_861_689_141_318_19),
    (0.943_761_930_424_009_3, 0.080_007_531_037_234_99),
    (0.990_150_086_695_945, 0.021_049_674_820_056_04),
    (0.999_419_541_897_761_4, 0.002_228_893_991_661_38),
];
/// Number of points over a part near whose ends the load vanishes.
pub const MAX_NODES: usize = 12;
/// A point of the sum over the face.
#[derive(Clone, Copy, Debug, Default)]
pub struct Node {
    /// Cone distance R [m].
    pub cone: f64,
    /// 1/R [1/m].
    pub per_cone: f64,
    /// The point's share of ∫R² dR [m³], or a share of 1 if the law has one resultant for the face.
    pub weight: f64,
    /// Width over which the point's force is spread [m].
    pub width: f64,
}

impl From<Slice> for Node {
    fn from(slice: Slice) -> Self {
        Self { cone: slice.cone, per_cone: 1.0 / slice.cone, weight: slice.weight, width: slice.width }
    }
}

/// Points of a quadrature rule over a part of the face.
#[inline(always)]
pub fn nodes<const N: usize>(rule: &[(f64, f64); N], [from, to]: [f64; 2]) -> [Node; N] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    rule.map(|(x, w)| {
        let (cone, width) = (middle + half * x, half * w);
        Node { cone, per_cone: 1.0 / cone, weight: width * cone * cone, width }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clustered_points_are_the_gauss_rule_for_their_weight() {
        let g = |t: f64| (15.0 * t - 10.0 * t.powi(3) + 3.0 * t.powi(5)) / 8.0;
        // twelve points are exact for powers of t up to the 23rd: ∫t^k dg = 15/8 ∫t^k (1 − t²)² dt
        let exact = |k: f64| 3.75 * (1.0 / (k + 1.0) - 2.0 / (k + 3.0) + 1.0 / (k + 5.0));
        for power in 0..24 {
            let sum: f64 = CROWDED
                .iter()
                .map(|&(x, w)| {
                    let (mut low, mut high) = (-1.0, 1.0);
                    for _ in 0..80 {
                        let t = 0.5 * (low + high);
                        if g(t) < x { low = t } else { high = t }
                    }
                    w * low.powi(power)
                })
                .sum();
            let exact = if power % 2 == 0 { exact(f64::from(power)) } else { 0.0 };
            assert!((sum - exact).abs() < 1e-14, "{power}: {sum:e} {exact:e}");
        }
    }
}
