//! Torsion of the half-shafts: T = k φ + c φ̇ with the twist φ = θ_s − θ_end between side gear and wheel.
//!
//! Kelvin–Voigt element of a uniform shaft, k = G I_t / L.

use crate::declaration::SIDES;
use crate::declaration::prelude::*;
use crate::model::effect_kinds::{
    Action, Attached, BodyEffect, BodyMotion, Declare, Effect, EffectSetting, Element, Heat, Instant, LashSpring, Law,
    Part, Reading, Slopes, Spring, Warmed, readings,
};
use crate::model::scene::{Dog, Dogs, InertiaSpec, Plan, Requests, Scene, SideDrive};
use crate::numeric::{Dual, Scalar, quotient};
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
        warms: Warmed::Shafts,
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
    fn check(&self, setting: &EffectSetting, found: &mut Vec<Problem>) {
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

    fn requests(&self, setting: &EffectSetting) -> Requests {
        // an end without inertia passes its load on without delay, so the shaft has a static twist and its end has no
        // degree of freedom
        let end = [setting.inertia.left_end, setting.inertia.right_end];
        Requests { shafts: end.map(|inertia| setting.on && inertia > 0.0), ..Requests::default() }
    }

    fn on_bodies(&self, setting: &EffectSetting, plan: &Plan) -> Option<Box<dyn BodyEffect>> {
        let (shafts, layout) = (HalfShafts::new(self, plan), plan.layout());
        if !layout.has_ends() {
            return None;
        }
        let end = [0, 1].map(|s| layout.end(s));
        if plan.dogs.iter().any(Option::is_some) {
            return Some(Box::new(ShaftsWithDogs { shafts, end, heat_index: setting.heat_index }));
        }
        // the twist grows if the side gear turns faster than the end
        let part = |s: usize| Part { law: shafts.springs[s], displacement: Some(end[s]), body: s, base: Some(end[s]) };
        Some(Box::new(Element::new([0, 1].map(part).into(), setting.heat_index)))
    }
}

impl HalfShaftSpec {
    /// Twist of the half-shaft of side `s` [rad].
    fn twist(&self, s: usize, at: &Instant) -> f64 {
        let motion = at.motion;
        if at.plan.shafts[s] {
            let (twist, dogs) = (motion.q[motion.layout.end(s)], motion.dogs);
            if dogs.is_open(&at.plan.dogs, s) { 0.0 } else { twist - dogs.middle(s) }
        } else if at.on && self.stiffness[s] > 0.0 {
            // the end has no degree of freedom, so the twist is static
            at.shaft_torque[s] / self.stiffness[s]
        } else {
            0.0
        }
    }
}

/// Half-shafts whose ends are degrees of freedom, left and right, behind dog clutches if the scene has any.
#[derive(Clone, Copy, Debug)]
pub struct HalfShafts {
    springs: [Spring; 2],
    /// Dog clutches.
    pub dogs: [Option<Dog>; 2],
}

impl HalfShafts {
    /// Half-shafts of `plan`. Stiffness and damping are 0 on a side whose end has no degree of freedom.
    pub fn new(spec: &HalfShaftSpec, plan: &Plan) -> Self {
        let of = |s: usize, value: f64| if plan.shafts[s] { value } else { 0.0 };
        let spring = |s: usize| Spring { stiffness: of(s, spec.stiffness[s]), damping: of(s, spec.damping[s]) };
        Self { springs: [0, 1].map(spring), dogs: plan.dogs }
    }

    /// Torque that the shaft of side `s` delivers to the wheel [N·m], at a twist [rad] and its rate [rad/s].
    #[inline]
    pub fn torque<T: Scalar>(&self, s: usize, [twist, rate]: [T; 2], dogs: &Dogs) -> T {
        match self.dogs[s] {
            None => self.springs[s].force(twist, rate, None),
            Some(_) => self.link(s, dogs).torque([twist, rate]),
        }
    }

