//! Clutches on command. Each connects a side gear with a shaft that turns at σ times the carrier's speed ω_c, through a
//! gearing without mass and loss:
//!
//! ```text
//! σ = 1        electronic limited slip
//! σ = 1 ± ε    superposition, which speeds the wheel up or slows it down: torque vectoring
//! σ = 0        brake of the side gear on the housing
//!
//! s = σ ω_c − ω_side                                    slip
//! C = u T_max sgn s                                     on the side gear; −σ C on the carrier, (σ − 1) C on the housing
//! T_L − T_R = C_L − C_R                                 in steady slip
//! T_L + T_R = T_c + (1 − σ_L) C_L + (1 − σ_R) C_R
//! ```
//!
//! The command u runs from 0 (open) to 1 and passes an actuator (`effect_kinds::actuator`). A clutch without slip holds up to the same torque (`effect_kinds::dry_friction`).
//! Slip speed, temperature and p·v change its torque as those of a clutch pack. The torque refers to the side gear.
//!
//! Source: J. Deur, V. Ivanović, M. Hancock and F. Assadian, Modeling and analysis of active differential dynamics,
//! J. Dyn. Syst. Meas. Control 132 (2010) 061501.

use crate::declaration::prelude::*;
use crate::declaration::{Row, sides};
use crate::model::effect_kinds::dry_friction::DAMPING_TIME;
use crate::model::effect_kinds::{
    Actuates, Actuator, BUILT, ByLoad, Class, Command, Declare, Effect, EffectSetting, Heat, InputField, Instant,
    Reading, RubbingSurface, Slides, SlipSpec, SurfaceTemperature, Warmed, check_slip, depends_on_speed,
    depends_on_temperature, readings,
};
use crate::model::scene::{ACTUATED_CLUTCHES, CARRIER, Requests, RubbingKind};
use crate::model::thermal::CLUTCH;
use crate::problem::Problem;

parameters! {
    /// Clutches on command between side gears and shafts that the carrier drives.
    pub struct ClutchesSpec in "clutches" {
        /// Torque of each clutch on its side gear at full command
        torque: f64 = 1e3, NEWTON_METRE, 0.0..=1e7;
        /// Speed of the shaft of this clutch over the carrier's speed: 1 = limited slip, 0 = brake on the housing, other
        /// values = superposition
        ratio: [f64; 2] = [1.0; 2], ONE, -10.0..=10.0;
        /// Stiffness of a clutch without slip
        stiffness: f64 = 1e5, NM_PER_RAD, 1.0..=1e9;
        /// Damping of a clutch without slip over its stiffness
        damping_time: f64 = DAMPING_TIME, SECOND, 0.0..=1.0;
        /// Mean radius of the plates, for sliding speed
        mean_radius: f64 = 0.05, METRE | MM, 1e-3..=1.0, when(depends_on_speed::<Self>());
        /// Total friction area of a clutch
        friction_area: f64 = 0.05, SQUARE_METRE | CM2, 1e-8..=10.0;
        /// Coefficient of friction of the plates
        plate_coefficient: f64 = 0.1, ONE, 0.01..=1.0;
        ..sliding: SlipSpec;
        ..actuator: Actuator;
    }
}

impl Slides for ClutchesSpec {
    fn sliding(&mut self) -> &mut SlipSpec {
        &mut self.sliding
    }
}

impl Actuates for ClutchesSpec {
    fn actuator(&mut self) -> &mut Actuator {
        &mut self.actuator
    }
}

/// Heat of the clutches on command.
pub const COMMANDED_HEAT: Heat = Heat {
    output: "heat.clutch_command",
    description: "Heat of the clutches on command since the start",
    warms: Warmed::Node(CLUTCH),
};

