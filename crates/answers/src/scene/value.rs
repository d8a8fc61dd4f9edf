//! Reader of values: a number, a text with a unit, true or false, or the literal of an enumeration.
//!
//! Scene files, command lines and the Python package all read values here. Whole numbers may be written as 12.0.

use toml::Value;

use super::units;
use crate::text::near;

/// Parses `text` from a command line into the value that a file would contain.
pub fn of_text(text: &str) -> Value {
    match (text.parse(), text.parse(), text.parse()) {
        (Ok(whole), _, _) => Value::Integer(whole),
        (_, Ok(number), _) => Value::Float(number),
        (_, _, Ok(truth)) => Value::Boolean(truth),
        _ => Value::String(text.to_owned()),
    }
}

/// Formats a value as in a file.
pub fn written(value: &Value) -> String {
    match value {
        Value::String(text) => format!("\"{text}\""),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => number.to_string(),
        Value::Boolean(value) => value.to_string(),
        Value::Datetime(time) => time.to_string(),
        Value::Array(_) => "[...]".into(),
        Value::Table(_) => "{...}".into(),
    }
}

/// Returns a real number in SI. A text has one of the units of the SI unit `si`; differences (`is_relative`) are
/// converted without the offset of their unit.
pub fn real(value: &Value, si: Option<&str>, is_relative: bool) -> Result<f64, String> {
    match value {
        Value::Float(number) => Ok(*number),
        Value::Integer(number) => Ok(*number as f64),
        Value::String(text) => units::parse(text, si, is_relative),
        _ => Err("it must be a number, or a text like \"4.5 mm\"".into()),
    }
}

/// Returns a whole number of 32 bits.
pub fn whole(value: &Value) -> Result<i32, String> {
    let wrong = || "it must be a whole number".to_owned();
    let (min, max) = (f64::from(i32::MIN), f64::from(i32::MAX));
    let number = match value {
        Value::Float(number) => *number,
        Value::Integer(number) => *number as f64,
        Value::String(text) => units::number(text).map_err(|problem| format!("{}; {problem}", wrong()))?,
        _ => return Err(wrong()),
    };
    if number != number.trunc() {
        return Err(wrong());
    }
    if (min..=max).contains(&number) { Ok(number as i32) } else { Err(format!("{} from {min} to {max}", wrong())) }
}

/// Returns true or false, in upper or lower case.
pub fn truth(value: &Value) -> Result<bool, String> {
    match value {
        Value::Boolean(truth) => Ok(*truth),
        Value::String(text) if text.eq_ignore_ascii_case("true") => Ok(true),
        Value::String(text) if text.eq_ignore_ascii_case("false") => Ok(false),
        _ => Err("it must be true or false".into()),
    }
}

/// Returns the number of a literal of an enumeration, which is given by its name or its number. `choices`: names and
/// numbers.
pub fn literal(value: &Value, choices: &[(&str, i32)]) -> Result<i32, String> {
    let names = || choices.iter().map(|(name, _)| *name);
    let number = match value {
        Value::Integer(_) | Value::Float(_) => whole(value).ok(),
        _ => None,
    };
    let found = choices.iter().find(|(name, known)| value.as_str() == Some(name) || number == Some(*known));
    if let Some((_, number)) = found {
        return Ok(*number);
    }
    let given = match value {
        Value::String(name) => name.clone(),
        other => written(other),
    };
    Err(format!("it is not one of {}{}", names().collect::<Vec<_>>().join(", "), near::hint(&given, names())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str) -> Value {
        Value::String(text.into())
    }

    #[test]
    fn whole_numbers_may_have_decimals_that_are_zero() {
        for twelve in [Value::Integer(12), Value::Float(12.0), text("12"), text("12.0")] {
            assert_eq!(whole(&twelve), Ok(12), "{twelve:?}");
        }
        for wrong in [Value::Float(12.5), text("12.5"), text("ten"), Value::Boolean(true), Value::Float(f64::NAN)] {
            assert!(whole(&wrong).is_err_and(|problem| problem.starts_with("it must be a whole number")), "{wrong:?}");
        }
        assert!(whole(&Value::Float(3e9)).is_err_and(|problem| problem.ends_with("to 2147483647")));
    }

    #[test]
    fn truth_is_a_word() {
        for (value, wanted) in [(text("True"), true), (of_text("true"), true), (text("FALSE"), false)] {
            assert_eq!(truth(&value), Ok(wanted), "{value:?}");
        }
        for wrong in [text("yes"), Value::Integer(1), Value::Float(0.5)] {
            assert!(truth(&wrong).is_err(), "{wrong:?}");
        }
    }

    #[test]
    fn literals_have_names_and_numbers() {
        let choices = [("rest", 1), ("rolling", 3)];
        for value in [text("rolling"), Value::Integer(3), Value::Float(3.0)] {
            assert_eq!(literal(&value, &choices), Ok(3), "{value:?}");
        }
        for wrong in [text("roling"), Value::Integer(2), Value::Boolean(true)] {
            assert!(literal(&wrong, &choices).is_err_and(|problem| problem.contains("rest, rolling")), "{wrong:?}");
        }
    }
}
