//! Conditions under which the value of a variable has an effect in a scene, as declared in its row. Warnings about
//! values without effect follow from them.
//!
//! ```text
//! condition = term {" or " term}      term = factor {" and " factor}      factor = "(" condition ")" | test
//! test = NAME " = " VALUES | NAME " != " VALUES | NAME " > " NUMBER | "co-simulation" | "initialisation"
//! ```
//!
//! NAME is a parameter; a tunable one counts with its present value. VALUES are literals, true, false or numbers, separated by `|`. The test `co-simulation`
//! is true if the FMU integrates. The test `initialisation` is true for values that are set before the first step.

use std::fmt;
use std::sync::OnceLock;

use super::named::{index_of, number, number_of};
use super::table::table;
use super::{Access, Variable};
use crate::model::{Inputs, Parameters};
use crate::problem::Problem;
use crate::static_memory::store_all;

/// Situation in which a value is set.
#[derive(Clone, Copy, Debug)]
pub struct Situation {
    /// True if the FMU integrates, as in co-simulation.
    pub own_steps: bool,
    /// True if the value is set before the simulation starts.
    pub from_start: bool,
}

impl Situation {
    /// Values set before a co-simulation starts.
    pub const START: Self = Self { own_steps: true, from_start: true };
    /// Values set while a co-simulation runs.
    pub const RUNNING: Self = Self { own_steps: true, from_start: false };
}

