//! Drag of bearings and churned oil: T = T₀ tanh(ω/ω₀) + b ω + c ω |ω| on the carrier. The first two terms also act on
//! each side gear.
//!
//! The terms are a load-independent bearing torque, viscous drag, and churning with the square of the speed. With
//! `viscosity_from_oil`, b is proportional to the dynamic viscosity of the oil and has its given value at a reference
//! temperature.
//!
//! Two carrier bearings, each under the load F, and a lip seal on each side gear's shaft add to T₀:
//!
//! ```text
//! carrier     2 f₁ F d_m     f₁ = 0.0004 for tapered rollers (A. Palmgren, Ball and Roller Bearing Engineering, 1959; T. A.
//!                            Harris, Rolling Bearing Analysis)
//! side gears  k d            k = 3.737 N for fluorocarbon rubber, 2.429 N for nitrile rubber (ISO/TR 14179-1:2001)
//! ```
//!
//! With `churning_from_geometry`, c is the value of a smooth disc with its rim and both sides, by ISO/TR 14179-1:2001:
//!
//! ```text
//! P = f_g ν n³ D^4.7 (7.37 L + 1.474 D) / (A_g 10²⁶)     P [kW], ν [mm²/s], n [1/min], D and L [mm], A_g = 0.2
//! ```
//!
//! with the dip factor f_g = immersed depth / D: 0 if the disc runs dry, 1 if it is submerged.

use crate::declaration::prelude::*;
use crate::model::effect_kinds::{BodyEffect, Declare, Effect, EffectSetting, Element, Heat, Law, Part, Warmed};
use crate::model::scene::{CARRIER, OilSpec, Plan, Viscosity};
use crate::model::thermal::OIL;
use crate::numeric::Scalar;
use crate::problem::Problem;

/// Arrangement constant A_g.
const ARRANGEMENT: f64 = 0.2;
/// Factor of the rim of a smooth disc.
const RIM: f64 = 7.37;
/// Factor of both sides of a smooth disc.
const SIDES: f64 = 1.474;
/// Exponent of the diameter.
const EXPONENT: f64 = 4.7;
/// Carrier bearings.
const BEARINGS: f64 = 2.0;

parameters! {
    /// Drag of bearings and oil.
    pub struct BearingDragSpec in "bearing_drag" {
        /// Load-independent bearing torque on the carrier
        carrier_torque: f64 = 0.0, NEWTON_METRE, 0.0..=1e4;
        /// Viscous drag on the carrier
        carrier_viscous: f64 = 0.0, NMS_PER_RAD, 0.0..=1e3;
        /// Churning torque of the carrier per square of its speed
        carrier_churning: f64 = 0.0, NMS2_PER_RAD2, 0.0..=1e2, when(is!(Self.churning_from_geometry, false));
        /// Load-independent bearing torque on each side gear
        side_torque: f64 = 0.0, NEWTON_METRE, 0.0..=1e4;
        /// Viscous drag on each side gear
        side_viscous: f64 = 0.0, NMS_PER_RAD, 0.0..=1e3;
        /// Speed at which the load-independent bearing torque has built up
        breakaway_speed: f64 = 0.1, RAD_PER_S | DEG_PER_S, 1e-6..=1e3,
            when(any([above!(Self.carrier_torque, 0.0), above!(Self.side_torque, 0.0),
                above!(Self.seal_diameter, 0.0), above!(Self.bearing_load, 0.0)]));
        /// Viscous drag proportional to the oil viscosity; false: given values
        viscosity_from_oil: bool = false,
            when(any([above!(Self.carrier_viscous, 0.0), above!(Self.side_viscous, 0.0)]));
        /// Oil temperature at which viscous drag has its given values
        reference_temperature: f64 = 353.15, KELVIN | DEG_C, TEMPERATURES, when(is!(Self.viscosity_from_oil, true));
        /// Churning torque from dimensions and oil (ISO/TR 14179-1); false: given value
        churning_from_geometry: bool = false;
        /// Outside diameter of ring gear and case
        carrier_diameter: f64 = 0.2, METRE | MM, 1e-3..=10.0,
            when(churning());
        /// Width of ring gear and case
        carrier_width: f64 = 0.05, METRE | MM, 0.0..=10.0,
            when(churning());
        /// Immersed depth over bearing_drag.carrier_diameter
        oil_level: f64 = 0.3, ONE, 0.0..=1.0, when(is!(Self.churning_from_geometry, true));
        /// Shaft diameter at the side gear seals; 0 = no seals
        seal_diameter: f64 = 0.0, METRE | MM, 0.0..=1.0;
        /// Torque of a seal per shaft diameter
        seal_torque_per_diameter: f64 = 3.737, NEWTON, 1e-3..=1e3, when(above!(Self.seal_diameter, 0.0));
        /// Load on each carrier bearing
        bearing_load: f64 = 0.0, NEWTON, 0.0..=1e7;
        /// Mean diameter of the carrier bearings
        bearing_diameter: f64 = 0.07, METRE | MM, 1e-3..=10.0, when(above!(Self.bearing_load, 0.0));
        /// Palmgren's coefficient f1 of the carrier bearings
        bearing_coefficient: f64 = 4e-4, ONE, 1e-6..=1.0, when(above!(Self.bearing_load, 0.0));
    }
}

