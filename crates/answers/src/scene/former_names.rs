//! Former names of variables. Scenes, command lines and the Python package still accept them, with a message that gives
//! the present names. The FMU itself accepts only present names.

use bevel_differential::variables::{Variable, table};

/// Former prefixes of names, with the present ones.
const BEGINNINGS: [[&str; 2]; 2] = [["planet.spin_", "spin."], ["planet[1].left_pair[", "mesh.pair["]];

/// All former names, with their variables.
pub fn all() -> impl Iterator<Item = (String, &'static Variable)> {
    table().rows.iter().filter_map(|row| Some((of(row.name)?, row)))
}

/// The former name of the variable `name`.
pub fn of(name: &str) -> Option<String> {
    BEGINNINGS.iter().find_map(|[once, now]| Some(format!("{once}{}", name.strip_prefix(now)?)))
}

/// Present name of the variable with the present or former name `name`. Other names are returned unchanged.
pub fn present(name: &str) -> &str {
    let renamed = BEGINNINGS.iter().find_map(|[once, now]| {
        let rest = name.strip_prefix(once)?;
        table().rows.iter().find(|row| row.name.strip_prefix(now) == Some(rest))
    });
    renamed.map_or(name, |row| row.name)
}

/// Messages about the former names among `names`.
pub fn notes<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    names.into_iter().filter(|name| present(name) != *name).map(note).collect()
}

/// Message about the former name `name`.
pub fn note(name: &str) -> String {
    format!("{name} is now named {}; write the new name", present(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn former_names_find_their_variables_and_other_names_are_unchanged() {
        let wanted = [
            ("planet.spin_command", "spin.command"),
            ("planet.spin_torque", "spin.torque"),
            ("planet[1].left_pair[1].tooth", "mesh.pair[1].tooth"),
            ("planet[1].left_pair[3].heel_pressure", "mesh.pair[3].heel_pressure"),
        ];
        for (once, now) in wanted {
            assert_eq!(present(once), now);
            assert!(all().any(|(former, row)| former == once && row.name == now), "{once}");
        }
        assert_eq!(all().count(), 2 + 3 * 6);
        for name in ["planet[1].left_pairs", "planet[1].left_pair[4].tooth", "planet.spin_speed", "spin.command"] {
            assert_eq!(present(name), name);
        }
        assert_eq!(notes(["left.speed", "planet.spin_torque"]), [note("planet.spin_torque")]);
    }
}
