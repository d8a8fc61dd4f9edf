//! An FMU instance as FMI sees it: life cycle and steps, on top of `model::Simulation`. No pointers here.

use super::calls::Phase;
use super::log::Log;
use super::refusal::{Answer, Refusal};
use super::snapshot::Snapshot;
use super::types::{DO_STEP_STATUS, Kind, LAST_SUCCESSFUL_TIME, Status, TERMINATED};
use crate::declaration::Field;
use crate::model::Parameters;
use crate::model::Simulation;
use crate::problem;
use crate::variables::{self, Access, Variable};

/// Communication points are compared with this tolerance, relative to the larger of time and step size: far above what
/// hosts lose by adding up steps.
const TIME_TOLERANCE: f64 = 1e-9;
/// But a point that is off by this share of the step is another point.
const STEP_TOLERANCE: f64 = 0.1;

/// How far a time may be from where it should be [s], for times around `time` and steps of `h`.
fn slack(time: f64, h: f64) -> f64 {
    let wide = TIME_TOLERANCE * time.abs().max(h);
    wide.min(STEP_TOLERANCE * h).max(64.0 * f64::EPSILON * time.abs())
}

/// An instance: what a snapshot keeps, and the log, which it does not.
pub struct Instance {
    /// Parameters, inputs, phase, simulation.
    pub now: Snapshot,
    /// The host's log.
    pub log: Log,
    /// Whether a law used outside its range was told of.
    warned: bool,
}

/// Accuracy and interval the host asks for.
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
    /// A fresh instance with start values.
    pub fn new(kind: Kind, log: Log) -> Self {
        Self { now: Snapshot::new(kind), log, warned: false }
    }

    /// fmi2SetupExperiment. A tolerance the host set as a parameter wins over the one given here.
    pub fn setup_experiment(&mut self, experiment: &Experiment) -> Answer {
        let Experiment { tolerance, start, stop } = *experiment;
        if !start.is_finite() {
            return Err(Refusal::error(format!("start time {start} s is not a finite number")));
        }
        if let Some(stop) = stop
            && (stop.is_nan() || stop <= start)
        {
            return Err(Refusal::error(format!("stop time {stop} s is not after the start time {start} s")));
        }
        if let Some(asked) = tolerance
            && (asked.is_nan() || asked <= 0.0)
        {
            return Err(Refusal::error(format!("tolerance {asked} is not a positive number")));
        }
        (self.now.start_time, self.now.stop_time) = (start, stop);
        if let (Some(asked), false, Some((row, slot))) = (tolerance, self.now.tolerance_chosen, tolerance_row()) {
            let range = row.range.unwrap_or(variables::Range { min: asked, max: asked });
            *slot(&mut self.now.parameters) = asked.clamp(range.min, range.max);
        }
        Ok(())
    }

    /// fmi2EnterInitializationMode.
    pub fn enter_initialization(&mut self) -> Answer {
        self.now.phase = Phase::Initialization;
        Ok(())
    }

    /// fmi2ExitInitializationMode: every problem at once, or a simulation that stands at its start.
    pub fn exit_initialization(&mut self) -> Answer {
        if let Err(refusal) = self.simulation().map(drop) {
            self.now.phase = Phase::Error;
            return Err(refusal);
        }
        self.now.phase = match self.now.kind {
            Kind::CoSimulation => Phase::StepComplete,
            Kind::ModelExchange => Phase::Event,
        };
        if let Some(simulation) = &mut self.now.simulation {
            match self.now.kind {
                Kind::CoSimulation => simulation.set_course(self.now.course),
                Kind::ModelExchange => simulation.hand_over(),
            }
        }
        if let Some(simulation) = &self.now.simulation {
            self.log.event(&simulation.describe());
            for warning in simulation.warnings() {
                self.log.warning(&warning.to_string());
            }
        }
        Ok(())
    }

    /// fmi2Terminate.
    pub fn terminate(&mut self) -> Answer {
        self.now.phase = Phase::Terminated;
        if let Some(simulation) = &self.now.simulation {
            self.log.event(&simulation.account());
        }
        Ok(())
    }

    /// fmi2Reset: as after fmi2Instantiate, but for the log's settings.
    pub fn reset(&mut self) -> Answer {
        self.now = Snapshot::new(self.now.kind);
        self.warned = false;
        Ok(())
    }

    /// After an internal error nothing but the parameters can be trusted.
    pub fn fail(&mut self) {
        self.now.simulation = None;
        self.now.phase = Phase::Error;
    }

    /// The simulation; in initialisation mode it is built when it is asked for, from what is set by then.
    pub fn simulation(&mut self) -> Answer<&mut Simulation> {
        let now = &mut self.now;
        if now.simulation.is_none() {
            match now.phase {
                Phase::Initialization => now.simulation = Some(now.start().map_err(|p| initial_problems(&p))?),
                phase => {
                    return Err(Refusal::error(format!(
                        "outputs have no values in the state \"{}\": no initialisation was completed",
                        phase.name()
                    )));
                }
            }
        }
        now.simulation.as_mut().ok_or_else(|| Refusal::error("there is no simulation"))
    }

    /// fmi2DoStep: from the current time to `point` + `h` [s].
    pub fn do_step(&mut self, point: f64, h: f64) -> Answer {
        let stop = self.now.stop_time;
        let time = self.simulation()?.time();
        check_step(time, stop, point, h)?;
        self.check_course(h)?;
        let until = point + h;
        // a step below the resolution of the time axis is done already
        if until <= time {
            return Ok(());
        }
        let course = self.now.course;
        let simulation = self.simulation()?;
        simulation.set_course(course);
        let outcome = simulation.advance(until);
        let (last, watched) = (simulation.time(), simulation.is_watched());
        if course.is_some() {
            let (inputs, course) = (*simulation.inputs(), simulation.course().copied());
            (self.now.inputs, self.now.course) = (inputs, course);
        }
        self.now.told = 0;
        let Err(failure) = outcome else {
            if watched {
                self.watch();
            }
            return Ok(());
        };
        self.now.phase = Phase::StepFailed;
        Err(Refusal::discard(format!(
            "{failure}; values are those of the last successful time {last} s; \
             go on with fmi2SetFMUstate or fmi2Reset"
        )))
    }

    /// Warns once when a law is used outside the range that it was published for.
    pub fn watch(&mut self) {
        if self.warned {
            return;
        }
        if let Some(problem) = self.now.simulation.as_ref().and_then(Simulation::out_of_range) {
            self.warned = true;
            self.log.warning(&problem.to_string());
        }
    }

    /// fmi2GetStatus.
    pub fn status(&self, kind: i32) -> Answer<Status> {
        match kind {
            DO_STEP_STATUS if self.now.phase == Phase::StepFailed => Ok(Status::Discard),
            DO_STEP_STATUS => Ok(Status::Ok),
            _ => Err(no_such_status(kind)),
        }
    }

    /// fmi2GetRealStatus.
    pub fn real_status(&self, kind: i32) -> Answer<f64> {
        match (kind, &self.now.simulation) {
            (LAST_SUCCESSFUL_TIME, Some(simulation)) => Ok(simulation.time()),
            _ => Err(no_such_status(kind)),
        }
    }

    /// fmi2GetBooleanStatus: the FMU never asks to end the simulation.
    pub fn boolean_status(&self, kind: i32) -> Answer<bool> {
        if kind == TERMINATED { Ok(false) } else { Err(no_such_status(kind)) }
    }
}

