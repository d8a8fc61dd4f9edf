//! A running simulation: parameters → geometry → plan → equations → state → readings.

use std::fmt;
use std::sync::Arc;

use super::bodies::Inertias;
use super::constants::Model;
use super::parameters::{Inputs, Parameters};
use super::readings::{Books, Forces, MAX_PLANETS, Motion};
use super::state::{CARRIER, PLANET, State};
use super::teeth::{Equations, Teeth};
use super::{resultants, start};
use crate::geometry::Pair;
use crate::integrate::{self, Effort, Failure};
use crate::numeric::TAU;
use crate::problem::Problem;

/// Evaluates an expression with the constant `N` set to the model's number of degrees of freedom.
macro_rules! by_size {
    ($model:expr, $body:expr) => {
        match $model.ideal.plan.groups().len() {
            1 => by_size!(4, @ $body),
            _ => by_size!(5, @ $body),
        }
    };
    ($n:literal, @ $body:expr) => {{
        const N: usize = $n;
        $body
    }};
}

/// First step tried after a start [s]: near the fastest motion of stiff teeth; the controller grows it in a few steps.
const FIRST_STEP: f64 = 1e-6;
/// Longest stretch integrated before positions are wrapped [s].
const STRETCH: f64 = 1.0;
/// Attempts at steps granted to one call: bounds the time that a host can be kept waiting to some seconds.
const BUDGET: u64 = 2_000_000;

/// Why a step could not be completed; the simulation stands at the last good time.
#[derive(Clone, Debug, PartialEq)]
pub struct StepFailure {
    /// Last good time [s].
    pub time: f64,
    /// What happened, where, and what may help.
    pub message: String,
}

impl fmt::Display for StepFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at t = {} s: {}", self.time, self.message)
    }
}

/// A simulation; cloning it takes a snapshot (constants are shared, the state is copied).
#[derive(Clone, Debug)]
pub struct Simulation {
    model: Arc<Model>,
    state: State,
    inputs: Inputs,
    forces: Option<Forces>,
}

impl Simulation {
    /// Starts a simulation at `time` [s]; values must be within the ranges of the interface.
    pub fn start(parameters: &Parameters, inputs: &Inputs, time: f64) -> Result<Self, Vec<Problem>> {
        let mut simulation = Self::resume(parameters, inputs, State::at_rest(time, FIRST_STEP))?;
        let (model, state) = (&simulation.model, &mut simulation.state);
        match &model.teeth {
            Some(teeth) => {
                let start = parameters.scene.start;
                by_size!(model, start::teeth_start::<N>(teeth, &model.ideal, inputs, start, state))
                    .map_err(|problem| vec![problem])?;
            }
            None => start::ideal_start(&model.ideal, inputs, parameters.scene.start, state),
        }
        simulation.state.energy_at_start = simulation.energy();
        Ok(simulation)
    }

    /// A simulation of `parameters` that goes on from `state`.
    pub fn resume(parameters: &Parameters, inputs: &Inputs, state: State) -> Result<Self, Vec<Problem>> {
        let model = Arc::new(Model::new(parameters)?);
        Ok(Self { model, state, inputs: *inputs, forces: None })
    }

    /// Sets the inputs that act from now on.
    pub fn set_inputs(&mut self, inputs: &Inputs) {
        if *inputs != self.inputs {
            self.inputs = *inputs;
            self.forces = None;
        }
    }

    /// Takes over tunable parameters: contact damping.
    pub fn tune(&mut self, parameters: &Parameters) {
        let model = Arc::make_mut(&mut self.model);
        model.parameters.contact.damping = parameters.contact.damping;
        if let Some(teeth) = &mut model.teeth {
            teeth.mesh.law.damping = parameters.contact.damping;
        }
        self.forces = None;
    }

    /// Integrates to `until` [s] with constant inputs. On failure the state is that of the last good time.
    pub fn advance(&mut self, until: f64) -> Result<(), StepFailure> {
        self.forces = None;
        self.apply_commands();
        let model = &self.model;
        let dof = PLANET + model.ideal.plan.groups().len();
        match &model.teeth {
            None => {
                let h = until - self.state.time;
                model.ideal.advance(&mut self.state, &self.inputs, h);
                self.state.time = until;
                self.state.statistics.accepted += 1;
                self.state.control.last = h;
                self.state.wrap(&model.periods, dof);
                Ok(())
            }
            Some(teeth) => {
                let (mut outcome, mut budget) = (Ok(()), BUDGET);
                while outcome.is_ok() && self.state.time < until {
                    let stretch =
                        if until - self.state.time > 1.5 * STRETCH { self.state.time + STRETCH } else { until };
                    let (inputs, state) = (&self.inputs, &mut self.state);
                    outcome = by_size!(
                        model,
                        integrate_teeth::<N>(teeth, inputs, state, stretch, &model.parameters, &mut budget)
                    );
                    self.state.wrap(&model.periods, dof);
                    // the rounding of the time axis may leave a rest too small to integrate
                    if outcome.is_ok() {
                        self.state.time = stretch;
                    }
                }
                outcome
            }
        }
    }

    /// Lets imposed speeds jump to their commands; the energy of the jump is impulsive work of the input.
    fn apply_commands(&mut self) {
        let ideal = &self.model.ideal;
        let Some(_) = &self.model.teeth else {
            self.state.work += ideal.jump(&mut self.state, &self.inputs);
            return;
        };
        let (plan, inertia) = (&ideal.plan, &ideal.inertia);
        let State { v, work, .. } = &mut self.state;
        let mut jump = |v: &mut f64, command: f64, inertia: f64| {
            if *v != command {
                *work += 0.5 * inertia * (command * command - *v * *v);
                *v = command;
            }
        };
        if plan.carrier_imposed {
            jump(&mut v[CARRIER], self.inputs.carrier_speed, inertia.carrier);
        }
        if plan.spin_imposed {
            for (g, group) in plan.groups().iter().enumerate() {
                jump(&mut v[PLANET + g], self.inputs.planet_spin, group.members * inertia.planet);
            }
        }
    }

