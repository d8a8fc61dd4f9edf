//! A running simulation: parameters → geometry → plan → equations → state → readings.

use std::sync::Arc;

use super::events::{break_tooth, end_of_stretch, energy, update_friction, with_brakes};
use super::failure::StepFailure;
use super::{imposed, start, stretch};
use crate::contact::tooth_load::ToothLoad;
use crate::friction::FrictionLaw;
use crate::geometry::Pair;
use crate::model::assembly::bodies::Inertias;
use crate::model::assembly::model::{Gears, Model};
use crate::model::dynamics::sizes::{by_rigid_size, by_size, with_equations};
use crate::model::dynamics::state::{Accepted, State};
use crate::model::effect_kinds::dry_friction::Mode;
use crate::model::outputs::readings::{Books, Forces, Motion};
use crate::model::outputs::resultants;
use crate::model::scene::layout::{CARRIER, HELD_PLANETS, HOLDS, MAX_PLANETS, WHEELS};
use crate::model::scene::{Course, Inputs, Plan, Start};
use crate::model::setup::Parameters;
use crate::model::setup::effect_outputs::{HEATS, READINGS, places_of};
use crate::numeric::TAU;
use crate::problem::Problem;

/// First step tried after a start [s]: near the fastest motion of stiff teeth; the controller grows it in a few steps.
const FIRST_STEP: f64 = 1e-6;

/// What a step costs, by what has to be evaluated, cheapest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CostClass {
    /// No teeth and nothing that acts beside them: a step is a formula.
    ClosedForm,
    /// No teeth, but torques of effects: integrated, without fast motion.
    Rigid,
    /// Teeth or springs that see no effect.
    Teeth,
    /// The same with effects on bodies.
    TeethAndBodies,
    /// Teeth slice by slice: errors, friction, pins.
    TeethInDetail,
}

/// A simulation; cloning it takes a snapshot (constants are shared, the state is copied).
#[derive(Clone, Debug)]
pub struct Simulation {
    pub(super) model: Arc<Model>,
    pub(super) state: State,
    pub(super) inputs: Inputs,
    pub(super) forces: Option<Forces>,
    /// Where the last step ended that a solver of the host's completed.
    pub(super) accepted: Option<Accepted>,
}

impl Simulation {
    /// Starts a simulation at `time` [s]; values must be within the ranges of the interface.
    pub fn start(parameters: &Parameters, inputs: &Inputs, time: f64) -> Result<Self, Vec<Problem>> {
        let mut simulation = Self::resume(parameters, inputs, State::at_rest(time, FIRST_STEP))?;
        let (model, state) = (&simulation.model, &mut simulation.state);
        start::speeds(model, inputs, state);
        if parameters.scene.start == Start::Equilibrium {
            match &model.gears {
                Gears::Rigid(rigid) => start::wind(model, &rigid.bodies.half_shafts, inputs, state),
                Gears::Teeth(teeth) => {
                    let full = teeth.additions.bodies.act_in(state);
                    by_size!(teeth, full, start::preload(&E::new(teeth, inputs, state), model, inputs, state))
                        .map_err(|problem| vec![problem])?;
                }
            }
        }
        imposed::jump(&simulation.model, inputs, &mut simulation.state);
        update_friction(&simulation.model, inputs, &mut simulation.state);
        simulation.state.work = 0.0;
        simulation.state.heat = [0.0; HEATS];
        simulation.state.energy_at_start = simulation.energy();
        Ok(simulation)
    }

    /// A simulation of `parameters` that goes on from `state`.
    pub fn resume(parameters: &Parameters, inputs: &Inputs, state: State) -> Result<Self, Vec<Problem>> {
        let model = Arc::new(Model::new(parameters)?);
        Ok(Self { model, state, inputs: *inputs, forces: None, accepted: None })
    }

