//! A differential for programs in Rust: set, run and read by the names and in the units of the FMU's variables.

use std::fmt;

use crate::declaration::Variability;
use crate::model::{Inputs, Parameters, Simulation, StepFailure};
use crate::problem::{self, Problem};
use crate::variables::{Access, Variable, assign, named, number_of, tuned, value_of};

/// A bevel gear differential.
///
/// Values are those of the FMU: SI units, and the same names. What is set before the first step or reading is what the
/// simulation starts from; after that inputs and tunable parameters may be set, and act from then on.
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
///     turn.set("planet.spin_command", 3.49)?;
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

/// Why something was refused or could not be completed.
#[derive(Clone, Debug, PartialEq)]
pub enum DifferentialError {
    /// There is no variable of this name.
    Unknown(String),
    /// Values that do not fit: each with its variable, range and hint.
    Values(Vec<Problem>),
    /// A step that could not be completed; the simulation stands at the last good time.
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
    /// The differential of the published study, with the start values of the FMU.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets `name` to a number in the unit of the interface; true and false are 1 and 0, choices have their numbers.
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
            simulation.set_inputs(&self.inputs);
            if !matches!(row.access, Access::Input(_)) {
                simulation.tune(&tuned(&self.parameters, simulation.parameters()));
            }
        }
        Ok(())
    }

    /// The value of `name` now. The first reading of an output starts the simulation.
    pub fn get(&mut self, name: &str) -> Result<f64, DifferentialError> {
        let row = variable(name)?;
        match row.access {
            Access::Output(source) => Ok(source.read(self.simulation()?)),
            _ => Ok(value_of(row, &self.parameters, &self.inputs).unwrap_or(f64::NAN)),
        }
    }

    /// Simulates on for `duration` [s]; inputs hold. The first call starts the simulation at 0 s.
    pub fn advance(&mut self, duration: f64) -> Result<(), DifferentialError> {
        if !(duration >= 0.0 && duration.is_finite()) {
            let message = format!("a duration of {duration} s is no time to simulate for");
            return Err(DifferentialError::Step(StepFailure { time: self.time(), message }));
        }
        let simulation = self.simulation()?;
        let until = simulation.time() + duration;
        if until <= simulation.time() {
            return Ok(());
        }
        simulation.advance(until).map_err(DifferentialError::Step)
    }

    /// Time that was simulated [s].
    pub fn time(&self) -> f64 {
        self.simulation.as_ref().map_or(0.0, Simulation::time)
    }

    /// The simulation, started if it was not: what it warns of, single tooth loads, and all else that has no name.
    pub fn simulation(&mut self) -> Result<&mut Simulation, DifferentialError> {
        let start = || Simulation::start(&self.parameters, &self.inputs, 0.0).map_err(DifferentialError::Values);
        let simulation = match self.simulation.take() {
            Some(simulation) => simulation,
            None => start()?,
        };
        Ok(self.simulation.insert(simulation))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(outcome: Result<(), DifferentialError>) -> String {
        outcome.expect_err("it is refused").to_string()
    }

    #[test]
    fn what_does_not_fit_is_refused_by_name_value_and_range() {
        let mut it = Differential::new();
        for (outcome, words) in [
            (it.set("geometry.modul", 1.0), vec!["geometry.modul"]),
            (it.set("geometry.module", 4.5), vec!["geometry.module", "4.5 m", "did you mean 4.5 mm"]),
            (it.set("geometry.planet_teeth", 10.5), vec!["geometry.planet_teeth", "10.5", "whole"]),
            (it.set("effects.strength", 2.0), vec!["effects.strength", "true"]),
            (it.set("contact.law", 99.0), vec!["contact.law", "line_weber"]),
            (it.set_text("contact.law", "lines"), vec!["\"lines\"", "impact (1)", "line (2)"]),
            (it.set_text("geometry.module", "big"), vec!["geometry.module", "\"big\""]),
            (it.set("left.speed", 1.0), vec!["left.speed", "output"]),
            (it.set("left.load_torque", f64::NAN), vec!["left.load_torque", "finite"]),
            (it.advance(f64::NAN), vec!["NaN s"]),
            (it.advance(-1.0), vec!["-1 s"]),
        ] {
            let said = refused(outcome);
            assert!(words.iter().all(|word| said.contains(word)), "{said}");
        }
        assert_eq!(it.time(), 0.0);
    }

    #[test]
    fn problems_of_the_start_come_together_and_the_values_stay() {
        let mut it = Differential::new();
        it.set("geometry.face_width", 0.2).expect("within its range");
        let said = refused(it.advance(0.1));
        assert!(said.contains("geometry.face_width"), "{said}");
        it.set("geometry.face_width", 0.02).expect("it was not started");
        it.advance(0.01).expect("it runs now");
        assert!(refused(it.set("geometry.face_width", 0.03)).contains("fixed parameter"));
    }

    #[test]
    fn inputs_and_tunable_parameters_act_from_when_they_are_set() {
        let mut it = Differential::new();
        it.set_text("scene.carrier_drive", "torque").expect("a choice");
        it.advance(0.01).expect("a step");
        let before = it.get("der(carrier.speed)").expect("an output");
        it.set("carrier.torque_command", 5000.0).expect("an input");
        it.set("contact.damping", 2e4).expect("a tunable parameter");
        it.advance(0.01).expect("a step");
        assert_eq!(it.get("carrier.torque_command").expect("an input"), 5000.0);
        assert!(it.get("der(carrier.speed)").expect("an output") > before);
        assert_eq!(it.time(), 0.02);
    }

    #[test]
    fn a_clone_goes_its_own_way() {
        let mut it = Differential::new();
        it.advance(0.01).expect("a step");
        let mut other = it.clone();
        it.advance(0.02).expect("a step");
        other.advance(0.02).expect("a step");
        assert_eq!(it.get("left.speed"), other.get("left.speed"));
    }
}
