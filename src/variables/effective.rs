//! Conditions under which the value of a variable has an effect in a scene, as declared in its row
//! (`declaration::condition`). Warnings about values without effect follow from them. A tunable parameter counts with its
//! present value.

use std::fmt;
use std::sync::OnceLock;

use super::Variable;
use super::named::{index_of, named, number, value_of};
use super::table::table;
use super::written::written;
use crate::declaration::{Condition, Need, Test};
use crate::model::effects;
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

/// True if `condition` holds.
fn holds(condition: &Condition, parameters: &Parameters, situation: Situation) -> bool {
    let of = |part: &Condition| holds(part, parameters, situation);
    match condition {
        Condition::Any(parts) => parts.iter().any(of),
        Condition::All(parts) => parts.iter().all(of),
        Condition::Test(test) => (test.holds)(parameters).unwrap_or(false),
        Condition::Need(need) => needing(*need).any(of),
        Condition::OwnSteps => situation.own_steps,
        Condition::FromStart => situation.from_start,
    }
}

/// Adds the alternatives of `condition` to `found`: the condition itself, unless it consists of alternatives.
fn add_alternatives(condition: &Condition, found: &mut Vec<Condition>) {
    match condition {
        Condition::Any(parts) => parts.iter().for_each(|part| add_alternatives(part, found)),
        Condition::Need(need) => needing(*need).for_each(|part| add_alternatives(part, found)),
        _ => found.push(*condition),
    }
}

/// Returns the test that failed, with the present value.
fn failed(test: &Test, parameters: &Parameters) -> Missing {
    let name = test.name();
    let Some(row) = named(&name) else { return Missing::default() };
    let values: Vec<String> = (test.wanted)().into_iter().map(|value| written(row, value)).collect();
    let now = value_of(row, parameters, &Inputs::ZERO).map_or(String::new(), |now| written(row, now));
    Missing { tests: vec![format!("{name} {} {} (now: {now})", test.sign, values.join(" or "))], ..Missing::default() }
}

/// Returns the tests that `condition` fails. Two short alternatives are both named. Of others, the one with the fewest
/// failed tests is chosen.
fn missing(condition: &Condition, parameters: &Parameters, situation: Situation) -> Missing {
    if holds(condition, parameters, situation) {
        return Missing::default();
    }
    let of = |part: &Condition| missing(part, parameters, situation);
    let words = |text: &str| Missing { tests: vec![text.to_owned()], ..Missing::default() };
    match condition {
        Condition::Any(_) | Condition::Need(_) => {
            let mut parts = Vec::new();
            add_alternatives(condition, &mut parts);
            let all: Vec<Missing> = parts.iter().map(of).collect();
            if let [one, other] = &all[..]
                && one.tests.len() + other.tests.len() <= MOST_TESTS
                && !one.has_alternatives
                && !other.has_alternatives
            {
                let [one, other] = [one, other].map(|missing| missing.tests.join(" and "));
                return words(&format!("either {one} or {other}"));
            }
            let has_alternatives = all.len() > 1;
            let nearest = all.into_iter().min_by_key(|missing| missing.tests.len()).unwrap_or_default();
            Missing { has_alternatives: has_alternatives || nearest.has_alternatives, ..nearest }
        }
        Condition::All(parts) => {
            let mut all = Missing::default();
            parts.iter().for_each(|part| all.add(of(part)));
            all
        }
        Condition::Test(test) => failed(test, parameters),
        Condition::OwnSteps => words("the FMU integrates, as in co-simulation"),
        Condition::FromStart => words("it is set before the first step"),
    }
}

/// Conditions under which anything depends on the value of a row, including outputs that repeat it.
fn conditions(row: &Variable) -> impl Iterator<Item = &Condition> {
    row.switch.iter().chain(&row.when)
}

/// True if the value of row `index` has an effect in a scene of `parameters`.
pub fn has_effect(index: usize, parameters: &Parameters, situation: Situation) -> bool {
    conditions(&table().rows[index]).all(|condition| holds(condition, parameters, situation))
}

/// True if the value of row `index` affects more than outputs that repeat it, in a scene of `parameters`.
pub fn acts(index: usize, parameters: &Parameters, situation: Situation) -> bool {
    let acts_when = &table().rows[index].acts_when;
    has_effect(index, parameters, situation) && acts_when.as_ref().is_none_or(|c| holds(c, parameters, situation))
}

/// Start values of all rows; `None` for outputs.
fn starts() -> &'static [Option<f64>] {
    static STARTS: OnceLock<&[Option<f64>]> = OnceLock::new();
    STARTS.get_or_init(|| {
        let (mut parameters, mut inputs) = (Parameters::default(), Inputs::default());
        let starts: Vec<_> = table().rows.iter().map(|row| number(row, &mut parameters, &mut inputs)).collect();
        store_all(&starts)
    })
}

