//! Numbers with units in the notation of users: "2861 deg/s", "4.5 mm".

use bevel_differential::variables::Variable;
use bevel_differential::variables::units::Unit;

use crate::text::numbers;

/// Units of time, and their number per second.
const TIMES: [(&str, f64); 5] = [("s", 1.0), ("ms", 1e3), ("us", 1e6), ("min", 1.0 / 60.0), ("h", 1.0 / 3600.0)];

/// Parses `text` into SI: a number with one of the units of `row`, or a bare number if the quantity has no unit.
pub fn parse(row: &Variable, text: &str) -> Result<f64, String> {
    let Some(unit) = row.unit else { return Err("takes a number without a unit".into()) };
    let (number, name) = split(text)?;
    let plain = unit.name == "1";
    if name.is_empty() {
        let wanted = names(&unit).join(", ");
        return if plain { Ok(number) } else { Err(format!("\"{text}\" has no unit: write one of {wanted}")) };
    }
    if name == unit.name {
        return Ok(number);
    }
    match unit.display.iter().find(|shown| shown.name == name) {
        Some(shown) => Ok(shown.read(number)),
        None if plain => Err(format!("takes a number without a unit; \"{text}\" has the unit {name}")),
        None => Err(format!("unit {name} of \"{text}\" does not fit; units that do: {}", names(&unit).join(", "))),
    }
}

/// Parses `text` into a time [s]: a bare number of seconds, or a number with a unit of time.
pub fn seconds(text: &str) -> Result<f64, String> {
    let (number, name) = split(text)?;
    let unit = if name.is_empty() { "s" } else { name.as_str() };
    match TIMES.iter().find(|(known, _)| *known == unit) {
        Some((_, per_second)) => Ok(number / per_second),
        None => Err(format!("unit {name} of \"{text}\" is not a unit of time; known: {}", times().join(", "))),
    }
}

/// Checks that values of `row` may be given in the unit `name`.
pub fn check(row: &Variable, name: &str) -> Result<(), String> {
    parse(row, &format!("1 {name}")).map(drop).map_err(|_| match row.unit {
        Some(unit) if unit.name != "1" => {
            format!("unit {name} does not fit; units that do: {}", names(&unit).join(", "))
        }
        _ => format!("unit {name} does not fit; write the number without a unit"),
    })
}

/// Names of the units of time.
pub fn times() -> [&'static str; TIMES.len()] {
    TIMES.map(|(name, _)| name)
}

/// Names of the FMU's unit and of its display units, in this order.
fn names(unit: &Unit) -> Vec<&'static str> {
    std::iter::once(unit.name).chain(unit.display.iter().map(|shown| shown.name)).collect()
}

/// Splits `text` into its number and the name of its unit, in the spelling of the FMU.
fn split(text: &str) -> Result<(f64, String), String> {
    let text = text.trim();
    // the number is the longest prefix that parses as one: "5e3" in "5e3 m", "5" in "5 m"
    let ends = (1..=text.len()).rev().filter(|&end| text.is_char_boundary(end));
    let found = ends.filter_map(|end| Some((text[..end].trim_end().parse::<f64>().ok()?, end))).next();
    let Some((number, end)) = found else { return Err(format!("\"{text}\" does not begin with a number")) };
    Ok((number, spelled(text[end..].trim())))
}

/// Name of a unit in the spelling of the FMU.
pub fn spelled(name: &str) -> String {
    let replaced =
        [("·", "."), ("*", "."), ("°", "deg"), ("µ", "u"), ("μ", "u"), ("²", "2"), ("Nm", "N.m"), ("1/min", "rpm")];
    replaced.iter().fold(name.to_owned(), |name, (from, to)| name.replace(from, to))
}

/// Name of the display unit of `row`; empty for numbers without a unit.
pub fn name(row: &Variable) -> &'static str {
    match (row.display, row.unit) {
        (Some(shown), _) => shown.name,
        (None, Some(unit)) if unit.name != "1" => unit.name,
        _ => "",
    }
}

