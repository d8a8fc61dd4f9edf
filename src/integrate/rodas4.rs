//! RODAS: order 4 with embedded order 3, six stages, L-stable and stiffly accurate.
//!
//! E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed., Springer 1996, section IV.7, with the
//! coefficients and the continuous extension (of order 3) of their code RODAS, first set. The error estimate is the
//! difference to the embedded solution. Smooth stiff forcing (Prothero–Robinson) lowers its order, which Rodas5P avoids.

use super::rosenbrock::{self, Tableau};
use super::{ErrorNorm, Extension, Linearisation, Method, Point, SecondOrder, Statistics, Trial};

/// The method.
pub struct Rodas4;

impl Method for Rodas4 {
    #[inline(always)]
    fn estimate(&self) -> u32 {
        3
    }

    #[inline]
    fn step<const N: usize, S: SecondOrder<N> + ?Sized>(
        &self,
        system: &S,
        (start, time): (&Point<N>, f64),
        lin: &Linearisation<N, S::Rates>,
        h: f64,
        norm: &ErrorNorm<N>,
        to: (&mut Statistics, &mut Extension<N>),
    ) -> Option<Trial<N, S::Rates>> {
        rosenbrock::step(&RODAS4, system, (start, time), (lin, h), norm, to)
    }
}

/// Coefficients of RODAS.
const RODAS4: Tableau<6> = Tableau {
    gamma: 0.25,
    a: &[
        &[1.544],
        &[0.946_678_528_081_582_6, 0.255_701_169_898_328_4],
        &[3.314_825_187_068_521, 2.896_124_015_972_201, 0.998_641_913_997_781_7],
        &[1.221_224_509_226_641, 6.019_134_481_288_629, 12.537_083_329_320_87, -0.687_886_036_105_895],
    ],
    c: &[
        &[-5.6688],
        &[-2.430_093_356_833_875, -0.206_359_915_709_191_5],
        &[-0.107_352_905_815_137_5, -9.594_562_251_023_355, -20.470_286_148_096_16],
        &[7.496_443_313_967_647, -10.246_804_314_643_52, -33.999_903_528_199_05, 11.708_908_932_061_6],
        &[
            8.083_246_795_921_522,
            -7.981_132_988_064_893,
            -31.521_594_328_743_71,
            16.319_305_431_231_36,
            -6.058_818_238_834_054,
        ],
    ],
    extension: &EXTENSION,
};

/// Weights of the continuous extension y(Θ) = (1−Θ) y₀ + Θ (y₁ + (1−Θ) (H₂U + Θ H₃U)).
const EXTENSION: [[f64; 6]; 2] = [
    [
        10.126_235_083_445_86,
        -7.487_995_877_610_167,
        -34.800_918_615_557_47,
        -7.992_771_707_568_823,
        1.025_137_723_295_662,
        0.0,
    ],
    [
        -0.676_280_339_280_125_3,
        6.087_714_651_680_015,
        16.430_843_208_924_78,
        24.767_225_114_183_86,
        -6.594_389_125_716_872,
        0.0,
    ],
];