/// Condition that churning follows from the carrier's size.
fn churning() -> Condition {
    all([is!(BearingDragSpec.churning_from_geometry, true), above!(BearingDragSpec.oil_level, 0.0)])
}

impl Declare for BearingDragSpec {
    const DESCRIPTION: &'static str = "Bearing friction and oil churning";
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.drag",
        description: "Heat of bearings and oil since the start",
        warms: Warmed::Node(OIL),
    });
    const EXAMPLE: &'static [(&'static str, f64)] = &[
        ("bearing_drag.carrier_torque", 0.5),
        ("bearing_drag.carrier_viscous", 5e-3),
        ("bearing_drag.carrier_churning", 1e-4),
        ("bearing_drag.side_torque", 0.2),
        ("bearing_drag.side_viscous", 1e-3),
    ];

    fn needs() -> Vec<(Need, Condition)> {
        vec![
            (Need::DynamicViscosity, all([on!(Self), is!(Self.viscosity_from_oil, true)])),
            (Need::Viscosity, all([on!(Self), churning()])),
        ]
    }
}

impl BearingDragSpec {
    /// True if churning follows from the carrier's size.
    fn churns_by_size(&self) -> bool {
        self.churning_from_geometry && self.oil_level > 0.0
    }

    /// Churning of a smooth disc over the kinematic viscosity [N·m·s³/(rad²·m²)].
    fn churning_per_viscosity(&self) -> f64 {
        let [diameter, width] = [self.carrier_diameter, self.carrier_width].map(|length| MM.show(length));
        let power = libm::pow(diameter, EXPONENT) * (RIM * width + SIDES * diameter) / (ARRANGEMENT * 1e26);
        // 1 m²/s is 10⁶ mm²/s, 1 kW is 10³ W, and n enters P = c ω³ with its third power
        1e9 * RPM.factor * RPM.factor * RPM.factor * self.oil_level * power
    }
}

impl Effect for BearingDragSpec {
    fn warnings(&self, _: &EffectSetting) -> Vec<Problem> {
        let given = [self.carrier_torque, self.carrier_viscous, self.side_torque, self.side_viscous];
        let churning = if self.churning_from_geometry { self.oil_level } else { self.carrier_churning };
        if given.into_iter().chain([churning, self.seal_diameter, self.bearing_load]).any(|of| of > 0.0) {
            return Vec::new();
        }
        vec![Problem::new(
            "effects.bearing_drag",
            "there is no drag: set a torque, viscous drag, churning, seals or a bearing load under bearing_drag, or \
             switch the effect off",
        )]
    }

    fn is_oiled(&self) -> bool {
        self.viscosity_from_oil || self.churns_by_size()
    }

