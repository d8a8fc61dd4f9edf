//! What can be read from a simulation: motion, forces, the ledger, and what is simulated.

use crate::contact::ToothLoad;
use crate::geometry::Pair;
use crate::model::assembly::{Gears, Inertias};
use crate::model::dynamics::{IdealEquations, Largest, State, Watched};
use crate::model::effect_kinds::Changes;
use crate::model::outputs::forces::{Extent, Forces};
use crate::model::outputs::pairs::{PairLines, pair_lines};
use crate::model::outputs::{LedgerReadings, Motion, resultants};
use crate::model::run::events::{energy, has_brakes, with_brakes};
use crate::model::run::progress::complete;
use crate::model::run::{Simulation, imposed};
use crate::model::scene::{CARRIER, FRICTION_BODIES, FRICTION_PLANETS, FRICTION_WHEELS, Inputs, MAX_PLANETS, Plan};
use crate::model::setup::effect_outputs::places_of;
use crate::model::setup::{Parameters, STEP_READINGS};
use crate::model::thermal::NODES;
use crate::numeric::TAU;
use crate::problem::Problem;
use crate::strength::LineContact;

impl Simulation {
    /// Time [s].
    pub fn time(&self) -> f64 {
        self.state.time()
    }

    /// The simulation as its inputs have it: speeds follow commands that were set since the last step, and brakes their
    /// torques, where there are any. The step itself begins with the change, and records its work.
    pub fn with_inputs_applied(&self) -> Option<Self> {
        let is_met = imposed::are_met(&self.model, &self.inputs, &self.state);
        // with a solver of the host friction changes at events
        let may_brake = !self.is_model_exchange() && has_brakes(&self.model);
        if is_met && !may_brake {
            return None;
        }
        let mut state = self.state;
        if !is_met {
            imposed::jump(&self.model, &self.inputs, &mut state);
        }
        let braked = if may_brake { with_brakes(&self.model, &self.inputs, &state) } else { None };
        if is_met && braked.is_none() {
            return None;
        }
        Some(Self { state: braked.unwrap_or(state), forces: None, ..self.clone() })
    }

    /// The simulation with the brakes on that inputs put on if they change from 0 in the direction `change`; `None` if there are none.
    /// The torque of these brakes is the least positive number. With a solver of the host, brakes are put on only at events.
    pub fn with_brakes_put_on(&self, change: &Inputs) -> Option<Self> {
        let mut inputs = self.inputs;
        for (torque, change) in inputs.brake_torque.iter_mut().zip(change.brake_torque) {
            if *torque == 0.0 && change != 0.0 {
                *torque = f64::MIN_POSITIVE;
            }
        }
        if inputs == self.inputs || self.is_model_exchange() || !has_brakes(&self.model) {
            return None;
        }
        let state = with_brakes(&self.model, &inputs, &self.state)?;
        Some(Self { state, inputs, forces: None, ..self.clone() })
    }

    /// The simulation as its outputs show it, if it differs: its inputs applied, and means over mesh cycles and temperatures up to the
    /// present. Friction changes only with completed steps.
    pub fn shown(&self) -> Option<Self> {
        let mut shown = self.with_inputs_applied();
        if (self.model.layout.has_ends() || self.model.thermal.is_some()) && self.state.pending_step.is_some() {
            let completed = self.completed().0;
            let state = &mut shown.get_or_insert_with(|| self.clone()).state;
            state.torque_means = completed.torque_means;
            state.thermal.rises = completed.thermal.rises;
        }
        shown
    }

    /// Angles and speeds.
    pub fn motion(&self) -> Motion {
        if let Some(present) = self.with_inputs_applied() { present.motion_of_state() } else { self.motion_of_state() }
    }

