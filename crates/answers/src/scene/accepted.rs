//! Start values that a scene accepts, so that no warning names them.

use bevel_differential::variables::unset::SetValues;
use bevel_differential::variables::{Access, index_of};
use serde_json::{Value as Json, json};
use toml::Value;

use super::set::variable;
use super::value::written;

/// Start values that a scene accepts.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Accepted {
    /// None of them.
    #[default]
    None,
    /// All of them.
    All,
    /// Those of the variables with these names.
    Named(Vec<&'static str>),
}

impl Accepted {
    /// Reads the value of `accept_start_values`. Fails with all problems of the value.
    pub fn read(value: &Value) -> Result<Self, Vec<String>> {
        let problem = |what: String| format!("accept_start_values = {}: {what}", written(value));
        let names = match value {
            Value::Boolean(true) => return Ok(Self::All),
            Value::Boolean(false) => return Ok(Self::None),
            Value::Array(names) => names,
            _ => return Err(vec![problem("it must be true, false, or a list of names".into())]),
        };
        let (mut found, mut problems) = (Vec::new(), Vec::new());
        for name in names {
            let row = name.as_str().map_or_else(|| Err(format!("{} is not a name", written(name))), variable);
            match row {
                Ok(row) if matches!(row.access, Access::Output(_)) => {
                    problems.push(problem(format!("{} is an output, which has no start value to accept", row.name)));
                }
                Ok(row) => found.push(row.name),
                Err(what) => problems.push(problem(what)),
            }
        }
        if problems.is_empty() { Ok(Self::Named(found)) } else { Err(problems) }
    }

    /// Adds the accepted variables to `set`, so that they count as set.
    pub fn add_to(&self, set: &mut SetValues) {
        if let Self::Named(names) = self {
            names.iter().filter_map(|name| index_of(name)).for_each(|index| set.insert(index));
        }
    }

    /// The value in the form of scene files.
    pub fn json(&self) -> Json {
        match self {
            Self::None => json!(false),
            Self::All => json!(true),
            Self::Named(names) => json!(names),
        }
    }
}