    fn on_bodies(&self, setting: &EffectSetting, _: &Plan) -> Option<Box<dyn BodyEffect>> {
        let [carrier, side] = self.resistances(setting.oil);
        let parts = [(side, 0), (side, 1), (carrier, CARRIER)]
            .into_iter()
            .filter(|(law, _)| law.acts())
            .map(|(law, body)| Part { law, displacement: None, body, base: None });
        Some(Box::new(Element::new(parts.collect(), setting.heat_index)))
    }
}

impl BearingDragSpec {
    /// Resistances of the carrier and of each side gear.
    fn resistances(&self, oil: &OilSpec) -> [Resistance; 2] {
        let by_size = self.churning_from_geometry;
        let bearings = BEARINGS * self.bearing_coefficient * self.bearing_load * self.bearing_diameter;
        let reference = self.viscosity_from_oil.then(|| oil.viscosity(self.reference_temperature).dynamic);
        let breakaway_speed = self.breakaway_speed;
        let carrier = Resistance {
            coulomb: self.carrier_torque + bearings,
            viscous: self.carrier_viscous,
            churning: if by_size { 0.0 } else { self.carrier_churning },
            churning_per_viscosity: if by_size { self.churning_per_viscosity() } else { 0.0 },
            reference,
            breakaway_speed,
        };
        let side = Resistance {
            coulomb: self.side_torque + self.seal_torque_per_diameter * self.seal_diameter,
            viscous: self.side_viscous,
            churning: 0.0,
            churning_per_viscosity: 0.0,
            ..carrier
        };
        [carrier, side]
    }
}

/// Resistance to the rotation of the carrier or of a side gear.
#[derive(Clone, Copy, Debug)]
struct Resistance {
    /// Torque of bearings and seals [N·m].
    coulomb: f64,
    /// Viscous drag [N·m·s/rad].
    viscous: f64,
    /// Churning that does not depend on the oil [N·m·s²/rad²].
    churning: f64,
    /// Churning that depends on the oil, over its kinematic viscosity [N·m·s³/(rad²·m²)].
    churning_per_viscosity: f64,
    /// Viscosity of the oil at which viscous drag has its given value [Pa·s]; `None` if it does not depend on the oil.
    reference: Option<f64>,
    /// Speed ω₀ at which the constant torque has reached tanh 1 = 76 % [rad/s].
    breakaway_speed: f64,
}

impl Resistance {
    /// True if there is any resistance.
    fn acts(&self) -> bool {
        [self.coulomb, self.viscous, self.churning, self.churning_per_viscosity].into_iter().any(|of| of != 0.0)
    }

    /// Resistance at the viscosity of `oil`. It is `#[cold]`, because in most scenes nothing depends on the oil. It is
    /// not inlined, because compilers would divide a viscosity before they test if there is one.
    #[cold]
    #[inline(never)]
    fn in_oil(&self, oil: Viscosity) -> Self {
        let churning = self.churning + self.churning_per_viscosity * oil.kinematic;
        let viscous = self.reference.map_or(self.viscous, |reference| self.viscous * (oil.dynamic / reference));
        Self { churning, viscous, ..*self }
    }
}

