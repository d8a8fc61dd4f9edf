//! Start values that have an effect in a scene although they were not set. These are the values of the study.

use serde::{Deserialize, Serialize};

use super::effective::{Situation, acts};
use super::named::{index_of, number};
use super::table::table;
use super::written::written_as_shown;
use super::{Access, Causality, Variable};
use crate::model::{Inputs, Parameters, turned_backward};
use crate::problem::Problem;

/// Number of bits in a word of [`SetValues`].
const BITS: usize = u64::BITS as usize;
/// Number of words in [`SetValues`]; it has far more bits than there are parameters and inputs.
const WORDS: usize = 16;

/// Set of the variables that were set, one bit for each row of the table. It includes a variable that is set to its
/// start value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetValues([u64; WORDS]);

impl SetValues {
    /// Adds the variable of row `index`.
    #[inline]
    pub fn insert(&mut self, index: usize) {
        if let Some(word) = self.0.get_mut(index / BITS) {
            *word |= 1 << (index % BITS);
        }
    }

    /// True if the variable of row `index` was set.
    #[inline]
    pub fn contains(&self, index: usize) -> bool {
        self.0.get(index / BITS).is_some_and(|word| word & (1 << (index % BITS)) != 0)
    }

    /// True if the variable `name` was set.
    fn contains_named(&self, name: &str) -> bool {
        index_of(name).is_some_and(|index| self.contains(index))
    }

    /// True if a value that describes the differential was set, so that it is not the differential of the study.
    pub fn describes_another_differential(&self) -> bool {
        let rows = table().rows.iter().enumerate();
        rows.filter(|(_, row)| DIFFERENTIAL.contains(&group(row))).any(|(index, _)| self.contains(index))
    }
}

/// Group of the inputs.
const DRIVES: &str = "drives and loads";
/// Group of the lock, which its command activates.
const LOCK: &str = "lock";
/// Groups that describe the differential itself.
const DIFFERENTIAL: [&str; 3] = ["geometry", "material", "inertia"];
/// Groups that determine how a scene is computed. Their values select methods and do not describe a differential.
const METHODS: [&str; 5] = ["scene", "effects", "solver", "solid", "coupling"];
/// Endings of the names of factors. A factor of 1 has no effect.
const FACTORS: [&str; 3] = ["_factor", "_ratio", ".beyond_limit"];

/// Returns the group of a variable: the first part of its name, or the common group of all inputs.
fn group(row: &Variable) -> &'static str {
    if row.causality == Causality::Input { DRIVES } else { row.name.split('.').next().unwrap_or(row.name) }
}

/// True if `value` of `row` has no effect: a number of 0, or a factor of 1.
fn has_no_effect(row: &Variable, value: f64) -> bool {
    let is_number = matches!(row.access, Access::Real(_) | Access::Integer(_) | Access::Input(_));
    is_number && (value == 0.0 || value == 1.0 && FACTORS.iter().any(|ending| row.name.ends_with(ending)))
}

/// Values of a group that have an effect but were not set.
#[derive(Clone, Debug, PartialEq)]
pub struct Unset {
    /// Name of the group: an effect, or "geometry", "material", …
    pub group: &'static str,
    /// Names and values, as users write them.
    pub values: Vec<String>,
}

/// Returns start values, by group, that have an effect in a scene of `parameters` and `inputs` and are not in `set`.
pub fn unset(parameters: &Parameters, inputs: &Inputs, set: &SetValues) -> Vec<Unset> {
    unset_as_shown(parameters, inputs, set, |row| *row)
}

/// Returns the values like [`unset`], each in the display unit that `shown` gives to its variable.
pub fn unset_as_shown(
    parameters: &Parameters,
    inputs: &Inputs,
    set: &SetValues,
    shown: impl Fn(&Variable) -> Variable,
) -> Vec<Unset> {
    let (mut parameters, mut inputs) = (*parameters, *inputs);
    let is_commanded = inputs.lock > 0.0 || set.contains_named("lock.command");
    let mut found: Vec<Unset> = Vec::new();
    for (index, row) in table().rows.iter().enumerate() {
        let group = group(row);
        if set.contains(index)
            || matches!(row.access, Access::Output(_) | Access::Boolean(_))
            || METHODS.contains(&group)
            || row.range.is_some_and(|range| range.only_value().is_some())
            || group == LOCK && !is_commanded
        {
            continue;
        }
        let Some(value) = number(row, &mut parameters, &mut inputs) else { continue };
        if has_no_effect(row, value) || !acts(index, &parameters, Situation::START) {
            continue;
        }
        let name = if group == DRIVES { row.name } else { row.name.split_once('.').map_or(row.name, |(_, rest)| rest) };
        let text = format!("{name} = {}", written_as_shown(&shown(row), value));
        match found.iter_mut().find(|known| known.group == group) {
            Some(known) => known.values.push(text),
            None => found.push(Unset { group, values: vec![text] }),
        }
    }
    found
}

/// Returns the groups in one line; empty if there are none.
pub fn in_one_line(found: &[Unset]) -> String {
    if found.is_empty() {
        return String::new();
    }
    let groups: Vec<String> = found.iter().map(|one| format!("{}: {}", one.group, one.values.join(", "))).collect();
    format!("{NOBODY_SET}{}", groups.join("; "))
}

