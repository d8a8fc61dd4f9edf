//! Properties of every law.

use bevel_differential::friction::*;
use bevel_differential::numeric::Dual;
use fastrand::Rng;

const LAWS: [FrictionLaw; 4] =
    [FrictionLaw::CoulombStribeck, FrictionLaw::BenedictKelley, FrictionLaw::Iso14179, FrictionLaw::XuKahraman];

fn spec(law: FrictionLaw) -> ToothFrictionSpec {
    ToothFrictionSpec { law, static_ratio: 1.4, ..ToothFrictionSpec::default() }
}

const AT: Conditions<f64> =
    Conditions { sliding: 0.3, sum_speed: 3.0, line_load: 300e3, radius: 8e-3, modulus: 1.15e11 };

/// Zero, or a number of any magnitude and sign.
fn any(random: &mut Rng) -> f64 {
    match random.u64(..8) {
        0 => 0.0,
        1 => f64::MAX.copysign(random.f64() - 0.5),
        2 => f64::MIN_POSITIVE.copysign(random.f64() - 0.5),
        3 => (random.f64() - 0.5) * 1e300,
        _ => 10f64.powf(random.f64() * 24.0 - 12.0).copysign(random.f64() - 0.2),
    }
}

fn dual(at: &Conditions<f64>) -> Conditions<Dual<4>> {
    Conditions {
        sliding: Dual::variable(at.sliding, 0),
        sum_speed: Dual::variable(at.sum_speed, 1),
        line_load: Dual::variable(at.line_load, 2),
        radius: Dual::variable(at.radius, 3),
        modulus: at.modulus,
    }
}

#[test]
fn coefficient_and_derivatives_are_finite_and_odd_for_all_finite_arguments() {
    let mut random = Rng::with_seed(1);
    for round in 0..40_000 {
        let law = LAWS[round % 4];
        let wild = ToothFrictionSpec {
            law,
            coefficient: any(&mut random),
            static_ratio: any(&mut random),
            stribeck_speed: any(&mut random),
            regularisation_speed: any(&mut random),
            oil_viscosity: any(&mut random),
            viscosity_from_oil: false,
            lubricant_factor: any(&mut random),
            roughness: any(&mut random),
        };
        let spec = if round % 3 == 0 { wild } else { spec(law) };
        let at = Conditions {
            sliding: any(&mut random),
            sum_speed: any(&mut random),
            line_load: any(&mut random),
            radius: any(&mut random),
            modulus: any(&mut random),
        };
        let h = signed_coefficient(&spec, &at);
        assert!(h.abs() <= LARGEST && h * at.sliding >= 0.0, "{spec:?} {at:?}: {h}");
        assert_eq!(signed_coefficient(&spec, &Conditions { sliding: -at.sliding, ..at }), -h);
        let with_slopes = signed_coefficient(&spec, &dual(&at));
        assert_eq!(with_slopes.v, h);
        assert!(with_slopes.d.iter().all(|d| d.is_finite()), "{spec:?} {at:?}: {with_slopes:?}");
        let _ = outside(&spec, &at);
    }
}

#[test]
fn derivatives_agree_with_central_differences_through_zero_sliding_and_at_every_bound() {
    let places = [
        AT,
        Conditions { sliding: 0.0, ..AT },
        Conditions { sliding: 4e-4, ..AT },
        Conditions { sliding: -2e-3, sum_speed: 2e-3, ..AT },
        Conditions { sliding: 0.0, sum_speed: 0.0, ..AT },
        Conditions { line_load: 153e3, ..AT },
        Conditions { line_load: 1.1e3, ..AT },
        Conditions { line_load: -1.0, ..AT },
        Conditions { sliding: 20.0, sum_speed: 33.0, line_load: 4e4, ..AT },
        Conditions { sliding: 5.0, sum_speed: 4.0, line_load: 2e6, ..AT },
    ];
    for law in LAWS {
        for at in &places {
            let exact = signed_coefficient(&spec(law), &dual(at)).d;
            let scales = [at.sliding.abs().max(1e-3), at.sum_speed.abs().max(1e-3), at.line_load.abs(), at.radius];
            for (i, scale) in scales.into_iter().enumerate() {
                let h = scale * 1e-4;
                let moved = |by: f64| {
                    let mut x = [at.sliding, at.sum_speed, at.line_load, at.radius];
                    x[i] += by;
                    let [sliding, sum_speed, line_load, radius] = x;
                    let at = Conditions { sliding, sum_speed, line_load, radius, modulus: at.modulus };
                    signed_coefficient(&spec(law), &at)
                };
                // fourth order, so that the comparison is limited only by rounding
                let slope = (8.0 * (moved(h) - moved(-h)) - (moved(2.0 * h) - moved(-2.0 * h))) / (12.0 * h);
                let error = (exact[i] - slope).abs() * scale;
                assert!(error < 1e-9, "{law:?} {at:?}, variable {i}: {} for {slope}", exact[i]);
            }
        }
    }
}

#[test]
fn friction_passes_through_zero_with_the_slope_of_the_regularisation() {
    for law in LAWS {
        let spec = spec(law);
        let at = |sliding| signed_coefficient(&spec, &Conditions { sliding, ..AT });
        assert_eq!(at(0.0), 0.0);
        let tiny = 1e-9;
        let exact = signed_coefficient(&spec, &dual(&Conditions { sliding: 0.0, ..AT })).d[0];
        assert!((at(tiny) / tiny / exact - 1.0).abs() < 1e-9, "{law:?}");
        assert!(exact > 0.0);
    }
    let plain = ToothFrictionSpec::default();
    let exact = signed_coefficient(&plain, &dual(&Conditions { sliding: 0.0, ..AT })).d[0];
    assert!((exact - 0.05 / 1e-3).abs() < 1e-12);
}

#[test]
fn beyond_the_regularisation_the_published_value_is_reached() {
    for (law, published) in [
        (FrictionLaw::BenedictKelley, benedict_kelley::coefficient(&spec(FrictionLaw::BenedictKelley), &AT)),
        (FrictionLaw::Iso14179, iso14179::coefficient(&spec(FrictionLaw::Iso14179), &AT)),
        (FrictionLaw::XuKahraman, xu_kahraman::coefficient(&spec(FrictionLaw::XuKahraman), &AT)),
    ] {
        let value = signed_coefficient(&spec(law), &AT);
        assert!((value / published - 1.0).abs() < 2e-5, "{law:?}: {value} for {published}");
        assert!((0.01..0.12).contains(&value), "{law:?}: {value}");
    }
}
