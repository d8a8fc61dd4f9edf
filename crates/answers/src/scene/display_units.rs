//! Units that a scene or its user prefers. Each replaces the usual display unit of all variables of its dimension.

use bevel_differential::variables::Variable;
use bevel_differential::variables::units::{ALL, DisplayUnit, Unit};

use super::units::{others, spelled};

/// Preferred display units, at most one for each SI unit.
#[derive(Clone, Debug, Default)]
pub struct DisplayUnits(Vec<(Unit, Option<DisplayUnit>)>);

impl DisplayUnits {
    /// Finds the units `names`, such as "rpm" and "kN". Fails with all wrong names.
    pub fn of<T: AsRef<str>>(names: &[T]) -> Result<Self, Vec<String>> {
        let (mut found, mut problems) = (Self::default(), Vec::new());
        for name in names.iter().map(AsRef::as_ref) {
            match known(name) {
                Ok(unit) => match found.0.iter().find(|other| other.0 == unit.0) {
                    Some(other) if other.1 == unit.1 => {}
                    Some(&other) => problems.push(format!(
                        "{} and {} are units of the same quantity; name one of them",
                        label(other),
                        label(unit)
                    )),
                    None => found.0.push(unit),
                },
                Err(problem) => problems.push(problem),
            }
        }
        if problems.is_empty() { Ok(found) } else { Err(problems) }
    }

    /// Adds `preferred` units, which replace those of the same dimension.
    pub fn prefer(&mut self, preferred: Self) {
        self.0.retain(|(unit, _)| preferred.0.iter().all(|(other, _)| other != unit));
        self.0.extend(preferred.0);
    }

    /// True if all variables are shown in their usual units.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Names of the units.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.0.iter().map(|&unit| label(unit))
    }

    /// Names of the SI units, each with the name of the preferred unit.
    pub fn by_si_unit(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        self.0.iter().map(|&unit| (unit.0.name, label(unit)))
    }

    /// Preferred unit of `row`, if there is one. Differences are never shown in a unit with an offset: 5 K, not 5 degC.
    fn preferred(&self, row: &Variable) -> Option<(Unit, Option<DisplayUnit>)> {
        let unit = row.unit?;
        let is_offset = |shown: Option<DisplayUnit>| shown.is_some_and(|shown| shown.offset != 0.0);
        let found =
            self.0.iter().find(|(known, shown)| known.name == unit.name && !(unit.is_relative && is_offset(*shown)));
        found.copied()
    }

    /// Returns the variable `row` with its preferred display unit.
    pub fn row(&self, row: &Variable) -> Variable {
        Variable { display: self.preferred(row).map_or(row.display, |(_, shown)| shown), ..*row }
    }

    /// Returns the variable `row` with its unit in files: SI, unless another unit is preferred.
    pub fn row_in_files(&self, row: &Variable) -> Variable {
        Variable { display: self.preferred(row).and_then(|(_, shown)| shown), ..*row }
    }
}

/// Name of a unit.
fn label((unit, shown): (Unit, Option<DisplayUnit>)) -> &'static str {
    shown.map_or(unit.name, |shown| shown.name)
}

/// Finds the SI unit of `name`, and the display unit if `name` is one.
fn known(name: &str) -> Result<(Unit, Option<DisplayUnit>), String> {
    let all = || {
        let units = ALL.iter().filter(|unit| unit.name != "1");
        units.flat_map(|&unit| {
            std::iter::once((unit, None)).chain(others(unit.name).map(move |&shown| (unit, Some(shown))))
        })
    };
    let spelled = spelled(name);
    all().find(|&unit| label(unit) == spelled).ok_or_else(|| {
        let hint = near(&spelled, all().map(label)).map(|near| format!("; did you mean {near}?"));
        let hint = hint.unwrap_or_else(|| format!("; known: {}", all().map(label).collect::<Vec<_>>().join(", ")));
        format!("there is no unit \"{name}\"{hint}")
    })
}

/// Returns the unit most similar to `name`, ignoring case, if more than half of the letters agree: kW is no misspelt kg.
/// Two swapped letters count as one error.
fn near<'a>(name: &str, units: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = name.to_lowercase();
    let nearest =
        units.map(|unit| (strsim::osa_distance(&wanted, &unit.to_lowercase()), unit)).min_by_key(|found| found.0);
    nearest.filter(|(edits, _)| 2 * edits < wanted.chars().count()).map(|(_, unit)| unit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::units::text;
    use bevel_differential::variables::named;

    fn shown(units: &[&str], name: &str, value: f64) -> String {
        text(&DisplayUnits::of(units).expect("known units").row(named(name).expect("a row")), value)
    }

    #[test]
    fn a_unit_applies_to_all_variables_of_its_dimension() {
        let speed = std::f64::consts::TAU;
        assert_eq!(shown(&[], "left.speed", speed), "360 deg/s");
        assert_eq!(shown(&["rpm"], "left.speed", speed), "60 rpm");
        assert_eq!(shown(&["1/min", "kN·m"], "planet[1].spin_speed", speed), "60 rpm");
        assert_eq!(shown(&["rad/s"], "left.speed", speed), "6.28319 rad/s");
        assert_eq!(shown(&["rpm", "kN.m"], "left.load_torque", 835.0), "0.835 kN.m");
        assert_eq!(shown(&["rpm"], "left.load_torque", 835.0), "835 N.m");
    }

    #[test]
    fn differences_of_temperatures_keep_a_unit_without_offset() {
        assert_eq!(shown(&["K"], "temperature.oil", 353.15), "353.15 K");
        assert_eq!(shown(&["degC"], "oil.temperature", 353.15), "80 degC");
        for units in [&["degC"][..], &["K"], &[]] {
            assert_eq!(shown(units, "warm_up.gears_above_oil", 5.0), "5 K");
        }
    }

    #[test]
    fn later_preferences_win_and_wrong_ones_are_reported_together() {
        let mut units = DisplayUnits::of(&["rpm", "kN"]).expect("known units");
        units.prefer(DisplayUnits::of(&["°/s"]).expect("a known unit"));
        assert_eq!(units.names().collect::<Vec<_>>(), ["kN", "deg/s"]);
        assert!(DisplayUnits::of(&["rpm", "rpm"]).is_ok());
        let problems = DisplayUnits::of(&["rmp", "kN", "N", "smoot"]).expect_err("wrong units");
        assert_eq!(problems[0], "there is no unit \"rmp\"; did you mean rpm?");
        assert_eq!(
            DisplayUnits::of(&["KNm"]).expect_err("a wrong unit"),
            ["there is no unit \"KNm\"; did you mean kN.m?"]
        );
        // half of two letters is no similarity
        for other in ["kZ", "Qg", "xN"] {
            let problem = &DisplayUnits::of(&[other]).expect_err("a wrong unit")[0];
            assert!(!problem.contains("did you mean"), "{problem}");
        }
        assert_eq!(problems[1], "kN and N are units of the same quantity; name one of them");
        assert!(problems[2].contains("known: m, mm, um, in, km, rad, deg, rad/s, deg/s, rpm"), "{}", problems[2]);
    }
}