    pub(in crate::model) fn motion_of_state(&self) -> Motion {
        let (model, state) = (&self.model, &self.state);
        let plan = &model.ideal.plan;
        let layout = plan.layout();
        let position = |i: usize| state.position(i, &model.periods);
        let v = &state.v;
        let side_angle = [position(CARRIER) + position(0), position(CARRIER) + position(1)];
        // an end counts its angle back from the side gear: by its twist
        let by_end = |s: usize| plan.shafts[s].then(|| layout.end(s));
        let mut motion = Motion {
            carrier_angle: position(CARRIER),
            carrier_speed: v[CARRIER],
            side_angle,
            side_speed: [v[0], v[1]],
            wheel_angle: [0, 1].map(|s| side_angle[s] - by_end(s).map_or(0.0, position)),
            wheel_speed: [0, 1].map(|s| v[by_end(s).unwrap_or(s)]),
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
        self.forces_with(Extent::Parts)
    }

    /// The same for whoever does not read the parts of normal forces in space, which cost as much as all others.
    pub fn forces_without_parts(&mut self) -> &Forces {
        self.forces_with(Extent::Loads)
    }

    fn forces_with(&mut self, extent: Extent) -> &Forces {
        if self.forces.as_ref().is_none_or(|forces| extent == Extent::Parts && !forces.has_parts) {
            let forces = self.shown().as_ref().unwrap_or(self).forces_of_state(extent);
            self.forces = Some(forces);
        }
        self.forces.get_or_insert_default()
    }

    pub(in crate::model) fn forces_of_state(&self, extent: Extent) -> Forces {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        match &model.gears {
            Gears::Ideal(ideal) if !ideal.body_effects.act_in(state) => resultants::ideal_forces(model, inputs, state),
            Gears::Ideal(ideal) => {
                resultants::ideal_forces_with_effects(model, &IdealEquations::new(ideal, inputs, state), inputs, state)
            }
            Gears::Teeth(teeth) => {
                resultants::teeth_forces(model, &Largest::new(teeth, inputs, state), inputs, (state, extent))
            }
        }
    }

    /// Loaded tooth pairs of planet 1 with the left side gear under the present inputs.
    pub fn pair_lines(&self) -> PairLines {
        self.with_inputs_applied().as_ref().unwrap_or(self).pair_lines_of_state()
    }

    pub(in crate::model) fn pair_lines_of_state(&self) -> PairLines {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        let Gears::Teeth(teeth) = &model.gears else { return PairLines::default() };
        let material = &model.parameters.material;
        let contact = LineContact::new(&model.pair, material.young_modulus, material.poisson_ratio);
        let first = model.ideal.plan.group_of[0];
        let equations = Largest::new(teeth, inputs, state);
        pair_lines((&model.pair, &contact), &equations, &state.point(), [first, 0])
    }

    /// Visits the load of every tooth pair, of one planet of each group; none where there are no teeth.
    pub fn tooth_loads(&self, mut visit: impl FnMut(&ToothLoad)) {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        let Gears::Teeth(teeth) = &model.gears else { return };
        let (equations, point) = (Largest::new(teeth, inputs, state), state.point());
        for g in 0..model.ideal.plan.groups().len() {
            for s in 0..2 {
                equations.tooth_loads(&model.pair, &point, g, s, &mut visit);
            }
        }
    }

    /// Visits the load of every tooth pair of planet 1 with the left side gear, slice by slice if loads differ over the face.
    /// The function in the second argument then gives the load per width [N/m] of that pair at any cone distance [m]. The
    /// parts of the normal are left at zero.
    pub fn loads_over_the_face(&self, visit: impl FnMut(&ToothLoad, Option<&dyn Fn(f64) -> f64>)) {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        let Gears::Teeth(teeth) = &model.gears else { return };
        let first = model.ideal.plan.group_of[0];
        Largest::new(teeth, inputs, state).loads_over_the_face(&state.point(), first, 0, visit);
    }

    /// State and what is watched with the step ahead completed up to the present.
    pub(in crate::model) fn completed(&self) -> (State, Watched) {
        let (mut state, mut watched) = (self.state, self.watched);
        complete(&self.model, (&mut state, &mut watched));
        (state, watched)
    }

    /// Kinetic and stored energy, at the end of the last step that the ledger knows of [J].
    pub(in crate::model) fn energy(&self, state: &State) -> f64 {
        let known = self.accepted.as_ref().map(|accepted| accepted.applied_to(state));
        energy(&self.model, &self.inputs, known.as_ref().unwrap_or(state))
    }

    /// Ledger and solver statistics.
    pub fn ledger(&self) -> LedgerReadings {
        let s = &self.state.statistics;
        let (state, watched) = &self.completed();
        let mut readings = [0.0; STEP_READINGS];
        if let Some(strength) = self.model.strength() {
            let (fatigue, planets) = (&watched.fatigue, self.model.ideal.plan.planets);
            strength.read_damage(fatigue, planets, &mut readings[const { places_of("strength", Changes::ByStep) }]);
        }
        if self.model.watch.as_ref().is_some_and(|watch| watch.keeps_mesh_history) {
            watched
                .mesh_history
                .read(&self.model.ideal.plan, &mut readings[const { places_of("mesh_history", Changes::ByStep) }]);
        }
        let thermal = &mut readings[const { places_of("warm_up", Changes::ByStep) }];
        thermal[..NODES].copy_from_slice(&state.thermal.temperatures());
        if let Some(network) = &self.model.thermal {
            thermal[NODES..].copy_from_slice(&[network.stored(&state.thermal), state.thermal.given_off]);
        }
        // these follow the recorded events: completing the step may switch friction before its event is recorded
        let held = |range: std::ops::Range<usize>| {
            let friction = self.state.friction[range].iter();
            friction.filter(|friction| friction.holds()).count() as f64
        };
        LedgerReadings {
            heat: state.heat,
            readings,
            held: [
                held(0..FRICTION_PLANETS),
                held(FRICTION_PLANETS..FRICTION_WHEELS),
                held(FRICTION_WHEELS..FRICTION_BODIES),
            ],
            energy_residual: self.energy(state) - state.energy_at_start - state.work + state.heat.iter().sum::<f64>(),
            steps: s.accepted as f64,
            rejected: (s.rejected_error + s.rejected_ledger + s.rejected_invalid + s.rejected_switch) as f64,
            rhs_calls: s.evaluations as f64,
            step_size: self.state.control.last,
        }
    }

    /// What is unusual about the gears.
    pub fn warnings(&self) -> &[Problem] {
        &self.model.warnings
    }

    /// Geometry of the pair.
    pub fn pair(&self) -> &Pair {
        &self.model.pair
    }

    /// Masses of planet and side gear, always those of their solids [kg].
    pub fn masses(&self) -> [f64; 2] {
        self.model.masses.map(|gear| gear.mass)
    }

    /// Inertias in use.
    pub fn inertias(&self) -> &Inertias {
        &self.model.ideal.inertia
    }

    /// One line on the solver's steps and rejections, by cause.
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
            self.ledger().energy_residual
        )
    }

    /// What is simulated.
    pub fn plan(&self) -> &Plan {
        &self.model.ideal.plan
    }

    /// What a step costs at present; a lock or a broken tooth may change it.
    pub fn cost(&self) -> CostClass {
        match &self.model.gears {
            Gears::Ideal(ideal) if !ideal.body_effects.act_in(&self.state) => CostClass::ClosedForm,
            Gears::Ideal(_) => CostClass::Ideal,
            Gears::Teeth(teeth) if teeth.effect_terms.in_detail || self.state.is_tooth_broken => {
                CostClass::TeethInDetail
            }
            Gears::Teeth(teeth) if teeth.effect_terms.body_effects.act_in(&self.state) => CostClass::TeethAndBodies,
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

/// What a step costs, by what has to be evaluated, cheapest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CostClass {
    /// No teeth and no effect on bodies: a step is a formula.
    ClosedForm,
    /// No teeth, but torques of effects: integrated, without fast motion.
    Ideal,
    /// Teeth or springs that see no effect.
    Teeth,
    /// The same with effects on bodies.
    TeethAndBodies,
    /// Teeth slice by slice: errors, friction, pins.
    TeethInDetail,
}
