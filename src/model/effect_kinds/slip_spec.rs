//! Parameters by which dry friction depends on slip speed, temperature and p·v. Several effects use them.
//!
//! A factor describes the dependence on temperature, relative to the friction at the reference temperature. It is
//! linear between three temperatures and constant beyond them.

use crate::declaration::Group;
use crate::declaration::prelude::*;
use crate::problem::Problem;

/// Group of parameters of an effect with dry friction that slides.
pub trait Slides: Group {
    /// The parameters of sliding.
    fn sliding(&mut self) -> &mut SlipSpec;
}

/// Test on a parameter of sliding in the group `Owner`.
macro_rules! slips {
    ($owner:ident.$field:ident $sign:tt $value:literal, $text:literal) => {
        test!($owner, stringify!($field), $text, |owner| { *owner }.sliding().$field $sign $value, [$value])
    };
}

parameters! {
    /// Dependence of dry friction on slip speed, temperature and p·v.
    pub struct SlipSpec of Owner: Slides, by sliding {
        /// Ratio of breakaway torque to sliding torque
        static_ratio: f64 = 1.0, ONE, 1.0..=10.0;
        /// Sliding speed at which the static excess friction has fallen to 1/e; 0 = immediate drop
        stribeck_speed: f64 = 0.0, M_PER_S, 0.0..=100.0, when(slips!(Owner.static_ratio > 1.0, ">"));
        /// Change of friction per sliding speed, relative to kinetic friction
        slip_slope: f64 = 0.0, S_PER_METRE, -1.0..=1.0;
        /// Temperature at which cold_factor applies
        cold_temperature: f64 = 253.15, KELVIN | DEG_C, TEMPERATURES, when(slips!(Owner.cold_factor != 1.0, "!="));
        /// Friction at cold_temperature relative to reference_temperature
        cold_factor: f64 = 1.0, ONE, 0.0..=10.0;
        /// Temperature at which friction has its given values
        reference_temperature: f64 = 353.15, KELVIN | DEG_C, TEMPERATURES, when(depends_on_temperature::<Owner>());
        /// Temperature at which hot_factor applies
        hot_temperature: f64 = 473.15, KELVIN | DEG_C, TEMPERATURES, when(slips!(Owner.hot_factor != 1.0, "!="));
        /// Friction at hot_temperature relative to reference_temperature
        hot_factor: f64 = 1.0, ONE, 0.0..=10.0;
        /// Limit of pressure times speed; 0 = none
        pv_limit: f64 = 0.0, W_PER_M2 | W_PER_MM2, 0.0..=1e12;
        /// Factor on friction above pv_limit
        beyond_limit: f64 = 1.0, ONE, 0.0..=10.0, when(slips!(Owner.pv_limit > 0.0, ">"));
    }
}

/// Condition that the friction of the group `Owner` depends on temperature.
pub fn depends_on_temperature<Owner: Slides>() -> Condition {
    any([slips!(Owner.cold_factor != 1.0, "!="), slips!(Owner.hot_factor != 1.0, "!=")])
}

/// Condition that the friction of the group `Owner` depends on slip speed.
pub fn depends_on_speed<Owner: Slides>() -> Condition {
    any([slips!(Owner.stribeck_speed > 0.0, ">"), slips!(Owner.slip_slope != 0.0, "!=")])
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
        let (end, factor) = if temperature < self.reference_temperature {
            (self.cold_temperature, self.cold_factor)
        } else {
            (self.hot_temperature, self.hot_factor)
        };
        1.0 + (factor - 1.0)
            * ((temperature - self.reference_temperature) / (end - self.reference_temperature)).min(1.0)
    }

    /// Problem if the temperatures do not increase and friction depends on them. The argument contains the variable
    /// names of the cold, reference and hot temperatures.
    pub fn problem(&self, [cold, reference, hot]: [&'static str; 3]) -> Option<Problem> {
        if !self.varies_with_temperature() {
            return None;
        }
        if self.cold_temperature >= self.reference_temperature {
            let (this, other) = (self.cold_temperature, self.reference_temperature);
            return Some(problem!(
                cold,
                "{this} K is not below {reference} = {other} K; the cold, reference and hot \
                 temperatures of friction must increase"
            ));
        }
        let (this, other) = (self.hot_temperature, self.reference_temperature);
        (this <= other).then(|| {
            problem!(
                hot,
                "{this} K is not above {reference} = {other} K; the cold, reference and hot temperatures of \
                 friction must increase"
            )
        })
    }
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

pub(in crate::model) use check_slip;

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
        assert_eq!(SlipSpec { cold_temperature: 360.0, ..law }.problem(names).map(|p| p.variable), Some("a"));
        assert_eq!(SlipSpec { hot_temperature: 353.15, ..law }.problem(names).map(|p| p.variable), Some("c"));
    }
}