    /// Sets the inputs that act from now on.
    pub fn set_inputs(&mut self, inputs: &Inputs) {
        if *inputs != self.inputs {
            self.inputs = *inputs;
            self.forces = None;
        }
    }

    /// The inputs that act now.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Tells how inputs go on from now; they stay as they are if that is not told.
    pub fn set_course(&mut self, course: Option<Course>) {
        if course != self.state.course {
            self.state.course = course;
            self.forces = None;
        }
    }

    /// How inputs go on, where it was told.
    pub fn course(&self) -> Option<&Course> {
        self.state.course.as_ref()
    }

    /// Takes over tunable parameters.
    pub fn tune(&mut self, parameters: &Parameters) {
        Arc::make_mut(&mut self.model).tune(parameters);
        self.forces = None;
    }

    /// Integrates to `until` [s]; inputs go on as told. On failure the state is that of the last good time.
    pub fn advance(&mut self, until: f64) -> Result<(), StepFailure> {
        self.forces = None;
        let Self { model, state, inputs, .. } = self;
        let model = &**model;
        imposed::jump(model, inputs, state);
        update_friction(model, inputs, state);
        if let Gears::Rigid(rigid) = &model.gears
            && !rigid.bodies.act_in(state)
        {
            let h = until - state.time;
            let (q, v, work) = (state.q, state.v, state.work);
            model.ideal.advance(state, inputs, h);
            if !state.moves() {
                (state.q, state.v, state.work) = (q, v, work);
                return Err(StepFailure::not_finite(state.time));
            }
            state.time = until;
            state.statistics.accepted += 1;
            state.control.last = h;
            state.wrap(&model.periods, &model.layout);
            return Ok(());
        }
        integrate(model, inputs, state, until)
    }

