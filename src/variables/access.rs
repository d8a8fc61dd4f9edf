//! Access to the value of a variable from its row of the table.

use crate::declaration::{EnumType, Field, GetChoice, Parameter, Row, SetChoice};
use crate::model::{Forces, InputField, LedgerReadings, Motion, PairLine, Parameters, Simulation};

/// Source of the value of an output.
#[derive(Clone, Copy)]
pub enum OutputSource {
    /// Constants of a simulation, which do not change after initialisation, by an index.
    Constant(usize, fn(&Simulation, usize) -> f64),
    /// Angles and speeds, by an index.
    Motion(usize, fn(&Motion, usize) -> f64),
    /// Forces by an index, which need one evaluation of the teeth.
    Forces(usize, fn(&Forces, usize) -> f64),
    /// Components of normal forces along axes and across pins, which also need an evaluation of the teeth, by an index.
    Components(usize, fn(&Forces, usize) -> f64),
    /// Loaded tooth pair of planet 1 with the left side gear, by its number.
    Pair(usize, fn(&PairLine) -> f64),
    /// Ledger and statistics of the solver, by an index.
    Ledger(usize, fn(&LedgerReadings, usize) -> f64),
    /// Reading of an effect that changes with steps and is one of several choices: its type, and its index among such
    /// readings.
    Choice(&'static EnumType, usize),
    /// Reading of an effect that may change at any instant, by its index among such readings.
    Reading(usize),
    /// Continuous state, by its number.
    State(usize),
    /// Time derivative of a continuous state, by the number of the state.
    Rate(usize),
}

impl OutputSource {
    /// Returns the value of the output.
    pub fn read(self, simulation: &mut Simulation) -> f64 {
        match self {
            Self::Constant(i, of) => of(simulation, i),
            Self::Motion(i, of) => of(&simulation.motion(), i),
            Self::Forces(i, of) | Self::Components(i, of) => of(simulation.forces(), i),
            Self::Pair(k, of) => of(&simulation.pair_lines()[k]),
            Self::Reading(index) => simulation.forces().readings[index],
            Self::Ledger(i, of) => of(&simulation.ledger(), i),
            Self::Choice(_, index) => simulation.ledger().readings[index],
            Self::State(k) => simulation.states()[k],
            Self::Rate(k) => simulation.state_rates()[k],
        }
    }
}

/// Type of a variable, and access to its value.
#[derive(Clone, Copy)]
pub enum Access {
    /// A real parameter.
    Real(Field<Parameters, f64>),
    /// An integer parameter.
    Integer(Field<Parameters, i32>),
    /// A Boolean parameter.
    Boolean(Field<Parameters, bool>),
    /// An enumeration parameter: type, getter, and setter for a value that is one of its choices.
    Enumeration(&'static EnumType, GetChoice<Parameters>, SetChoice<Parameters>),
    /// A real input.
    Input(InputField),
    /// A real output, a local variable, or a calculated parameter.
    Output(OutputSource),
}

impl Access {
    /// Returns the type of an enumeration.
    pub fn enumeration(&self) -> Option<&'static EnumType> {
        match self {
            Self::Enumeration(kind, ..) | Self::Output(OutputSource::Choice(kind, _)) => Some(kind),
            _ => None,
        }
    }
}

/// A row of the table.
pub type Variable = Row<Access>;

impl From<Parameter<Parameters>> for Access {
    fn from(parameter: Parameter<Parameters>) -> Self {
        match parameter {
            Parameter::Real(field) => Self::Real(field),
            Parameter::Integer(field) => Self::Integer(field),
            Parameter::Boolean(field) => Self::Boolean(field),
            Parameter::Enumeration(kind, get, set) => Self::Enumeration(kind, get, set),
        }
    }
}
