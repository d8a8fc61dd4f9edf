//! Dry friction in the equations of motion: torques, derivatives, energy, and where it sticks or slides.

use super::equations::Equations;
use super::in_detail::Local;
use super::jacobian::Jacobian;
use super::power::Power;
use crate::contact::detailed::DetailedLoad;
use crate::contact::detailed::{LOCAL, WITH_OTHER};
use crate::integrate::{Matrix, Point};
use crate::model::assembly::teeth::SIGMA;
use crate::model::effect_kinds::dry_friction::DryFriction;
use crate::model::effect_kinds::friction_state::Mode;
use crate::model::effect_kinds::slip::Slip;
use crate::model::effect_kinds::surface_load::SurfaceLoad;
use crate::model::scene::layout::{CARRIER, FRICTION_BODIES, FRICTION_PLANETS, FRICTION_WHEELS};

impl<const N: usize, const G: usize, const WITH_EFFECTS: bool> Equations<'_, N, G, WITH_EFFECTS> {
    /// Bodies that may stick, by their number: side gears, groups of planets, wheels.
    fn bodies_that_stick(&self) -> impl Iterator<Item = usize> + use<N, G, WITH_EFFECTS> {
        (0..FRICTION_PLANETS + self.groups()).chain(FRICTION_WHEELS..FRICTION_WHEELS + 2)
    }

    /// Those on which friction acts.
    fn bodies_with_friction(&self) -> impl Iterator<Item = usize> {
        self.bodies_that_stick().filter(|&i| self.friction().on(i).is_on())
    }

    /// Degree of freedom on which the friction of body `i` acts.
    fn freedom_of(&self, i: usize) -> usize {
        match i {
            0..FRICTION_PLANETS => i,
            FRICTION_PLANETS..FRICTION_WHEELS => self.planet(i - FRICTION_PLANETS),
            _ => self.wheel(i - FRICTION_WHEELS),
        }
    }

    /// Degree of freedom of wheel `s`: the end of its half-shaft, or the side gear with a rigid one.
    fn wheel(&self, s: usize) -> usize {
        if self.ends() && self.teeth.plan.shafts[s] { self.end(s) } else { s }
    }

    /// Motion of body `i` against the surface it rubs on: carrier, pin, or ground.
    fn slip(&self, at: &Point<N>, i: usize) -> Slip {
        let body = self.freedom_of(i);
        match i {
            0..FRICTION_PLANETS => Slip { position: at.q[i], speed: at.v[i] - at.v[CARRIER] },
            FRICTION_PLANETS..FRICTION_WHEELS => Slip { position: at.q[body], speed: at.v[body] },
            _ => {
                let s = i - FRICTION_WHEELS;
                let twist = if body == s { 0.0 } else { at.q[body] };
                Slip { position: at.q[CARRIER] + at.q[s] - twist, speed: at.v[body] }
            }
        }
    }

    /// Friction on body `i`, and how many bodies it stands for.
    fn friction_on(&self, i: usize) -> (&DryFriction, f64) {
        let count =
            if (FRICTION_PLANETS..FRICTION_WHEELS).contains(&i) { self.members(i - FRICTION_PLANETS) } else { 1.0 };
        (self.friction().on(i), count)
    }

    /// Loads on all rubbing surfaces under the present inputs, given those of side gears and planets.
    pub(in crate::model) fn surface_loads_of(
        &self,
        sides: &[SurfaceLoad],
        planets: &[SurfaceLoad],
    ) -> [SurfaceLoad; FRICTION_BODIES] {
        let mut all = [SurfaceLoad::default(); FRICTION_BODIES];
        all[..sides.len()].copy_from_slice(sides);
        all[FRICTION_PLANETS..FRICTION_PLANETS + planets.len()].copy_from_slice(planets);
        all[FRICTION_WHEELS..].copy_from_slice(&self.friction().wheel_loads(&self.inputs));
        all
    }

    /// Whether loads decide if friction switches at `at`.
    fn awaits_load(&self, at: &Point<N>) -> bool {
        let awaits = |i: usize| self.friction().on(i).awaits_load(&self.friction_state[i], &self.slip(at, i));
        self.bodies_with_friction().any(awaits)
    }

    /// Loads on all rubbing surfaces at `at`, `time` [s] after the inputs were set.
    fn surface_loads(&self, at: &Point<N>, time: f64) -> [SurfaceLoad; FRICTION_BODIES] {
        let mut all = if self.friction().depends_on_load() {
            let (sides, planets) = self.mesh_surface_loads(at, &self.all_loads::<f64>(at));
            self.surface_loads_of(&sides, &planets)
        } else {
            self.surface_loads_of(&[], &[])
        };
        if self.is_driven_by_inputs() && time > 0.0 {
            let (inputs, _) = self.input_derivatives.after(time, &self.inputs);
            all[FRICTION_WHEELS..].copy_from_slice(&self.friction().wheel_loads(&inputs));
        }
        all
    }

    /// Adds the torques and the heat of dry friction under the loads on its surfaces.
    #[inline]
    pub(in crate::model) fn add_friction(
        &self,
        at: &Point<N>,
        surface_loads: impl FnOnce() -> [SurfaceLoad; FRICTION_BODIES],
        sum: &mut [f64; N],
        power: &mut Power,
    ) {
        if self.rubs() {
            self.rub(at, &surface_loads(), sum, power);
        }
    }

    fn rub(
        &self,
        at: &Point<N>,
        surface_loads: &[SurfaceLoad; FRICTION_BODIES],
        sum: &mut [f64; N],
        power: &mut Power,
    ) {
        for i in self.bodies_with_friction() {
            let (friction, count) = self.friction_on(i);
            let (state, slip) = (&self.friction_state[i], self.slip(at, i));
            let torque = friction.act(state, &slip, &surface_loads[i], count, &mut power.heat);
            power.limit[i] = torque * state.mode.direction();
            sum[self.freedom_of(i)] -= torque;
            if i < FRICTION_PLANETS {
                sum[CARRIER] += torque;
            }
        }
    }

    /// Adds the torques of brakes that slide, which follow from the inputs alone.
    pub(in crate::model) fn add_brakes(&self, sum: &mut [f64; N]) {
        let surface_loads = self.friction().wheel_loads(&self.inputs);
        for s in (0..2).filter(|&s| self.friction().wheel[s].is_on()) {
            let direction = self.friction_state[FRICTION_WHEELS + s].mode.direction();
            sum[self.wheel(s)] -= direction * self.friction().wheel[s].limit(&surface_loads[s]);
        }
    }

    /// Torques of the friction on the wheels [N·m].
    pub(in crate::model) fn brake_torques(&self, at: &Point<N>) -> [f64; 2] {
        let surface_loads = self.friction().wheel_loads(&self.inputs);
        [0, 1].map(|s| {
            let (friction, i) = (&self.friction().wheel[s], FRICTION_WHEELS + s);
            if friction.is_on() {
                friction.torque(&self.friction_state[i], &self.slip(at, i), &surface_loads[s])
            } else {
                0.0
            }
        })
    }

    /// Derivatives of dry friction by the motion of the bodies it holds.
    pub(in crate::model) fn friction_slopes(&self, j: &mut Jacobian<'_, N>) {
        if !self.rubs() {
            return;
        }
        for i in self.bodies_with_friction() {
            let [k, c] = self.friction().on(i).torque_slopes(&self.friction_state[i]);
            let body = self.freedom_of(i);
            if i >= FRICTION_WHEELS {
                // the angle of a wheel is that of the carrier, plus that of the side gear, less the twist
                let s = i - FRICTION_WHEELS;
                j.by_position[body][CARRIER] -= k;
                j.by_position[body][s] -= k;
                if body != s {
                    j.by_position[body][body] += k;
                }
                j.by_velocity[body][body] -= c;
                continue;
            }
            j.by_position[body][body] -= k;
            j.by_rate[body][body] -= c;
            if i < FRICTION_PLANETS {
                j.by_position[CARRIER][i] += k;
                j.by_rate[CARRIER][i] += c;
            }
        }
    }

    /// Derivatives of dry friction by the loads of the meshes.
    pub(in crate::model) fn friction_slopes_by_loads<T: Local>(
        &self,
        loads: &[[DetailedLoad<T>; 2]; G],
        planets: &[SurfaceLoad; G],
        j: &mut Jacobian<'_, N>,
    ) {
        let side = self.teeth.sin_base[1];
        let [of_side, of_planet] = [self.friction().side.limit_slopes(), self.friction().planet.limit_slopes()];
        for s in 0..2 {
            let direction = self.friction_state[s].mode.direction();
            if direction == 0.0 || !self.friction().side.is_on() {
                continue;
            }
            let torque = self.sum(|g| self.members(g) * side * loads[g][s].force[0].value());
            let slopes: [[f64; WITH_OTHER]; G] = self.by_group(|g| {
                let (axial, force) = (loads[g][s].side_axial.slopes(), loads[g][s].force[0].slopes());
                std::array::from_fn(|k| {
                    self.members(g) * (of_side[0] * axial[k] + of_side[1] * torque.signum() * side * force[k])
                })
            });
            for (row, sign) in [(s, -direction), (CARRIER, direction)] {
                self.spread::<T>(row, sign, s, &slopes, j);
            }
        }
        for g in 0..self.groups() {
            let direction = self.friction_state[2 + g].mode.direction();
            if direction == 0.0 || !self.friction().planet.is_on() {
                continue;
            }
            let [l, r] = &loads[g];
            let across = l.tangential.value() + r.tangential.value();
            let along = l.side_axial.value() - r.side_axial.value();
            let per = if planets[g].load > 0.0 { of_planet[1] / planets[g].load } else { 0.0 };
            for s in 0..2 {
                let load = &loads[g][s];
                let (t, a, p) = (load.tangential.slopes(), load.side_axial.slopes(), load.planet_axial.slopes());
                let mut slopes = [[0.0; WITH_OTHER]; G];
                slopes[g] =
                    std::array::from_fn(|k| of_planet[0] * p[k] + per * (across * t[k] + SIGMA[s] * along * a[k]));
                self.spread::<T>(self.planet(g), -direction, s, &slopes, j);
            }
        }
    }

    /// Derivatives of the planets' dry friction by the speeds that throw them outward.
    pub(in crate::model) fn friction_slopes_by_orbit(&self, at: &Point<N>, j: &mut Jacobian<'_, N>) {
        let per_thrust = self.friction().planet.limit_slopes()[0];
        for g in 0..self.groups() {
            let direction = self.friction_state[FRICTION_PLANETS + g].mode.direction();
            j.by_velocity[self.planet(g)][self.orbit(g)] -= direction * per_thrust * self.centrifugal(at, g)[1];
        }
    }

    /// Adds to row `row` the slopes of something by the variables of all meshes of side `s`, and of the planets' other meshes
    /// where those matter.
    fn spread<T: Local>(
        &self,
        row: usize,
        sign: f64,
        s: usize,
        slopes: &[[f64; WITH_OTHER]; G],
        j: &mut Jacobian<'_, N>,
    ) {
        self.spread_positions(row, sign, s, |g, k| slopes[g][k], j.by_position);
        self.spread_positions(row, sign, s, |g, k| slopes[g][3 + k], &mut j.by_rate);
        if T::BY_OTHER {
            self.spread_positions(row, sign, 1 - s, |g, k| slopes[g][LOCAL + k], j.by_position);
        }
    }

    /// Adds to row `row` the slopes of something by q, x, w, or their rates, of all meshes of side `s`.
    #[inline]
    fn spread_positions(
        &self,
        row: usize,
        sign: f64,
        s: usize,
        slopes: impl Fn(usize, usize) -> f64,
        m: &mut Matrix<N>,
    ) {
        let [planet, side] = self.teeth.sin_base;
        let turn = SIGMA[s] * planet;
        m[row][s] += sign * self.sum(|g| side * slopes(g, 0));
        for g in 0..self.groups() {
            m[row][self.planet(g)] += sign * turn * (slopes(g, 1) - slopes(g, 0));
            if self.pins() {
                m[row][self.pin(g)] -= sign * side * slopes(g, 0);
            }
        }
        if self.pins() {
            m[row][self.seat(s)] += sign * self.sum(|g| slopes(g, 2));
        }
    }

    /// Energy of stuck friction [J].
    pub(in crate::model) fn friction_energy(&self, at: &Point<N>) -> f64 {
        let energy = |i: usize| {
            let (friction, count) = self.friction_on(i);
            count * friction.energy(&self.friction_state[i], self.slip(at, i).position)
        };
        self.bodies_that_stick().filter(|&i| self.friction_state[i].stiffness > 0.0).map(energy).sum()
    }

    /// Fraction of a step after which friction switches, if it does, given its ends with their times [s].
    pub(in crate::model) fn friction_crossing(&self, start: (&Point<N>, f64), end: (&Point<N>, f64)) -> Option<f64> {
        if !self.rubs() || !self.awaits_load(end.0) {
            return None;
        }
        let surface_loads = [start, end].map(|(at, time)| self.surface_loads(at, time));
        self.bodies_with_friction()
            .filter_map(|i| {
                let slips = [self.slip(start.0, i), self.slip(end.0, i)];
                let ends = [(&slips[0], &surface_loads[0][i]), (&slips[1], &surface_loads[1][i])];
                self.friction().on(i).crossing(&self.friction_state[i], ends[0], ends[1])
            })
            .reduce(f64::min)
    }

    /// Distance of each friction from its switch, where it acts.
    pub(in crate::model) fn friction_margins(&self, at: &Point<N>) -> [Option<f64>; FRICTION_BODIES] {
        let mut margins = [None; FRICTION_BODIES];
        if self.rubs() {
            let surface_loads = self.surface_loads(at, 0.0);
            for i in self.bodies_with_friction() {
                let margin =
                    self.friction().on(i).margin(&self.friction_state[i], &self.slip(at, i), &surface_loads[i]);
                margins[i] = Some(margin);
            }
        }
        margins
    }

    /// Whether friction is due to switch at `at`, `time` [s] after the inputs were set.
    pub(in crate::model) fn is_friction_due(&self, at: &Point<N>, time: f64) -> bool {
        if !self.rubs() || !self.awaits_load(at) {
            return false;
        }
        let surface_loads = self.surface_loads(at, time);
        self.bodies_with_friction()
            .any(|i| self.friction().on(i).is_due(&self.friction_state[i], &self.slip(at, i), &surface_loads[i]))
    }

    /// Drags the anchors of bodies that slide along to `at`, where the ledger rates are `power`.
    #[inline]
    pub(in crate::model) fn drag_anchors(&self, at: &Point<N>, power: &Power, anchors: &mut [f64; FRICTION_BODIES]) {
        if !self.rubs() {
            return;
        }
        for i in self.bodies_that_stick().filter(|&i| self.friction_state[i].mode != Mode::Stuck) {
            anchors[i] = self.friction().on(i).drag(anchors[i], self.slip(at, i).position, power.limit[i]);
        }
    }

    /// Switches friction where it is due at `at`, `time` [s] after the inputs were set, on `bodies`; what its springs
    /// lose is heat.
    pub(in crate::model) fn settle_friction(
        &mut self,
        at: &Point<N>,
        time: f64,
        bodies: std::ops::Range<usize>,
        heat: &mut [f64],
    ) {
        let surface_loads = self.surface_loads(at, time);
        for i in self.bodies_that_stick().filter(|i| bodies.contains(i)) {
            let (friction, count) = self.friction_on(i);
            let (friction, slip) = (*friction, self.slip(at, i));
            if friction.is_on() {
                friction.settle(&mut self.friction_state[i], &slip, &surface_loads[i], count, heat);
            }
        }
    }

    /// Adapts friction to changed stiffnesses: it starts on bodies that were free, and ends on others.
    pub(in crate::model) fn adapt_friction(&mut self, at: &Point<N>, heat: &mut [f64]) {
        for i in self.bodies_that_stick() {
            let (friction, count) = self.friction_on(i);
            let (friction, slip) = (*friction, self.slip(at, i));
            friction.adapt(&mut self.friction_state[i], &slip, heat, count);
        }
    }
}
