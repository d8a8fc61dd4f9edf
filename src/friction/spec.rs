//! User parameters of tooth friction.

use crate::declaration::prelude::*;
use crate::problem::Problem;

/// Largest coefficient that a law may return; the coefficient of unlubricated steel is higher.
pub const LARGEST: f64 = 0.3;

choices! {
    /// Law of the coefficient of friction between tooth flanks.
    pub enum FrictionLaw: "FrictionLaw" {
        CoulombStribeck = 1, "coulomb_stribeck": "given coefficient, with an optional Stribeck peak";
        BenedictKelley = 2, "benedict_kelley": "local coefficient of Benedict and Kelley (1961)";
        Iso14179 = 3, "iso_14179": "mean coefficient of ISO/TR 14179-2";
        XuKahraman = 4, "xu_kahraman": "local coefficient of Xu and Kahraman (2007)";
    }
}

parameters! {
    /// Law, lubricant and surface.
    ///
    /// The start values are μ = 0.05 without a peak. For the published laws, they represent a 75W-90 axle oil at about
    /// 80 °C on run-in flanks.
    pub struct ToothFrictionSpec in "tooth_friction" {
        /// Friction law of the flanks
        law: FrictionLaw = FrictionLaw::CoulombStribeck;
        /// Kinetic coefficient of friction of the flanks
        coefficient: f64 = 0.05, ONE, 0.0..=0.3, TUNABLE, when(is!(Self.law, FrictionLaw::CoulombStribeck));
        /// Ratio of static to kinetic coefficient; 1 = no Stribeck peak
        static_ratio: f64 = 1.0, ONE, 1.0..=10.0, when(is!(Self.law, FrictionLaw::CoulombStribeck));
        /// Sliding speed at which the Stribeck peak has fallen to 1/e
        stribeck_speed: f64 = 0.01, M_PER_S, 1e-6..=100.0,
            when(all([is!(Self.law, FrictionLaw::CoulombStribeck), above!(Self.static_ratio, 1.0)]));
        /// Sliding speed over which friction changes sign
        regularisation_speed: f64 = 1e-3, M_PER_S, 1e-6..=1.0;
        /// Dynamic viscosity of the oil at the mesh inlet
        oil_viscosity: f64 = 0.02, PA_S | MILLI_PA_S, 1e-5..=100.0,
            when(all([differs!(Self.law, FrictionLaw::CoulombStribeck), is!(Self.viscosity_from_oil, false)]));
        /// Viscosity of the oil at its temperature; false: tooth_friction.oil_viscosity
        viscosity_from_oil: bool = false, when(differs!(Self.law, FrictionLaw::CoulombStribeck));
        /// Lubricant factor X_L of ISO/TR 14179-2
        lubricant_factor: f64 = 1.0, ONE, 0.1..=3.0, when(is!(Self.law, FrictionLaw::Iso14179));
        /// Roughness R_a of the flanks
        roughness: f64 = 0.4e-6, METRE | UM, 0.0..=1e-4, when(differs!(Self.law, FrictionLaw::CoulombStribeck));
    }
}

impl ToothFrictionSpec {
    /// Validation error of the first invalid value, or `None`.
    pub fn problem(&self) -> Option<Problem> {
        let positive = [
            ("tooth_friction.stribeck_speed", self.stribeck_speed, "m/s"),
            ("tooth_friction.regularisation_speed", self.regularisation_speed, "m/s"),
            ("tooth_friction.oil_viscosity", self.oil_viscosity, "Pa·s"),
            ("tooth_friction.lubricant_factor", self.lubricant_factor, "1"),
            ("tooth_friction.roughness", self.roughness, "m"),
        ];
        if !(0.0..=LARGEST).contains(&self.coefficient) {
            let message =
                format!("{} is not a coefficient of lubricated teeth; allowed 0 to {LARGEST}", self.coefficient);
            return Some(Problem::new("tooth_friction.coefficient", message));
        }
        let peak = self.coefficient * self.static_ratio;
        if !(self.static_ratio >= 1.0 && peak <= LARGEST) {
            let message = format!(
                "{} results in a static coefficient of {peak}; \
                 the ratio must be at least 1, the static coefficient at most {LARGEST}",
                self.static_ratio
            );
            return Some(Problem::new("tooth_friction.static_ratio", message));
        }
        let bad = positive.iter().find(|(_, value, _)| !(*value > 0.0 && value.is_finite()))?;
        Some(problem!(bad.0, "{} {} is not a positive number", bad.1, bad.2))
    }

    /// v_ε [m/s], never zero.
    pub(super) fn slowest(&self) -> f64 {
        self.regularisation_speed.clamp(1e-9, 1e3)
    }

    /// Viscosity [mPa·s], which equals the cP of the sources.
    pub(super) fn centipoise(&self) -> f64 {
        self.oil_viscosity.clamp(1e-5, 1e3) * 1e3
    }

    /// R_a [µm].
    pub(super) fn micrometres(&self) -> f64 {
        self.roughness.clamp(1e-9, 1e-3) * 1e6
    }
}
