//! Conditions under which rows have an effect, as alternative lists of requirements.

use bevel_differential::declaration::{Condition, Test};
use bevel_differential::model::effects::needs;
use bevel_differential::variables::{Variable, named};

/// Requirement of a condition. The value of `row` must be one of `values` (sign `=`), none of them (`!`), or greater
/// than the first one (`>`).
#[derive(Clone)]
pub struct Requirement {
    pub row: &'static Variable,
    pub sign: char,
    pub values: Vec<f64>,
}

impl From<&Test> for Requirement {
    fn from(test: &Test) -> Self {
        let row = named(&test.name()).unwrap_or_else(|| panic!("no {}", test.name()));
        Self { row, sign: test.sign.chars().next().unwrap(), values: (test.wanted)() }
    }
}

/// Alternatives in which `row` has an effect. Each is a list of requirements that must all be met. The conditions of
/// co-simulation and initialisation add no requirement.
pub fn alternatives(row: &Variable) -> Vec<Vec<Requirement>> {
    let of = |condition: Option<Condition>| condition.map_or(vec![vec![]], |condition| read(&condition));
    both(of(row.switch), of(row.when))
}

fn both(a: Vec<Vec<Requirement>>, b: Vec<Vec<Requirement>>) -> Vec<Vec<Requirement>> {
    a.iter().flat_map(|one| b.iter().map(|other| [one.as_slice(), other].concat())).collect()
}

fn read(condition: &Condition) -> Vec<Vec<Requirement>> {
    match condition {
        Condition::Any(parts) => parts.iter().flat_map(read).collect(),
        Condition::Need(need) => {
            needs().iter().filter(|(of, _)| of == need).flat_map(|(_, condition)| read(condition)).collect()
        }
        Condition::All(parts) => parts.iter().map(read).fold(vec![vec![]], both),
        Condition::Test(test) => vec![vec![test.into()]],
        Condition::OwnSteps | Condition::FromStart => vec![vec![]],
    }
}
