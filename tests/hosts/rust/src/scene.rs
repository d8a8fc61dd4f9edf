//! The scene and the table: the same as in common.py.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::fs;

use serde::Deserialize;
use serde_json::{Map, Value};

/// Values of the outputs by communication point.
pub type Rows = BTreeMap<usize, Vec<f64>>;

/// A value with the FMI type that sets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Typed {
    Real(f64),
    /// Also an Enumeration, by its number.
    Integer(i32),
    Boolean(bool),
}

/// What is simulated: values by name in SI.
#[derive(Deserialize)]
pub struct Scene {
    pub step: f64,
    stop: f64,
    parameters: Map<String, Value>,
    inputs: Map<String, Value>,
    outputs: Map<String, Value>,
}

impl Scene {
    pub fn read(path: &str) -> Result<Self, Box<dyn Error>> {
        Ok(serde_json::from_str(&fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?)?)
    }

    pub fn steps(&self) -> usize {
        (self.stop / self.step).round() as usize
    }

    pub fn stop(&self) -> f64 {
        self.stop
    }

    pub fn outputs(&self) -> impl Iterator<Item = &String> {
        self.outputs.keys()
    }

    /// All that is set before initialisation; `is_real` tells the type of a number.
    pub fn start(&self, is_real: impl Fn(&str) -> bool) -> Result<Vec<(&str, Typed)>, String> {
        let parameters = self.parameters.iter().map(|(name, value)| (name.as_str(), value));
        let inputs = self.inputs.iter().map(|(name, value)| (name.as_str(), value.get(0).map_or(value, |at| &at[1])));
        let typed = |(name, value): (&'_ str, &Value)| match value {
            Value::Bool(flag) => Ok(Typed::Boolean(*flag)),
            Value::Number(number) if is_real(name) => number.as_f64().map(Typed::Real).ok_or(name.to_owned()),
            Value::Number(number) => {
                let whole = number.as_i64().and_then(|number| i32::try_from(number).ok());
                whole.map(Typed::Integer).ok_or(name.to_owned())
            }
            _ => Err(name.to_owned()),
        };
        let all: Result<Vec<_>, String> =
            parameters.chain(inputs).map(|(name, value)| Ok((name, typed((name, value))?))).collect();
        all.map_err(|name| format!("{name}: a number, true or false is needed"))
    }

    /// Inputs that change at communication point `k`.
    pub fn changes(&self, k: usize) -> impl Iterator<Item = (&str, f64)> {
        self.inputs.iter().flat_map(move |(name, value)| {
            let series = value.as_array().map_or(&[][..], Vec::as_slice);
            let here = series.iter().filter_map(move |at| {
                let (time, value) = (at[0].as_f64()?, at[1].as_f64()?);
                (k > 0 && (time / self.step).round() as usize == k).then_some(value)
            });
            here.map(move |value| (name.as_str(), value))
        })
    }

    /// Writes the table, with 17 significant digits.
    pub fn write(&self, rows: &Rows, path: &str) -> Result<(), Box<dyn Error>> {
        let mut text = String::from("point");
        for name in self.outputs() {
            write!(text, ",{name}")?;
        }
        for (k, values) in rows {
            write!(text, "\n{k}")?;
            for value in values {
                write!(text, ",{value:.16e}")?;
            }
        }
        text.push('\n');
        fs::write(path, text).map_err(|error| format!("{path}: {error}"))?;
        Ok(())
    }
}
