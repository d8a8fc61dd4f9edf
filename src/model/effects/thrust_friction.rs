//! Thrust washers and pins: what gives an open differential its torque bias.
//!
//! Dry friction T = μ F r on each surface, with the thrust of all meshes on the side gear, both meshes' thrust on the
//! planet and the resultant across its pin (Coulomb; H. Naunheimer et al., Automotive Transmissions, 2nd ed., Springer
//! 2011, section 10.2 on locking values).

use serde::{Deserialize, Serialize};

use crate::declaration::units::{self, MM};
use crate::declaration::{Parameter, Row, real, tunable};
use crate::model::effect_kinds::effect::{Declare, Effect, Heat, Needs, Setting};
use crate::model::effect_kinds::friction_source::{FrictionSource, PlanetFriction, SideFriction};
use crate::model::scene::GearContact;

/// Friction of thrust washers and pins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ThrustFrictionSpec {
    /// Coefficient of the thrust washers μ_w.
    pub coefficient: f64,
    /// Coefficient of the pins μ_p.
    pub pin_coefficient: f64,
    /// Radius of the pins [m].
    pub pin_radius: f64,
    /// Mean radius of the planets' washers [m].
    pub planet_washer_radius: f64,
    /// Mean radius of the side gears' washers [m].
    pub side_washer_radius: f64,
    /// Stiffness against turning before a side gear's washer slips [N·m/rad]; planets by the square of the gear ratio.
    pub stiffness: f64,
}

impl Default for ThrustFrictionSpec {
    fn default() -> Self {
        Self {
            coefficient: 0.05,
            pin_coefficient: 0.05,
            pin_radius: 8e-3,
            planet_washer_radius: 14e-3,
            side_washer_radius: 22e-3,
            stiffness: 1e5,
        }
    }
}

impl Declare for ThrustFrictionSpec {
    const DESCRIPTION: &'static str =
        "Friction of thrust washers and pins, which stick: the torque bias of an open differential";
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.thrust",
        description: "Heat of thrust washers and pins since the start",
        at_wheels: false,
    });
    const NEEDS: Option<Needs> = Some(Needs {
        contacts: &[GearContact::Lumped, GearContact::Tooth],
        why: "it follows from the thrusts of the meshes, which solid teeth do not give",
    });

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        vec![
            tunable(real(
                "thrust_friction.coefficient",
                units::ONE,
                None,
                (0.0, 1.0),
                |p| &mut p.coefficient,
                "Coefficient of friction of the thrust washers",
            )),
            tunable(real(
                "thrust_friction.pin_coefficient",
                units::ONE,
                None,
                (0.0, 1.0),
                |p| &mut p.pin_coefficient,
                "Coefficient of friction of the pins",
            )),
            real(
                "thrust_friction.pin_radius",
                units::METRE,
                Some(MM),
                (0.0, 1.0),
                |p| &mut p.pin_radius,
                "Radius of the pins",
            ),
            real(
                "thrust_friction.planet_washer_radius",
                units::METRE,
                Some(MM),
                (0.0, 1.0),
                |p| &mut p.planet_washer_radius,
                "Mean radius of the planets' thrust washers",
            ),
            real(
                "thrust_friction.side_washer_radius",
                units::METRE,
                Some(MM),
                (0.0, 1.0),
                |p| &mut p.side_washer_radius,
                "Mean radius of the side gears' thrust washers",
            ),
            real(
                "thrust_friction.stiffness",
                units::NM_PER_RAD,
                None,
                (1.0, 1e9),
                |p| &mut p.stiffness,
                "Stiffness of a side gear's stuck washer; planets by the square of the gear ratio",
            ),
        ]
    }
}

impl Effect for ThrustFrictionSpec {
    fn friction(&self, setting: &Setting) -> Option<FrictionSource> {
        let [planet, side] = setting.pair.gears.map(|gear| f64::from(gear.teeth));
        let ratio = planet / side;
        Some(FrictionSource {
            side: SideFriction {
                per_thrust: self.coefficient * self.side_washer_radius,
                stiffness: self.stiffness,
                ..SideFriction::default()
            },
            planet: PlanetFriction {
                per_pin_force: self.pin_coefficient * self.pin_radius,
                per_thrust: self.coefficient * self.planet_washer_radius,
                stiffness: self.stiffness * ratio * ratio,
            },
            ..FrictionSource::new(setting.heat)
        })
    }
}
