//! Drag of bearings and churned oil: T = T₀ tanh(ω/ω₀) + b ω + c ω |ω| on the carrier, the first two on the side gears.
//!
//! The three parts of the SKF model in their plainest form: load-independent bearing torque, viscous drag, and churning
//! with the square of the speed (ISO/TR 14179-1). With `viscosity_from_oil` b grows with the dynamic viscosity of the oil over
//! that at a reference temperature.

use crate::declaration::units::{self, DEG_C, DEG_PER_S};
use crate::declaration::{Parameter, Row, row};
use crate::model::effect_kinds::{Action, BodyEffect, BodyMotion, Declare, Effect, Heat, Setting, Slopes};
use crate::model::scene::Plan;

spec! {
    /// Drag of bearings and oil.
    pub struct BearingDragSpec {
        /// Load-independent bearing torque on the carrier [N·m].
        pub carrier_torque: f64 = 0.5,
        /// Viscous drag on the carrier [N·m·s/rad].
        pub carrier_viscous: f64 = 5e-3,
        /// Churning on the carrier, with the square of its speed [N·m·s²/rad²].
        pub carrier_churning: f64 = 1e-4,
        /// Load-independent bearing torque on each side gear [N·m].
        pub side_torque: f64 = 0.2,
        /// Viscous drag on each side gear [N·m·s/rad].
        pub side_viscous: f64 = 1e-3,
        /// Speed at which bearing torque has built up [rad/s].
        pub breakaway_speed: f64 = 0.1,
        /// Whether viscous drag follows the viscosity of `oil` at its temperature.
        pub viscosity_from_oil: bool = false,
        /// Temperature at which viscous drag is as given [K].
        pub reference_temperature: f64 = 353.15,
    }
}

impl Declare for BearingDragSpec {
    const DESCRIPTION: &'static str = "Friction of bearings and churning of oil";
    const HEAT: Option<Heat> =
        Some(Heat { output: "heat.drag", description: "Heat of bearings and oil since the start", at_wheels: false });

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        vec![
            row("bearing_drag.carrier_torque", "Load-independent bearing torque on the carrier").real(
                units::NEWTON_METRE,
                (0.0, 1e4),
                |p| &mut p.carrier_torque,
            ),
            row("bearing_drag.carrier_viscous", "Viscous drag on the carrier").real(
                units::NMS_PER_RAD,
                (0.0, 1e3),
                |p| &mut p.carrier_viscous,
            ),
            row("bearing_drag.carrier_churning", "Churning of oil by the carrier, with the square of its speed").real(
                units::NMS2_PER_RAD2,
                (0.0, 1e2),
                |p| &mut p.carrier_churning,
            ),
            row("bearing_drag.side_torque", "Load-independent bearing torque on each side gear").real(
                units::NEWTON_METRE,
                (0.0, 1e4),
                |p| &mut p.side_torque,
            ),
            row("bearing_drag.side_viscous", "Viscous drag on each side gear").real(
                units::NMS_PER_RAD,
                (0.0, 1e3),
                |p| &mut p.side_viscous,
            ),
            row("bearing_drag.breakaway_speed", "Speed at which the bearing torque has built up")
                .when("bearing_drag.carrier_torque > 0 or bearing_drag.side_torque > 0")
                .real((units::RAD_PER_S, DEG_PER_S), (1e-6, 1e3), |p| &mut p.breakaway_speed),
            row(
                "bearing_drag.viscosity_from_oil",
                "Viscous drag by the viscosity of the oil at its temperature; false: as given",
            )
            .when("bearing_drag.carrier_viscous > 0 or bearing_drag.side_viscous > 0")
            .switch(|p| &mut p.viscosity_from_oil),
            row("bearing_drag.reference_temperature", "Temperature of the oil at which viscous drag is as given")
                .when("bearing_drag.viscosity_from_oil = true")
                .real((units::KELVIN, DEG_C), (213.15, 673.15), |p| &mut p.reference_temperature),
        ]
    }
}

impl Effect for BearingDragSpec {
    fn is_oiled(&self) -> bool {
        self.viscosity_from_oil
    }

    fn on_bodies(&self, setting: &Setting, _: &Plan) -> Option<Box<dyn BodyEffect>> {
        let reference = setting.oil.viscosity(self.reference_temperature);
        Some(Box::new(Drag { spec: *self, reference, heat_index: setting.heat_index }))
    }
}

/// Drag on carrier and side gears.
#[derive(Clone, Copy, Debug)]
struct Drag {
    spec: BearingDragSpec,
    /// Viscosity of the oil at which viscous drag is as given [Pa·s].
    reference: f64,
    heat_index: usize,
}

impl Drag {
    /// Torque against the rotation of body `i` and its slope by the speed.
    fn drag(&self, at: &BodyMotion, i: usize) -> (f64, f64) {
        let spec = &self.spec;
        let (coulomb, viscous, churning) = if i == at.layout.carrier() {
            (spec.carrier_torque, spec.carrier_viscous, spec.carrier_churning)
        } else {
            (spec.side_torque, spec.side_viscous, 0.0)
        };
        let viscous = match at.oil_viscosity {
            Some(viscosity) if spec.viscosity_from_oil => viscous * (viscosity / self.reference),
            _ => viscous,
        };
        let v = at.v[i];
        let t = libm::tanh(v / spec.breakaway_speed);
        (
            coulomb * t + viscous * v + churning * v * v.abs(),
            coulomb * (1.0 - t * t) / spec.breakaway_speed + viscous + 2.0 * churning * v.abs(),
        )
    }
}

impl BodyEffect for Drag {
    fn act(&self, at: &BodyMotion, out: &mut Action) {
        for i in 0..3 {
            let (torque, _) = self.drag(at, i);
            out.force[i] -= torque;
            out.heat[self.heat_index] += torque * at.v[i];
        }
    }

    fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
        for i in 0..3 {
            out.velocity(i, i, -self.drag(at, i).1);
        }
    }
}