/// Conditions under which effects have `need`.
fn needing(need: Need) -> impl Iterator<Item = &'static Condition> {
    static NEEDS: OnceLock<&[(Need, Condition)]> = OnceLock::new();
    let needs = NEEDS.get_or_init(|| store_all(&effects::needs()));
    needs.iter().filter(move |(of, _)| *of == need).map(|(_, condition)| condition)
}

/// Returns a warning if `value` differs from the start value of row `index` and has no effect in a scene of
/// `parameters`.
pub fn value_without_effect(
    index: usize,
    value: f64,
    parameters: &Parameters,
    situation: Situation,
) -> Option<Problem> {
    let row = &table().rows[index];
    if starts()[index].is_none_or(|start| start == value) || acts(index, parameters, situation) {
        return None;
    }
    let only_repeated = has_effect(index, parameters, situation);
    let mut all = Missing::default();
    for condition in conditions(row).chain(&row.acts_when) {
        all.add(missing(condition, parameters, situation));
    }
    let repeated = if only_repeated { ". Here, only outputs repeat it" } else { "" };
    let here = |name: &&str| index_of(name).is_some_and(|index| acts(index, parameters, situation));
    let instead = row.instead.filter(here).map_or(String::new(), |name| format!(". Here, {name} acts instead"));
    Some(problem!(row.name, "{}{NO_EFFECT}{all}{repeated}{instead}", written(row, value)))
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

/// Returns warnings about all initial values that have no effect in the scene.
pub fn values_without_effect(parameters: &Parameters, inputs: &Inputs, situation: Situation) -> Vec<Problem> {
    let (mut numbers, mut inputs) = (*parameters, *inputs);
    let mut of = |(i, row)| value_without_effect(i, number(row, &mut numbers, &mut inputs)?, parameters, situation);
    table().rows.iter().enumerate().filter_map(&mut of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declaration::Causality;
    use crate::variables::Access;
    use crate::variables::assign;

    #[test]
    fn every_test_names_a_parameter_and_reads_its_value() {
        fn check(condition: &Condition) {
            match condition {
                Condition::Any(parts) | Condition::All(parts) => parts.iter().for_each(check),
                Condition::Need(need) => {
                    assert!(needing(*need).next().is_some(), "{need:?}");
                    needing(*need).for_each(check);
                }
                Condition::Test(test) => check_test(test),
                Condition::OwnSteps | Condition::FromStart => {}
            }
        }
        fn check_test(test: &Test) {
            let row = named(&test.name()).unwrap_or_else(|| panic!("{}", test.name()));
            assert_eq!(row.causality, Causality::Parameter, "{}", row.name);
            // the named parameter, and no other, decides
            let wanted = (test.wanted)();
            let values: Vec<f64> = match row.access {
                Access::Enumeration(kind, ..) => kind.choices.iter().map(|choice| f64::from(choice.value)).collect(),
                Access::Boolean(_) => vec![0.0, 1.0],
                _ => vec![row.range.unwrap().min, wanted[0], row.range.unwrap().max],
            };
            for value in values {
                let mut parameters = Parameters::default();
                assign(row, value, &mut parameters, &mut Inputs::default()).unwrap();
                let expected = match test.sign {
                    "=" => wanted.contains(&value),
                    "!=" => !wanted.contains(&value),
                    ">" => value > wanted[0],
                    sign => panic!("{sign}"),
                };
                assert_eq!((test.holds)(&parameters), Some(expected), "{} {value}", row.name);
            }
        }
        for row in table().rows {
            conditions(row).chain(&row.acts_when).for_each(check);
        }
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
            value_without_effect(index, value, &p, Situation::START).unwrap().to_string()
        };
        assert_eq!(
            said("carrier.torque_command", 900.0, |_| ()),
            "carrier.torque_command: 900 N.m changes nothing in this scene. It acts only if scene.carrier_drive = torque \
             (now: speed)"
        );
        // another command acts
        assert_eq!(
            said("carrier.torque_command", 900.0, |p| {
                (p.effects.final_drive, p.scene.carrier_drive) = (true, crate::model::CarrierDrive::Torque);
            }),
            "carrier.torque_command: 900 N.m changes nothing in this scene. It acts only if effects.final_drive = false \
             (now: true). Here, pinion.torque_command acts instead"
        );
        // the wheel brake is off, and both alternatives are missing
        assert_eq!(
            said("wheel_brake.reference_temperature", 250.0, |_| ()),
            "wheel_brake.reference_temperature: 250 K changes nothing in this scene. It acts only if effects.wheel_brake \
             = true (now: false) and either wheel_brake.cold_factor != 1 (now: 1) or wheel_brake.hot_factor != 1 (now: 1)"
        );
    }
}
