//! Proof that effects that are off cost nothing: the full build gives the same bits as a build without any, and does no more
//! work. Work is arithmetic, branches and calls; moves around them are the compiler's, and are held to a per cent.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, ensure};
use bevel_differential::model::EFFECTS;
use clap::Args;

use crate::check::executed::{Executed, Kind};
use crate::check::stepping::{self, Vectors};
use answers::text::table::{Table, for_terminal};
use fmu_build::tools::progress::Progress;
use fmu_build::tools::sections;

/// The marks around the table.
const MARKS: [&str; 2] = ["<!-- off:begin -->", "<!-- off:end -->"];

/// What a run gave.
#[derive(Clone, Debug, PartialEq)]
struct CountedRun {
    bits: String,
    /// Instructions per communication step.
    executed: Executed,
}

/// How far builds of the same work may differ in all instructions, as the compiler keeps other values in registers.
const ARRANGEMENT: f64 = 0.01;

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
        let of =
            |program: &Path| scenes.iter().map(|scene| measure(program, vectors, scene)).collect::<Result<Vec<_>>>();
        Ok([of(&full)?, of(&without)?])
    };
    let (vectors, [off, left_out]) = stepping::counted(counted)?;
    let mut table = Table::new(["effect", "left out", "off", "on", "on / off"]).left([0]);
    for effect in EFFECTS.iter().filter(|_| !quick) {
        let on = stepping::instructions(&full, vectors, "turn", &[effect.name])?;
        let [out, off] = [&left_out, &off].map(|runs| runs[1].executed.total());
        let counts = [out, off, on].map(|count| format!("{count:.0}"));
        let cost = format!("{:.2}", on / off);
        table.push([format!("`{}`", effect.name)].into_iter().chain(counts).chain([cost]));
    }
    progress.finish();
    for ((off, left_out), scene) in off.iter().zip(&left_out).zip(scenes) {
        off.costs_no_more_than(left_out).with_context(|| format!("effects that are off, {scene}"))?;
    }
    let total = |run: &CountedRun| run.executed.total();
    if quick {
        let mut table = Table::new(["per communication step in the turn", "left out", "off"]).left([0]);
        for (name, kind) in WORK {
            table.push(
                [name.to_owned()]
                    .into_iter()
                    .chain([&left_out, &off].map(|runs| format!("{:.1}", runs[1].executed.of(kind)))),
            );
        }
        table.push(
            ["all instructions".to_owned()]
                .into_iter()
                .chain([&left_out, &off].map(|runs| format!("{:.1}", total(&runs[1])))),
        );
        println!("{}\nsame bits, no more work", for_terminal(&table.markdown()));
        return Ok(());
    }
    let page = format!(
        "{}\nInstructions per communication step of 1 ms in the study's turn. \"Left out\" is a build without any effect: its \
         results have the same bits, and off does no more work: not one operation on floating-point numbers, branch or \
         call more. What is left between them are moves: compilers keep other values in registers. Switching on takes the \
         time of more steps, too, where the effect brings faster motion.\n",
        table.markdown(),
    );
    println!("{}", for_terminal(&page));
    if write {
        sections::renew("docs/effects.md", MARKS, &page)?;
    }
    Ok(())
}

/// What is work, by name.
const WORK: [(&str, Kind); 2] = [("floating-point operations", Kind::Float), ("branches and calls", Kind::Branch)];

impl CountedRun {
    fn costs_no_more_than(&self, other: &Self) -> Result<()> {
        ensure!(self.bits == other.bits, "results change: {} for {}", self.bits, other.bits);
        for (name, kind) in WORK {
            let [here, there] = [self, other].map(|run| run.executed.of(kind));
            ensure!(here <= there, "{name}: {here} for {there} per communication step");
        }
        let [here, there] = [self, other].map(|run| run.executed.total());
        ensure!(here <= (1.0 + ARRANGEMENT) * there, "instructions: {here} for {there} per communication step");
        Ok(())
    }
}

fn measure(program: &Path, vectors: Vectors, scene: &str) -> Result<CountedRun> {
    let read = Command::new(program).args([scene, &stepping::COUNTED[1].to_string()]).output()?;
    ensure!(read.status.success(), "{scene}: {}", String::from_utf8_lossy(&read.stderr));
    let bits = String::from_utf8_lossy(&read.stdout).trim().to_owned();
    Ok(CountedRun { bits, executed: Executed::per_step(program, vectors, scene, &[])? })
}
