//! Life cycle and steps of an FMU instance, on top of `model::Simulation` and without pointers.

use super::{Allowed, CallError, CallResult, Category, Interface, Kind, Log, Phase, Snapshot};
use crate::declaration::Field;
use crate::model::{Parameters, Reported, Share, Simulation};
use crate::problem::{self, Problem};
use crate::variables::effective::{self, Situation};
use crate::variables::unset;
use crate::variables::{self, Access, Variable};

/// Tolerance of communication points, relative to the larger of time and step size. It is far above the rounding errors
/// of hosts that add up steps.
const TIME_TOLERANCE: f64 = 1e-9;
/// Maximum tolerance as a fraction of the step. A point farther away is a different point.
const STEP_TOLERANCE: f64 = 0.1;

/// Tolerance of communication points [s] near `time` [s] for steps of `h` [s].
fn time_tolerance(time: f64, h: f64) -> f64 {
    let tolerance = TIME_TOLERANCE * time.abs().max(h);
    tolerance.min(STEP_TOLERANCE * h).max(64.0 * f64::EPSILON * time.abs())
}

/// An instance: a snapshot, and data that snapshots do not contain.
pub struct Instance {
    /// Version of FMI with which it was created.
    pub interface: &'static Interface,
    /// Features that the host of a co-simulation allows.
    pub allowed: Allowed,
    /// Parameters, inputs, phase, simulation.
    pub now: Snapshot,
    /// Messages to the host.
    pub log: Log,
    /// Cache for further starts, shared by all instances.
    pub cache: Share,
    /// Tolerance and time interval that the host announced to this instance. They survive when a state is restored.
    announced: Option<Experiment>,
    /// Warnings logged so far, each of which is logged once per run.
    reported: Reported,
    /// Inputs that may have derivatives, as a bit mask in the order of the table. The derivatives may be 0.
    pub(super) changing: u32,
    /// Variables for which a warning says that their values have no effect.
    without_effect: Vec<&'static str>,
}

/// Tolerance and time interval announced by the host.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// Relative tolerance, if given.
    pub tolerance: Option<f64>,
    /// Start time [s].
    pub start: f64,
    /// Stop time [s], if given.
    pub stop: Option<f64>,
}

impl Instance {
    /// Creates an instance with start values.
    pub fn new(interface: &'static Interface, kind: Kind, log: Log) -> Self {
        Self {
            interface,
            allowed: Allowed::default(),
            now: Snapshot::new(interface, kind),
            log,
            cache: Share::new(),
            announced: None,
            reported: Reported::default(),
            changing: 0,
            without_effect: Vec::new(),
        }
    }

    /// Adopts the tolerance and the time interval announced by the host. A tolerance that the host sets as a parameter
    /// takes precedence.
    pub fn setup_experiment(&mut self, experiment: &Experiment) -> CallResult {
        let Experiment { tolerance, start, stop } = *experiment;
        if !start.is_finite() {
            return Err(CallError::error(format!("start time {start} s is not a finite number")));
        }
        if let Some(stop) = stop
            && (stop.is_nan() || stop < start)
        {
            return Err(CallError::error(format!("stop time {stop} s is before the start time {start} s")));
        }
        if let Some(requested) = tolerance
            && (requested.is_nan() || requested <= 0.0)
        {
            return Err(CallError::error(format!("tolerance {requested} is not a positive number")));
        }
        self.announced = Some(*experiment);
        self.now.start_time = start;
        // an announcement without a stop time removes an earlier one
        self.now.stop_time = None;
        self.now.follow(experiment, &self.cache)
    }

    /// Enters initialization mode.
    pub fn enter_initialization(&mut self) -> CallResult {
        self.now.phase = Phase::Initialization;
        Ok(())
    }

    /// Leaves initialization mode and starts the simulation. Fails with every problem found.
    pub fn exit_initialization(&mut self) -> CallResult {
        if let Err(error) = self.simulation().map(drop) {
            self.now.phase = Phase::Error;
            return Err(error);
        }
        self.now.phase = match self.now.kind {
            Kind::CoSimulation => Phase::StepComplete,
            Kind::ModelExchange => Phase::Event,
        };
        if let Some(simulation) = &mut self.now.simulation {
            match self.now.kind {
                Kind::CoSimulation => simulation.set_input_derivatives(self.now.input_derivatives),
                Kind::ModelExchange => simulation.start_model_exchange(),
            }
        }
        self.publish()?;
        if self.allowed.events {
            self.now.phase = Phase::Event;
        }
        if let Some(simulation) = self.now.simulation.as_ref().filter(|_| self.log.is_on(Category::Events)) {
            self.log.event(&simulation.describe());
        }
        if let Some(simulation) = self.now.simulation.as_ref().filter(|_| self.log.is_on(Category::Warning)) {
            for warning in simulation.warnings() {
                self.log.warning(&warning.to_string());
            }
            self.warn_without_effect(effective::values_without_effect(
                &self.now.parameters,
                &self.now.inputs,
                self.situation(true),
            ));
        }
        self.report_unset();
        Ok(())
    }

