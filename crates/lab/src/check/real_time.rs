//! The costliest communication step of the fixed-step method compared with the median one, in instructions.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use clap::Args;

use crate::check::stepping::{self, Vectors};
use answers::text::numbers::Spread;
use answers::text::table::Table;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::{paths, sections};

/// Scenes, by the names that the stepping program knows.
const SCENES: [(&str, &[&str]); 4] =
    [("straight", &[]), ("turn", &[]), ("straight", &["rolling"]), ("turn", &["rolling", "reversal"])];
/// Steps of the method [s].
const SIZES: [&str; 3] = ["1e-3", "1e-4", "1e-5"];
/// Communication steps of 1 ms.
const STEPS: &str = "300";
/// Most that the costliest step may cost over the median one.
const MOST: f64 = 2.0;
/// The marks around the table.
const MARKS: [&str; 2] = ["<!-- real-time:begin -->", "<!-- real-time:end -->"];

/// Checks that no step of the fixed-step method costs more than twice the median, in instructions (needs valgrind)
#[derive(Args, Clone, Debug)]
pub struct RealTimeCommand {
    /// Also renew the table in docs/cost.md
    #[arg(long)]
    write: bool,
}

impl RealTimeCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        run(self.write)
    }
}

fn run(write: bool) -> Result<()> {
    let progress = Progress::start("building the stepping program");
    let program = stepping::build(true, "full")?;
    let folder = paths::target().join("real-time");
    let mut table =
        Table::new(["scene", "`solver.fixed_step`, s", "median", "costliest", "costliest / median"]).left([0]);
    let mut worst = 0.0f64;
    for (scene, options) in SCENES {
        for size in SIZES {
            progress.stage(&format!("counting {scene} {}, steps of {size} s", options.join(" ")));
            let _ = fs::remove_dir_all(&folder);
            paths::create_folder(&folder)?;
            let file = format!("--callgrind-out-file={}", folder.join("count").display());
            let each = ["--dump-after=*one_communication_step*", &file];
            let fixed = format!("fixed_step={size}");
            stepping::callgrind(
                &program,
                Vectors::Narrow,
                &each,
                &[&[scene, STEPS, "unread", &fixed], options].concat(),
            )?;
            let counts = counts(&folder)?;
            let (median, most) = (Spread::of(&counts).median, counts.iter().copied().fold(0.0, f64::max));
            worst = worst.max(most / median);
            let name = std::iter::once(scene).chain(options.iter().copied()).collect::<Vec<_>>().join(", ");
            let ratio = format!("{:.2}", most / median);
            table.push([name, size.to_owned(), format!("{median:.0}"), format!("{most:.0}"), ratio]);
        }
    }
    progress.finish();
    let note = format!("Instructions of a communication step of 1 ms, {STEPS} steps each.\n");
    println!("{}\n{note}", table.terminal());
    if worst > MOST {
        bail!("the costliest step costs {worst:.2} times the median one, more than {MOST}");
    }
    if write {
        sections::renew("docs/cost.md", MARKS, &format!("{}\n{note}", table.markdown()))?;
    }
    Ok(())
}

/// Instructions of each step: callgrind writes a file after every one, `count.1`, `count.2`, …; the first holds the start of
/// the program as well, and `count` its end.
fn counts(folder: &Path) -> Result<Vec<f64>> {
    let mut counts = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let part = path.extension().and_then(|part| part.to_str()?.parse::<u32>().ok());
        if part.is_some_and(|part| part > 1) {
            let text = fs::read_to_string(&path)?;
            let count = text.lines().find_map(|line| line.strip_prefix("summary:")?.trim().parse::<f64>().ok());
            counts.push(count.with_context(|| format!("{} has no count", path.display()))?);
        }
    }
    ensure!(counts.len() > 1, "callgrind found no separate steps: does the stepping program have its symbols?");
    Ok(counts)
}
