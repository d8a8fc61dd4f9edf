//! Lock between both side gears and the carrier: a clutch that is pressed from outside, with T_max = command × torque. While it holds,
//! each side is a spring and a damper in parallel: T = command × stiffness × (z + τ ω).

use super::limited_slip::CLUTCH_HEAT;
use crate::declaration::prelude::*;
use crate::declaration::{Row, row};
use crate::model::effect_kinds::dry_friction::DAMPING_TIME;
use crate::model::effect_kinds::{
    Actuates, Actuator, BUILT, ByLoad, Command, Declare, Effect, EffectSetting, Heat, InputField, RubbingSurface,
};
use crate::model::scene::{ACTUATED_LOCK, RubbingKind};

parameters! {
    /// Lock between side gears and carrier, controlled by a command.
    pub struct LockSpec in "lock" {
        /// Lock torque on each side at full command
        torque: f64 = 5e3, NEWTON_METRE, 0.0..=1e7;
        /// Lock stiffness on each side at full command
        stiffness: f64 = 1e6, NM_PER_RAD, 1.0..=1e9;
        /// Damping of the closed lock over its stiffness
        damping_time: f64 = DAMPING_TIME, SECOND, 0.0..=1.0;
        ..actuator: Actuator;
    }
}

impl Actuates for LockSpec {
    fn actuator(&mut self) -> &mut Actuator {
        &mut self.actuator
    }
}

impl Declare for LockSpec {
    const DESCRIPTION: &'static str = "Lock between side gears and carrier, controlled by lock.command";
    const HEAT: Option<Heat> = Some(CLUTCH_HEAT);
    const EXAMPLE: &'static [(&'static str, f64)] = &[("lock.command", 1.0)];

    fn inputs() -> Vec<Row<InputField>> {
        // a build without effects accepts no command for the lock
        let most = if BUILT { 1.0 } else { 0.0 };
        let row = row("lock.command", "Command of the differential lock: 0 open, 1 locked");
        vec![row.command(ONE, most, |i| &mut i.lock)]
    }
}

impl Effect for LockSpec {
    fn actuator(&self) -> Option<(Actuator, &'static [usize])> {
        Some((self.actuator, &[ACTUATED_LOCK]))
    }

    fn add_surfaces(&self, setting: &EffectSetting, surfaces: &mut Vec<RubbingSurface>) {
        surfaces.push(RubbingSurface {
            limit: ByLoad { constant: self.torque, ..ByLoad::NONE },
            stiffness: self.stiffness,
            damping_time: [self.damping_time; 2],
            command: Command::Lock,
            ..RubbingSurface::new(RubbingKind::Side, setting.heat_index)
        });
    }
}