    /// Link of side `s` between side gear and wheel.
    fn link(&self, s: usize, dogs: &Dogs) -> Link<'_> {
        let spring = &self.springs[s];
        let Some(dog) = &self.dogs[s] else { return Link::Shaft(spring) };
        match dogs.closed[s] {
            Some(gap) => {
                let Spring { stiffness, damping } = *spring;
                Link::Closed { spring: LashSpring { stiffness, damping, half_lash: dog.half_lash }, gap }
            }
            None => Link::Open { dog, ratchets: dogs.commanded[s] },
        }
    }

    /// Power that damping of the shaft of side `s` turns into heat [W], at the `rate` of its twist [rad/s].
    #[inline]
    pub fn heat(&self, s: usize, rate: f64) -> f64 {
        self.springs[s].heat(rate, 0.0)
    }

    /// Static twist of the shaft of side `s` [rad] under `torque` [N·m].
    pub fn static_twist(&self, s: usize, torque: f64, dogs: &Dogs) -> f64 {
        match self.link(s, dogs) {
            Link::Shaft(spring) => torque / spring.stiffness,
            Link::Closed { spring, gap } => gap + spring.displacement(torque),
            Link::Open { .. } => 0.0,
        }
    }

    /// Compliance of the shaft of side `s` [rad/(N·m)]; 0 if it does not twist.
    pub fn compliance(&self, s: usize) -> f64 {
        quotient(1.0, self.springs[s].stiffness).unwrap_or(0.0)
    }

    /// Fails if a dog clutch has no shaft that twists.
    pub fn check(&self) -> Result<(), Problem> {
        match (0..2).find(|&s| self.dogs[s].is_some() && self.springs[s].stiffness == 0.0) {
            None => Ok(()),
            Some(s) => Err(problem!(
                "effects.disconnect",
                "the {0} wheel cannot turn separately from its side gear; set effects.half_shaft = true and \
                 inertia.{0}_end above 0, or scene.{0}_drive = speed",
                SIDES[s]
            )),
        }
    }
}

/// Link between side gear and wheel.
enum Link<'a> {
    /// Half-shaft without dog clutch.
    Shaft(&'a Spring),
    /// Half-shaft behind a closed dog clutch, whose teeth are in the middle of their `gap` at this twist [rad].
    Closed { spring: LashSpring, gap: f64 },
    /// Open dog clutch.
    Open { dog: &'a Dog, ratchets: bool },
}

impl Link<'_> {
    /// Torque on the wheel [N·m].
    fn torque<T: Scalar>(&self, [twist, rate]: [T; 2]) -> T {
        match self {
            Self::Shaft(spring) => spring.force(twist, rate, None),
            Self::Closed { spring, gap } => spring.torque(twist - *gap, rate),
            Self::Open { dog, ratchets: true } => dog.ratcheting(rate),
            Self::Open { .. } => T::constant(0.0),
        }
    }

    /// Heat [W], and its index in the ledger; `shaft` is the index of the heat of half-shafts.
    fn heat(&self, [twist, rate]: [f64; 2], shaft: usize) -> (usize, f64) {
        match self {
            Self::Shaft(spring) => (shaft, spring.heat(rate, 0.0)),
            Self::Closed { spring, gap } => (shaft, spring.heat(twist - gap, rate)),
            Self::Open { dog, .. } => (dog.heat_index, self.torque([twist, rate]) * rate),
        }
    }

    /// Elastic energy [J].
    fn energy(&self, twist: f64) -> f64 {
        match self {
            Self::Shaft(spring) => spring.energy(twist),
            Self::Closed { spring, gap } => spring.energy(twist - gap),
            Self::Open { .. } => 0.0,
        }
    }
}

/// Half-shafts of a scene with dog clutches.
#[derive(Debug)]
struct ShaftsWithDogs {
    shafts: HalfShafts,
    /// Degrees of freedom of the wheel-side ends.
    end: [usize; 2],
    heat_index: usize,
}

impl ShaftsWithDogs {
    /// Twist of the shaft of side `s`, and its rate.
    fn local(&self, s: usize, at: &BodyMotion) -> [f64; 2] {
        [at.q[self.end[s]], at.v[s] - at.v[self.end[s]]]
    }
}

impl BodyEffect for ShaftsWithDogs {
    fn act(&self, at: &BodyMotion, out: &mut Action) {
        for s in 0..2 {
            let (link, motion) = (self.shafts.link(s, at.dogs), self.local(s, at));
            let torque = link.torque(motion);
            out.force[s] -= torque;
            out.force[self.end[s]] += torque;
            let (index, heat) = link.heat(motion, self.heat_index);
            out.heat[index] += heat;
        }
    }

    fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
        for s in 0..2 {
            let ([twist, rate], end) = (self.local(s, at), self.end[s]);
            let local = [Dual::<2>::variable(twist, 0), Dual::variable(rate, 1)];
            let [by_twist, by_rate] = self.shafts.torque(s, local, at.dogs).d;
            for (row, sign) in [(s, -1.0), (end, 1.0)] {
                out.position(row, end, sign * by_twist);
                out.velocity(row, s, sign * by_rate);
                out.velocity(row, end, -sign * by_rate);
            }
        }
    }

    fn kink(&self, at: &BodyMotion, h: f64) -> Option<f64> {
        let of = |s: usize| {
            let Link::Closed { spring, gap } = self.shafts.link(s, at.dogs) else { return None };
            let [twist, rate] = self.local(s, at);
            spring.kink(twist - gap, rate, h)
        };
        (0..2).filter_map(of).reduce(f64::min)
    }

    fn energy(&self, at: &BodyMotion) -> f64 {
        let of = |s: usize| self.shafts.link(s, at.dogs).energy(self.local(s, at)[0]);
        of(0) + of(1)
    }
}