fn check_step(time: f64, stop: Option<f64>, point: f64, h: f64) -> Answer {
    if !(h.is_finite() && h > 0.0) {
        return Err(Refusal::error(format!("communication step size {h} s is not finite and positive")));
    }
    if !point.is_finite() || (point - time).abs() > slack(time, h) {
        return Err(Refusal::error(format!("communication point {point} s is not the current time {time} s")));
    }
    let until = point + h;
    if !until.is_finite() {
        return Err(Refusal::error(format!("the end of the step, {until} s, is not a finite number")));
    }
    match stop {
        Some(stop) if until > stop + slack(stop, h) => {
            Err(Refusal::error(format!("the step ends at {until} s, after the stop time {stop} s")))
        }
        _ => Ok(()),
    }
}

/// The refusal to answer fmi2Get…Status; FMI asks for fmi2Discard.
pub fn no_such_status(kind: i32) -> Refusal {
    Refusal::discard(format!("there is nothing to tell about the status kind {kind}"))
}

fn initial_problems(problems: &[problem::Problem]) -> Refusal {
    Refusal::error(format!("initialisation failed:\n{}", problem::list(problems)))
}

/// Row of the solver's tolerance and access to it.
fn tolerance_row() -> Option<(&'static Variable, Field<Parameters, f64>)> {
    variables::table().rows.iter().find(|row| is_tolerance(row)).and_then(|row| match row.access {
        Access::Real(slot) => Some((row, slot)),
        _ => None,
    })
}

/// Whether `row` is the solver's tolerance, which fmi2SetupExperiment sets too.
pub fn is_tolerance(row: &Variable) -> bool {
    row.name == "solver.relative_tolerance"
}
