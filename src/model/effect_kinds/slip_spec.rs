//! Parameters by which dry friction depends on slip speed, temperature and p·v. Several effects use them.
//!
//! A factor describes the dependence on temperature, relative to the friction at the reference temperature. It is
//! linear between three temperatures and constant beyond them.

use crate::problem::Problem;

spec! {
    /// Dependence of dry friction on slip speed, temperature and p·v.
    pub struct SlipSpec {
        /// Stribeck speed, at which the static excess has fallen to 1/e [m/s]; 0 = friction jumps from static to
        /// kinetic.
        pub stribeck_speed: f64 = 0.0,
        /// Change of the kinetic friction per speed, over its value at standstill [s/m].
        pub slip_slope: f64 = 0.0,
        /// Temperature of the cold point [K].
        pub cold: f64 = 253.15,
        /// Friction at the cold point over friction at the reference.
        pub cold_factor: f64 = 1.0,
        /// Temperature at which friction has its given values [K].
        pub reference: f64 = 353.15,
        /// Temperature of the hot point [K].
        pub hot: f64 = 473.15,
        /// Friction at the hot point over friction at the reference.
        pub hot_factor: f64 = 1.0,
        /// Limit of pressure × speed [W/m²]; 0 for no limit.
        pub pv_limit: f64 = 0.0,
        /// Friction beyond `pv_limit` over friction below it.
        pub beyond_limit: f64 = 1.0,
    }
}

impl SlipSpec {
    /// True if friction changes with temperature.
    pub fn varies_with_temperature(&self) -> bool {
        self.cold_factor != 1.0 || self.hot_factor != 1.0
    }

    /// Friction at `temperature` [K] over friction at the reference.
    pub fn factor_at(&self, temperature: f64) -> f64 {
        if !self.varies_with_temperature() {
            return 1.0;
        }
        let (end, factor) =
            if temperature < self.reference { (self.cold, self.cold_factor) } else { (self.hot, self.hot_factor) };
        1.0 + (factor - 1.0) * ((temperature - self.reference) / (end - self.reference)).min(1.0)
    }

    /// Problem if the temperatures do not increase and friction depends on them. The argument contains the variable
    /// names of the cold, reference and hot temperatures.
    pub fn problem(&self, [cold, reference, hot]: [&'static str; 3]) -> Option<Problem> {
        if !self.varies_with_temperature() {
            return None;
        }
        if self.cold >= self.reference {
            let (this, other) = (self.cold, self.reference);
            return Some(problem!(
                cold,
                "{this} K is not below {reference} = {other} K; the cold, reference and hot \
                 temperatures of friction must increase"
            ));
        }
        let (this, other) = (self.hot, self.reference);
        (this <= other).then(|| {
            problem!(
                hot,
                "{this} K is not above {reference} = {other} K; the cold, reference and hot temperatures of \
                 friction must increase"
            )
        })
    }
}

/// Rows of the dry-friction parameters of an effect, from its name and its field of type [`SlipSpec`].
macro_rules! slip_rows {
    ($effect:literal, $field:ident) => {{
        use $crate::declaration::{row, units};
        let temperature = |name, of, condition, at: fn(&mut Self) -> &mut f64| {
            row(name, of).when(condition).real((units::KELVIN, units::DEG_C), units::TEMPERATURES, at)
        };
        let factor = |name, of, at: fn(&mut Self) -> &mut f64| row(name, of).real(units::ONE, (0.0, 10.0), at);
        [
            row(
                concat!($effect, ".stribeck_speed"),
                "Sliding speed at which the static excess friction has fallen to 1/e; 0 = immediate drop",
            )
            .when(concat!($effect, ".static_ratio > 1"))
            .real(units::M_PER_S, (0.0, 100.0), |p: &mut Self| &mut p.$field.stribeck_speed),
            row(concat!($effect, ".slip_slope"), "Change of friction per sliding speed, relative to kinetic friction")
                .real(units::S_PER_METRE, (-1.0, 1.0), |p: &mut Self| &mut p.$field.slip_slope),
            temperature(
                concat!($effect, ".cold_temperature"),
                "Temperature at which cold_factor applies",
                concat!($effect, ".cold_factor != 1"),
                |p| &mut p.$field.cold,
            ),
            factor(
                concat!($effect, ".cold_factor"),
                "Friction at cold_temperature relative to reference_temperature",
                |p| &mut p.$field.cold_factor,
            ),
            temperature(
                concat!($effect, ".reference_temperature"),
                "Temperature at which friction has its given values",
                concat!($effect, ".cold_factor != 1 or ", $effect, ".hot_factor != 1"),
                |p| &mut p.$field.reference,
            ),
            temperature(
                concat!($effect, ".hot_temperature"),
                "Temperature at which hot_factor applies",
                concat!($effect, ".hot_factor != 1"),
                |p| &mut p.$field.hot,
            ),
            factor(
                concat!($effect, ".hot_factor"),
                "Friction at hot_temperature relative to reference_temperature",
                |p| &mut p.$field.hot_factor,
            ),
            row(concat!($effect, ".pv_limit"), "Limit of pressure times speed; 0 = none").real(
                (units::W_PER_M2, units::W_PER_MM2),
                (0.0, 1e12),
                |p: &mut Self| &mut p.$field.pv_limit,
            ),
            row(concat!($effect, ".beyond_limit"), "Factor on friction above pv_limit")
                .when(concat!($effect, ".pv_limit > 0"))
                .real(units::ONE, (0.0, 10.0), |p: &mut Self| &mut p.$field.beyond_limit),
        ]
    }};
}

/// Adds the problem of an effect's friction temperatures, if there is one.
macro_rules! check_slip {
    ($effect:literal, $sliding:expr, $found:expr) => {
        $found.extend($sliding.problem([
            concat!($effect, ".cold_temperature"),
            concat!($effect, ".reference_temperature"),
            concat!($effect, ".hot_temperature"),
        ]))
    };
}

pub(in crate::model) use {check_slip, slip_rows};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_over_temperature_meets_its_points_and_is_constant_beyond() {
        let law = SlipSpec { cold_factor: 1.3, hot_factor: 0.8, ..SlipSpec::default() };
        for (temperature, factor) in
            [(200.0, 1.3), (253.15, 1.3), (303.15, 1.15), (353.15, 1.0), (413.15, 0.9), (473.15, 0.8), (600.0, 0.8)]
        {
            assert!((law.factor_at(temperature) - factor).abs() < 1e-12, "{temperature}");
        }
        let names = ["a", "b", "c"];
        assert!(law.problem(names).is_none());
        assert_eq!(SlipSpec { cold: 360.0, ..law }.problem(names).map(|p| p.variable), Some("a"));
        assert_eq!(SlipSpec { hot: 353.15, ..law }.problem(names).map(|p| p.variable), Some("c"));
    }
}
