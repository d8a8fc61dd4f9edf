//! Checks of the laws of elements.

use super::element::{Law, Spring};
use crate::model::scene::Viscosity;
use crate::numeric::Dual;

/// Checks a law at displacements and rates of both signs: derivatives against differences, force against energy, energy
/// and heat against power, heat that is never negative, and its mirror image.
pub fn verify(law: &impl Law, oil: Option<Viscosity>, displacements: &[f64], rates: &[f64]) {
    let force = |z: f64, rate: f64| law.force(z, rate, oil);
    // five-point difference of a function near x
    let slope = |of: &dyn Fn(f64) -> f64, x: f64| {
        let h = 1e-4 * x.abs().max(1e-3);
        (8.0 * (of(x + h) - of(x - h)) - (of(x + 2.0 * h) - of(x - 2.0 * h))) / (12.0 * h)
    };
    let close = |found: f64, expected: f64, what: &str| {
        assert!((found - expected).abs() <= 1e-7 * found.abs().max(expected.abs()), "{what}: {found} {expected}");
    };
    for (&z, &rate) in displacements.iter().flat_map(|z| rates.iter().map(move |rate| (z, rate))) {
        let Dual { v, d: [by_z, by_rate] } = law.force(Dual::variable(z, 0), Dual::variable(rate, 1), oil);
        assert_eq!(v, force(z, rate));
        close(by_z, slope(&|z| force(z, rate), z), "derivative with respect to displacement");
        close(by_rate, slope(&|rate| force(z, rate), rate), "derivative with respect to the rate");
        let elastic = slope(&|z| law.energy(z), z);
        close(force(z, 0.0), elastic, "force at rest and derivative of the energy");
        let heat = law.heat(rate, force(z, rate));
        close(force(z, rate) * rate, elastic * rate + heat, "power");
        assert!(heat >= 0.0, "heat {heat} W at {z}, {rate}");
        assert_eq!(force(-z, -rate), -force(z, rate));
        assert_eq!(law.energy(-z), law.energy(z));
        assert_eq!(law.heat(-rate, force(-z, -rate)), heat);
    }
}

#[test]
fn a_spring_with_a_damper_is_consistent() {
    verify(&Spring { stiffness: 9000.0, damping: 12.0 }, None, &[0.1, 1e-3], &[2.0, 0.3]);
}