/// Name and unit of a column of `row`: `left.speed [rpm]`, as in tables of inputs.
pub fn header(row: &Variable) -> String {
    match name(row) {
        "" => row.name.to_owned(),
        unit => format!("{} [{unit}]", row.name),
    }
}

/// Converts the SI `value` to the display unit of `row`.
pub fn shown(row: &Variable, value: f64) -> f64 {
    row.display.map_or(value, |display| display.show(value))
}

/// Formats the SI `value` in the display unit of `row`, with the name of the unit.
pub fn text(row: &Variable, value: f64) -> String {
    format!("{} {}", six_digits(shown(row, value)), name(row)).trim_end().to_owned()
}

/// Formats the SI difference `value` between two values of `row`, with the name of the unit.
pub fn difference_text(row: &Variable, value: f64) -> String {
    text(&row.of_differences(), value)
}

/// Formats a number with six significant digits.
pub fn six_digits(value: f64) -> String {
    numbers::short(value, 6)
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevel_differential::variables::named;

    fn row(name: &str) -> &'static Variable {
        named(name).expect("a row")
    }

    #[test]
    fn units_are_converted_to_si() {
        let close = |name: &str, text: &str, wanted: f64| {
            let value = parse(row(name), text).expect(text);
            assert!((value / wanted - 1.0).abs() < 1e-14, "{text}: {value}");
        };
        close("geometry.module", "4.5 mm", 4.5e-3);
        close("geometry.module", "4.5e-3m", 4.5e-3);
        close("carrier.speed_command", "2861 °/s", 2861f64.to_radians());
        close("carrier.speed_command", "60 rpm", std::f64::consts::TAU);
        close("carrier.speed_command", "60 1/min", std::f64::consts::TAU);
        close("left.load_torque", "0.8 kN·m", 800.0);
        close("left.load_torque", "835 N·m", 835.0);
        close("inertia.carrier", "0.02 kg·m²", 0.02);
        close("contact.stiffness", "5.77e5 N/mm^1.5", 5.77e5 * 1e3f64.powf(1.5));
        close("solver.relative_tolerance", "1e-6", 1e-6);
        close("oil.temperature", "80 degC", 353.15);
        close("oil.temperature", "80 °C", 353.15);
        assert_eq!(seconds("2 ms"), Ok(2e-3));
        assert_eq!(seconds("0.5"), Ok(0.5));
    }

    #[test]
    fn temperature_differences_have_no_offset_in_either_direction() {
        let differences = [
            "warm_up.gears_above_oil",
            "warm_up.clutch_above_oil",
            "warm_up.washers_above_oil",
            "warm_up.case_above_oil",
            "warm_up.ambient_change",
            "warm_up.sump_change",
        ];
        for name in differences {
            for value in [20.0, -20.0] {
                assert_eq!(parse(row(name), &format!("{value} degC")), Ok(value), "{name}");
                assert_eq!(parse(row(name), &format!("{value} K")), Ok(value), "{name}");
                assert_eq!(text(row(name), value), format!("{value} K"), "{name}");
            }
        }
        assert_eq!(text(row("temperature.flash"), 36.5), "36.5 K");
        assert_eq!(text(row("temperature.oil"), 353.15), "80 degC");
        assert_eq!(difference_text(row("temperature.oil"), 5.0), "5 K");
        assert_eq!(difference_text(row("geometry.module"), 4.5e-3), "4.5 mm");
    }

    #[test]
    fn wrong_units_are_reported_with_those_that_fit() {
        let wrong = |name: &str, text: &str| parse(row(name), text).expect_err(text);
        assert!(wrong("geometry.module", "4.5 kg").ends_with("units that do: m, mm, um"));
        assert!(wrong("geometry.module", "4.5").contains("has no unit"));
        assert!(wrong("geometry.module", "large").contains("does not begin with a number"));
        assert!(wrong("solver.relative_tolerance", "1 mm").contains("without a unit"));
        assert!(seconds("3 m").is_err());
    }
}
