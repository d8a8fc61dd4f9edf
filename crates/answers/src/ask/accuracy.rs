//! Question about the cheapest model of a scene that is accurate enough.

use std::path::PathBuf;

use anyhow::Result;
use serde::Deserialize;
use serde_json::{Value, json};

use super::scenes::changed;
use super::source::{Source, seconds};
use crate::accuracy::answer::{Answer, Role, answer};
use crate::accuracy::fraction::fraction;
use crate::accuracy::switches::Switch;
use crate::accuracy::words::difference;
use crate::accuracy::{Question, chosen, report, table};
use crate::progress::Progress;
use crate::scene::acting::acting;
use crate::scene::{script, ssv};

/// Request for the cheapest model of a scene that gives the wanted quantities within an accuracy.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AccuracyQuestion {
    of: Source,
    /// Wanted quantities, `OUTPUT[:STATISTIC]`; none = all outputs of the scene.
    #[serde(default)]
    want: Vec<String>,
    /// Wanted accuracy, such as "1%" or "0.01".
    within: String,
    /// Time from which outputs count, in seconds or with a unit; the start of the run by default.
    from: Option<String>,
    /// Path at which the caller saves the scene file with the chosen setting. Relative paths in that file start from there.
    file: Option<PathBuf>,
}

/// Reason to leave out quantities that the caller calculates.
const NOT_EXAMINED: &str = "it is calculated from outputs after a run, and only the accuracy of outputs is examined";

impl AccuracyQuestion {
    pub(super) fn answer(&self, progress: &mut Progress) -> Result<Value> {
        let scene = self.of.scene(progress)?;
        if self.want.is_empty() {
            progress.warn(scene.quantities.iter().map(|(_, name)| format!("{name}: {NOT_EXAMINED}")));
        }
        let question = Question {
            wants: self.want.clone(),
            within: fraction(&self.within)?,
            from: seconds("from", self.from.as_deref())?.unwrap_or(0.0),
        };
        let found = answer(&scene, &question, progress)?;
        let wants: Vec<String> = found.wants.iter().map(|want| want.text(&found.scene)).collect();
        let setting_json = |run: Option<usize>| {
            let run = run.map(|run| &found.trials[run])?;
            let [on, own] = [&run.scene.parameters, &found.choice()?.scene.parameters];
            Some(json!({"set": changed(&acting(&run.scene)), "difference": difference(own, on)}))
        };
        let choice = found.choice();
        let text =
            |what: fn(&crate::scene::Scene) -> Result<String>| choice.map(|run| what(&acting(&run.scene))).transpose();
        let file = self.file.as_deref().filter(|_| choice.is_some()).map(|to| chosen::file(&found, to)).transpose()?;
        Ok(json!({
            "text": report::text(&found),
            "scene": found.scene.name,
            "wants": wants,
            "within": found.within,
            "values": found.reference.values,
            "uncertain": found.is_uncertain(),
            "runs": table::rows(&found),
            "csv": table::csv(&found)?,
            "use": setting_json(found.chosen),
            "cheaper": setting_json(found.too_coarse),
            "richer": setting_json(found.richer),
            "reference": {
                "set": changed(&acting(&found.reference.scene)),
                "values": found.reference.values,
                "scales": found.scales,
            },
            "spent": found.spent,
            "effects": found.effects.iter().map(|(switch, role)| role_json(&found, switch, role)).collect::<Vec<_>>(),
            "ssv": text(ssv::text)?,
            "python": text(script::text)?,
            "file": file,
        }))
    }
}

/// Role of an effect in the answer, as JSON.
fn role_json(answer: &Answer, switch: &Switch, role: &Role) -> Value {
    let (word, by, why) = match role {
        Role::Acts { by, chosen: true } if *by > answer.within => ("needed", Some(*by), None),
        Role::Acts { by, chosen: true } => ("kept", Some(*by), None),
        Role::Acts { by, chosen: false } => ("out", Some(*by), None),
        Role::Neutral { by, .. } => ("neutral", *by, None),
        Role::NotOnLevel => ("not_known", None, None),
        Role::NotInScene => ("not_there", None, None),
        Role::SetOff => ("set_off", None, None),
        Role::NotAsked => ("not_asked", None, None),
        Role::Kept(why) => ("kept", None, Some(why)),
        Role::Refused(why) => ("refused", None, Some(why)),
    };
    json!({"name": switch.name(), "role": word, "by": by, "why": why})
}
