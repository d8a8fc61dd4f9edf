//! Proof that an effect that is off costs nothing: builds that leave its file out are compared with the full build, bit by
//! bit and instruction by instruction.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use clap::Args;

use crate::check::stepping;
use crate::tools::progress::Progress;
use crate::tools::sections;
use crate::tools::table::{Table, for_terminal};

/// Every effect that a build can leave out, by the name of its cargo feature.
pub const EFFECTS: [&str; 11] = [
    "bearing_drag",
    "final_drive",
    "half_shaft",
    "limited_slip",
    "lock",
    "pin_compliance",
    "strength",
    "thrust_friction",
    "tooth_errors",
    "tooth_fault",
    "tooth_friction",
];

/// The marks around the table.
const MARKS: [&str; 2] = ["<!-- off:begin -->", "<!-- off:end -->"];

/// Steps of the two runs whose difference is counted: starting up cancels.
const STEPS: [u32; 2] = [100, 300];

/// What a run gave.
#[derive(Clone, Debug, PartialEq)]
struct CountedRun {
    bits: String,
    /// Instructions per communication step.
    instructions: f64,
}

/// Checks that an effect that is off costs nothing, by bits and instructions of builds without it (needs valgrind)
#[derive(Args, Clone, Debug)]
pub struct ZeroCostCommand {
    /// Compare with one build without any effect
    #[arg(long)]
    quick: bool,
    /// Also renew the table in docs/effects.md
    #[arg(long)]
    write: bool,
}

impl ZeroCostCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        run(self.quick, self.write)
    }
}

fn run(quick: bool, write: bool) -> Result<()> {
    let progress = Progress::start("building with all effects");
    let full = stepping::build(&EFFECTS, "full")?;
    let off = [measure(&full, "straight", &[])?, measure(&full, "turn", &[])?];
    let mut table = Table::new(["effect", "left out", "off", "on", "on / off"]).left([0]);
    let mut different = Vec::new();
    let mut compare = |what: &str, kept: &[&str]| -> Result<f64> {
        progress.stage(&format!("building without {what}"));
        let without = stepping::build(kept, "less")?;
        let runs = [measure(&without, "straight", &[])?, measure(&without, "turn", &[])?];
        if runs != off {
            different.push(format!("{what}: {runs:?} left out, {off:?} off"));
        }
        Ok(runs[1].instructions)
    };
    let without_any = if quick { Some(compare("all of them", &[])?) } else { None };
    for effect in EFFECTS {
        let left_out = match without_any {
            Some(count) => count,
            None => compare(effect, &EFFECTS.into_iter().filter(|&e| e != effect).collect::<Vec<_>>())?,
        };
        let on = measure(&full, "turn", &[effect])?.instructions;
        let cost = on / off[1].instructions;
        let counts = [left_out, off[1].instructions, on].map(|count| format!("{count:.0}"));
        table.push([format!("`{effect}`")].into_iter().chain(counts).chain([format!("{cost:.2}")]));
    }
    progress.finish();
    let page = format!(
        "{}\nInstructions per communication step of 1 ms in the study's turn. {} \
         Switching on takes the time of more steps, too, where the effect brings faster motion.\n",
        table.markdown(),
        if quick {
            "\"Left out\" is one build without any of these files; its results have the same bits."
        } else {
            "\"Left out\" is a build without the file of this effect; its results have the same bits."
        }
    );
    println!("{}", for_terminal(&page));
    if !different.is_empty() {
        bail!("effects that are off change results or instructions:\n{}", different.join("\n"));
    }
    if write {
        sections::renew("docs/effects.md", MARKS, &page)?;
    }
    Ok(())
}

fn measure(program: &Path, scene: &str, effects: &[&str]) -> Result<CountedRun> {
    let read = Command::new(program).args([scene, &STEPS[1].to_string()]).args(effects).output()?;
    ensure!(read.status.success(), "{scene} {effects:?}: {}", String::from_utf8_lossy(&read.stderr));
    let bits = String::from_utf8_lossy(&read.stdout).trim().to_owned();
    let mut counts = [0.0; 2];
    for (count, steps) in counts.iter_mut().zip(STEPS) {
        let steps = steps.to_string();
        let report = stepping::callgrind(program, &[], &[&[scene, &steps, "unread"], effects].concat())?;
        *count = report
            .lines()
            .find_map(|line| line.split("Collected :").nth(1)?.trim().parse().ok())
            .context("valgrind reported no count")?;
    }
    Ok(CountedRun { bits, instructions: (counts[1] - counts[0]) / f64::from(STEPS[1] - STEPS[0]) })
}