impl Law for Resistance {
    #[inline]
    fn force<T: Scalar>(&self, _: T, speed: T, oil: Option<Viscosity>) -> T {
        let warmed;
        let on = match oil {
            Some(oil) => {
                warmed = self.in_oil(oil);
                &warmed
            }
            None => self,
        };
        let mut drag = T::constant(0.0);
        // most of the work is in the hyperbolic tangent
        if on.coulomb != 0.0 {
            drag = (speed / T::constant(on.breakaway_speed)).tanh() * on.coulomb;
        }
        drag + speed * on.viscous + speed * on.churning * speed.abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::effect_kinds::element_tests::verify;

    /// Oil of 100 mm²/s.
    const OIL: Option<Viscosity> = Some(Viscosity { kinematic: 1e-4, dynamic: 0.085 });

    fn none() -> BearingDragSpec {
        BearingDragSpec { ..Default::default() }
    }

    #[test]
    fn a_carrier_churns_as_a_smooth_disc_by_its_rim_and_its_sides() {
        let spec = BearingDragSpec { churning_from_geometry: true, ..none() };
        let on = spec.resistances(&OilSpec::default());
        // by hand: D = 200 mm, L = 50 mm, f_g = 0.3, 100 mm²/s, 1000 1/min; 200^4.7 = 6.528 914 474 78 × 10¹⁰
        let rim = 7.37 * 0.3 * 100.0 * 1e9 * 6.528_914_474_778_8e10 * 50.0 / 0.2e26;
        let sides = 1.474 * 0.3 * 100.0 * 1e9 * 6.528_914_474_778_8e10 * 200.0 / 0.2e26;
        let speed = 1000.0 * std::f64::consts::PI / 30.0;
        for sign in [1.0, -1.0] {
            let torque = on[0].force(0.0, sign * speed, OIL);
            assert!((torque * sign * speed / 1e3 / (rim + sides) - 1.0).abs() < 1e-9, "{torque}");
        }
        assert_eq!(on[1].force(0.0, speed, OIL), 0.0);
        let dry = BearingDragSpec { oil_level: 0.0, ..spec };
        assert!(spec.is_oiled() && !dry.is_oiled());
        assert_eq!(dry.resistances(&OilSpec::default())[0].force(0.0, speed, None), 0.0);
    }

    #[test]
    fn seals_and_loaded_bearings_add_to_the_torque_that_builds_up() {
        let spec = BearingDragSpec { seal_diameter: 0.04, bearing_load: 5000.0, carrier_churning: 0.0, ..none() };
        let on = spec.resistances(&OilSpec::default());
        // by hand: 2 · 0.0004 · 5000 N · 70 mm = 280 N·mm, and 3.737e-3 · 40 N·m
        for (on, full) in on.into_iter().zip([0.28, 0.149_48]) {
            for speed in [-20.0, 0.05, 20.0] {
                let torque = on.force(0.0, speed, None);
                assert!((torque - full * f64::tanh(speed / 0.1)).abs() < 1e-9 * full, "{torque}");
            }
        }
    }

    #[test]
    fn viscous_drag_is_as_given_at_the_reference_and_proportional_to_the_oils_viscosity_elsewhere() {
        let given = BearingDragSpec { carrier_viscous: 0.02, side_viscous: 0.01, carrier_churning: 0.0, ..none() };
        let at_reference = OilSpec::default().viscosity(given.reference_temperature);
        for (follows, times, expected) in [(true, 1.0, 1.0), (true, 3.0, 3.0), (true, 0.25, 0.25), (false, 3.0, 1.0)] {
            let spec = BearingDragSpec { viscosity_from_oil: follows, ..given };
            let on = spec.resistances(&OilSpec::default());
            let oil = Viscosity { dynamic: times * at_reference.dynamic, ..at_reference };
            for (on, viscous) in on.into_iter().zip([0.02, 0.01]) {
                for speed in [40.0, -40.0] {
                    let torque = on.force(0.0, speed, Some(oil));
                    assert!((torque - expected * viscous * speed).abs() < 1e-12, "{follows} {times}: {torque}");
                }
            }
        }
    }

    #[test]
    fn the_laws_are_consistent() {
        let spec = BearingDragSpec {
            churning_from_geometry: true,
            viscosity_from_oil: true,
            seal_diameter: 0.04,
            bearing_load: 5000.0,
            carrier_torque: 0.5,
            carrier_viscous: 5e-3,
            side_torque: 0.2,
            side_viscous: 1e-3,
            ..BearingDragSpec::default()
        };
        let on = spec.resistances(&OilSpec::default());
        for law in on {
            for oil in [OIL, None] {
                verify(&law, oil, &[0.0], &[50.0, 0.02, 90.0]);
            }
        }
    }
}