/// A parsed condition, with rows by their indices.
#[derive(Clone, Copy, Debug)]
enum Condition {
    Any(&'static [Self]),
    All(&'static [Self]),
    OneOf(usize, &'static [f64]),
    NoneOf(usize, &'static [f64]),
    Above(usize, f64),
    OwnSteps,
    FromStart,
}

impl Condition {
    /// Parses `text`. Returns `None` if it has another form or contains an unknown name.
    fn read(text: &str) -> Option<Self> {
        let several = |parts: Vec<&str>| parts.into_iter().map(Self::read).collect::<Option<Vec<_>>>();
        for (word, of) in [(" or ", Self::Any as fn(&'static [Self]) -> Self), (" and ", Self::All)] {
            let parts = split(text, word);
            if parts.len() > 1 {
                return several(parts).map(|parts| of(store_all(&parts)));
            }
        }
        if let Some(inner) = text.strip_prefix('(') {
            return Self::read(inner.strip_suffix(')')?);
        }
        match text {
            "co-simulation" => return Some(Self::OwnSteps),
            "initialisation" => return Some(Self::FromStart),
            _ => {}
        }
        let mut words = text.split(' ');
        let (name, sign, values) = (words.next()?, words.next()?, words.next()?);
        let index = index_of(name)?;
        let values = values.split('|').map(|word| number_in(&table().rows[index], word)).collect::<Option<Vec<_>>>()?;
        let values = store_all(&values);
        match sign {
            "=" => Some(Self::OneOf(index, values)),
            "!=" => Some(Self::NoneOf(index, values)),
            ">" => Some(Self::Above(index, *values.first()?)),
            _ => None,
        }
    }

    fn holds(&self, parameters: &mut Parameters, situation: Situation) -> bool {
        let p = parameters;
        match self {
            Self::Any(parts) => parts.iter().any(|part| part.holds(p, situation)),
            Self::All(parts) => parts.iter().all(|part| part.holds(p, situation)),
            Self::OneOf(index, values) => parameter(*index, p).is_some_and(|value| values.contains(&value)),
            Self::NoneOf(index, values) => parameter(*index, p).is_some_and(|value| !values.contains(&value)),
            Self::Above(index, bound) => parameter(*index, p).is_some_and(|value| value > *bound),
            Self::OwnSteps => situation.own_steps,
            Self::FromStart => situation.from_start,
        }
    }

    /// Returns the failed tests. Two short alternatives are both named. Of others, the one with the fewest failed tests
    /// is chosen.
    fn missing(&self, parameters: &mut Parameters, situation: Situation) -> Missing {
        if self.holds(parameters, situation) {
            return Missing::default();
        }
        let mut test = |index: &usize, sign: &str, values: &[f64]| {
            let row = &table().rows[*index];
            let values: Vec<String> = values.iter().map(|value| written(row, *value)).collect();
            let now = parameter(*index, parameters).map_or(String::new(), |now| written(row, now));
            Missing {
                tests: vec![format!("{} {sign} {} (now: {now})", row.name, values.join(" or "))],
                ..Missing::default()
            }
        };
        let words = |text: &str| Missing { tests: vec![text.to_owned()], ..Missing::default() };
        match self {
            Self::Any(parts) => {
                let all: Vec<Missing> = parts.iter().map(|part| part.missing(parameters, situation)).collect();
                if let [one, other] = &all[..]
                    && one.tests.len() + other.tests.len() <= MOST_TESTS
                    && !one.has_alternatives
                    && !other.has_alternatives
                {
                    let [one, other] = [one, other].map(|missing| missing.tests.join(" and "));
                    return words(&format!("either {one} or {other}"));
                }
                let nearest = all.into_iter().min_by_key(|missing| missing.tests.len()).unwrap_or_default();
                Missing { has_alternatives: true, ..nearest }
            }
            Self::All(parts) => {
                let mut all = Missing::default();
                parts.iter().for_each(|part| all.add(part.missing(parameters, situation)));
                all
            }
            Self::OneOf(index, values) => test(index, "=", values),
            Self::NoneOf(index, values) => test(index, "!=", values),
            Self::Above(index, bound) => test(index, ">", &[*bound]),
            Self::OwnSteps => words("the FMU integrates, as in co-simulation"),
            Self::FromStart => words("it is set before the first step"),
        }
    }
}

/// Splits `text` at each `word` outside brackets.
fn split<'a>(text: &'a str, word: &str) -> Vec<&'a str> {
    let (mut parts, mut depth, mut begin) = (Vec::new(), 0, 0);
    for (i, letter) in text.char_indices() {
        match letter {
            '(' => depth += 1,
            ')' => depth -= 1,
            ' ' if depth == 0 && i >= begin && text[i..].starts_with(word) => {
                parts.push(&text[begin..i]);
                begin = i + word.len();
            }
            _ => {}
        }
    }
    parts.push(&text[begin..]);
    parts
}

/// Number of the value `word` of `row`, or `None` if `row` cannot have this value.
fn number_in(row: &Variable, word: &str) -> Option<f64> {
    match row.access {
        Access::Enumeration(..) | Access::Boolean(_) => number_of(row, word).ok(),
        _ => word.parse().ok(),
    }
}

fn parameter(index: usize, parameters: &mut Parameters) -> Option<f64> {
    number(&table().rows[index], parameters, &mut Inputs::ZERO.clone())
}

/// Conditions under which the value of a row has an effect.
#[derive(Clone, Copy)]
struct Needs {
    /// Start value; `None` for an output.
    start: Option<f64>,
    /// Condition that the switch of the row's effect is on; `None` = no switch.
    switch: Option<Condition>,
    /// Condition [`Row::when`](crate::declaration::Row::when); `None` = always.
    when: Option<Condition>,
    /// Condition [`Row::acts_when`](crate::declaration::Row::acts_when); `None` = always.
    acts_when: Option<Condition>,
}

impl Needs {
    /// Conditions under which anything depends on the value, including outputs that repeat it.
    fn all(&self) -> impl Iterator<Item = &Condition> {
        self.switch.iter().chain(&self.when)
    }
}

/// Conditions of all rows.
fn needs() -> &'static [Needs] {
    static NEEDS: OnceLock<&[Needs]> = OnceLock::new();
    NEEDS.get_or_init(|| {
        let (mut parameters, mut inputs) = (Parameters::default(), Inputs::default());
        let mut of = |row: &Variable| Needs {
            start: number(row, &mut parameters, &mut inputs),
            switch: row.switch.and_then(|name| Condition::read(&format!("{name} = true"))),
            when: row.when.and_then(Condition::read),
            acts_when: row.acts_when.and_then(Condition::read),
        };
        store_all(&table().rows.iter().map(&mut of).collect::<Vec<_>>())
    })
}

/// True if the value of row `index` has an effect in a scene of `parameters`.
pub fn has_effect(index: usize, parameters: &mut Parameters, situation: Situation) -> bool {
    needs()[index].all().all(|condition| condition.holds(parameters, situation))
}

/// True if the value of row `index` affects more than outputs that repeat it, in a scene of `parameters`.
pub fn acts(index: usize, parameters: &mut Parameters, situation: Situation) -> bool {
    let needed = &needs()[index].acts_when;
    has_effect(index, parameters, situation) && needed.as_ref().is_none_or(|c| c.holds(parameters, situation))
}

/// Returns a warning if `value` differs from the start value of row `index` and has no effect in a scene of
/// `parameters`.
pub fn value_without_effect(
    index: usize,
    value: f64,
    parameters: &mut Parameters,
    situation: Situation,
) -> Option<Problem> {
    let (row, needs) = (&table().rows[index], &needs()[index]);
    if needs.start.is_none_or(|start| start == value) || acts(index, parameters, situation) {
        return None;
    }
    let only_repeated = has_effect(index, parameters, situation);
    let mut missing = Missing::default();
    for condition in needs.all().chain(&needs.acts_when) {
        missing.add(condition.missing(parameters, situation));
    }
    let repeated = if only_repeated { ". Here, only outputs repeat it" } else { "" };
    Some(problem!(row.name, "{}{NO_EFFECT}{missing}{repeated}", written(row, value)))
}

/// Common text of the warnings about values without effect.
const NO_EFFECT: &str = " changes nothing in this scene. It acts ";

/// Maximum number of failed tests in two alternatives that are both named.
const MOST_TESTS: usize = 3;

/// Tests that a condition fails, with the present values.
#[derive(Default)]
struct Missing {
    /// Text of each failed test.
    tests: Vec<String>,
    /// True if the condition has alternatives to these tests.
    has_alternatives: bool,
}

impl Missing {
    fn add(&mut self, other: Self) {
        for test in other.tests {
            if !self.tests.contains(&test) {
                self.tests.push(test);
            }
        }
        self.has_alternatives |= other.has_alternatives;
    }
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = if self.has_alternatives { "for example if" } else { "only if" };
        write!(f, "{word} {}", self.tests.join(" and "))
    }
}

/// Returns a value as users write it, with its unit.
fn written(row: &Variable, value: f64) -> String {
    match row.access {
        Access::Enumeration(kind, ..) => {
            let choice = kind.choices.iter().find(|choice| f64::from(choice.value) == value);
            choice.map_or(String::new(), |choice| choice.name.to_owned())
        }
        Access::Boolean(_) => (value != 0.0).to_string(),
        _ => {
            let unit = row.unit.map_or("", |unit| if unit.name == "1" { "" } else { unit.name });
            format!("{value} {unit}").trim_end().to_owned()
        }
    }
}

/// Returns a value like [`written`], but in the display unit of `row`.
pub(super) fn written_as_shown(row: &Variable, value: f64) -> String {
    match (row.access, row.display) {
        (Access::Real(_) | Access::Input(_), Some(shown)) => {
            format!("{} {}", crate::model::six_digits(shown.show(value)), shown.name)
        }
        (Access::Real(_) | Access::Input(_), None) => written(row, crate::model::six_digits(value)),
        _ => written(row, value),
    }
}

/// Returns warnings about all initial values that have no effect in the scene.
pub fn values_without_effect(parameters: &Parameters, inputs: &Inputs, situation: Situation) -> Vec<Problem> {
    let (mut parameters, mut inputs) = (*parameters, *inputs);
    let mut of =
        |(i, row)| value_without_effect(i, number(row, &mut parameters, &mut inputs)?, &mut parameters, situation);
    table().rows.iter().enumerate().filter_map(&mut of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declaration::Causality;

    #[test]
    fn every_condition_can_be_parsed_and_depends_only_on_parameters() {
        fn check(condition: &Condition) {
            match condition {
                Condition::Any(parts) | Condition::All(parts) => parts.iter().for_each(check),
                Condition::OneOf(index, _) | Condition::NoneOf(index, _) | Condition::Above(index, _) => {
                    assert_eq!(table().rows[*index].causality, Causality::Parameter, "{}", table().rows[*index].name);
                }
                Condition::OwnSteps | Condition::FromStart => {}
            }
        }
        for (row, needs) in table().rows.iter().zip(needs()) {
            assert_eq!(row.switch.is_some(), needs.switch.is_some(), "{}", row.name);
            assert_eq!(row.when.is_some(), needs.when.is_some(), "{}: {:?}", row.name, row.when);
            assert_eq!(row.acts_when.is_some(), needs.acts_when.is_some(), "{}: {:?}", row.name, row.acts_when);
            needs.all().chain(&needs.acts_when).for_each(check);
        }
    }

    #[test]
    fn or_binds_less_than_and_and_brackets_bind_most() {
        let holds = |text: &str| Condition::read(text).unwrap().holds(&mut Parameters::default(), Situation::START);
        let (yes, no) = ("scene.start = equilibrium", "scene.start = rolling|rest");
        assert!(holds(yes) && !holds(no) && !holds("scene.start != rest|equilibrium"));
        assert!(holds(&format!("{yes} or {no} and {no}")));
        assert!(!holds(&format!("({yes} or {no}) and {no}")));
        assert!(holds("inertia.carrier > 0.019") && !holds("inertia.carrier > 0.02"));
        assert!(Condition::read("scene.start = standing").is_none());
        assert!(Condition::read("scene.begin = rest").is_none());
    }

    #[test]
    fn an_oil_temperature_that_only_outputs_repeat_is_named() {
        let mut p = Parameters::default();
        p.oil.temperature = 253.15;
        let said = |p: &Parameters, situation| -> Vec<String> {
            values_without_effect(p, &Inputs::default(), situation).iter().map(Problem::to_string).collect()
        };
        let found = said(&p, Situation::START);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(
            found[0].starts_with("oil.temperature: 253.15 K changes nothing in this scene. It acts for example if ")
                && found[0].ends_with(". Here, only outputs repeat it"),
            "{found:?}"
        );
        (p.effects.limited_slip, p.specs.limited_slip.preload) = (true, 50.0);
        assert_eq!(said(&p, Situation::START).len(), 1);
        p.specs.limited_slip.sliding.cold_factor = 1.2;
        assert!(said(&p, Situation::START).is_empty() && said(&p, Situation::RUNNING).is_empty());
        p.effects.warm_up = true;
        assert!(said(&p, Situation::START).is_empty());
        assert_eq!(said(&p, Situation::RUNNING).len(), 1, "the oil warms up, so its given temperature has no effect");
        p.specs.warm_up.sump_given = true;
        assert!(said(&p, Situation::RUNNING).is_empty());
    }

    #[test]
    fn start_values_warn_of_nothing_in_any_scene() {
        let mut p = Parameters::default();
        p.scene.gear_contact = crate::model::GearContact::Ideal;
        assert!(values_without_effect(&p, &Inputs::default(), Situation::START).is_empty());
        p.specs.limited_slip.preload = 70.0;
        let found = values_without_effect(&p, &Inputs::default(), Situation::START);
        assert_eq!(found.len(), 1);
        assert_eq!(
            found[0].to_string(),
            "limited_slip.preload: 70 N.m changes nothing in this scene. It acts only if effects.limited_slip = true (now: \
             false)"
        );
    }

    #[test]
    fn a_value_without_effect_names_the_nearest_missing_conditions_with_their_present_values() {
        let said = |name: &str, value: f64, change: fn(&mut Parameters)| {
            let mut p = Parameters::default();
            change(&mut p);
            let index = index_of(name).unwrap();
            value_without_effect(index, value, &mut p, Situation::START).unwrap().to_string()
        };
        assert_eq!(
            said("carrier.torque_command", 900.0, |_| ()),
            "carrier.torque_command: 900 N.m changes nothing in this scene. It acts only if scene.carrier_drive = torque \
             (now: speed)"
        );
        // the wheel brake is off, and both alternatives are missing
        assert_eq!(
            said("wheel_brake.reference_temperature", 250.0, |_| ()),
            "wheel_brake.reference_temperature: 250 K changes nothing in this scene. It acts only if effects.wheel_brake \
             = true (now: false) and either wheel_brake.cold_factor != 1 (now: 1) or wheel_brake.hot_factor != 1 (now: 1)"
        );
    }
}
