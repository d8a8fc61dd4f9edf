//! Dry friction of ideal gears: where it acts, and where it sticks or slides. Planets stick with the side gears here.

use super::power::Power;
use super::rigid_equations::RigidEquations;
use crate::integrate::Point;
use crate::model::assembly::rigid::MOST;
use crate::model::effect_kinds::friction_state::Mode;
use crate::model::effect_kinds::slip::Slip;
use crate::model::effect_kinds::surface_load::SurfaceLoad;
use crate::model::scene::layout::{CARRIER, FRICTION_BODIES, FRICTION_WHEELS};
use crate::model::setup::effect_outputs::HEATS;

impl RigidEquations<'_> {
    /// Bodies that may stick, by their number: side gears, wheels. Planets stick with the side gears here.
    pub(super) fn bodies_that_stick() -> impl Iterator<Item = usize> {
        [0, 1, FRICTION_WHEELS, FRICTION_WHEELS + 1].into_iter()
    }

    /// Those on which friction acts.
    pub(super) fn bodies_with_friction(&self) -> impl Iterator<Item = usize> {
        Self::bodies_that_stick().filter(|&i| self.friction.on(i).is_on())
    }

    /// Degree of freedom on which the friction of body `i` acts.
    pub(super) fn freedom_of(&self, i: usize) -> usize {
        if i < FRICTION_WHEELS { i } else { self.wheel(i - FRICTION_WHEELS) }
    }

    /// Motion of body `i` against the surface it rubs on: carrier, or ground.
    pub(super) fn slip(&self, at: &Point<MOST>, i: usize) -> Slip {
        let body = self.freedom_of(i);
        if i < FRICTION_WHEELS {
            return Slip { position: at.q[i], speed: at.v[i] - at.v[CARRIER] };
        }
        let s = i - FRICTION_WHEELS;
        let twist = if body == s { 0.0 } else { at.q[body] };
        Slip { position: at.q[CARRIER] + at.q[s] - twist, speed: at.v[body] }
    }

    /// Loads on all rubbing surfaces `time` [s] after the inputs were set.
    pub(super) fn surface_loads(&self, time: f64) -> [SurfaceLoad; FRICTION_BODIES] {
        let mut all = [SurfaceLoad::default(); FRICTION_BODIES];
        let wheels = if self.driven && time > 0.0 {
            self.friction.wheel_loads(&self.input_derivatives.after(time, &self.inputs).0)
        } else {
            self.friction.wheel_loads(&self.inputs)
        };
        all[FRICTION_WHEELS..].copy_from_slice(&wheels);
        all
    }

    /// Torques of the friction on the wheels [N·m].
    pub fn brake_torques(&self, at: &Point<MOST>) -> [f64; 2] {
        let surface_loads = self.surface_loads(0.0);
        [FRICTION_WHEELS, FRICTION_WHEELS + 1].map(|i| {
            let friction = self.friction.on(i);
            let torque = || friction.torque(&self.friction_state[i], &self.slip(at, i), &surface_loads[i]);
            if friction.is_on() { torque() } else { 0.0 }
        })
    }

    /// Distance of each friction from its switch, where it acts.
    pub(in crate::model) fn friction_margins(&self, at: &Point<MOST>) -> [Option<f64>; FRICTION_BODIES] {
        let surface_loads = self.surface_loads(0.0);
        let mut margins = [None; FRICTION_BODIES];
        for i in self.bodies_with_friction() {
            let margin = self.friction.on(i).margin(&self.friction_state[i], &self.slip(at, i), &surface_loads[i]);
            margins[i] = Some(margin);
        }
        margins
    }

    /// Whether friction is due to switch at `at`, `time` [s] after the inputs were set.
    pub fn is_friction_due(&self, at: &Point<MOST>, time: f64) -> bool {
        let surface_loads = self.surface_loads(time);
        let due = |i: usize| self.friction.on(i).is_due(&self.friction_state[i], &self.slip(at, i), &surface_loads[i]);
        self.bodies_with_friction().any(due)
    }

    /// Drags the anchors of bodies that slide along to `at`, where the ledger rates are `power`.
    pub fn drag_anchors(&self, at: &Point<MOST>, power: &Power, anchors: &mut [f64; FRICTION_BODIES]) {
        for i in self.bodies_with_friction().filter(|&i| self.friction_state[i].mode != Mode::Stuck) {
            anchors[i] = self.friction.on(i).drag(anchors[i], self.slip(at, i).position, power.limit[i]);
        }
    }

    /// Switches friction where it is due at `at`, `time` [s] after the inputs were set, on `bodies`; what its springs
    /// lose is heat.
    pub fn settle_friction(
        &mut self,
        at: &Point<MOST>,
        time: f64,
        bodies: std::ops::Range<usize>,
        heat: &mut [f64; HEATS],
    ) {
        let surface_loads = self.surface_loads(time);
        for i in Self::bodies_that_stick().filter(|i| bodies.contains(i)) {
            let (friction, slip) = (*self.friction.on(i), self.slip(at, i));
            if friction.is_on() {
                friction.settle(&mut self.friction_state[i], &slip, &surface_loads[i], 1.0, heat);
            }
        }
    }

    /// Takes friction over from another stiffness.
    pub fn adapt_friction(&mut self, at: &Point<MOST>, heat: &mut [f64; HEATS]) {
        for i in Self::bodies_that_stick() {
            let (friction, slip) = (*self.friction.on(i), self.slip(at, i));
            friction.adapt(&mut self.friction_state[i], &slip, heat, 1.0);
        }
    }
}
