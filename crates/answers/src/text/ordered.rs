//! JSON whose objects keep the order of their entries.

use serde::{Serialize, Serializer};
use serde_json::Value;

/// JSON whose objects keep the order of their entries, which a map of the library would lose.
#[derive(Serialize)]
#[serde(untagged)]
pub enum Ordered {
    /// A value without objects.
    Value(Value),
    /// A list.
    List(Vec<Ordered>),
    /// An object.
    #[serde(serialize_with = "entries")]
    Object(Vec<(&'static str, Ordered)>),
}

fn entries<S: Serializer>(entries: &[(&'static str, Ordered)], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map(entries.iter().map(|(key, value)| (key, value)))
}

impl<T: Into<Value>> From<T> for Ordered {
    fn from(value: T) -> Self {
        Self::Value(value.into())
    }
}
