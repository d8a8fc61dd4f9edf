//! User parameters of tooth friction.

use serde::{Deserialize, Serialize};

use crate::problem::Problem;

/// Largest coefficient any law may return: that of unlubricated steel starts beyond it.
pub const LARGEST: f64 = 0.3;

/// Law of the coefficient of friction between tooth flanks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum FrictionLaw {
    /// Given coefficient, with an optional Stribeck peak at low speed.
    CoulombStribeck = 1,
    /// Benedict and Kelley's local coefficient from disc tests.
    BenedictKelley = 2,
    /// Mean coefficient of ISO/TR 14179-2, evaluated at local speed, load and curvature.
    Iso14179 = 3,
    /// Xu and Kahraman's fit to elastohydrodynamic solutions.
    XuKahraman = 4,
}

/// Law, lubricant and surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToothFrictionSpec {
    /// The law.
    pub law: FrictionLaw,
    /// Kinetic coefficient μ_k of [`FrictionLaw::CoulombStribeck`], 0 to 0.3.
    pub coefficient: f64,
    /// Static over kinetic coefficient μ_s/μ_k, from 1: no peak.
    pub static_ratio: f64,
    /// Stribeck speed v_S, at which the peak has fallen to 1/e [m/s].
    pub stribeck_speed: f64,
    /// Speed v_ε over which friction changes its sign [m/s].
    pub regularisation_speed: f64,
    /// Dynamic viscosity of the oil at ambient pressure and the temperature at which it enters the mesh [Pa·s]:
    /// the quantity that all three published laws use, so that no temperature is needed.
    pub oil_viscosity: f64,
    /// Factor X_L of the oil in ISO/TR 14179-2: 1 mineral oils, 0.8 polyalphaolefins and esters, 0.75 polyglycols, 1.3
    /// phosphate esters, 1.5 traction fluids.
    pub lubricant_factor: f64,
    /// Roughness R_a, the mean of both flanks [m].
    pub roughness: f64,
}

impl Default for ToothFrictionSpec {
    /// μ = 0.05 without a peak; for the published laws a 75W-90 axle oil at about 80 °C on run-in flanks.
    fn default() -> Self {
        Self {
            law: FrictionLaw::CoulombStribeck,
            coefficient: 0.05,
            static_ratio: 1.0,
            stribeck_speed: 0.01,
            regularisation_speed: 1e-3,
            oil_viscosity: 0.02,
            lubricant_factor: 1.0,
            roughness: 0.4e-6,
        }
    }
}

impl ToothFrictionSpec {
    /// Validation error of the first value that no law could use, if any.
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
                "{} makes a static coefficient of {peak}; allowed from 1 up to a static coefficient of {LARGEST}",
                self.static_ratio
            );
            return Some(Problem::new("tooth_friction.static_ratio", message));
        }
        let bad = positive.iter().find(|(_, value, _)| !(*value > 0.0 && value.is_finite()))?;
        Some(Problem::new(bad.0, format!("{} {} is not a positive number", bad.1, bad.2)))
    }

    /// v_ε [m/s], never zero.
    pub(super) fn slowest(&self) -> f64 {
        self.regularisation_speed.clamp(1e-9, 1e3)
    }

    /// Viscosity [mPa·s], the cP of the sources.
    pub(super) fn centipoise(&self) -> f64 {
        self.oil_viscosity.clamp(1e-5, 1e3) * 1e3
    }

    /// R_a [µm].
    pub(super) fn micrometres(&self) -> f64 {
        self.roughness.clamp(1e-9, 1e-3) * 1e6
    }
}
