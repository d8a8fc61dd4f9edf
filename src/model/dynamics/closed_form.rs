//! Ideal gears without effects: the motion of a step in closed form.
//!
//! Under constant inputs, speeds are linear and angles quadratic in time. Inputs with derivatives are parabolas of
//! time, so that speeds are cubics and angles quartics. The work is the integral of torques times speeds.

use super::State;
use crate::model::assembly::{Ideal, IdealMotion};
use crate::model::scene::{CARRIER, Inputs, PLANET};

impl Ideal {
    /// Advances the motion by `h` [s] under constant inputs. The result is exact.
    pub fn advance(&self, state: &mut State, inputs: &Inputs, h: f64) {
        let m = self.motion(inputs);
        let v = state.v;
        let turn = |speed: f64, acceleration: f64| h * (speed + 0.5 * h * acceleration);
        let (carrier, spin) = (turn(v[CARRIER], m.carrier), turn(v[PLANET], m.spin));
        let relative = self.turn(state, carrier, spin);
        let [left, right] = inputs.load_torque;
        state.sums.work += m.carrier_torque * carrier + m.spin_torque * spin
            - left * (carrier + relative)
            - right * (carrier - relative);
        state.v[CARRIER] += h * m.carrier;
        state.v[PLANET] += h * m.spin;
        self.constrain(&mut state.v);
    }

    /// Advances the motion by `h` [s] under inputs that are parabolas of time. The result is exact. `motions` are
    /// accelerations and torques with their derivatives.
    #[inline]
    pub fn advance_along(&self, state: &mut State, motions: &[IdealMotion; 3], h: f64) {
        let carrier = SpeedCubic { speed: state.v[CARRIER], acceleration: motions.each_ref().map(|m| m.carrier) };
        let spin = SpeedCubic { speed: state.v[PLANET], acceleration: motions.each_ref().map(|m| m.spin) };
        let (by_carrier, by_spin) = (carrier.moments(h), spin.moments(h));
        for (k, m) in motions.iter().enumerate() {
            state.sums.work += m.net[0] * by_carrier[k] + m.net[1] * by_spin[k];
        }
        self.turn(state, by_carrier[0], by_spin[0]);
        (state.v[CARRIER], state.v[PLANET]) = (carrier.speed_at(h), spin.speed_at(h));
    }

    /// Turns all gears by the angles of carrier and spin. Returns the angle of the left side gear relative to the
    /// carrier.
    #[inline]
    fn turn(&self, state: &mut State, carrier: f64, spin: f64) -> f64 {
        let relative = self.ratio * spin;
        state.q[0] += relative;
        state.q[1] -= relative;
        state.q[CARRIER] += carrier;
        for g in 0..self.plan.groups().len() {
            state.q[PLANET + g] += spin;
        }
        relative
    }

    /// Sets imposed speeds to their `inputs`, and speeds of side gears by Willis' equation.
    pub fn impose(&self, state: &mut State, inputs: &Inputs) {
        if self.plan.drive_imposed {
            state.v[CARRIER] = inputs.drive_speed;
        }
        if self.plan.spin_imposed {
            state.v[PLANET] = inputs.planet_spin;
        }
        self.constrain(&mut state.v);
    }
}

/// Motion whose acceleration is a parabola of time: ω = ω₀ + a t + ȧ t²/2 + ä t³/6.
struct SpeedCubic {
    /// Speed at the start, ω₀ [rad/s].
    speed: f64,
    /// Acceleration at the start and its derivatives: a, ȧ, ä [rad/s², rad/s³, rad/s⁴].
    acceleration: [f64; 3],
}

impl SpeedCubic {
    /// Speed after `h` [s].
    fn speed_at(&self, h: f64) -> f64 {
        let [a, b, c] = self.acceleration;
        self.speed + h * (a + h * (0.5 * b + h * (c * (1.0 / 6.0))))
    }

    /// ∫ω dt, ∫ω t dt and ∫ω t²/2 dt from 0 to `h` [s]. The first is the angle turned. The work of a torque
    /// M + Ṁ t + M̈ t²/2 is the sum of M, Ṁ and M̈ times these three integrals.
    fn moments(&self, h: f64) -> [f64; 3] {
        let (v, [a, b, c]) = (self.speed, self.acceleration);
        [
            h * (v + h * (0.5 * a + h * ((1.0 / 6.0) * b + h * ((1.0 / 24.0) * c)))),
            h * h * (0.5 * v + h * ((1.0 / 3.0) * a + h * (0.125 * b + h * ((1.0 / 30.0) * c)))),
            h * h * h * ((1.0 / 6.0) * v + h * (0.125 * a + h * (0.05 * b + h * ((1.0 / 72.0) * c)))),
        ]
    }
}
