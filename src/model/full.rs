//! Forces of a scene with effects: meshes in detail where an effect asks for it, effects on bodies, dry friction.

use super::causes::Cause;
use super::course::Course;
use super::dry::{Clamp, Mode, Pressing, Turn};
use super::effects::{Action, Bodies, Slopes};
use super::equations::{Equations, Jacobian};
use super::layout::{CARRIER, HOLDS};
use super::parameters::Inputs;
use super::power::Power;
use super::teeth::SIGMA;
use crate::contact::detailed::{DetailedLoad, DetailedState, SliceLoad};
use crate::contact::gaps::FlankGaps;
use crate::contact::mesh::MeshForce;
use crate::integrate::{Matrix, Point, in_pairs};
use crate::numeric::{Dual, Scalar, sqrt};

/// Variables of a mesh in detail: q, x, w and their rates.
const LOCAL: usize = 6;

/// Numbers, or numbers with derivatives by the variables of one mesh.
pub trait Local: Scalar {
    /// Variable `i` of the mesh.
    fn local(value: f64, i: usize) -> Self;
    /// Derivatives by the variables of the mesh; zero for plain numbers.
    fn slopes(&self) -> [f64; LOCAL];
}

impl Local for f64 {
    fn local(value: f64, _: usize) -> Self {
        value
    }
    fn slopes(&self) -> [f64; LOCAL] {
        [0.0; LOCAL]
    }
}

impl Local for Dual<LOCAL> {
    fn local(value: f64, i: usize) -> Self {
        Dual::variable(value, i)
    }
    fn slopes(&self) -> [f64; LOCAL] {
        self.d
    }
}