    /// Logs start values that have an effect but were not set. They belong to the differential of the study, so they
    /// are a warning for any other differential, and otherwise part of the description of the scene. Also warns if load
    /// torques among them turn the wheels backward.
    fn report_unset(&self) {
        let Snapshot { parameters, inputs, set, .. } = &self.now;
        let is_another = set.describes_another_differential();
        if self.log.is_on(if is_another { Category::Warning } else { Category::Events }) {
            let line = unset::in_one_line(&unset::unset(parameters, inputs, set));
            match (line.is_empty(), is_another) {
                (true, _) => {}
                (false, true) => self.log.warning(&line),
                (false, false) => self.log.event(&line),
            }
        }
        if self.log.is_on(Category::Warning)
            && let Some(warning) = unset::runaway(parameters, inputs, set)
        {
            self.log.warning(&warning.to_string());
        }
    }

    /// True if a change of the variable affects the present scene.
    pub fn has_effect(&mut self, reference: u32) -> bool {
        let situation = self.situation(self.now.phase == Phase::Initialization);
        effective::has_effect(reference as usize, &self.now.parameters, situation)
    }

    fn situation(&self, from_start: bool) -> Situation {
        Situation { own_steps: self.now.kind == Kind::CoSimulation, from_start }
    }

    /// Logs a warning if a value that was set while the simulation runs has no effect.
    pub fn warn_of_set_value(&mut self, reference: u32, value: f64) {
        if self.now.phase.is_running() && self.log.is_on(Category::Warning) {
            let (index, situation) = (reference as usize, self.situation(false));
            if variables::table().rows.get(index).is_some_and(|row| self.without_effect.contains(&row.name)) {
                return;
            }
            let found = effective::value_without_effect(index, value, &self.now.parameters, situation);
            self.warn_without_effect(found);
        }
    }

    /// Logs that values have no effect, once for each variable.
    fn warn_without_effect(&mut self, found: impl IntoIterator<Item = Problem>) {
        for problem in found {
            // a tolerance announced by the host does not count as set by the user
            let is_announced =
                tolerance_row().is_some_and(|(row, _)| row.name == problem.variable) && !self.now.tolerance_chosen;
            if !is_announced && !self.without_effect.contains(&problem.variable) {
                self.log.warning(&problem.to_string());
                self.without_effect.push(problem.variable);
            }
        }
    }

    /// Ends the simulation.
    pub fn terminate(&mut self) -> CallResult {
        self.warn_at_end();
        self.now.phase = Phase::Terminated;
        if let Some(simulation) = &mut self.now.simulation {
            self.log.event(&simulation.account());
        }
        Ok(())
    }

    /// Resets the data of the instance to those of a new one. The settings of the log, and the features that the host
    /// allows, stay.
    pub fn reset(&mut self) -> CallResult {
        self.now = Snapshot::new(self.interface, self.now.kind);
        self.announced = None;
        self.reported = Reported::default();
        self.without_effect.clear();
        Ok(())
    }

    /// Enters the error state after an internal error. Only the parameters are reliable then.
    pub fn fail(&mut self) {
        (self.now.simulation, self.now.discrete) = (None, None);
        self.now.phase = Phase::Error;
    }

    /// Returns the simulation. In initialisation mode, it is built on demand from the values set so far.
    #[inline]
    pub fn simulation(&mut self) -> CallResult<&mut Simulation> {
        if self.now.simulation.is_none() {
            self.build_simulation()?;
        }
        self.now.simulation.as_mut().ok_or_else(|| CallError::error("there is no simulation"))
    }

    #[cold]
    fn build_simulation(&mut self) -> CallResult {
        let now = &mut self.now;
        if now.phase != Phase::Initialization {
            return Err(CallError::error(format!(
                "outputs have no values in the state \"{}\": initialisation was not completed",
                now.phase.name()
            )));
        }
        let started = now
            .start_from(&now.parameters, &now.inputs, &self.cache)
            .map_err(|problems| CallError::error(format!("initialisation failed:\n{}", problem::list(&problems))))?;
        now.simulation = Some(started);
        Ok(())
    }

