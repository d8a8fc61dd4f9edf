//! Stiffness and transmission error of random gear pairs, compared with Weber's integrals by direct quadrature, over
//! the path of contact and past its ends as far as corners touch.

use crate::stiffness_pairs::{LINE_LOAD, STEEL, buildable, random_pairs};
use bevel_differential::contact::spring::Spring;
use bevel_differential::contact::stiffness::{PairStiffness, RootSpec, Span, ToothSection};
use bevel_differential::geometry::Pair;
use std::f64::consts::PI;

/// Gauss–Legendre quadrature with sixteen points (Abramowitz & Stegun, table 25.4): positive abscissae with their
/// weights.
const GAUSS: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_095),
];
/// Number of panels of a span. Each is half as long as the one below, because the chord of a pointed tooth is zero a
/// little above the load.
const PANELS: i32 = 7;

/// Distance past the end of the path over which its curvature blends into a corner [base pitches]. The curvature is
/// computed from compliances a millionth of the path apart, so rounding changes it by up to `ROUNDING` of the
/// stiffness.
const TURN: f64 = 4e-3;
const ROUNDING: f64 = 1e-6;

/// Adds ∫(y_c−y)²/s³ dy and ∫dy/s over `span` up to the height `top` = y_c [m] to `sums`.
fn add(sums: [f64; 2], span: &Span, top: f64) -> [f64; 2] {
    let (mut end, mut above) = (span.from, span.to);
    for _ in 0..60 {
        let half = 0.5 * (end + above);
        if span.piece.at(half).height < top { end = half } else { above = half }
    }
    let left = |panel: i32| if panel < PANELS { (end - span.from) * 0.5f64.powi(panel) } else { 0.0 };
    let mut sums = sums;
    for panel in 0..PANELS {
        let (middle, half) = (end - 0.5 * (left(panel) + left(panel + 1)), 0.5 * (left(panel) - left(panel + 1)));
        for (x, weight) in GAUSS.iter().flat_map(|&(x, weight)| [(-x, weight), (x, weight)]) {
            let point = span.piece.at(middle + half * x);
            let (dy, chord) = (weight * half * point.rise, 2.0 * point.half_chord);
            sums[0] += dy * (top - point.height).powi(2) / chord.powi(3);
            sums[1] += dy / chord;
        }
    }
    sums
}

/// Weber's compliance [1/Pa] of a tooth of the section `tooth`, loaded at the roll length `roll` [m].
fn compliance(tooth: &ToothSection, roll: f64) -> f64 {
    let tau = tooth.base_half_angle - roll / tooth.base_radius;
    let top = tooth.base_radius / tau.cos();
    let lever = (top - tooth.root_height) / tooth.root_chord;
    // below its root section, the tooth has a constant chord
    let [bending, shear] = match lever < 0.0 {
        true => [lever.powi(3) / 3.0, lever],
        false => tooth.spans().iter().fold([0.0; 2], |sums, span| add(sums, span, top)),
    };
    let (nu, tan_squared) = (STEEL.poisson / (1.0 - STEEL.poisson), tau.tan().powi(2));
    let shear_factor = 2.4 * (1.0 + nu);
    let root = 18.0 / PI * lever * lever + 2.0 * (1.0 - nu) * lever + 4.8 / PI * (1.0 + tan_squared / shear_factor);
    let by_load = 12.0 * bending + (shear_factor + tan_squared) * shear + root;
    tau.cos().powi(2) * by_load * (1.0 - STEEL.poisson.powi(2)) / STEEL.young
}

/// Arc [rad] by which tooth pairs at the positions `places` [rad] yield together under the reference load.
fn transmission_error(law: &impl Spring, places: &[f64], reference: f64) -> f64 {
    let load = |arc: f64| places.iter().map(|&s| law.at(arc, s).torque).sum::<f64>();
    let (mut below, mut above) = (0.0, 0.1);
    assert!(load(above) > reference);
    for _ in 0..60 {
        let half = 0.5 * (below + above);
        if load(half) < reference { below = half } else { above = half }
    }
    above
}

#[test]
fn stiffness_and_transmission_error_match_the_integrals() {
    let mut worst = [0f64; 4];
    let pairs = random_pairs(55).filter(buildable).filter_map(|spec| {
        let pair = Pair::new(&spec);
        let found = PairStiffness::new(&pair, &RootSpec { fillet: 0.3 }, STEEL.young, STEEL.poisson, LINE_LOAD).ok()?;
        let teeth = &found.teeth;
        let expected =
            PairStiffness::of_gears(&pair, teeth, LINE_LOAD, |i, roll| compliance(&teeth.sections[i], roll)).ok()?;
        Some((pair, [found, expected]))
    });
    for (pair, both) in pairs.take(200) {
        let mut compare = |kind: usize, of: &dyn Fn(&PairStiffness) -> f64| {
            let off = (of(&both[0]) / of(&both[1]) - 1.0).abs();
            assert!(off < if kind == 3 { ROUNDING } else { 1e-9 }, "{pair:?} {kind}: {off:e}");
            worst[kind] = worst[kind].max(off);
        };
        compare(0, &PairStiffness::mesh_mean);
        let PairStiffness { range: [low, high], corner_range, reference, .. } = both[0];
        let pitch = pair.base_pitch;
        // farther out, the pair is not loaded
        let ends = [low - corner_range[0], high + corner_range[1]];
        for j in 0..=1000 {
            let s = ends[0] + (ends[1] - ends[0]) * f64::from(j) / 1000.0;
            let past_end = (low - s).max(s - high);
            compare(if past_end > 0.0 && past_end < TURN * pitch { 3 } else { 1 }, &|of| of.at(s));
        }
        for first in (0..20).map(|j| low + pitch * f64::from(j) / 20.0).filter(|&s| s < high) {
            let places: Vec<f64> = (0..8).map(|k| first + f64::from(k) * pitch).filter(|&s| s < high).collect();
            compare(2, &|of| transmission_error(&of.line(), &places, reference));
            compare(2, &|of| transmission_error(&of.line_weber(), &places, reference));
        }
    }
    println!("worst mean stiffness, stiffness, transmission error, stiffness next to the path: {worst:?}");
}
