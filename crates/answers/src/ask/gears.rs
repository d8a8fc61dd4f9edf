//! Questions about gears without a scene.

use std::collections::BTreeMap;

use anyhow::{Result, anyhow};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::geometry::design::Design;
use crate::geometry::interference::InterferenceCheck;
use crate::geometry::shape::shape;
use crate::geometry::{json, text, xyz};
use crate::problem::{Problem, Problems};
use crate::progress::Progress;
use crate::scene::set::{real, variable};
use crate::scene::value::of_text;

/// Minimum and maximum number of pieces of a flank's curve. One piece shows no involute; CAD programs need no more than
/// the maximum.
const FACETS: [usize; 2] = [2, 1000];
/// Maximum number of facets of a flank in surfaces: more would take hundreds of megabytes.
const MOST_OF_SURFACES: usize = 200;

/// Request for dimensions, interference and curves of gears.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GeometryQuestion {
    /// Parameters, each `name=value`.
    #[serde(default)]
    set: Vec<String>,
    /// Number of pieces of a flank's curve, and of facets of surfaces.
    #[serde(default = "usual")]
    facets: usize,
    /// Also return the gears as data for CAD.
    #[serde(default)]
    solids: bool,
    /// Check interference with teeth thicker by this length.
    thicken: Option<String>,
}

fn usual() -> usize {
    32
}

impl GeometryQuestion {
    pub(super) fn answer(&self, progress: &mut Progress) -> Result<Value> {
        let (design, thicken) = self.checked()?;
        progress.begin_task(0.0, "turning the gears through a tooth pitch");
        let check = InterferenceCheck::with_progress(&design, thicken, progress)?;
        // the reply contains the warnings, and files contain them separately
        let (dimensions, found) = (text::dimensions(&design), check.text());
        progress.warn(&design.warnings);
        let mut files = BTreeMap::from([
            ("dimensions.txt".to_owned(), text::text(&design)),
            ("dimensions.json".to_owned(), json::text(&design, Some(&check))?),
            ("interference.txt".to_owned(), found.clone()),
        ]);
        let curves = xyz::curves(&design.pair, &design.spec, self.facets + 1);
        files.extend(curves.iter().map(|curve| (format!("{}.txt", curve.name), curve.text())));
        let mut answer = json!({"text": format!("{dimensions}\n{found}"), "interference": check.any(), "verdict": check.verdict(), "files": files});
        if self.solids {
            progress.begin_task(1.0, "making solids");
            let density = design.parameters.material.density;
            let shape = shape(&design.pair, &design.spec, density, self.facets);
            answer["shape"] = shape.map_err(|found| anyhow!("{found}"))?;
        }
        Ok(answer)
    }

    /// Returns the gears and the extra tooth thickness [m], or all problems.
    fn checked(&self) -> Result<(Design, f64), Problems> {
        let mut problems = Problems::default();
        let design = Design::new(&self.set).map_err(|found| problems.extend(found.0));
        let [least, most] = [FACETS[0], if self.solids { MOST_OF_SURFACES } else { FACETS[1] }];
        if !(least..=most).contains(&self.facets) {
            let message = format!("facets {}: must be a whole number from {least} to {most}", self.facets);
            problems.push(Problem {
                range: Some([least as f64, most as f64]),
                ..Problem::of("facets", self.facets.to_string(), message)
            });
        }
        let thicken = self.thicken.as_deref().map(|text| {
            let row = variable("geometry.backlash");
            let number = row.and_then(|row| real(row, &of_text(text)).map_err(|why| format!("thicken {text}: {why}")));
            number.map_err(|message| problems.push(Problem::of("thicken", text, message)))
        });
        match (design, thicken.unwrap_or(Ok(0.0))) {
            (Ok(design), Ok(thicken)) => problems.or((design, thicken)),
            _ => Err(problems),
        }
    }
}