    /// Advances from the current time to `point` + `h` [s].
    #[inline]
    pub fn do_step(&mut self, point: f64, h: f64) -> CallResult {
        let time = self.simulation()?.time();
        self.check_step(time, point, h)?;
        let not_plain = self.check_inputs_within_step(h)?;
        let until = point + h;
        // a step below the resolution of time changes nothing
        if until <= time {
            return Ok(());
        }
        let now = &mut self.now;
        let ramps = now.begin_ramp(until);
        let Some(simulation) = &mut now.simulation else { return Ok(()) };
        let outcome = simulation.advance(until);
        if ramps {
            now.end_ramp(until);
        } else if now.input_derivatives.is_some() {
            now.take_reached_inputs(not_plain);
        }
        now.derivatives_set = 0;
        if let Err(failure) = outcome {
            return Err(self.step_failed(&failure));
        }
        self.warn_while_running();
        if self.now.stop_time.is_some_and(|stop| until + time_tolerance(stop, h) >= stop) {
            self.warn_at_end();
        }
        Ok(())
    }

    /// Logs warnings about the simulation so far, each once per run.
    #[inline]
    pub fn warn_while_running(&mut self) {
        if self.log.is_on(Category::Warning) {
            self.log_unreported();
        }
    }

    fn log_unreported(&mut self) {
        if let Some(simulation) = &self.now.simulation {
            for warning in simulation.unreported(&mut self.reported) {
                self.log.warning(&warning.to_string());
            }
        }
    }

    /// Logs warnings that are known only at the end of a run, once.
    pub fn warn_at_end(&mut self) {
        if let Some(simulation) = self.now.simulation.as_mut().filter(|_| self.log.is_on(Category::Warning)) {
            for warning in simulation.unreported_at_end(&mut self.reported) {
                self.log.warning(&warning.to_string());
            }
        }
    }

    /// Restores a snapshot of an instance of the same kind and the same version of FMI. The stop time and the tolerance
    /// that the host announced to this instance take precedence over those of the snapshot.
    pub fn restore(&mut self, snapshot: &Snapshot) -> CallResult {
        let now = &self.now;
        if snapshot.version != now.version {
            return Err(CallError::error(format!(
                "the state belongs to an instance created with FMI {}.0, but this instance was created with FMI {}.0",
                snapshot.version, now.version
            )));
        }
        if snapshot.kind != now.kind {
            return Err(CallError::error(format!(
                "the state belongs to an instance for {:?}, but this instance is for {:?}",
                snapshot.kind, now.kind
            )));
        }
        let mut restored = snapshot.clone();
        if let Some(announced) = &self.announced {
            restored.follow(announced, &self.cache)?;
        }
        self.now = restored;
        self.changing = u32::MAX;
        // snapshots contain published values only if their host handled events; only such a host has published values
        let lacks_values = self.now.discrete.is_none() && self.now.phase.is_running();
        if lacks_values || !self.allowed.events { self.publish() } else { Ok(()) }
    }

    /// Refuses a step that does not start at the present `time` [s], or that ends after the stop time.
    pub fn check_step(&self, time: f64, point: f64, h: f64) -> CallResult {
        if !(h.is_finite() && h > 0.0) {
            return Err(CallError::error(format!("communication step size {h} s is not finite and positive")));
        }
        if !point.is_finite() || (point - time).abs() > time_tolerance(time, h) {
            return Err(CallError::error(format!("communication point {point} s is not the current time {time} s")));
        }
        let until = point + h;
        if !until.is_finite() {
            return Err(CallError::error(format!("the end of the step, {until} s, is not a finite number")));
        }
        match self.now.stop_time {
            Some(stop) if until > stop + time_tolerance(stop, h) => Err(self.after_stop(until, stop)),
            _ => Ok(()),
        }
    }

    /// Returns the error of a step that ends at `until` [s], after the stop time `stop` [s].
    #[cold]
    fn after_stop(&self, until: f64, stop: f64) -> CallError {
        let mut message = format!("the step ends at {until} s, after the stop time {stop} s");
        if self.announced.is_none_or(|announced| announced.stop.is_none()) {
            let setup = self.interface.setup;
            message += &format!(
                " of the restored state; announce a later stop time with {setup} before restoring a state, or save states \
                 of an instance without a stop time"
            );
        }
        CallError::error(message)
    }
}

/// Returns the row of the solver's tolerance, and access to its value.
pub fn tolerance_row() -> Option<(&'static Variable, Field<Parameters, f64>)> {
    variables::table().rows.iter().find(|row| is_tolerance(row)).and_then(|row| match row.access {
        Access::Real(slot) => Some((row, slot)),
        _ => None,
    })
}

/// True if `row` is the solver's tolerance, which the host may also announce.
pub fn is_tolerance(row: &Variable) -> bool {
    row.name == "solver.relative_tolerance"
}

/// Compile-time check that instances can move between threads, and that threads can share simulations, the table of
/// variables and FMU states.
const _: () = {
    const fn movable<T: Send>() {}
    const fn shared<T: Send + Sync>() {}
    movable::<Instance>();
    shared::<Snapshot>();
    shared::<Simulation>();
    shared::<variables::Table>();
};
