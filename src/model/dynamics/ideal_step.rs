//! The exact step of the ideal differential under constant inputs.

use super::State;
use crate::model::assembly::Ideal;
use crate::model::scene::{CARRIER, Inputs, PLANET};

impl Ideal {
    /// Exact motion over `h` [s] under constant inputs.
    pub fn advance(&self, state: &mut State, inputs: &Inputs, h: f64) {
        let m = self.motion(inputs);
        let v = state.v;
        let turn = |speed: f64, acceleration: f64| h * (speed + 0.5 * h * acceleration);
        let (carrier, spin) = (turn(v[CARRIER], m.carrier), turn(v[PLANET], m.spin));
        let relative = self.ratio * spin;
        state.q[0] += relative;
        state.q[1] -= relative;
        state.q[CARRIER] += carrier;
        for g in 0..self.plan.groups().len() {
            state.q[PLANET + g] += spin;
        }
        let [left, right] = inputs.load_torque;
        state.work += m.carrier_torque * carrier + m.spin_torque * spin
            - left * (carrier + relative)
            - right * (carrier - relative);
        state.v[CARRIER] += h * m.carrier;
        state.v[PLANET] += h * m.spin;
        self.constrain(&mut state.v);
    }
}
