//! Proof that effects that are off cost nothing: the full build gives the same bits as a build without any, and takes no more
//! instructions.

use std::path::Path;
use std::process::Command;

use anyhow::{Result, ensure};
use bevel_differential::model::EFFECTS;
use clap::Args;

use crate::check::stepping::{self, Vectors};
use crate::tools::progress::Progress;
use crate::tools::sections;
use crate::tools::table::{Table, for_terminal};

/// The marks around the table.
const MARKS: [&str; 2] = ["<!-- off:begin -->", "<!-- off:end -->"];

/// What a run gave.
#[derive(Clone, Debug, PartialEq)]
struct CountedRun {
    bits: String,
    /// Instructions per communication step.
    instructions: f64,
}

/// Checks that effects that are off cost nothing, by bits and instructions of a build without any (needs valgrind)
#[derive(Args, Clone, Debug)]
pub struct ZeroCostCommand {
    /// Leave out what each effect costs when it is on
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
    let full = stepping::build(true, "full")?;
    progress.stage("building without effects");
    let without = stepping::build(false, "less")?;
    progress.stage("counting instructions");
    let scenes = ["straight", "turn"];
    let counted = |vectors| -> Result<[Vec<CountedRun>; 2]> {
        let of = |program: &Path| {
            scenes.iter().map(|scene| measure(program, vectors, scene, &[])).collect::<Result<Vec<_>>>()
        };
        Ok([of(&full)?, of(&without)?])
    };
    let (vectors, [off, left_out]) = stepping::counted(counted)?;
    let mut table = Table::new(["effect", "left out", "off", "on", "on / off"]).left([0]);
    for effect in EFFECTS.iter().filter(|_| !quick) {
        let on = measure(&full, vectors, "turn", &[effect.name])?.instructions;
        let counts = [left_out[1].instructions, off[1].instructions, on].map(|count| format!("{count:.0}"));
        let cost = format!("{:.2}", on / off[1].instructions);
        table.push([format!("`{}`", effect.name)].into_iter().chain(counts).chain([cost]));
    }
    progress.finish();
    for (off, left_out) in off.iter().zip(&left_out) {
        ensure!(off.bits == left_out.bits, "effects that are off change results: left out {left_out:?}, off {off:?}");
        // compilers arrange the same blocks in different orders, and then jump more or less often
        ensure!(
            off.instructions <= left_out.instructions,
            "effects that are off cost instructions: left out {left_out:?}, off {off:?}"
        );
    }
    if quick {
        println!(
            "left out {:.0} and off {:.0} instructions per communication step in the turn, same bits",
            left_out[1].instructions, off[1].instructions
        );
        return Ok(());
    }
    let page = format!(
        "{}\nInstructions per communication step of 1 ms in the study's turn. \"Left out\" is a build without any effect: its \
         results have the same bits, and off takes no more instructions. The compiler may order the same blocks differently \
         in both builds and jump more often in one. Switching on takes the time of more steps, too, where the effect brings faster motion.\n",
        table.markdown(),
    );
    println!("{}", for_terminal(&page));
    if write {
        sections::renew("docs/effects.md", MARKS, &page)?;
    }
    Ok(())
}

fn measure(program: &Path, vectors: Vectors, scene: &str, effects: &[&str]) -> Result<CountedRun> {
    let read = Command::new(program).args([scene, &stepping::COUNTED[1].to_string()]).args(effects).output()?;
    ensure!(read.status.success(), "{scene} {effects:?}: {}", String::from_utf8_lossy(&read.stderr));
    let bits = String::from_utf8_lossy(&read.stdout).trim().to_owned();
    Ok(CountedRun { bits, instructions: stepping::instructions(program, vectors, scene, effects)? })
}
