//! Torsion of the half-shafts: T = k φ + c φ̇ with the twist φ = θ_s − θ_end between side gear and wheel.
//!
//! Kelvin–Voigt element of a uniform shaft, k = G I_t / L.

use crate::declaration::prelude::*;
use crate::model::effect_kinds::{
    Attached, BodyEffect, Declare, Effect, Element, Heat, Instant, Law, Part, Reading, Setting, Spring, readings,
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

/// Wheel at the end of the half-shaft on a side.
macro_rules! wheel {
    ($side:literal) => {
        Attached {
            name: concat!("the ", $side, " wheel"),
            of: $side,
            states: ["shaft_twist", "end_speed"],
            descriptions: [
                concat!(
                    "Twist of the ",
                    $side,
                    " half-shaft, positive if the side gear is ahead; 0 without a separate wheel end"
                ),
                concat!(
                    "Speed of the wheel end of the ",
                    $side,
                    " half-shaft; 0 without a separate wheel end, so for the wheel read ",
                    $side,
                    ".wheel_speed"
                ),
            ],
        }
    };
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
    const BODIES: &'static [Attached] = &[wheel!("left"), wheel!("right")];
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
        let (shafts, layout) = (HalfShafts::new(self, plan), plan.layout());
        let part = |s: usize| {
            let end = layout.end(s);
            // the twist grows if the side gear turns faster than the end
            Part { law: shafts.0[s], displacement: Some(end), body: s, base: Some(end) }
        };
        layout.has_ends().then(|| Box::new(Element::new([0, 1].map(part).into(), setting.heat_index)) as _)
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

/// Half-shafts whose ends are degrees of freedom, left and right.
#[derive(Clone, Copy, Debug)]
pub struct HalfShafts([Spring; 2]);

impl HalfShafts {
    /// Half-shafts of `plan`. Stiffness and damping are 0 on a side whose end has no degree of freedom.
    pub fn new(spec: &HalfShaftSpec, plan: &Plan) -> Self {
        let of = |s: usize, value: f64| if plan.shafts[s] { value } else { 0.0 };
        Self([0, 1].map(|s| Spring { stiffness: of(s, spec.stiffness[s]), damping: of(s, spec.damping[s]) }))
    }

    /// Torque that the shaft of side `s` delivers to the wheel [N·m], at `twist` [rad] and its `rate` [rad/s].
    #[inline]
    pub fn torque(&self, s: usize, twist: f64, rate: f64) -> f64 {
        self.0[s].force(twist, rate, None)
    }

    /// Power that damping of the shaft of side `s` turns into heat [W], at the `rate` of its twist [rad/s].
    #[inline]
    pub fn heat(&self, s: usize, rate: f64) -> f64 {
        self.0[s].heat(rate, 0.0)
    }

    /// Static twist of the shaft of side `s` [rad] under `torque` [N·m].
    pub fn static_twist(&self, s: usize, torque: f64) -> f64 {
        torque / self.0[s].stiffness
    }
}
