//! Questions about the study that the start values come from.

use anyhow::Result;
use bevel_differential::model::Parameters;
use serde::Deserialize;
use serde_json::{Value, json};

use crate::study::comparison;
use crate::study::evaluation::{Results, request};
use crate::study::theory::Theory;

/// Asks what to simulate for the study. With the results of these simulations it asks for the comparison.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyQuestion {
    #[serde(default)]
    results: Option<Results>,
}

impl StudyQuestion {
    pub(super) fn answer(&self) -> Result<Value> {
        let theory = Theory::new(&Parameters::default());
        let Some(results) = &self.results else {
            return Ok(request(&theory));
        };
        let report = comparison::report(&theory, results);
        Ok(json!({"text": report.terminal(), "document": report.markdown()}))
    }
}