    /// Kinetic and elastic energy [J].
    fn energy(&self) -> f64 {
        match &self.model.teeth {
            None => self.model.ideal.kinetic_energy(&self.state),
            Some(teeth) => {
                let (inputs, state) = (&self.inputs, &self.state);
                by_size!(self.model, Equations::<N>::new(teeth, inputs, state).energy(&state.point()))
            }
        }
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Angles and speeds.
    pub fn motion(&self) -> Motion {
        let (model, state) = (&self.model, &self.state);
        let position = |i: usize| state.position(i, &model.periods);
        let v = &state.v;
        let mut motion = Motion {
            carrier_angle: position(CARRIER),
            carrier_speed: v[CARRIER],
            side_angle: [position(CARRIER) + position(0), position(CARRIER) + position(1)],
            side_speed: [v[0], v[1]],
            spin_angle: [0.0; MAX_PLANETS],
            spin_speed: [0.0; MAX_PLANETS],
            mesh_frequency: f64::from(model.parameters.geometry.planet_teeth) * v[PLANET].abs() / TAU,
        };
        for i in 0..model.ideal.plan.planets {
            let g = PLANET + model.ideal.plan.group_of[i];
            motion.spin_angle[i] = position(g);
            motion.spin_speed[i] = v[g];
        }
        motion
    }

    /// Forces under the present inputs, computed at the first call after a change.
    pub fn forces(&mut self) -> &Forces {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        self.forces.get_or_insert_with(|| match &model.teeth {
            None => resultants::ideal_forces(&model.pair, &model.ideal, inputs, state),
            Some(teeth) => by_size!(
                model,
                resultants::teeth_forces(&model.pair, &Equations::<N>::new(teeth, inputs, state), inputs, state)
            ),
        })
    }

    /// Ledger and solver statistics.
    pub fn books(&self) -> Books {
        let s = &self.state.statistics;
        Books {
            heat_contact: self.state.heat,
            energy_residual: self.energy() - self.state.energy_at_start - self.state.work + self.state.heat,
            steps: s.accepted as f64,
            rejected: (s.rejected_error + s.rejected_invalid) as f64,
            rhs_calls: s.evaluations as f64,
            step_size: self.state.control.last,
        }
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
            "solver: {} steps accepted, {} rejected for their error, {} for values that are not finite; \
             {} evaluations of the tooth forces, {} Jacobians; energy residual {:e} J",
            s.accepted,
            s.rejected_error,
            s.rejected_invalid,
            s.evaluations,
            s.jacobians,
            self.books().energy_residual
        )
    }

    /// One line that tells what is simulated.
    pub fn describe(&self) -> String {
        self.model.ideal.plan.describe()
    }
}

/// Why an accepted step is refused: a tooth bent beyond what teeth can bend.
struct Jump {
    deflection: f64,
    planet: usize,
    side: usize,
}

fn integrate_teeth<const N: usize>(
    teeth: &Teeth,
    inputs: &Inputs,
    state: &mut State,
    until: f64,
    parameters: &Parameters,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let equations = Equations::<N>::new(teeth, inputs, state);
    // the equations do not know the time: counted from here it is resolved as finely as steps can get
    let (mut point, mut time) = (state.point(), 0.0);
    let mut good = (point, time);
    let State { control, statistics, work, heat, .. } = state;
    let outcome = integrate::advance(
        &equations,
        &mut point,
        &mut time,
        until - state.time,
        Effort { tolerance: parameters.solver.relative_tolerance, control, statistics, budget },
        |step| {
            let (approach, planet, side) = equations.deepest(step.end);
            if approach > teeth.jump {
                return Err(Jump { deflection: approach * teeth.mesh.cone, planet, side });
            }
            // Simpson's rule on begin, middle and end of the step
            let [a, m, b] = step.power;
            *work += step.h / 6.0 * (a.input + 4.0 * m.input + b.input);
            *heat += step.h / 6.0 * (a.heat + 4.0 * m.heat + b.heat);
            good = (*step.end, step.time);
            Ok(())
        },
    );
    state.set_point(&good.0);
    state.time += good.1;
    let Err(failure) = outcome else { return Ok(()) };
    let message = match failure {
        Failure::Refused(Jump { deflection, planet, side }) => format!(
            "a tooth would jump between planet[{}] and the {} side gear: deflection {:.3} mm along the line of action exceeds the limit {:.3} mm; \
             reduce the load or raise contact.stiffness",
            planet + 1,
            ["left", "right"][side],
            deflection * 1e3,
            teeth.jump * teeth.mesh.cone * 1e3
        ),
        Failure::StepTooSmall { size } => format!(
            "the step size fell to {size:.3e} s, below what time can resolve; look at the inputs, \
             or loosen solver.relative_tolerance = {:e}",
            parameters.solver.relative_tolerance
        ),
        Failure::TooManySteps => format!(
            "{BUDGET} attempts at steps were not enough for one communication step; shorten it, \
             loosen solver.relative_tolerance = {:e}, or add contact.damping",
            parameters.solver.relative_tolerance
        ),
    };
    Err(StepFailure { time: state.time, message })
}