/// Start of the line that lists these values.
pub const NOBODY_SET: &str = "these start values of the study influence this scene, and nobody set them (set them if \
     your differential differs): ";

/// Returns a warning if load torques that were not set would turn the wheels backward from rest.
pub fn runaway(parameters: &Parameters, inputs: &Inputs, set: &SetValues) -> Option<Problem> {
    let is_set = ["left.load_torque", "right.load_torque"].map(|name| set.contains_named(name));
    turned_backward(parameters, inputs, is_set)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{CarrierDrive, GearContact};

    fn set_of(names: &[&str]) -> SetValues {
        let mut set = SetValues::default();
        names.iter().for_each(|name| set.insert(index_of(name).unwrap()));
        set
    }

    #[test]
    fn every_variable_that_can_be_set_has_a_bit() {
        let last = table().rows.iter().rposition(|row| !matches!(row.access, Access::Output(_))).unwrap();
        assert!(last < WORDS * BITS);
        let set = set_of(&[table().rows[last].name]);
        assert!(set.contains(last) && !set.contains(last - 1) && !set.contains(usize::MAX));
    }

    #[test]
    fn the_list_names_values_with_an_effect_and_none_that_was_set() {
        let mut p = Parameters::default();
        p.scene.gear_contact = GearContact::Ideal;
        let found = unset(&p, &Inputs::default(), &set_of(&["geometry.module", "left.load_torque"]));
        let line = in_one_line(&found);
        assert!(line.starts_with(NOBODY_SET) && !line.contains('\n'), "{line}");
        for acts in [
            "side_teeth = 16",
            "carrier.speed_command = 2861 deg/s",
            "right.load_torque = 835 N.m",
            "inertia: carrier = 0.02",
        ] {
            assert!(line.contains(acts), "{acts}: {line}");
        }
        for silent in [
            "module",
            "left.load_torque",
            "young_modulus",
            "torque_command",
            "shaft_angle",
            "limited_slip",
            "solver",
            "lock",
        ] {
            assert!(!line.contains(silent), "{silent}: {line}");
        }
    }

    #[test]
    fn active_effects_list_their_constants_and_a_lock_does_so_when_commanded() {
        let mut p = Parameters::default();
        p.effects.half_shaft = true;
        (p.effects.limited_slip, p.specs.limited_slip.preload) = (true, 50.0);
        let all = |p: &Parameters, inputs: &Inputs, set: &[&str]| unset(p, inputs, &set_of(set));
        let of = |found: &[Unset], group: &str| {
            found.iter().find(|one| one.group == group).map_or(String::new(), |one| one.values.join(", "))
        };
        let found = all(&p, &Inputs::default(), &["limited_slip.preload", "half_shaft.left_stiffness"]);
        assert!(of(&found, "limited_slip").starts_with("stiffness = 100000 N.m/rad"), "{found:?}");
        assert!(!of(&found, "limited_slip").contains("torque_coefficient"));
        assert!(of(&found, "half_shaft").contains("right_stiffness = 10000 N.m/rad"));
        assert!(!of(&found, "half_shaft").contains("left_stiffness"));
        assert_eq!(of(&found, "lock"), "");
        let commanded = Inputs { lock: 1.0, ..Inputs::default() };
        assert!(of(&all(&p, &commanded, &[]), "lock").contains("torque = 5000 N.m"));
        assert!(of(&all(&p, &Inputs::default(), &["lock.command"]), "lock").contains("torque = 5000 N.m"));
        let every: Vec<&str> = table().rows.iter().map(|row| row.name).collect();
        assert!(all(&p, &commanded, &every).is_empty());
    }

    #[test]
    fn values_of_gears_material_or_inertia_describe_another_differential() {
        for (name, describes) in [
            ("geometry.module", true),
            ("material.density", true),
            ("inertia.carrier", true),
            ("left.load_torque", false),
        ] {
            assert_eq!(set_of(&[name]).describes_another_differential(), describes, "{name}");
        }
    }

    #[test]
    fn loads_that_were_not_set_cause_a_warning_if_they_turn_the_wheels_backward() {
        let mut p = Parameters::default();
        p.scene.carrier_drive = CarrierDrive::Torque;
        let warned = |torque: f64, set: &[&str]| {
            let inputs = Inputs { carrier_torque: torque, ..Inputs::default() };
            runaway(&p, &inputs, &set_of(set)).map(|problem| problem.to_string())
        };
        // both loads are 835 N·m
        let said = warned(300.0, &[]).unwrap();
        assert!(
            said.starts_with("left.load_torque: ") && said.contains("835 N.m") && said.contains("300 N.m"),
            "{said}"
        );
        assert!(warned(1669.0, &[]).is_some() && warned(0.0, &[]).is_some() && warned(-300.0, &[]).is_some());
        assert!(warned(1670.0, &[]).is_none() && warned(1671.0, &[]).is_none());
        assert!(warned(300.0, &["left.load_torque"]).unwrap().starts_with("right.load_torque: "));
        assert!(warned(300.0, &["left.load_torque", "right.load_torque"]).is_none());
    }
}
