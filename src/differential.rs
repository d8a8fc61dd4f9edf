//! Differential for programs in Rust, which set, run and read it by the names and in the units of the FMU's variables.

use std::fmt;

use crate::declaration::Variability;
use crate::model::{HostInputs, Inputs, Parameters, Simulation, StepFailure};
use crate::problem::{self, Problem};
use crate::variables::{Access, Variable, assign, named, number_of, tuned, value_of};

/// A bevel gear differential.
///
/// Names and SI units are those of the FMU. Values that are set before the first step or reading are initial values.
/// Later, inputs and tunable parameters may be set, with immediate effect.
///
/// ```
/// use bevel_differential::{Differential, DifferentialError};
///
/// fn main() -> Result<(), DifferentialError> {
///     let mut turn = Differential::new();
///     turn.set("geometry.module", 4.5e-3)?;
///     turn.set_text("contact.law", "line")?;
///     turn.set_text("scene.planet_spin", "imposed")?;
///     turn.set("carrier.speed_command", 16.65)?;
///     turn.set("spin.command", 3.49)?;
///     turn.advance(0.1)?;
///     let (left, right) = (turn.get("left.speed")?, turn.get("right.speed")?);
///     assert!((left + right - 2.0 * 16.65).abs() < 0.01, "the mean of both wheels is the carrier's speed");
///     assert!(turn.get("planet[1].left_normal_force")? > 0.0);
///     Ok(())
/// }
/// ```
#[derive(Clone, Debug, Default)]
pub struct Differential {
    parameters: Parameters,
    inputs: Inputs,
    simulation: Option<Simulation>,
}

/// Error of a call that was refused or could not be completed.
#[derive(Clone, Debug, PartialEq)]
pub enum DifferentialError {
    /// Unknown name of a variable.
    Unknown(String),
    /// Invalid values, each with its variable, range and hint.
    Values(Vec<Problem>),
    /// A step that could not be completed. The simulation is at the last good time.
    Step(StepFailure),
}

impl fmt::Display for DifferentialError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name) => write!(f, "there is no variable \"{name}\""),
            Self::Values(problems) => write!(f, "{}", problem::list(problems)),
            Self::Step(failure) => failure.fmt(f),
        }
    }
}

impl std::error::Error for DifferentialError {}

impl From<Problem> for DifferentialError {
    fn from(problem: Problem) -> Self {
        Self::Values(vec![problem])
    }
}

fn variable(name: &str) -> Result<&'static Variable, DifferentialError> {
    named(name).ok_or_else(|| DifferentialError::Unknown(name.to_owned()))
}

impl Differential {
    /// Creates a differential with the start values of the FMU. They are those of the study, except for the addenda.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets `name` to a number in the unit of the interface. True and false are 1 and 0, and choices have their
    /// numbers.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), DifferentialError> {
        self.assign(variable(name)?, value)
    }

    /// Sets a choice by its name, or a switch to "true" or "false".
    pub fn set_text(&mut self, name: &str, text: &str) -> Result<(), DifferentialError> {
        let row = variable(name)?;
        self.assign(row, number_of(row, text)?)
    }

    fn assign(&mut self, row: &Variable, value: f64) -> Result<(), DifferentialError> {
        if self.simulation.is_some() && row.variability == Variability::Fixed {
            let what = "is a fixed parameter: it can be set only before the first step or reading";
            return Err(Problem::new(row.name, what).into());
        }
        assign(row, value, &mut self.parameters, &mut self.inputs)?;
        if let Some(simulation) = &mut self.simulation {
            if simulation.ramps_inputs() {
                simulation.apply_unramped(&HostInputs::held(&self.inputs));
            } else {
                simulation.set_inputs(&self.inputs);
            }
            if !matches!(row.access, Access::Input(_)) {
                simulation.tune(&tuned(&self.parameters, simulation.parameters()));
            }
        }
        Ok(())
    }

    /// Returns the present value of `name`. The first reading of an output starts the simulation.
    pub fn get(&mut self, name: &str) -> Result<f64, DifferentialError> {
        let row = variable(name)?;
        match row.access {
            Access::Output(source) => Ok(source.read(self.simulation()?)),
            _ => Ok(value_of(row, &self.parameters, &self.inputs).unwrap_or(f64::NAN)),
        }
    }

    /// Advances the simulation by `duration` [s]. Inputs are held, or ramped with `solver.input_ramp`. The first call
    /// starts the simulation at 0 s.
    pub fn advance(&mut self, duration: f64) -> Result<(), DifferentialError> {
        if !(duration >= 0.0 && duration.is_finite()) {
            let message = format!("the duration {duration} s is not a finite number of at least 0");
            return Err(DifferentialError::Step(StepFailure { time: self.time(), message }));
        }
        let host = HostInputs::held(&self.inputs);
        let simulation = self.simulation()?;
        let until = simulation.time() + duration;
        if until <= simulation.time() {
            return Ok(());
        }
        if !simulation.ramps_inputs() {
            return simulation.advance(until).map_err(DifferentialError::Step);
        }
        simulation.ramp_inputs(&host, until);
        simulation.advance(until).map_err(DifferentialError::Step)?;
        simulation.end_ramp(&host);
        Ok(())
    }

    /// Simulated time [s].
    pub fn time(&self) -> f64 {
        self.simulation.as_ref().map_or(0.0, Simulation::time)
    }

    /// Returns the simulation, and starts it if necessary. It provides warnings, individual tooth loads, and everything
    /// else without a variable name.
    pub fn simulation(&mut self) -> Result<&mut Simulation, DifferentialError> {
        let start = || Simulation::start(&self.parameters, &self.inputs, 0.0).map_err(DifferentialError::Values);
        let simulation = match self.simulation.take() {
            Some(simulation) => simulation,
            None => start()?,
        };
        Ok(self.simulation.insert(simulation))
    }
}
