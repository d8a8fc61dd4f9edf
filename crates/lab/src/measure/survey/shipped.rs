//! How long the answers for the shipped scenes take: all outputs of each, to 1 %.

use std::time::Instant;

use anyhow::Result;

use answers::accuracy::words::{setting, two};
use answers::accuracy::{Question, answer};
use answers::scene::{self, load};
use answers::text::table::Table;
use answers::watch::Watch;
use fmu_build::tools::progress::Progress;

/// The accuracy that is asked for, as a fraction.
const WITHIN: f64 = 0.01;

/// Answers for all shipped scenes, and a table of what that took.
pub fn table(progress: &Progress) -> Result<Table> {
    let head = ["scene", "one reference run, s", "runs", "as dear as reference runs", "answer, s", "setting"];
    let mut table = Table::new(head).left([0, 5]);
    let files = scene::files(&fmu_build::tools::paths::scenes())?;
    for (place, file) in files.iter().enumerate() {
        let scene = load::load(file)?;
        let question = Question { wants: Vec::new(), within: WITHIN, from: 0.0, timed: true };
        let begun = Instant::now();
        let found = answer(
            &scene,
            &question,
            &mut Watch::new(|done, what| {
                progress
                    .advance((place as f64 + done.min(1.0)) / files.len() as f64, &format!("{}: {what}", scene.name));
                true
            }),
        )?;
        let took = begun.elapsed().as_secs_f64();
        let chosen = match found.choice() {
            Some(_) if found.is_uncertain() => "not certain: two runs of the reference part".to_owned(),
            Some(chosen) => setting(&chosen.scene.parameters),
            None => "none but the reference".to_owned(),
        };
        table.push([
            format!("`{}`", scene.name),
            two(found.reference.effort.seconds),
            found.trials.len().to_string(),
            two(found.spent),
            two(took),
            chosen,
        ]);
    }
    Ok(table)
}
