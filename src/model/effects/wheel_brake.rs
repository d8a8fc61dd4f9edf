//! Brakes at the wheels: dry friction between wheel and ground that opposes rotation and holds a wheel at standstill.
//!
//! While the wheel slips T = ±T_brake; at standstill a spring holds it up to that torque, T = k (z + τ ω) with the rotation
//! z since it stopped (`effect_kinds::dry_friction`). The wheel is the end of the half-shaft where that has one, the side
//! gear with its rigid end otherwise. The damping of the spring is critical for the inertia J of the end alone,
//! τ = 2 √(J/k), so that a wheel comes to rest without ringing; without an end it is that of all dry friction.
//!
//! Source: the brake of the Modelica Standard Library, Rotational.Components.Brake, with the spring of P. R. Dahl in place
//! of a locked mode, so that both wheels may be braked while speeds are imposed.

use crate::declaration::{Parameter, Row, row, units};
use crate::model::effect_kinds::dry_friction::DAMPING_TIME;
use crate::model::effect_kinds::{BUILT, Declare, Effect, FrictionSource, Heat, InputField, Setting, WheelFriction};
use crate::numeric::sqrt;

spec! {
    /// Brakes at the wheels.
    pub struct WheelBrakeSpec {
        /// Stiffness of a brake at standstill [N·m/rad].
        pub stiffness: f64 = 1e5,
    }
}

/// Far beyond any brake, near enough that no intermediate result overflows [N·m].
const MAX_TORQUE: f64 = 1e8;

impl Declare for WheelBrakeSpec {
    const DESCRIPTION: &'static str =
        "Brakes that resist and hold the wheels, by left.brake_torque and right.brake_torque";
    const HEAT: Option<Heat> =
        Some(Heat { output: "heat.brake", description: "Heat of the wheel brakes since the start", at_wheels: true });
    const EXAMPLE: &'static [(&'static str, f64)] = &[("left.brake_torque", 200.0), ("right.brake_torque", 200.0)];

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        vec![row("wheel_brake.stiffness", "Stiffness of a brake that holds its wheel at standstill").real(
            units::NM_PER_RAD,
            (1.0, 1e9),
            |p| &mut p.stiffness,
        )]
    }

    fn inputs() -> Vec<Row<InputField>> {
        let torque = |name, at: InputField, description| {
            // a build without effects accepts no brake torque
            let max = if BUILT { MAX_TORQUE } else { 0.0 };
            row(name, description).command(units::NEWTON_METRE, max, at)
        };
        vec![
            torque(
                "left.brake_torque",
                |i| &mut i.brake_torque[0],
                "Torque of the left wheel's brake with effects.wheel_brake: opposes rotation, and holds a wheel \
                 at standstill",
            ),
            torque(
                "right.brake_torque",
                |i| &mut i.brake_torque[1],
                "Torque of the right wheel's brake with effects.wheel_brake: opposes rotation, and holds a wheel \
                 at standstill",
            ),
        ]
    }
}

impl Effect for WheelBrakeSpec {
    fn friction(&self, setting: &Setting) -> Option<FrictionSource> {
        let end = [setting.inertia.left_end, setting.inertia.right_end];
        let wheel = WheelFriction {
            limit: |inputs| inputs.brake_torque,
            stiffness: self.stiffness,
            damping_time: end.map(|inertia| DAMPING_TIME.max(2.0 * sqrt(inertia / self.stiffness))),
        };
        Some(FrictionSource { wheel: Some(wheel), ..FrictionSource::new(setting.heat_index) })
    }
}
