//! Conditions under which rows have an effect, as alternative lists of requirements. The parser is independent of the
//! program's parser.

use bevel_differential::variables::{Access, Variable, named};

/// Requirement of a condition. The value of `row` must be one of `values` (sign `=`), none of them (`!`), or greater
/// than the first one (`>`).
#[derive(Clone)]
pub struct Requirement {
    pub row: &'static Variable,
    pub sign: char,
    pub values: Vec<f64>,
}

/// Alternatives in which `row` has an effect. Each is a list of requirements that must all be met. The conditions
/// `co-simulation` and `initialisation` add no requirement.
pub fn alternatives(row: &Variable) -> Vec<Vec<Requirement>> {
    let switch = row.switch.map_or(vec![vec![]], |name| read(&format!("{name} = true")));
    both(switch, row.when.map_or(vec![vec![]], read))
}

fn both(a: Vec<Vec<Requirement>>, b: Vec<Vec<Requirement>>) -> Vec<Vec<Requirement>> {
    a.iter().flat_map(|one| b.iter().map(|other| [one.as_slice(), other].concat())).collect()
}

fn read(text: &str) -> Vec<Vec<Requirement>> {
    let mut words: Vec<String> =
        text.replace('(', "( ").replace(')', " )").split(' ').rev().map(String::from).collect();
    let found = any(&mut words);
    assert!(words.is_empty(), "{text}");
    found
}

/// Parses alternatives joined by "or". Words are taken from the end.
fn any(words: &mut Vec<String>) -> Vec<Vec<Requirement>> {
    let mut found = all(words);
    while words.pop_if(|word| word == "or").is_some() {
        found.extend(all(words));
    }
    found
}

fn all(words: &mut Vec<String>) -> Vec<Vec<Requirement>> {
    let mut found = one(words);
    while words.pop_if(|word| word == "and").is_some() {
        found = both(found, one(words));
    }
    found
}

fn one(words: &mut Vec<String>) -> Vec<Vec<Requirement>> {
    let word = words.pop().unwrap();
    match word.as_str() {
        "(" => {
            let found = any(words);
            assert_eq!(words.pop().as_deref(), Some(")"));
            found
        }
        "co-simulation" | "initialisation" => vec![vec![]],
        name => {
            let row = named(name).unwrap_or_else(|| panic!("no {name}"));
            let sign = words.pop().unwrap().chars().next().unwrap();
            let values = words.pop().unwrap();
            vec![vec![Requirement { row, sign, values: values.split('|').map(|value| value_of(row, value)).collect() }]]
        }
    }
}

fn value_of(row: &Variable, word: &str) -> f64 {
    match row.access {
        Access::Enumeration(kind, ..) => {
            f64::from(kind.choices.iter().find(|choice| choice.name == word).unwrap().value)
        }
        Access::Boolean(_) => f64::from(word.parse::<bool>().unwrap()),
        _ => word.parse().unwrap(),
    }
}
