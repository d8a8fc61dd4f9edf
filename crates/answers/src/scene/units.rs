//! Numbers with units in the notation of users: "2861 deg/s", "4.5 mm".

use std::f64::consts::PI;

use bevel_differential::variables::Variable;
use bevel_differential::variables::units::{ALL, DisplayUnit};

use crate::text::numbers;

const fn unit(name: &'static str, per_si: f64) -> DisplayUnit {
    DisplayUnit { name, factor: per_si, offset: 0.0 }
}

/// Units in which users may write values, in addition to the display units of the FMU, by SI unit.
const WRITTEN: [(&str, &[DisplayUnit]); 8] = [
    ("s", &[unit("ms", 1e3), unit("us", 1e6), unit("min", 1.0 / 60.0), unit("h", 1.0 / 3600.0)]),
    ("m", &[unit("in", 1.0 / 0.0254), unit("km", 1e-3)]),
    ("m/s", &[unit("mph", 1.0 / 0.447_04)]),
    ("Pa", &[unit("psi", 1.0 / 6_894.757_293_168_361)]),
    ("W", &[unit("kW", 1e-3)]),
    ("N.m", &[unit("lb.ft", 1.0 / 1.355_817_948_331_400_4)]),
    ("N.m/rad", &[unit("N.m/deg", PI / 180.0)]),
    ("K", &[DisplayUnit { name: "degF", factor: 1.8, offset: -459.67 }]),
];

/// Other spellings of units, with those of the FMU and of [`WRITTEN`]. They are replaced in this order.
const SPELLINGS: [(&str, &str); 13] = [
    ("·", "."),
    ("*", "."),
    ("°", "deg"),
    ("µ", "u"),
    ("μ", "u"),
    ("²", "2"),
    ("Nm", "N.m"),
    ("1/min", "rpm"),
    ("RPM", "rpm"),
    ("lbf", "lb"),
    ("ft-lb", "lb.ft"),
    ("ft.lb", "lb.ft"),
    ("lb-ft", "lb.ft"),
];

/// Parses `text` into SI: a number with a unit of the SI unit `si`, or a bare number if the quantity has no unit.
/// Differences (`is_relative`) are converted without the offset of their unit.
pub fn parse(text: &str, si: Option<&str>, is_relative: bool) -> Result<f64, String> {
    let Some(si) = si else { return Err("takes a number without a unit".into()) };
    let (number, name) = split(text)?;
    let plain = matches!(si, "1" | "");
    if name.is_empty() {
        return if plain { Ok(number) } else { Err(format!("\"{text}\" has no unit: write one of {}", names(si))) };
    }
    if name == si {
        return Ok(number);
    }
    match others(si).find(|shown| shown.name == name) {
        Some(shown) if is_relative => Ok(DisplayUnit { offset: 0.0, ..*shown }.read(number)),
        Some(shown) => Ok(shown.read(number)),
        None if plain => Err(format!("takes a number without a unit; \"{text}\" has the unit {name}")),
        None => Err(format!("unit {name} of \"{text}\" does not fit; units that do: {}", names(si))),
    }
}

/// Parses `text` into a time [s]: a bare number of seconds, or a number with a unit of time.
pub fn seconds(text: &str) -> Result<f64, String> {
    let (number, name) = split(text)?;
    if name.is_empty() { Ok(number) } else { parse(text, Some("s"), false) }
}

/// Parses `text` into a number without a unit.
pub fn number(text: &str) -> Result<f64, String> {
    parse(text, Some("1"), false)
}

/// Checks that values of `row` may be given in the unit `name`.
pub fn check(row: &Variable, name: &str) -> Result<(), String> {
    let si = row.unit.map(|unit| unit.name);
    parse(&format!("1 {name}"), si, false).map(drop).map_err(|_| match si {
        Some(si) if si != "1" => format!("unit {name} does not fit; units that do: {}", names(si)),
        _ => format!("unit {name} does not fit; write the number without a unit"),
    })
}

/// Units of values in the SI unit `si`, except for `si` itself.
pub fn others(si: &str) -> impl Iterator<Item = &'static DisplayUnit> {
    let shown = ALL.iter().filter(move |unit| unit.name == si).flat_map(|unit| unit.display);
    shown.chain(WRITTEN.iter().filter(move |(known, _)| *known == si).flat_map(|(_, units)| *units))
}

/// Names of the units of values in the SI unit `si`.
pub fn names(si: &str) -> String {
    std::iter::once(si).chain(others(si).map(|unit| unit.name)).collect::<Vec<_>>().join(", ")
}

/// Splits `text` into its number and the name of its unit, in the spelling of the FMU.
pub fn split(text: &str) -> Result<(f64, String), String> {
    let text = text.trim();
    // the number is the longest prefix that parses as one: "5e3" in "5e3 m", "5" in "5 m"
    let ends = (1..=text.len()).rev().filter(|&end| text.is_char_boundary(end));
    let found = ends.filter_map(|end| Some((text[..end].trim_end().parse::<f64>().ok()?, end))).next();
    let Some((number, end)) = found else { return Err(format!("\"{text}\" does not begin with a number")) };
    if !number.is_finite() {
        return Err(format!("\"{text}\" is not a finite number"));
    }
    let rest = &text[end..];
    if let Some(part) = rest.strip_prefix(',').filter(|part| part.starts_with(|letter: char| letter.is_ascii_digit())) {
        let [without, with_point] = ["", "."].map(|mark| text.replacen(',', mark, 1));
        let digits = part.bytes().take_while(u8::is_ascii_digit).count();
        return Err(if digits == 3 {
            format!(
                "\"{text}\": is the comma a decimal comma, or does it separate thousands? Write {with_point} or {without}"
            )
        } else {
            format!("\"{text}\" has a decimal comma: write {with_point}")
        });
    }
    Ok((number, spelled(rest.trim())))
}

/// Name of a unit in the spelling of the FMU.
pub fn spelled(name: &str) -> String {
    SPELLINGS.iter().fold(name.to_owned(), |name, (from, to)| name.replace(from, to))
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

    /// Value of `row` for a text.
    fn parse(row: &Variable, text: &str) -> Result<f64, String> {
        super::parse(text, row.unit.map(|unit| unit.name), row.unit.is_some_and(|unit| unit.is_relative))
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
        close("left.load_torque", "10 lb.ft", 13.558_179_483_314_004);
        close("left.load_torque", "10 ft·lbf", 13.558_179_483_314_004);
        close("half_shaft.left_stiffness", "2 N·m/°", 360.0 / std::f64::consts::PI);
        close("geometry.module", "0.5 in", 0.0127);
        close("carrier.speed_command", "60 RPM", std::f64::consts::TAU);
        close("material.young_modulus", "3e7 psi", 206_842_718_795.050_83);
        close("solver.fixed_step", "0.1 ms", 1e-4);
        close("oil.temperature", "176 °F", 353.15);
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
                assert_eq!(parse(row(name), &format!("{} degF", 1.8 * value)), Ok(value), "{name}");
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
        assert!(wrong("geometry.module", "4.5 kg").ends_with("units that do: m, mm, um, in, km"));
        assert!(wrong("geometry.module", "4.5").contains("has no unit"));
        assert!(wrong("geometry.module", "large").contains("does not begin with a number"));
        assert!(wrong("solver.relative_tolerance", "1 mm").contains("without a unit"));
        assert!(wrong("geometry.module", "17,5 mm").ends_with("write 17.5 mm"));
        assert!(seconds("3 m").is_err() && seconds("inf").is_err());
    }
}