impl<const N: usize, const G: usize, const P: usize, const FULL: bool> Equations<'_, N, G, P, FULL> {
    /// Index of the first axial seat.
    const SEAT: usize = CARRIER + 1;

    /// All positions and velocities as effects see them.
    fn bodies<'b>(&'b self, at: &'b Point<N>) -> Bodies<'b> {
        let Self { inputs, course, .. } = self;
        Bodies { q: &at.q, v: &at.v, layout: &self.teeth.layout, inputs, input_rates: &course.rates[0] }
    }

    /// Gaps of the teeth as they are now.
    pub(super) fn gaps(&self) -> Option<&FlankGaps> {
        self.teeth.full.gaps[usize::from(self.fault)].as_deref()
    }

    /// State of the mesh of group `g` with side `s` in detail.
    fn detailed_state<T: Local>(&self, at: &Point<N>, g: usize, s: usize) -> DetailedState<T> {
        let state = self.mesh_state(at, g, s);
        let seat = if P > 0 { [at.q[Self::SEAT + s], at.v[Self::SEAT + s]] } else { [0.0; 2] };
        let of = |i: usize, [a, b]: [f64; 2], c: f64| [T::local(a, i), T::local(b, i + 1), T::local(c, i + 2)];
        DetailedState {
            position: of(0, state.position, seat[0]),
            rate: of(3, state.rate, seat[1]),
            wrapped: self.wrapped(g, s),
        }
    }

    /// Loads of the mesh of group `g` with side `s` in detail; each loaded slice is shown to `look`.
    pub(super) fn detail<T: Local>(
        &self,
        at: &Point<N>,
        g: usize,
        s: usize,
        look: impl FnMut(&SliceLoad),
    ) -> DetailedLoad<T> {
        let state = self.detailed_state(at, g, s);
        let gaps = self.gaps().map(|g| g as _);
        let names = (self.teeth.plan.group(g).planet, s);
        self.teeth.full.detailed.load(&self.teeth.mesh.engagement, gaps, names, &state, look)
    }

    /// What presses side gears and planets, from loads of all meshes.
    fn pressings<T: Local>(&self, loads: &[[DetailedLoad<T>; 2]; G]) -> ([Pressing; 2], [Pressing; G]) {
        let side = self.teeth.sin_base[1];
        let sides = [0, 1].map(|s| Pressing {
            thrust: in_pairs(G, |g| self.members(g) * loads[g][s].side_axial.value()),
            load: in_pairs(G, |g| self.members(g) * side * loads[g][s].force[0].value()).abs(),
        });
        let planets = std::array::from_fn(|g| {
            let [l, r] = &loads[g];
            let across = l.tangential.value() + r.tangential.value();
            let along = l.side_axial.value() - r.side_axial.value();
            Pressing {
                thrust: l.planet_axial.value() + r.planet_axial.value(),
                load: sqrt(across * across + along * along),
            }
        });
        (sides, planets)
    }

    fn all_loads<T: Local>(&self, at: &Point<N>) -> [[DetailedLoad<T>; 2]; G] {
        std::array::from_fn(|g| [0, 1].map(|s| self.detail(at, g, s, |_| {})))
    }

    /// Motion of side gear `i` (or, from 2, of group `i − 2`) against what holds it.
    fn turn(&self, at: &Point<N>, i: usize) -> Turn {
        if i < 2 {
            Turn { position: at.q[i], speed: at.v[i] - at.v[CARRIER] }
        } else {
            let body = Self::PLANET + i - 2;
            Turn { position: at.q[body], speed: at.v[body] }
        }
    }

    /// Clamp of body `i` and how many bodies it stands for.
    fn clamp(&self, i: usize) -> (&Clamp, f64) {
        if i < 2 { (&self.clamps[0], 1.0) } else { (&self.clamps[1], self.members(i - 2)) }
    }

    /// What presses each held body.
    fn presses(&self, at: &Point<N>) -> [Pressing; 6] {
        let mut all = [Pressing::default(); 6];
        if self.clamps.iter().any(Clamp::depends_on_load) {
            let (sides, planets) = self.pressings(&self.all_loads::<f64>(at));
            all[..2].copy_from_slice(&sides);
            all[2..2 + G].copy_from_slice(&planets);
        }
        all
    }

    /// Forces of everything but commanded torques; derivatives where they are asked for.
    #[inline(always)]
    pub(super) fn act(
        &self,
        at: &Point<N>,
        sum: &mut [f64; N],
        imposed: &mut [f64; N],
        power: &mut Power,
        slopes: Option<&mut Jacobian<N>>,
    ) {
        match slopes {
            None => {
                if self.teeth.full.in_detail {
                    self.act_in_detail::<f64>(at, sum, power, None);
                } else {
                    let (forces, heat) = self.tooth_torques(at);
                    *sum = forces;
                    power.heat[Cause::Contact as usize] = heat;
                    self.hold(at, &[Pressing::default(); 6], sum, power);
                }
                self.act_on_bodies(at, sum, imposed, power);
            }
            Some(j) => {
                if self.teeth.full.in_detail {
                    self.act_in_detail::<Dual<LOCAL>>(at, sum, power, Some(j));
                } else {
                    let mut load = [[MeshForce::default(); 2]; G];
                    let (mut position, mut rate) = ([[[[0.0; 3]; 3]; 2]; G], [[[[0.0; 3]; 3]; 2]; G]);
                    for g in 0..G {
                        for s in 0..2 {
                            let (force, by) = self.teeth.mesh.linearise(&self.mesh_state(at, g, s));
                            load[g][s] = force;
                            position[g][s] = self.block(s, &by.by_position);
                            rate[g][s] = self.block(s, &by.by_rate);
                        }
                    }
                    self.add_forces(|g, s| load[g][s].force, sum);
                    self.add_blocks(&position, &mut j.by_position);
                    self.add_blocks(&rate, &mut j.by_rate);
                    power.heat[Cause::Contact as usize] =
                        in_pairs(G, |g| self.members(g) * (load[g][0].heat + load[g][1].heat));
                    self.hold(at, &[Pressing::default(); 6], sum, power);
                }
                self.hold_slopes(j);
                self.act_on_bodies(at, sum, imposed, power);
                let mut imposed_by = [[0.0; N]; 2];
                let mut out = Slopes {
                    n: N,
                    by_position: j.by_position.as_flattened_mut(),
                    by_velocity: j.by_velocity.as_flattened_mut(),
                    imposed: imposed_by.each_mut().map(|row| row.as_mut_slice()),
                };
                for effect in self.teeth.full.bodies.iter() {
                    effect.slopes(&self.bodies(at), &mut out);
                }
                j.of_imposed = imposed_by;
            }
        }
    }

    /// The part of the accelerations that inputs `inputs` on the course `course` have, for accelerations are linear in both.
    pub(super) fn forced(&self, at: &Point<N>, inputs: &Inputs, course: &Course) -> [f64; N] {
        let part = |inputs: &Inputs, course: &Course| {
            let these = self.under(inputs, course);
            let (mut sum, mut imposed, mut power) = ([0.0; N], [0.0; N], Power::default());
            these.act_on_bodies(at, &mut sum, &mut imposed, &mut power);
            these.finish(at, &mut sum, &imposed, &mut power);
            sum
        };
        let (with, without) = (part(inputs, course), part(&Inputs::ZERO, &Course::STILL));
        std::array::from_fn(|i| with[i] - without[i])
    }

    /// Effects on bodies.
    fn act_on_bodies(&self, at: &Point<N>, sum: &mut [f64; N], imposed: &mut [f64; N], power: &mut Power) {
        let bodies = self.bodies(at);
        imposed[CARRIER] += bodies.input_rates.carrier_speed;
        let mut out =
            Action { force: sum, imposed: &mut imposed[CARRIER], drive: &mut power.drive, heat: &mut power.heat };
        for effect in self.teeth.full.bodies.iter() {
            effect.act(&bodies, &mut out);
        }
        if Self::ENDS {
            power.shaft = [0, 1].map(|s| self.shaft_torque(at, s));
        }
    }

    /// Torque that the half-shaft of side `s` hands on to the wheel, where it twists [N·m].
    pub(super) fn shaft_torque(&self, at: &Point<N>, s: usize) -> f64 {
        if !Self::ENDS || !self.teeth.plan.shafts[s] {
            return self.inputs.load_torque[s];
        }
        let (spec, end) = (&self.teeth.full.half_shaft, N - 2 + s);
        spec.stiffness[s] * at.q[end] + spec.damping[s] * (at.v[s] - at.v[end])
    }

    /// Meshes in detail and what their loads press.
    fn act_in_detail<T: Local>(
        &self,
        at: &Point<N>,
        sum: &mut [f64; N],
        power: &mut Power,
        slopes: Option<&mut Jacobian<N>>,
    ) {
        let loads = self.all_loads::<T>(at);
        self.add_forces(|g, s| [loads[g][s].force[0].value(), loads[g][s].force[1].value()], sum);
        if P > 0 {
            for s in 0..2 {
                sum[Self::SEAT + s] += in_pairs(G, |g| self.members(g) * loads[g][s].force[2].value());
            }
        }
        for (i, cause) in [Cause::Contact, Cause::ToothFriction].into_iter().enumerate() {
            power.heat[cause as usize] = in_pairs(G, |g| self.members(g) * (loads[g][0].heat[i] + loads[g][1].heat[i]));
        }
        let (sides, planets) = self.pressings(&loads);
        let mut presses = [Pressing::default(); 6];
        presses[..2].copy_from_slice(&sides);
        presses[2..2 + G].copy_from_slice(&planets);
        self.hold(at, &presses, sum, power);
        if let Some(j) = slopes {
            let block = |part: usize| {
                std::array::from_fn(|g| {
                    [0, 1].map(|s| {
                        let force: [[f64; LOCAL]; 3] = loads[g][s].force.map(|f| f.slopes());
                        self.local_block(s, &force.map(|d| [d[part], d[part + 1], d[part + 2]]))
                    })
                })
            };
            self.add_blocks(&block(0), &mut j.by_position);
            self.add_blocks(&block(3), &mut j.by_rate);
            self.press_slopes(&loads, &planets, j);
        }
    }

    /// Dry friction.
    fn hold(&self, at: &Point<N>, presses: &[Pressing; 6], sum: &mut [f64; N], power: &mut Power) {
        for i in 0..2 + G {
            let (clamp, count) = self.clamp(i);
            if !clamp.is_on() {
                continue;
            }
            let (hold, turn) = (&self.holds[i], self.turn(at, i));
            let torque = clamp.torque(hold, &turn, &presses[i]);
            if i < 2 {
                sum[i] -= torque;
                sum[CARRIER] += torque;
            } else {
                sum[Self::PLANET + i - 2] -= torque;
            }
            clamp.heat(hold, &turn, &presses[i], count, &mut power.heat);
        }
    }

    /// Derivatives of dry friction by the motion of what it holds.
    fn hold_slopes(&self, j: &mut Jacobian<N>) {
        for i in 0..2 + G {
            let (clamp, _) = self.clamp(i);
            if !clamp.is_on() {
                continue;
            }
            let [k, c] = clamp.torque_slopes(&self.holds[i]);
            let body = if i < 2 { i } else { Self::PLANET + i - 2 };
            j.by_position[body][body] -= k;
            j.by_rate[body][body] -= c;
            if i < 2 {
                j.by_position[CARRIER][i] += k;
                j.by_rate[CARRIER][i] += c;
            }
        }
    }

    /// Derivatives of dry friction by what the meshes press.
    fn press_slopes<T: Local>(&self, loads: &[[DetailedLoad<T>; 2]; G], planets: &[Pressing; G], j: &mut Jacobian<N>) {
        let side = self.teeth.sin_base[1];
        let [of_side, of_planet] = self.clamps.map(|c| c.limit_slopes());
        for s in 0..2 {
            let direction = self.holds[s].mode.direction();
            if direction == 0.0 || !self.clamps[0].is_on() {
                continue;
            }
            let torque = in_pairs(G, |g| self.members(g) * side * loads[g][s].force[0].value());
            let slopes: [[f64; LOCAL]; G] = std::array::from_fn(|g| {
                let (axial, force) = (loads[g][s].side_axial.slopes(), loads[g][s].force[0].slopes());
                std::array::from_fn(|k| {
                    self.members(g) * (of_side[0] * axial[k] + of_side[1] * torque.signum() * side * force[k])
                })
            });
            for (row, sign) in [(s, -direction), (CARRIER, direction)] {
                self.spread(row, sign, s, &slopes, j);
            }
        }
        for g in 0..G {
            let direction = self.holds[2 + g].mode.direction();
            if direction == 0.0 || !self.clamps[1].is_on() {
                continue;
            }
            let [l, r] = &loads[g];
            let across = l.tangential.value() + r.tangential.value();
            let along = l.side_axial.value() - r.side_axial.value();
            let per = if planets[g].load > 0.0 { of_planet[1] / planets[g].load } else { 0.0 };
            for s in 0..2 {
                let load = &loads[g][s];
                let (t, a, p) = (load.tangential.slopes(), load.side_axial.slopes(), load.planet_axial.slopes());
                let mut slopes = [[0.0; LOCAL]; G];
                slopes[g] =
                    std::array::from_fn(|k| of_planet[0] * p[k] + per * (across * t[k] + SIGMA[s] * along * a[k]));
                self.spread(Self::PLANET + g, -direction, s, &slopes, j);
            }
        }
    }

    /// Adds to row `row` the slopes of something by the variables of all meshes of side `s`.
    fn spread(&self, row: usize, sign: f64, s: usize, slopes: &[[f64; LOCAL]; G], j: &mut Jacobian<N>) {
        let [planet, side] = self.teeth.sin_base;
        let turn = SIGMA[s] * planet;
        for (part, m) in [(0, &mut j.by_position), (3, &mut j.by_rate)] {
            m[row][s] += sign * in_pairs(G, |g| side * slopes[g][part]);
            for g in 0..G {
                let d = &slopes[g];
                m[row][Self::PLANET + g] += sign * turn * (d[part + 1] - d[part]);
                if P > 0 {
                    m[row][Self::PIN + g] -= sign * side * d[part];
                }
            }
            if P > 0 {
                m[row][Self::SEAT + s] += sign * in_pairs(G, |g| slopes[g][part + 2]);
            }
        }
    }

    /// Sums of the forces of meshes, pins and seats at rest, and their derivatives, for the static equilibrium.
    pub(super) fn structure(&self, at: &Point<N>) -> ([f64; N], Matrix<N>) {
        let (mut sum, mut j) = ([0.0; N], Jacobian::default());
        let mut power = Power::default();
        let still = Point { q: at.q, v: [0.0; N] };
        let loads = self.all_loads::<Dual<LOCAL>>(&still);
        self.add_forces(|g, s| [loads[g][s].force[0].v, loads[g][s].force[1].v], &mut sum);
        if P > 0 {
            for s in 0..2 {
                sum[Self::SEAT + s] += in_pairs(G, |g| self.members(g) * loads[g][s].force[2].v);
            }
        }
        let blocks = std::array::from_fn(|g| {
            [0, 1].map(|s| self.local_block(s, &loads[g][s].force.map(|f| [f.d[0], f.d[1], f.d[2]])))
        });
        self.add_blocks(&blocks, &mut j.by_position);
        let mut carrier = 0.0;
        let bodies = self.bodies(&still);
        let mut action =
            Action { force: &mut sum, imposed: &mut carrier, drive: &mut power.drive, heat: &mut power.heat };
        let mut unused = [[0.0; N]; 2];
        let mut slopes = Slopes {
            n: N,
            by_position: j.by_position.as_flattened_mut(),
            by_velocity: j.by_velocity.as_flattened_mut(),
            imposed: unused.each_mut().map(|row| row.as_mut_slice()),
        };
        for effect in self.teeth.full.bodies.iter().filter(|e| e.is_structure()) {
            effect.act(&bodies, &mut action);
            effect.slopes(&bodies, &mut slopes);
        }
        (sum, j.by_position)
    }

    /// Elastic energy of meshes and pins, and with `all` of half-shafts and holds too [J].
    pub(super) fn stored(&self, at: &Point<N>, all: bool) -> f64 {
        let full = &self.teeth.full;
        let mut energy = if full.in_detail {
            in_pairs(G, |g| self.members(g) * (self.mesh_energy(at, g, 0) + self.mesh_energy(at, g, 1)))
        } else {
            self.elastic_energy(at)
        };
        let bodies = self.bodies(at);
        energy += full.bodies.iter().filter(|e| all || e.is_structure()).map(|e| e.energy(&bodies)).sum::<f64>();
        if all {
            for i in 0..2 + G {
                let (clamp, count) = self.clamp(i);
                energy += count * clamp.energy(&self.holds[i], self.turn(at, i).position);
            }
        }
        energy
    }

    /// Elastic energy of the mesh of group `g` with side `s` [J].
    pub(super) fn mesh_energy(&self, at: &Point<N>, g: usize, s: usize) -> f64 {
        let full = &self.teeth.full;
        if !(FULL && full.in_detail) {
            return self.teeth.mesh.energy(&self.mesh_state(at, g, s));
        }
        let state = self.detailed_state(at, g, s);
        let names = (self.teeth.plan.group(g).planet, s);
        full.detailed.energy(&self.teeth.mesh.engagement, self.gaps().map(|g| g as _), names, &state)
    }

    /// Where a hold switches within a step.
    pub(super) fn holds_crossing(&self, start: &Point<N>, end: &Point<N>) -> Option<f64> {
        if !self.clamps.iter().any(Clamp::is_on) {
            return None;
        }
        let presses = [self.presses(start), self.presses(end)];
        (0..2 + G)
            .filter_map(|i| {
                let (clamp, _) = self.clamp(i);
                let turns = [self.turn(start, i), self.turn(end, i)];
                clamp.is_on().then_some(())?;
                clamp.crossing(&self.holds[i], (&turns[0], &presses[0][i]), (&turns[1], &presses[1][i]))
            })
            .reduce(f64::min)
    }

    /// How far each hold is from its switch, where there is one.
    pub(super) fn margins(&self, at: &Point<N>) -> [Option<f64>; HOLDS] {
        let mut margins = [None; HOLDS];
        if FULL && self.clamps.iter().any(Clamp::is_on) {
            let presses = self.presses(at);
            for i in (0..2 + G).filter(|&i| self.clamp(i).0.is_on()) {
                margins[i] = Some(self.clamp(i).0.margin(&self.holds[i], &self.turn(at, i), &presses[i]));
            }
        }
        margins
    }

    /// Whether a hold is due to switch at `at`.
    pub(super) fn hold_is_due(&self, at: &Point<N>) -> bool {
        if !self.clamps.iter().any(Clamp::is_on) {
            return false;
        }
        let presses = self.presses(at);
        (0..2 + G).any(|i| {
            let (clamp, _) = self.clamp(i);
            clamp.is_on() && clamp.is_due(&self.holds[i], &self.turn(at, i), &presses[i])
        })
    }

    /// Drags the anchors of bodies that slide along to `at`.
    #[inline(always)]
    pub(super) fn drag_anchors(&self, at: &Point<N>, anchors: &mut [f64; HOLDS]) {
        if self.holds.iter().all(|hold| hold.mode == Mode::Stuck) {
            return;
        }
        let presses = self.presses(at);
        for i in (0..2 + G).filter(|&i| self.holds[i].mode != Mode::Stuck) {
            anchors[i] = self.clamp(i).0.drag(anchors[i], &self.turn(at, i), &presses[i]);
        }
    }

    /// Switches holds that are due at `at` and books what their springs give up.
    pub(super) fn settle_holds(&mut self, at: &Point<N>, heat: &mut [f64; super::causes::CAUSES]) {
        let presses = self.presses(at);
        for i in 0..2 + G {
            let (clamp, count) = self.clamp(i);
            let (clamp, turn) = (*clamp, self.turn(at, i));
            if clamp.is_on() {
                clamp.settle(&mut self.holds[i], &turn, &presses[i], count, heat);
            }
        }
    }

    /// Takes holds over from other stiffnesses: catches bodies that were free, lets go of others.
    pub(super) fn take_over(&mut self, at: &Point<N>, heat: &mut [f64; super::causes::CAUSES]) {
        for i in 0..2 + G {
            let (clamp, count) = self.clamp(i);
            let (clamp, turn) = (*clamp, self.turn(at, i));
            clamp.take_over(&mut self.holds[i], &turn, heat, count);
        }
    }
}
