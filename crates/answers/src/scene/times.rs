//! Times in scenes: numbers of seconds, or texts with a unit of time.

use toml::Value;

use super::units;
use super::value::written;

/// Parses a time in seconds.
pub fn seconds(value: &Value) -> Result<f64, String> {
    match value {
        Value::Float(number) => Ok(*number),
        Value::Integer(number) => Ok(*number as f64),
        Value::String(text) => units::seconds(text),
        _ => Err("it must be a number of seconds, or a text like \"20 ms\"".into()),
    }
}

/// Parses a length of time that must be finite and above zero [s]. `key` names it in the error.
pub fn span(key: &str, value: &Value) -> Result<f64, String> {
    length(key, value, |span| span > 0.0, "it must be above 0 s")
}

/// Parses a length of time that may be zero [s]. `key` names it in the error.
pub fn duration(key: &str, value: &Value) -> Result<f64, String> {
    length(key, value, |duration| duration >= 0.0, "it must be 0 s or more")
}

fn length(key: &str, value: &Value, is_valid: fn(f64) -> bool, rule: &str) -> Result<f64, String> {
    let message = |what: String| format!("{key} = {}: {what}", written(value));
    let length = seconds(value).map_err(message)?;
    if is_valid(length) && length.is_finite() { Ok(length) } else { Err(message(rule.into())) }
}

/// Checks that a communication step fits into the simulated time. A scene of zero duration has no steps.
pub fn check_step(step: f64, stop_time: f64) -> Result<(), String> {
    if step > stop_time && stop_time > 0.0 {
        return Err(format!("step = {step} s is longer than stop_time = {stop_time} s"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_seconds_and_texts_have_units() {
        let text = |text: &str| Value::String(text.into());
        assert_eq!(seconds(&Value::Float(0.5)), Ok(0.5));
        assert_eq!(seconds(&Value::Integer(2)), Ok(2.0));
        assert_eq!(seconds(&text("20 ms")), Ok(0.02));
        assert_eq!(seconds(&text("0.5 s")), Ok(0.5));
        assert!(seconds(&text("20 mm")).is_err_and(|problem| problem.contains("s, ms, us, min")));
        assert!(seconds(&Value::Boolean(true)).is_err_and(|problem| problem.contains("20 ms")));
    }

    #[test]
    fn a_span_is_above_zero() {
        for value in [Value::Float(0.0), Value::Float(f64::NAN), Value::String("-1 ms".into())] {
            assert!(span("step", &value).is_err_and(|problem| problem.starts_with("step = ")), "{value:?}");
        }
        assert!(check_step(1.0, 0.5).is_err() && check_step(0.5, 0.5).is_ok());
    }

    #[test]
    fn a_duration_may_be_zero_and_then_has_no_steps() {
        assert_eq!(duration("stop_time", &Value::Integer(0)), Ok(0.0));
        for value in [Value::Float(-1e-300), Value::Float(f64::INFINITY), Value::String("-1 ms".into())] {
            assert!(
                duration("stop_time", &value).is_err_and(|problem| problem.starts_with("stop_time = ")),
                "{value:?}"
            );
        }
        assert!(check_step(1.0, 0.0).is_ok());
    }
}
