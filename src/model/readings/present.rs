//! Simulation as its outputs show it: under the present inputs, which the next step will apply, and with sums up to the
//! present, which follow from the dense output of the pending step.

use std::borrow::Cow;

use crate::integrate::{Rodas5P, Solver, SolverContext};
use crate::model::assembly::Model;
use crate::model::dynamics::shape::Shape;
use crate::model::dynamics::{State, Sums};
use crate::model::effects::Memories;
use crate::model::run::by_shape::{InShape, in_shape};
use crate::model::run::events::{has_commanded, with_commanded};
use crate::model::run::interval::resumed;
use crate::model::run::{LedgerEquations, Simulation, imposed};
use crate::model::scene::Inputs;

/// Reads the sums at the present from the dense output of the pending step.
struct Reader<'a> {
    model: &'a Model,
    state: &'a State,
    memories: Option<&'a mut Memories>,
}

/// Sums at the present, and kinetic and stored energy [J]; no energy if the state is the end of a completed step. Also
/// adds the step up to the present to the `memories`. Returns `None` if the ledger of this step does not close.
fn present_sums(model: &Model, state: &State, memories: Option<&mut Memories>) -> Option<(Sums, Option<f64>)> {
    if state.pending_step.is_none() {
        return Some((state.sums, None));
    }
    // derivatives that are set now belong to the next step
    let constant = state.inputs.derivatives.is_some().then(|| {
        let mut constant = *state;
        constant.inputs.derivatives = None;
        constant
    });
    in_shape(model, Reader { model, state: constant.as_ref().unwrap_or(state), memories })
}

impl InShape for Reader<'_> {
    type Output = Option<(Sums, Option<f64>)>;

    fn inputs_and_state(&self) -> (&Inputs, &State) {
        (&self.state.inputs.values, self.state)
    }

    fn run<const N: usize, S: Shape<N>, E: LedgerEquations<N> + ?Sized>(self, equations: &mut E) -> Self::Output {
        let Self { model, state, memories } = self;
        let mut sums = state.sums;
        let mut clock = state.pending_step.as_ref()?.clock;
        clock.end = clock.now;
        let mut trajectory = resumed::<N>(state, &clock);
        let Some(pending) = &trajectory.pending else { return Some((sums, None)) };
        // the step up to the present, as if it were completed
        let (mut control, mut statistics) = (state.control, state.statistics);
        let tolerance = model.parameters.solver.relative_tolerance;
        let context = SolverContext { tolerance, control: &mut control, statistics: &mut statistics, budget: &mut 0 };
        let mut solver = Solver::new(&Rodas5P, &*equations, context, &trajectory);
        let part = trajectory.accepted_part(pending);
        let judged = solver.judge(&trajectory, pending, &part);
        if !judged.is_balanced {
            return None;
        }
        let step = solver.complete(&mut trajectory, &part, judged);
        equations.record(model, &step, (state.time() - clock.now, &mut sums, memories));
        let mut anchors = equations.applied().anchors();
        equations.drag_anchors(step.end, &step.ledger_rates[2], &mut anchors);
        equations.applied_mut().set_anchors(&anchors);
        Some((sums, Some(equations.energy(&trajectory.point).iter().sum())))
    }
}

impl Simulation {
    /// Returns the simulation with its inputs applied. Speeds follow commands that were set since the last step, and
    /// brakes follow their torques. The step itself begins with this change and records its work.
    pub fn with_inputs_applied(&self) -> Cow<'_, Self> {
        let is_met = imposed::are_met(&self.model, &self.inputs, &self.state);
        // with a solver of the host, friction changes only at events
        let may_brake = !self.is_model_exchange() && has_commanded(&self.model);
        if is_met && !may_brake {
            return Cow::Borrowed(self);
        }
        let mut state = self.state;
        if !is_met {
            imposed::follow_commands(&self.model, &self.inputs, &mut state);
        }
        let braked = if may_brake { with_commanded(&self.model, &self.inputs, &state) } else { None };
        if is_met && braked.is_none() {
            return Cow::Borrowed(self);
        }
        Cow::Owned(Self { state: braked.unwrap_or(state), forces: None, ..self.clone() })
    }

    /// Returns the simulation with the brakes and clutches applied whose inputs change from 0 in the direction `change`,
    /// or `None` if there are none. Their inputs are the smallest positive number. With a solver of the host, they are
    /// applied only at events.
    pub fn with_friction_applied(&self, change: &Inputs) -> Option<Self> {
        let mut inputs = self.inputs;
        let changes = change.friction_commands().into_iter().flatten();
        for (command, change) in inputs.friction_commands_mut().into_iter().flatten().zip(changes) {
            if *command == 0.0 && change != 0.0 {
                *command = f64::MIN_POSITIVE;
            }
        }
        if inputs == self.inputs || self.is_model_exchange() || !has_commanded(&self.model) {
            return None;
        }
        let state = with_commanded(&self.model, &inputs, &self.state)?;
        Some(Self { state, inputs, forces: None, ..self.clone() })
    }

    /// Returns the simulation as its outputs show it: with its inputs applied, and with temperatures and means over
    /// mesh cycles up to the present. Friction changes only with completed steps.
    pub fn shown(&self) -> Cow<'_, Self> {
        let mut shown = self.with_inputs_applied();
        if (self.model.layout.has_ends() || self.model.thermal.is_some()) && self.state.pending_step.is_some() {
            let sums = present_sums(&self.model, &self.state, None).map(|(sums, _)| sums);
            let present = sums.unwrap_or_else(|| self.completed().state.sums);
            let Sums { torque_means, thermal, .. } = &mut shown.to_mut().state.sums;
            *torque_means = present.torque_means;
            thermal.rises = present.thermal.rises;
        }
        shown
    }

    /// Reads sums, energy (if it is known, [J]) and memories at the present. The simulation itself is unchanged.
    pub(in crate::model) fn read_present<T>(&mut self, read: impl FnOnce(&Self, (Sums, Option<f64>)) -> T) -> T {
        let checkpoint = self.memories.checkpoint();
        if let Some(sums) = present_sums(&self.model, &self.state, Some(&mut self.memories)) {
            let found = read(self, sums);
            self.memories.roll_back(checkpoint);
            return found;
        }
        let mut completed = self.completed();
        let sums = (completed.state.sums, Some(completed.energy(&completed.state)));
        std::mem::swap(&mut self.memories, &mut completed.memories);
        let found = read(self, sums);
        std::mem::swap(&mut self.memories, &mut completed.memories);
        found
    }

    /// A copy that has completed its pending step up to the present. Its ledger does not close, which is rare, so shorter
    /// steps replace it, as they will when the simulation moves on.
    #[cold]
    fn completed(&self) -> Self {
        let mut completed = self.clone();
        completed.complete_pending();
        completed
    }
}
