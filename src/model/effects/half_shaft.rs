//! Torsion of the half-shafts: T = k φ + c φ̇ with the twist φ = θ_s − θ_end between side gear and wheel.
//!
//! Kelvin–Voigt element of a uniform shaft, k = G I_t / L.

use crate::declaration::prelude::*;
use crate::model::effect_kinds::{
    Action, BodyEffect, BodyMotion, Declare, Effect, Heat, Instant, Reading, Setting, Slopes, readings,
};
use crate::model::scene::{InertiaSpec, Plan, Requests, Scene, SideDrive};
use crate::problem::Problem;

parameters! {
    /// Torsion of the half-shafts.
    pub struct HalfShaftSpec in "half_shaft" {
        /// Torsional stiffness of the {side} half-shaft
        stiffness: [f64; 2] = [1e4; 2], NM_PER_RAD, 0.0..=1e9, when_each(driven().map(|driven| any([on!(Self), driven])));
        /// Torsional damping of the {side} half-shaft
        damping: [f64; 2] = [5.0; 2], NMS_PER_RAD, 0.0..=1e6, when_each(twists());
    }
}

/// Condition that the wheel side of each half-shaft is driven by speed.
fn driven() -> [Condition; 2] {
    [is!(Scene.left_drive, SideDrive::Speed), is!(Scene.right_drive, SideDrive::Speed)]
}

/// Condition that the twist of each half-shaft changes with a delay.
fn twists() -> [Condition; 2] {
    let [left, right] = driven();
    let on = on!(HalfShaftSpec);
    [
        any([left, all([on, above!(InertiaSpec.left_end, 0.0)])]),
        any([right, all([on, above!(InertiaSpec.right_end, 0.0)])]),
    ]
}

impl Declare for HalfShaftSpec {
    const DESCRIPTION: &'static str = "Torsion of the half-shafts, with inertia at the wheels";
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.half_shaft",
        description: "Heat of damping in the half-shafts since the start",
        at_wheels: false,
    });
    const READINGS: &'static [Reading] = readings! {
        /// Twist of the half-shaft, positive if the side gear is ahead of the wheel; 0 for a rigid half-shaft
        "left.twist": RADIAN | DEG, Always(|shafts, at| shafts.twist(0, at));
        /// Twist of the half-shaft, positive if the side gear is ahead of the wheel; 0 for a rigid half-shaft
        "right.twist": RADIAN | DEG, Always(|shafts, at| shafts.twist(1, at));
    };
    /// A speed-driven side acts through its half-shaft.
    const MAY_ACT_UNSWITCHED: bool = true;
    const EXAMPLE: &'static [(&'static str, f64)] = &[("inertia.left_end", 0.5), ("inertia.right_end", 0.5)];

    fn when() -> Option<Condition> {
        Some(any([is!(Scene.left_drive, SideDrive::Torque), is!(Scene.right_drive, SideDrive::Torque)]))
    }
}

impl Effect for HalfShaftSpec {
    fn check(&self, setting: &Setting, found: &mut Vec<Problem>) {
        let moving_ends = self.requests(setting).shafts;
        let drives = [setting.scene.left_drive, setting.scene.right_drive];
        for s in 0..2 {
            if (moving_ends[s] || drives[s] == SideDrive::Speed) && self.stiffness[s] <= 0.0 {
                found.push(problem!(
                    ["half_shaft.left_stiffness", "half_shaft.right_stiffness"][s],
                    "{} N.m/rad: a half-shaft that twists needs a stiffness above 0",
                    self.stiffness[s]
                ));
            }
        }
    }

    fn requests(&self, setting: &Setting) -> Requests {
        // an end without inertia passes its load on without delay, so the shaft has a static twist and its end has no
        // degree of freedom
        let end = [setting.inertia.left_end, setting.inertia.right_end];
        Requests { shafts: end.map(|inertia| setting.on && inertia > 0.0), ..Requests::default() }
    }

    fn on_bodies(&self, setting: &Setting, plan: &Plan) -> Option<Box<dyn BodyEffect>> {
        let shafts = HalfShafts::new(self, plan);
        plan.layout()
            .has_ends()
            .then(|| Box::new(ShaftTorques { shafts, heat_index: setting.heat_index }) as Box<dyn BodyEffect>)
    }
}

impl HalfShaftSpec {
    /// Twist of the half-shaft of side `s` [rad].
    fn twist(&self, s: usize, at: &Instant) -> f64 {
        if at.plan.shafts[s] {
            at.motion.q[at.motion.layout.end(s)]
        } else if at.on && self.stiffness[s] > 0.0 {
            // the end has no degree of freedom, so the twist is static
            at.shaft_torque[s] / self.stiffness[s]
        } else {
            0.0
        }
    }
}

/// Stiffness and damping of the half-shafts whose ends are degrees of freedom.
#[derive(Clone, Copy, Debug)]
pub struct HalfShafts {
    /// Stiffness k, left and right [N·m/rad].
    stiffness: [f64; 2],
    /// Damping c, left and right [N·m·s/rad].
    damping: [f64; 2],
}

impl HalfShafts {
    /// Half-shafts of `plan`. Stiffness and damping are 0 on a side whose end has no degree of freedom.
    pub fn new(spec: &HalfShaftSpec, plan: &Plan) -> Self {
        let of = |values: [f64; 2]| [0, 1].map(|s| if plan.shafts[s] { values[s] } else { 0.0 });
        Self { stiffness: of(spec.stiffness), damping: of(spec.damping) }
    }

    /// Torque that the shaft of side `s` delivers to the wheel [N·m], at `twist` [rad] and its `rate` [rad/s].
    #[inline]
    pub fn torque(&self, s: usize, twist: f64, rate: f64) -> f64 {
        self.stiffness[s] * twist + self.damping[s] * rate
    }

    /// Power that damping of the shaft of side `s` turns into heat [W], at the `rate` of its twist [rad/s].
    #[inline]
    pub fn heat(&self, s: usize, rate: f64) -> f64 {
        self.damping[s] * rate * rate
    }

    /// Static twist of the shaft of side `s` [rad] under `torque` [N·m].
    pub fn static_twist(&self, s: usize, torque: f64) -> f64 {
        torque / self.stiffness[s]
    }
}

/// Torques of the half-shafts on side gears and ends.
#[derive(Clone, Copy, Debug)]
struct ShaftTorques {
    shafts: HalfShafts,
    heat_index: usize,
}

impl BodyEffect for ShaftTorques {
    fn act(&self, at: &BodyMotion, out: &mut Action) {
        for s in 0..2 {
            let end = at.layout.end(s);
            let rate = at.v[s] - at.v[end];
            let torque = self.shafts.torque(s, at.q[end], rate);
            out.force[s] -= torque;
            out.force[end] += torque;
            out.heat[self.heat_index] += self.shafts.heat(s, rate);
        }
    }

    fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
        for s in 0..2 {
            let end = at.layout.end(s);
            let (k, c) = (self.shafts.stiffness[s], self.shafts.damping[s]);
            out.position(s, end, -k);
            out.position(end, end, k);
            out.velocity(s, s, -c);
            out.velocity(s, end, c);
            out.velocity(end, s, c);
            out.velocity(end, end, -c);
        }
    }

    fn heat_of_half_shafts(&self) -> Option<usize> {
        Some(self.heat_index)
    }

    fn energy(&self, at: &BodyMotion) -> f64 {
        (0..2)
            .map(|s| {
                let twist = at.q[at.layout.end(s)];
                0.5 * self.shafts.stiffness[s] * twist * twist
            })
            .sum()
    }
}
