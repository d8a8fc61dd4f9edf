//! Clutch packs between side gears and carrier: T_max = preload + κ |T_s|. T_s is the torque of the meshes on the side
//! gear; ramps and thrust press the plates in proportion to it. A factor for the slip speed multiplies T_max
//! (`effect_kinds::slip_law`). Friction that falls with speed causes judder.
//!
//! Source: the preloaded plate clutch of H. Naunheimer et al., Automotive Transmissions, 2nd ed., Springer 2011,
//! section 10.2.

use crate::declaration::units::{CM2, MM};
use crate::declaration::{Parameter, Row, row, units};
use crate::model::effect_kinds::{
    Declare, Effect, FrictionSource, Heat, Pressed, Reading, Setting, SideFriction, SlipSpec, SurfaceTemperature,
    check_slip, pv_reading, slip_rows,
};
use crate::model::scene::GearContact;
use crate::model::thermal::CLUTCH;
use crate::problem::Problem;

spec! {
    /// Clutch packs between side gears and carrier.
    pub struct LimitedSlipSpec {
        /// Torque of each clutch without load [N·m].
        pub preload: f64 = 0.0,
        /// Torque of each clutch per torque of the meshes on its side gear.
        pub torque_coefficient: f64 = 0.0,
        /// Breakaway torque of a stuck clutch over its sliding torque.
        pub static_ratio: f64 = 1.0,
        /// Stiffness of a stuck clutch [N·m/rad].
        pub stiffness: f64 = 1e5,
        /// Mean radius of the plates [m].
        pub mean_radius: f64 = 0.05,
        /// Area of all rubbing faces of a pack [m²].
        pub friction_area: f64 = 0.05,
        /// Coefficient of friction of the plates.
        pub plate_coefficient: f64 = 0.1,
        /// Sliding of the plates.
        pub sliding: SlipSpec = SlipSpec::default(),
    }
}

/// Heat of all clutches between side gears and carrier.
pub const CLUTCH_HEAT: Heat = Heat {
    output: "heat.clutch",
    description: "Heat of limited-slip clutches and lock since the start",
    at_wheels: false,
};

impl Declare for LimitedSlipSpec {
    const DESCRIPTION: &'static str =
        "Clutch packs between side gears and carrier, preloaded and torque-proportional, with stiction";
    const HEAT: Option<Heat> = Some(CLUTCH_HEAT);
    const EXAMPLE: &'static [(&'static str, f64)] = &[("limited_slip.preload", 50.0)];
    const READINGS: &'static [Reading] =
        &[pv_reading("pv.clutch", "Pressure times sliding speed of the clutch packs; larger of both")];

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        let mut rows: Vec<Row<Parameter<Self>>> = vec![
            row("limited_slip.preload", "Clutch torque on each side without load").tunable().real(
                units::NEWTON_METRE,
                (0.0, 1e6),
                |p| &mut p.preload,
            ),
            row("limited_slip.torque_coefficient", "Clutch torque on each side per mesh torque on the side gear")
                .tunable()
                .real(units::ONE, (0.0, 10.0), |p| &mut p.torque_coefficient),
            row("limited_slip.static_ratio", "Ratio of breakaway torque to sliding torque").real(
                units::ONE,
                (1.0, 10.0),
                |p| &mut p.static_ratio,
            ),
            row("limited_slip.stiffness", "Stiffness of a sticking clutch")
                .real(units::NM_PER_RAD, (1.0, 1e9), |p| &mut p.stiffness),
            row("limited_slip.mean_radius", "Mean radius of the plates, for sliding speed")
                .when("limited_slip.stribeck_speed > 0 or limited_slip.slip_slope != 0")
                .real((units::METRE, MM), (1e-3, 1.0), |p| &mut p.mean_radius),
            row("limited_slip.friction_area", "Total friction area of a clutch pack").real(
                (units::SQUARE_METRE, CM2),
                (1e-8, 10.0),
                |p| &mut p.friction_area,
            ),
            row("limited_slip.plate_coefficient", "Coefficient of friction of the plates").real(
                units::ONE,
                (0.01, 1.0),
                |p| &mut p.plate_coefficient,
            ),
        ];
        rows.extend(slip_rows!("limited_slip", sliding));
        rows
    }
}

impl Effect for LimitedSlipSpec {
    fn check(&self, setting: &Setting, found: &mut Vec<Problem>) {
        check_slip!("limited_slip", self.sliding, found);
        if self.torque_coefficient == 0.0 {
            return;
        }
        let contact = match setting.scene.gear_contact {
            GearContact::Ideal => "ideal",
            GearContact::Solid => "solid",
            GearContact::Lumped | GearContact::Tooth => return,
        };
        found.push(problem!(
            "limited_slip.torque_coefficient",
            "{}: a torque-proportional clutch needs the forces of the meshes, which scene.gear_contact = {contact} \
             does not provide to it; set the coefficient to 0 (preload only), or choose lumped or tooth",
            self.torque_coefficient
        ));
    }

    fn warnings(&self, _: &Setting) -> Vec<Problem> {
        let has_torque = self.preload > 0.0 || self.torque_coefficient > 0.0;
        let problem = || {
            Problem::new(
                "effects.limited_slip",
                "the clutches have no torque: set limited_slip.preload, limited_slip.torque_coefficient or both, or \
                 switch the effect off",
            )
        };
        if has_torque { Vec::new() } else { vec![problem()] }
    }

    fn friction(&self, setting: &Setting) -> Option<FrictionSource> {
        // a friction torque T = μ N r needs the pressure p = N/A, so that p r = T/(μ A)
        let per_torque = 1.0 / (self.plate_coefficient * self.friction_area);
        let pressed = Pressed { constant: self.preload, per_load: self.torque_coefficient, ..Pressed::NONE };
        let side = SideFriction {
            constant: self.preload,
            per_torque: self.torque_coefficient,
            stiffness: self.stiffness,
            radius: self.mean_radius,
            pressed: pressed.times(per_torque),
            ..SideFriction::default()
        };
        let Self { static_ratio, sliding, .. } = *self;
        let temperature = SurfaceTemperature::Node(CLUTCH);
        Some(FrictionSource { side, static_ratio, sliding, temperature, ..FrictionSource::new(setting.heat_index) })
    }
}
