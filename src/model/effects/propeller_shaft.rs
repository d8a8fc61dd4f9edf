//! Propeller shaft between the drive and the pinion of the final drive, with one universal joint at its driven end.
//!
//! The shaft is a spring with a damper, T = k (θ₂ − θ_p) + c d/dt (θ₂ − θ_p), between the pinion and the output θ₂ of
//! the joint. At the joint angle β, the driven end θ₁ turns with
//!
//! ```text
//! θ₂ = θ₁ − atan2(q sin 2θ₁, 1 + q cos 2θ₁),   q = tan²(β/2)
//! ```
//!
//! which is tan θ₂ = cos β tan θ₁ without branches. A quarter turn of the joint reverses the sign of q, so that tan θ₂ =
//! tan θ₁/cos β. The torque on the driven end is T dθ₂/dθ₁.
//!
//! Source: kinematics of Hooke's joint, for example H. C. Seherr-Thoss, F. Schmelz, E. Aucktor, Universal Joints and
//! Driveshafts, Springer 2006.

use crate::declaration::prelude::*;
use crate::model::effect_kinds::{
    Action, Attached, BodyEffect, BodyMotion, Class, Declare, Effect, EffectSetting, Heat, Slopes, StaticLoads, Warmed,
};
use crate::model::scene::{AttachedBody, Base, CARRIER, PROPELLER, Plan, Requests};
use crate::numeric::{Dual, Scalar, cos, sin};

/// Number of iterations with which the static twist finds the joint's output at its own angle.
const ROUNDS: usize = 50;

parameters! {
    /// Propeller shaft.
    pub struct PropellerShaftSpec in "propeller_shaft" {
        /// Torsional stiffness of the propeller shaft
        stiffness: f64 = 2e4, NM_PER_RAD, 1e-3..=1e9;
        /// Torsional damping of the propeller shaft
        damping: f64 = 2.0, NMS_PER_RAD, 0.0..=1e6;
        /// Angle of the universal joint at the driven end; 0 = no joint
        joint_angle: f64 = 0.0, RADIAN | DEG, 0.0..=1.2;
        /// Joint turned by a quarter turn about the shaft
        joint_quarter_turn: bool = false, when(above!(Self.joint_angle, 0.0));
    }
}

impl Declare for PropellerShaftSpec {
    const DESCRIPTION: &'static str = "Propeller shaft that twists, in front of the final drive";
    const CLASS: Class = Class::Machine;
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.propeller_shaft",
        description: "Heat of damping in the propeller shaft since the start",
        warms: Warmed::Shafts,
    });
    const BODIES: &'static [Attached] = &[Attached {
        name: "the driven end of the propeller shaft",
        of: "propeller",
        states: ["lag", "carrier_speed"],
        descriptions: [
            "Angle by which the driven end lags behind the pinion, at the carrier's speed; 0 without \
             effects.propeller_shaft",
            "Speed of the driven end divided by the ratio of the final drive; 0 without effects.propeller_shaft, so for \
             the port read propeller.speed",
        ],
    }];
    const NEEDS_EFFECT: Option<&'static str> = Some("effects.final_drive");
    const EXAMPLE: &'static [(&'static str, f64)] =
        &[("effects.final_drive", 1.0), ("propeller_shaft.joint_angle", 0.1)];

    fn needs() -> Vec<(Need, Condition)> {
        vec![(Need::PropellerEnd, on!(Self))]
    }
}

impl Effect for PropellerShaftSpec {
    fn requests(&self, setting: &EffectSetting) -> Requests {
        let mut requests = Requests::default();
        requests.attached[PROPELLER] = Some(AttachedBody { to: Base::Pinion, inertia: setting.inertia.propeller_end });
        requests
    }

    fn on_bodies(&self, setting: &EffectSetting, plan: &Plan) -> Option<Box<dyn BodyEffect>> {
        let (layout, ratio) = (plan.layout(), plan.drive_ratio.unwrap_or(1.0));
        let half = 0.5 * self.joint_angle;
        let tangent = sin(half) / cos(half);
        Some(Box::new(Shaft {
            ratio,
            stiffness: self.stiffness,
            damping: self.damping,
            q: tangent * tangent * if self.joint_quarter_turn { -1.0 } else { 1.0 },
            pinion: layout.pinion(),
            end: layout.port,
            heat_index: setting.heat_index,
        }))
    }
}

/// Propeller shaft in a scene.
#[derive(Clone, Copy, Debug)]
struct Shaft {
    /// Ratio of the final drive.
    ratio: f64,
    /// Stiffness k [N·m/rad].
    stiffness: f64,
    /// Damping c [N·m·s/rad].
    damping: f64,
    /// q of the joint; 0 without a joint.
    q: f64,
    /// Degrees of freedom of the pinion and of the driven end.
    pinion: usize,
    end: usize,
    heat_index: usize,
}

