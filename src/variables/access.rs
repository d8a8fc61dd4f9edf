//! The way from a row of the table to the value of its variable.

use crate::declaration::{EnumType, Field, GetChoice, Parameter, Row, SetChoice};
use crate::model::{Forces, InputField, LedgerReadings, Motion, PairLine, Parameters, Simulation};

/// Where the value of an output is read.
#[derive(Clone, Copy)]
pub enum OutputSource {
    /// From the constants of a simulation, which do not change from the end of initialisation on.
    Constant(fn(&Simulation) -> f64),
    /// From angles and speeds.
    Motion(fn(&Motion) -> f64),
    /// From forces, which take one evaluation of the teeth.
    Forces(fn(&Forces) -> f64),
    /// The same, of the parts of normal forces along axes and across pins.
    Parts(fn(&Forces) -> f64),
    /// From a loaded tooth pair of planet 1 with the left side gear, by its number.
    Pair(usize, fn(&PairLine) -> f64),
    /// From the ledger and the solver's statistics.
    Ledger(fn(&LedgerReadings) -> f64),
    /// A reading of an effect that changes at any instant, by its place among these.
    Reading(usize),
    /// A reading of an effect that changes with accepted steps, by its place among these.
    LedgerReading(usize),
    /// Heat, by its place in the ledger.
    Heat(usize),
    /// A continuous state, by its number.
    State(usize),
    /// The rate of one.
    Rate(usize),
}

impl OutputSource {
    /// Value of the output.
    pub fn read(self, simulation: &mut Simulation) -> f64 {
        match self {
            Self::Constant(of) => of(simulation),
            Self::Motion(of) => of(&simulation.motion()),
            Self::Forces(of) | Self::Parts(of) => of(simulation.forces()),
            Self::Pair(k, of) => of(&simulation.pair_lines()[k]),
            Self::Reading(place) => simulation.forces().readings[place],
            Self::Ledger(of) => of(&simulation.ledger()),
            Self::LedgerReading(place) => simulation.ledger().readings[place],
            Self::Heat(place) => simulation.ledger().heat[place],
            Self::State(k) => simulation.states()[k],
            Self::Rate(k) => simulation.state_rates()[k],
        }
    }
}

/// Type of a variable and the way to its value.
#[derive(Clone, Copy)]
pub enum Access {
    /// A real parameter.
    Real(Field<Parameters, f64>),
    /// An integer parameter.
    Integer(Field<Parameters, i32>),
    /// A Boolean parameter.
    Boolean(Field<Parameters, bool>),
    /// An enumeration parameter: type, reading, and assignment of a value that is one of its choices.
    Enumeration(&'static EnumType, GetChoice<Parameters>, SetChoice<Parameters>),
    /// A real input.
    Input(InputField),
    /// A real output, a local variable, or a calculated parameter.
    Output(OutputSource),
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
