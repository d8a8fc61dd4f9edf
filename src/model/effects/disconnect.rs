//! Disconnect: dog clutches between side gears and half-shafts.
//!
//! ```text
//! open      T = 0, or T_r sgn φ̇ while its teeth ratchet because it is to close
//! closes    when |φ̇| ≤ Δω and the teeth face gaps, within the lash, so it transmits no torque
//! closed    T = max(0, k (φ − b/2) + c φ̇) and its mirror image: the half-shaft with the lash b of the teeth
//! opens     when |T| falls to its limit; the energy of the twist becomes heat
//! ```
//!
//! φ is the angle of the side gear minus that of the wheel, from the middle of a gap on. Teeth that face teeth at the same
//! speed wait for ever.
//!
//! Source: H. Naunheimer et al., Automotive Transmissions, 2nd ed., Springer 2011, chapter 9, dog clutches.

use crate::declaration::prelude::*;
use crate::declaration::{Row, sides};
use crate::model::effect_kinds::{
    Class, Declare, Effect, EffectSetting, Heat, InputField, Instant, Reading, Warmed, readings,
};
use crate::model::scene::{Dog, DogMotion, DogPhase, Requests};
use crate::model::thermal::OIL;
use crate::numeric::TAU;
use crate::problem::Problem;

choices! {
    /// Sides with a dog clutch.
    pub enum DogSides: "DogSides" {
        Left = 1, "left": "between the left side gear and its half-shaft";
        Right = 2, "right": "between the right side gear and its half-shaft";
        Both = 3, "both": "on both sides";
    }
}

parameters! {
    /// Dog clutches between side gears and half-shafts.
    pub struct DisconnectSpec in "disconnect" {
        /// Sides with a dog clutch
        sides: DogSides = DogSides::Right;
        /// Number of teeth of each half
        teeth: i32 = 24, ONE, 3..=500;
        /// Lash of the closed teeth
        lash: f64 = 0.02, RADIAN | DEG, 1e-6..=1.0;
        /// Difference of the speeds of side gear and wheel up to which the teeth engage
        most_speed: f64 = 5.0, RAD_PER_S | RPM, 1e-3..=1e4;
        /// Torque up to which the teeth disengage
        most_torque: f64 = 20.0, NEWTON_METRE, 1e-3..=1e6;
        /// Mean torque of ratcheting teeth, which are to close but cannot yet
        ratchet_torque: f64 = 0.0, NEWTON_METRE, 0.0..=1e5;
    }
}

impl Declare for DisconnectSpec {
    const DESCRIPTION: &'static str = "Disconnect: dog clutches between side gears and half-shafts";
    const CLASS: Class = Class::Machine;
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.disconnect",
        description: "Heat of dog clutches since the start: of ratcheting teeth, and of twists that are released",
        warms: Warmed::Node(OIL),
    });
    const READINGS: &'static [Reading] = readings! {
        /// Left dog clutch: 0 open, 1 waits for equal speeds, 2 waits for a gap, 3 closed, 4 waits for low torque (3
        /// also without a clutch)
        "left.dog_phase": ONE, Always(|_, at| phase(0, at));
        /// Right dog clutch: 0 open, 1 waits for equal speeds, 2 waits for a gap, 3 closed, 4 waits for low torque (3
        /// also without a clutch)
        "right.dog_phase": ONE, Always(|_, at| phase(1, at));
    };
    const EXAMPLE: &'static [(&'static str, f64)] =
        &[("effects.half_shaft", 1.0), ("inertia.left_end", 0.5), ("inertia.right_end", 0.5)];

    fn inputs() -> Vec<Row<InputField>> {
        let [left, right] =
            sides("dog_command", "Command of the {side} dog clutch, with effects.disconnect: closed above 0.5");
        vec![
            left.when(is!(Self.sides, DogSides::Left, DogSides::Both)).command(ONE, 1.0, |i| &mut i.dog_command[0]),
            right.when(is!(Self.sides, DogSides::Right, DogSides::Both)).command(ONE, 1.0, |i| &mut i.dog_command[1]),
        ]
    }
}

/// Number of the phase of the dog clutch of side `s`. A side without a clutch is closed.
fn phase(s: usize, at: &Instant) -> f64 {
    let (motion, Some(dog)) = (at.motion, &at.plan.dogs[s]) else { return f64::from(DogPhase::Closed as u8) };
    let end = motion.layout.end(s);
    let local = DogMotion { twist: motion.q[end], rate: motion.v[s] - motion.v[end], torque: at.shaft_torque[s] };
    f64::from(dog.phase(motion.dogs.of(s), &local) as u8)
}

impl Effect for DisconnectSpec {
    fn check(&self, _: &EffectSetting, found: &mut Vec<Problem>) {
        if self.lash >= self.pitch() {
            found.push(problem!(
                "disconnect.lash",
                "{} is not below the pitch of disconnect.teeth = {}, {}",
                DEG.text(self.lash),
                self.teeth,
                DEG.text(self.pitch())
            ));
        }
    }

    fn requests(&self, setting: &EffectSetting) -> Requests {
        let dog = Dog {
            pitch: self.pitch(),
            half_lash: 0.5 * self.lash,
            most_speed: self.most_speed,
            most_torque: self.most_torque,
            ratchet: self.ratchet_torque,
            heat_index: setting.heat_index,
        };
        let sides = [self.sides != DogSides::Right, self.sides != DogSides::Left];
        Requests { dogs: sides.map(|has_dog| has_dog.then_some(dog)), ..Requests::default() }
    }
}

impl DisconnectSpec {
    /// Pitch of the teeth [rad].
    fn pitch(&self) -> f64 {
        TAU / f64::from(self.teeth)
    }
}