/// Number of local coordinates: angle of the driven end, its lag behind the pinion, and the speeds of both, all at the
/// carrier's speed.
const LOCAL: usize = 4;

impl Shaft {
    /// Angle of the joint's output minus that of its input [rad], and dθ₂/dθ₁, at the angle θ₁ [rad].
    fn joint<T: Scalar>(&self, angle: T) -> [T; 2] {
        if self.q == 0.0 {
            return [T::constant(0.0), T::constant(1.0)];
        }
        let (sine, cosine) = ((angle * 2.0).sin(), (angle * 2.0).cos());
        let (y, x) = (sine * self.q, cosine * self.q + 1.0);
        // the derivative of atan2(y, x) along the angle is 2q (q + cos 2θ)/(x² + y²)
        let slope = (cosine + self.q) * (2.0 * self.q) / (x * x + y * y);
        // |y/x| is below one because |q| is
        [-(y / x).atan(), -slope + 1.0]
    }

    /// Twist of the shaft [rad], its rate, and dθ₂/dθ₁.
    fn twist<T: Scalar>(&self, [end, lag, end_speed, pinion_speed]: [T; LOCAL]) -> [T; 3] {
        let [ahead, slope] = self.joint(end * self.ratio);
        // θ₂ − θ_p = θ₁ − θ_p + (θ₂ − θ₁)
        let twist = lag * -self.ratio + ahead;
        [twist, (end_speed * slope - pinion_speed) * self.ratio, slope]
    }

    /// Torques on the driven end and on the pinion, at the carrier's speed.
    fn torques<T: Scalar>(&self, at: [T; LOCAL]) -> [T; 2] {
        let [twist, rate, slope] = self.twist(at);
        let torque = (twist * self.stiffness + rate * self.damping) * self.ratio;
        [-(torque * slope), torque]
    }

    /// True if the pinion turns relative to the carrier.
    fn has_own_pinion(&self) -> bool {
        self.pinion != CARRIER
    }

    /// Angle of the pinion at the carrier's speed.
    fn pinion_angle(&self, q: &[f64]) -> f64 {
        q[CARRIER] - if self.has_own_pinion() { q[self.pinion] } else { 0.0 }
    }

    /// Local coordinates.
    fn local(&self, at: &BodyMotion) -> [f64; LOCAL] {
        [self.pinion_angle(at.q) - at.q[self.end], at.q[self.end], at.v[self.end], at.v[self.pinion]]
    }
}

impl BodyEffect for Shaft {
    fn act(&self, at: &BodyMotion, out: &mut Action) {
        let local = self.local(at);
        let [on_end, on_pinion] = self.torques(local);
        out.force[self.end] += on_end;
        out.force[self.pinion] += on_pinion;
        let [_, rate, _] = self.twist(local);
        out.heat[self.heat_index] += self.damping * rate * rate;
    }

    fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
        let local = self.local(at);
        let torques = self.torques(std::array::from_fn(|k| Dual::<LOCAL>::variable(local[k], k)));
        for (row, torque) in [self.end, self.pinion].into_iter().zip(torques) {
            let [by_angle, by_lag, by_end_speed, by_pinion_speed] = torque.d;
            out.position(row, CARRIER, by_angle);
            if self.has_own_pinion() {
                out.position(row, self.pinion, -by_angle);
            }
            out.position(row, self.end, by_lag - by_angle);
            out.velocity(row, self.end, by_end_speed);
            out.velocity(row, self.pinion, by_pinion_speed);
        }
    }

    fn is_in_front(&self) -> bool {
        true
    }

    fn energy(&self, at: &BodyMotion) -> f64 {
        let [twist, ..] = self.twist(self.local(at));
        0.5 * self.stiffness * twist * twist
    }

    fn speed_ratio(&self) -> f64 {
        self.joint(0.0)[1]
    }

    fn shaft_torque(&self, at: &BodyMotion) -> Option<f64> {
        let [_, on_pinion] = self.torques(self.local(at));
        Some(on_pinion)
    }

    fn wind_up(&self, loads: &StaticLoads, [q, v]: [&mut [f64]; 2]) {
        let pinion = self.pinion_angle(q);
        for _ in 0..ROUNDS {
            let [twist, rate, slope] = self.twist([pinion - q[self.end], q[self.end], v[self.end], v[self.pinion]]);
            if !loads.imposed {
                v[self.end] = v[self.pinion] / slope;
            }
            // an imposed speed may wind the shaft, so that its damper carries a part
            let damped = if loads.imposed { self.damping * rate } else { 0.0 };
            let wanted = (loads.propeller / self.ratio - damped) / self.stiffness;
            q[self.end] += (twist - wanted) / (self.ratio * slope);
        }
    }
}