impl Declare for ClutchesSpec {
    const DESCRIPTION: &'static str =
        "Clutches on command: electronic limited slip, torque vectoring, or brakes of the side gears";
    const CLASS: Class = Class::Machine;
    const BIASES_TORQUE: bool = true;
    const PV_LIMIT: Option<&'static str> = Some("clutches.pv_limit");
    const HEAT: Option<Heat> = Some(COMMANDED_HEAT);
    const READINGS: &'static [Reading] = readings! {
        /// Pressure times sliding speed of the clutches on command; larger of both
        "pv.clutch_command": W_PER_M2 | W_PER_MM2, Always;
        /// Torque of the left clutch on its side gear, positive if it drives forward
        "left.clutch_torque": NEWTON_METRE, Always(|_, at| at.clutch_torque[0]);
        /// Torque of the right clutch on its side gear, positive if it drives forward
        "right.clutch_torque": NEWTON_METRE, Always(|_, at| at.clutch_torque[1]);
        /// Speed of the shaft of the left clutch minus the speed of the side gear; 0 without effects.clutches
        "left.clutch_slip": RAD_PER_S | RPM, Always(|clutches, at| clutches.slip(0, at));
        /// Speed of the shaft of the right clutch minus the speed of the side gear; 0 without effects.clutches
        "right.clutch_slip": RAD_PER_S | RPM, Always(|clutches, at| clutches.slip(1, at));
        /// Torque of the gearing of both clutches on the housing, positive if it would turn it forward; 0 without
        /// effects.clutches
        "clutches.housing_torque": NEWTON_METRE, Always(|clutches, at| clutches.on_housing(at));
    };
    const EXAMPLE: &'static [(&'static str, f64)] = &[("left.clutch_command", 0.05), ("right.clutch_command", 0.05)];

    fn needs() -> Vec<(Need, Condition)> {
        vec![(Need::Temperature, all([on!(Self), depends_on_temperature::<Self>()]))]
    }

    fn inputs() -> Vec<Row<InputField>> {
        let [left, right] =
            sides("clutch_command", "Command of the {side} clutch, with effects.clutches: 0 open, 1 full torque");
        // a build without effects accepts no command
        let most = if BUILT { 1.0 } else { 0.0 };
        vec![
            left.command(ONE, most, |i| &mut i.clutch_command[0]),
            right.command(ONE, most, |i| &mut i.clutch_command[1]),
        ]
    }
}

impl ClutchesSpec {
    /// Slip of the clutch of side `s` [rad/s].
    fn slip(&self, s: usize, at: &Instant) -> f64 {
        if at.on { self.ratio[s] * at.motion.v[CARRIER] - at.motion.v[s] } else { 0.0 }
    }

    /// Torque on the housing [N·m].
    fn on_housing(&self, at: &Instant) -> f64 {
        if at.on { (0..2).map(|s| (self.ratio[s] - 1.0) * at.clutch_torque[s]).sum() } else { 0.0 }
    }
}

impl Effect for ClutchesSpec {
    fn check(&self, _: &EffectSetting, found: &mut Vec<Problem>) {
        check_slip!("clutches", self.sliding, found);
    }

    fn warnings(&self, _: &EffectSetting) -> Vec<Problem> {
        if self.torque > 0.0 {
            return Vec::new();
        }
        vec![Problem::new(
            "clutches.torque",
            "0 N.m: the clutches have no torque at any command; set their torque at full command",
        )]
    }

    fn requests(&self, _: &EffectSetting) -> Requests {
        Requests { clutch_ratio: self.ratio.map(Some), ..Requests::default() }
    }

    fn actuator(&self) -> Option<(Actuator, &'static [usize])> {
        Some((self.actuator, &ACTUATED_CLUTCHES))
    }

    fn add_surfaces(&self, setting: &EffectSetting, surfaces: &mut Vec<RubbingSurface>) {
        let limit = ByLoad { per_load: self.torque, ..ByLoad::NONE };
        surfaces.push(RubbingSurface {
            limit,
            stiffness: self.stiffness,
            damping_time: [self.damping_time; 2],
            radius: self.mean_radius,
            pressed: limit.pressed(self.plate_coefficient, self.friction_area),
            sliding: self.sliding,
            temperature: SurfaceTemperature::Node(CLUTCH),
            command: Command::Limits(|inputs| inputs.clutch_command),
            ..RubbingSurface::new(RubbingKind::Clutch, setting.heat_index)
        });
    }
}