    /// Kinetic and stored energy, at the end of the last step that the ledger knows of [J].
    fn energy(&self) -> f64 {
        let known = self.accepted.as_ref().map(|accepted| accepted.of(&self.state));
        energy(&self.model, &self.inputs, known.as_ref().unwrap_or(&self.state))
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// The simulation as its inputs have it: speeds follow commands that were set since the last step, and brakes their
    /// torques, where there are any. The step itself begins with the change, and books it.
    pub fn present(&self) -> Option<Self> {
        let (model, inputs) = (&*self.model, &self.inputs);
        let mut present = None;
        if !imposed::are_met(model, inputs, &self.state) {
            imposed::jump(model, inputs, &mut present.insert(self.clone()).state);
        }
        // under a solver of the host's friction changes at events
        let state = present.as_ref().map_or(&self.state, |present| &present.state);
        if !self.is_handed_over()
            && let Some(braked) = with_brakes(model, inputs, state)
        {
            present.get_or_insert_with(|| self.clone()).state = braked;
        }
        if let Some(present) = &mut present {
            present.forces = None;
        }
        present
    }

    /// Angles and speeds.
    pub fn motion(&self) -> Motion {
        if let Some(present) = self.present() { present.motion_of_state() } else { self.motion_of_state() }
    }

    pub(super) fn motion_of_state(&self) -> Motion {
        let (model, state) = (&self.model, &self.state);
        let plan = &model.ideal.plan;
        let layout = plan.layout();
        let position = |i: usize| state.position(i, &model.periods);
        let v = &state.v;
        let mut motion = Motion {
            carrier_angle: position(CARRIER),
            carrier_speed: v[CARRIER],
            side_angle: [position(CARRIER) + position(0), position(CARRIER) + position(1)],
            side_speed: [v[0], v[1]],
            spin_angle: [0.0; MAX_PLANETS],
            spin_speed: [0.0; MAX_PLANETS],
            mesh_frequency: f64::from(model.parameters.geometry.planet_teeth) * v[layout.planet(0)].abs() / TAU,
        };
        for i in 0..plan.planets {
            let g = layout.planet(plan.group_of[i]);
            motion.spin_angle[i] = position(g);
            motion.spin_speed[i] = v[g];
        }
        motion
    }

    /// Forces under the present inputs, computed at the first call after a change.
    pub fn forces(&mut self) -> &Forces {
        if self.forces.is_none() {
            let present = self.present();
            self.forces = Some(present.as_ref().unwrap_or(self).forces_of_state());
        }
        self.forces.get_or_insert_default()
    }

    pub(super) fn forces_of_state(&self) -> Forces {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        match &model.gears {
            Gears::Rigid(rigid) if !rigid.bodies.act_in(state) => resultants::ideal_forces(model, inputs, state),
            Gears::Rigid(rigid) => {
                by_rigid_size!(model, resultants::rigid_forces(model, &E::new(rigid, inputs, state), inputs, state))
            }
            Gears::Teeth(teeth) => {
                let full = teeth.additions.bodies.act_in(state);
                by_size!(teeth, full, resultants::teeth_forces(model, &E::new(teeth, inputs, state), inputs, state))
            }
        }
    }

    /// Shows the load of every tooth pair, of one planet of each group; none where there are no teeth.
    pub fn tooth_loads(&self, mut visit: impl FnMut(&ToothLoad)) {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        let Gears::Teeth(teeth) = &model.gears else { return };
        let full = teeth.additions.bodies.act_in(state);
        by_size!(teeth, full, {
            let (equations, point) = (E::new(teeth, inputs, state), state.point());
            for g in 0..model.ideal.plan.groups().len() {
                for s in 0..2 {
                    equations.tooth_loads(&model.pair, &point, g, s, &mut visit);
                }
            }
        });
    }

    /// Whether a law is in use whose range may be left while running.
    pub fn is_watched(&self) -> bool {
        let p = &self.model.parameters;
        p.effects.tooth_friction && p.specs.tooth_friction.law != FrictionLaw::CoulombStribeck
    }

    /// What lies outside the range of the law in use, at this instant.
    pub fn out_of_range(&self) -> Option<Problem> {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        let Gears::Teeth(teeth) = &model.gears else { return None };
        let friction = teeth.additions.detailed.friction.as_ref()?;
        let mut found = None;
        by_size!(teeth, true, {
            let (equations, point) = (E::new(teeth, inputs, state), state.point());
            for g in 0..model.ideal.plan.groups().len() {
                for s in 0..2 {
                    equations.detail::<f64>(&point, g, s, |slice| {
                        if found.is_none() {
                            found = slice.sliding.as_ref().and_then(|sliding| friction.outside(sliding));
                        }
                    });
                }
            }
        });
        found.map(|what| Problem::new("tooth_friction.law", format!("{what} at t = {} s; reported once", state.time)))
    }

    /// Ledger and solver statistics.
    pub fn books(&self) -> Books {
        let s = &self.state.statistics;
        let mut readings = [0.0; READINGS];
        if self.model.strength.is_some() {
            self.state.fatigue.read(&mut readings[places_of("strength")]);
        }
        let held = |range: std::ops::Range<usize>| {
            let friction = self.state.friction[range].iter();
            friction.filter(|f| f.stiffness > 0.0 && f.mode == Mode::Stuck).count() as f64
        };
        Books {
            heat: self.state.heat,
            readings,
            held: [held(0..HELD_PLANETS), held(HELD_PLANETS..WHEELS), held(WHEELS..HOLDS)],
            energy_residual: self.energy() - self.state.energy_at_start - self.state.work
                + self.state.heat.iter().sum::<f64>(),
            steps: s.accepted as f64,
            rejected: (s.rejected_error + s.rejected_ledger + s.rejected_invalid + s.rejected_switch) as f64,
            rhs_calls: s.evaluations as f64,
            step_size: self.state.control.last,
        }
    }

    /// Where the host's solver last completed a step, for snapshots.
    pub fn accepted(&self) -> Option<&Accepted> {
        self.accepted.as_ref()
    }

    /// The same simulation with the host's solver last at `accepted`.
    pub fn from_accepted(self, accepted: Option<Accepted>) -> Self {
        Self { accepted, ..self }
    }

    /// The state, for snapshots.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// What is unusual about the gears.
    pub fn warnings(&self) -> &[Problem] {
        &self.model.warnings
    }

    /// Geometry of the pair.
    pub fn pair(&self) -> &Pair {
        &self.model.pair
    }

    /// Inertias in use.
    pub fn inertias(&self) -> &Inertias {
        &self.model.ideal.inertia
    }

    /// One line that tells what the solver did, by cause.
    pub fn account(&self) -> String {
        let s = &self.state.statistics;
        format!(
            "solver: {} steps accepted, {} rejected for their error, {} for their ledger, {} for values that are not finite, {} cut at a switch; \
             {} evaluations of the tooth forces, {} Jacobians; energy residual {:e} J",
            s.accepted,
            s.rejected_error,
            s.rejected_ledger,
            s.rejected_invalid,
            s.rejected_switch,
            s.evaluations,
            s.jacobians,
            self.books().energy_residual
        )
    }

    /// What is simulated.
    pub fn plan(&self) -> &Plan {
        &self.model.ideal.plan
    }

    /// What a step costs at present; a lock or a broken tooth may change it.
    pub fn cost(&self) -> CostClass {
        match &self.model.gears {
            Gears::Rigid(rigid) if !rigid.bodies.act_in(&self.state) => CostClass::ClosedForm,
            Gears::Rigid(_) => CostClass::Rigid,
            Gears::Teeth(teeth) if teeth.additions.in_detail => CostClass::TeethInDetail,
            Gears::Teeth(teeth) if teeth.additions.bodies.act_in(&self.state) => CostClass::TeethAndBodies,
            Gears::Teeth(_) => CostClass::Teeth,
        }
    }

    /// Names of the switches that are on.
    pub fn active_effects(&self) -> impl Iterator<Item = &'static str> {
        self.model.parameters.effects.active()
    }

