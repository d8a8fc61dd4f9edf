//! Viscosity and density of the oil over temperature.
//!
//! ```text
//! log₁₀ log₁₀(ν + 0.7) = A − B log₁₀ T        ν [mm²/s], T [K]
//! ρ = ρ₁₅ − k (T − 288.15 K)
//! ```
//!
//! The line runs through the viscosities at 40 and 100 °C, which define ISO VG and viscosity index.
//!
//! Source: C. Walther; ASTM D341, without its corrections below 2 mm²/s.

use crate::declaration::prelude::*;
use crate::problem::Problem;

/// Temperatures at which the viscosity is given, 40 and 100 °C [K].
const POINTS: [f64; 2] = [313.15, 373.15];
/// Temperature of the given density, 15 °C [K].
const DENSITY_POINT: f64 = 288.15;
/// Constant of Walther's equation [mm²/s].
const WALTHER: f64 = 0.7;
/// Number of m²/s in 1 mm²/s.
const MM2: f64 = 1e-6;
/// Lower limit of the density, as a fraction of the given density. No oil is so light.
const LEAST_DENSITY: f64 = 0.1;

parameters! {
    /// The oil in the sump. The start values are those of an axle oil 75W-90.
    pub struct OilSpec in "oil" {
        /// Temperature of the oil and of all friction surfaces in it; with effects.warm_up, the temperature at the start
        /// or of a given sump
        temperature: f64 = 353.15, KELVIN | DEG_C, TEMPERATURES, TUNABLE,
            when(any([Condition::Need(Need::GivenTemperature), Condition::FromStart])),
            acts_when(any([Condition::Need(Need::TemperatureAtStart), Condition::Need(Need::Temperature), VISCOUS]));
        /// Kinematic viscosity of the oil at 40 degC
        viscosity_40: f64 = 100e-6, M2_PER_S | MM2_PER_S, 1e-6..=0.1, when(VISCOUS);
        /// Kinematic viscosity of the oil at 100 degC
        viscosity_100: f64 = 15e-6, M2_PER_S | MM2_PER_S, 1e-6..=0.1, when(VISCOUS);
        /// Density of the oil at 15 degC
        density: f64 = 870.0, KG_PER_M3, 1.0..=1e5, when(DENSE);
        /// Decrease of the oil density per temperature
        density_fall: f64 = 0.65, KG_PER_M3_K, 0.0..=1e3, when(DENSE);
    }
}

/// Condition that the dynamic viscosity, and therefore the density, has an effect.
const DENSE: Condition = Condition::Need(Need::DynamicViscosity);
/// Condition that the viscosity has an effect.
const VISCOUS: Condition = Condition::Any(&[DENSE, Condition::Need(Need::Viscosity)]);

/// Viscosity of an oil at one temperature.
#[derive(Clone, Copy, Debug)]
pub struct Viscosity {
    /// Kinematic viscosity [m²/s].
    pub kinematic: f64,
    /// Dynamic viscosity [Pa·s].
    pub dynamic: f64,
}

impl OilSpec {
    /// A and B of Walther's line.
    fn line(&self) -> [f64; 2] {
        let double_log = |viscosity: f64| libm::log10(libm::log10(viscosity / MM2 + WALTHER));
        let [thick, thin] = [self.viscosity_40, self.viscosity_100].map(double_log);
        let [cool, warm] = POINTS.map(libm::log10);
        let slope = (thick - thin) / (warm - cool);
        [thick + slope * cool, slope]
    }

    /// Kinematic viscosity at `temperature` [K], in m²/s.
    pub fn kinematic_viscosity(&self, temperature: f64) -> f64 {
        let [a, b] = self.line();
        let power = |exponent: f64| libm::pow(10.0, exponent);
        MM2 * (power(power(a - b * libm::log10(temperature))) - WALTHER).max(0.01)
    }

    /// Density at `temperature` [K], in kg/m³.
    pub fn density_at(&self, temperature: f64) -> f64 {
        (self.density - self.density_fall * (temperature - DENSITY_POINT)).max(LEAST_DENSITY * self.density)
    }

    /// Viscosity at `temperature` [K].
    pub fn viscosity(&self, temperature: f64) -> Viscosity {
        let kinematic = self.kinematic_viscosity(temperature);
        Viscosity { kinematic, dynamic: kinematic * self.density_at(temperature) }
    }

    /// Problem if the given viscosities contradict each other.
    pub fn problem(&self) -> Option<Problem> {
        let Self { viscosity_40, viscosity_100, .. } = *self;
        (viscosity_100 >= viscosity_40).then(|| {
            problem!(
                "oil.viscosity_100",
                "{viscosity_100:e} m2/s is not below oil.viscosity_40 = {viscosity_40:e} m2/s: an oil thins as it \
                 warms up"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walthers_line_runs_through_its_points_and_rises_in_the_cold() {
        let oil = OilSpec::default();
        assert!((oil.kinematic_viscosity(313.15) / 100e-6 - 1.0).abs() < 1e-9);
        assert!((oil.kinematic_viscosity(373.15) / 15e-6 - 1.0).abs() < 1e-9);
        // by hand: (log log 100.7, log log 15.7) = (0.301 687, 0.077 695), A = 7.644 69, B = 2.942 20
        let by_hand = |t: f64| {
            let (y0, y1) = (100.7_f64.log10().log10(), 15.7_f64.log10().log10());
            let (x0, x1) = (313.15_f64.log10(), 373.15_f64.log10());
            let y = y0 + (y1 - y0) * (t.log10() - x0) / (x1 - x0);
            10f64.powf(10f64.powf(y)) - 0.7
        };
        for t in [233.15, 273.15, 353.15, 423.15] {
            assert!((oil.kinematic_viscosity(t) * 1e6 / by_hand(t) - 1.0).abs() < 1e-9, "{t}");
        }
        let change = oil.viscosity(233.15).dynamic / oil.viscosity(423.15).dynamic;
        assert!((1e3..1e5).contains(&change), "{change}");
    }

    #[test]
    fn an_oil_that_thickens_as_it_warms_up_is_refused() {
        let oil = OilSpec { viscosity_100: 120e-6, ..OilSpec::default() };
        assert_eq!(oil.problem().map(|problem| problem.variable), Some("oil.viscosity_100"));
        assert!(OilSpec::default().problem().is_none());
    }
}
