//! Brakes at the wheels: dry friction between wheel and ground that opposes rotation and holds a wheel at standstill.
//!
//! While the wheel slips, T = ±T_brake. At standstill, a spring holds the wheel up to this torque, T = k (z + τ ω) with
//! the rotation z since it stopped (`effect_kinds::dry_friction`). The wheel is the end of the half-shaft if it has
//! one, and otherwise the side gear with its rigid end. The damping of the spring is critical for the inertia J of the
//! end, τ = 2 √(J/k), so a wheel comes to rest without ringing. Without an inertia of the end, τ has the value of all
//! dry friction. Slip speed changes T_brake as described in `effect_kinds::slip_law`.
//!
//! Source: the brake of the Modelica Standard Library, Rotational.Components.Brake, with the spring of P. R. Dahl
//! instead of a locked mode. Both wheels may therefore be braked while speeds are imposed.

use crate::declaration::prelude::*;
use crate::declaration::{Row, sides};
use crate::model::effect_kinds::dry_friction::DAMPING_TIME;
use crate::model::effect_kinds::{
    BUILT, ByLoad, Class, Command, Declare, Effect, EffectSetting, Heat, InputField, Reading, RubbingSurface, Slides,
    SlipSpec, SurfaceTemperature, Warmed, check_slip, depends_on_speed, depends_on_temperature, readings,
};
use crate::model::scene::{MAX_TORQUE, RubbingKind};
use crate::numeric::sqrt;
use crate::problem::Problem;

parameters! {
    /// Brakes at the wheels.
    pub struct WheelBrakeSpec in "wheel_brake" {
        /// Stiffness of a brake at standstill
        stiffness: f64 = 1e5, NM_PER_RAD, 1.0..=1e9;
        /// Mean radius of the linings, for sliding speed
        mean_radius: f64 = 0.12, METRE | MM, 1e-3..=1.0, when(depends_on_speed::<Self>());
        /// Lining area of a wheel brake
        friction_area: f64 = 0.01, SQUARE_METRE | CM2, 1e-8..=10.0;
        /// Coefficient of friction of the linings
        lining_coefficient: f64 = 0.4, ONE, 0.01..=1.0;
        /// Temperature of the linings
        temperature: f64 = 353.15, KELVIN | DEG_C, 213.15..=1273.15, TUNABLE,
            when(depends_on_temperature::<Self>());
        ..sliding: SlipSpec;
    }
}

impl Slides for WheelBrakeSpec {
    fn sliding(&mut self) -> &mut SlipSpec {
        &mut self.sliding
    }
}

impl Declare for WheelBrakeSpec {
    const DESCRIPTION: &'static str = "Wheel brakes, controlled by left.brake_torque and right.brake_torque";
    const CLASS: Class = Class::Machine;
    const PV_LIMIT: Option<&'static str> = Some("wheel_brake.pv_limit");
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.brake",
        description: "Heat of the wheel brakes since the start",
        warms: Warmed::Wheels,
    });
    const READINGS: &'static [Reading] = readings! {
        /// Pressure times sliding speed of the linings; larger of both
        "pv.brake": W_PER_M2 | W_PER_MM2, Always;
    };
    const EXAMPLE: &'static [(&'static str, f64)] = &[("left.brake_torque", 200.0), ("right.brake_torque", 200.0)];

    fn inputs() -> Vec<Row<InputField>> {
        let [left, right] = sides(
            "brake_torque",
            "Brake torque on the {side} wheel, with effects.wheel_brake; it opposes rotation and holds a standing \
             wheel",
        );
        // a build without effects accepts no brake torque
        let max = if BUILT { MAX_TORQUE } else { 0.0 };
        vec![
            left.command(NEWTON_METRE, max, |i| &mut i.brake_torque[0]),
            right.command(NEWTON_METRE, max, |i| &mut i.brake_torque[1]),
        ]
    }
}

impl Effect for WheelBrakeSpec {
    fn check(&self, _: &EffectSetting, found: &mut Vec<Problem>) {
        check_slip!("wheel_brake", self.sliding, found);
    }

    fn add_surfaces(&self, setting: &EffectSetting, surfaces: &mut Vec<RubbingSurface>) {
        let end = [setting.inertia.left_end, setting.inertia.right_end];
        let limit = ByLoad { per_load: 1.0, ..ByLoad::NONE };
        surfaces.push(RubbingSurface {
            limit,
            stiffness: self.stiffness,
            damping_time: end.map(|inertia| DAMPING_TIME.max(2.0 * sqrt(inertia / self.stiffness))),
            radius: self.mean_radius,
            pressed: limit.pressed(self.lining_coefficient, self.friction_area),
            sliding: self.sliding,
            temperature: SurfaceTemperature::Given(self.temperature),
            command: Command::Limits(|inputs| inputs.brake_torque),
            ..RubbingSurface::new(RubbingKind::Wheel, setting.heat_index)
        });
    }
}