    /// Parameters in use.
    pub fn parameters(&self) -> &Parameters {
        &self.model.parameters
    }

    /// One line that says what is simulated.
    pub fn describe(&self) -> String {
        let effects: Vec<&str> = self.active_effects().collect();
        let effects = if effects.is_empty() { "none".into() } else { effects.join(", ") };
        format!("{}; effects on: {effects}", self.model.ideal.plan.describe())
    }
}

/// Integrates to `until` [s]; apart from the closed form, whose few instructions its frame would outweigh.
#[inline(never)]
fn integrate(model: &Model, inputs: &mut Inputs, state: &mut State, until: f64) -> Result<(), StepFailure> {
    let before = (*state, *inputs);
    let mut budget = stretch::budget(model);
    while state.time < until {
        let (begin, end) = (state.time, end_of_stretch(model, state, until));
        let outcome = with_equations!(model, state, inputs, |equations| {
            stretch::integrate::<N, _>(equations, model, state, end, &mut budget)
        });
        state.wrap(&model.periods, &model.layout);
        if let Gears::Rigid(_) = &model.gears {
            model.ideal.constrain(&mut state.v);
        }
        go_on(inputs, state, if outcome.is_ok() { end } else { state.time } - begin);
        outcome?;
        // the rounding of the time axis may leave a rest too small to integrate
        state.time = end;
        break_tooth(model, inputs, state);
    }
    if !state.is_valid() {
        (*state, *inputs) = before;
        return Err(StepFailure::not_finite(state.time));
    }
    Ok(())
}

/// Takes inputs to what they are `time` [s] later.
fn go_on(inputs: &mut Inputs, state: &mut State, time: f64) {
    if let Some(course) = state.course {
        let (later, rest) = course.after(time, inputs);
        (*inputs, state.course) = (later, Some(rest));
        state.carrier_command = inputs.carrier_speed;
    }
}
