//! What effects cost when they are on: each alone, each pair, and all together.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use bevel_differential::model::EFFECTS;
use clap::Args;

use crate::check::stepping::{self, Vectors};
use crate::tools::machine::machine;
use crate::tools::numbers::{Spread, significant};
use crate::tools::progress::Progress;
use crate::tools::sections;
use crate::tools::table::{Table, for_terminal};

const DOCUMENT: &str = "docs/prices.md";
/// The marks around the tables.
const MARKS: [&str; 2] = ["<!-- prices:begin -->", "<!-- prices:end -->"];
const SCENE: &str = "turn";
/// What the richest scene of gears in service has on: teeth by their line law with errors of grade 6.
const ALL: [&str; 11] = [
    "line",
    "tooth_friction",
    "thrust_friction",
    "limited_slip",
    "half_shaft",
    "pin_compliance",
    "bearing_drag",
    "strength",
    "tooth_errors",
    "tooth_errors.accuracy_grade=6",
    "tooth_errors.planet_tip_relief=0",
];
/// Communication steps of a timed run, and how often it is repeated.
const TIMED: u32 = 500;
const REPEATED: usize = 5;
/// Communication step [s].
const STEP: f64 = 1e-3;

/// Counts what each effect, each pair of effects and all together cost (needs valgrind, some ten minutes)
#[derive(Args, Clone, Debug)]
pub struct PricesCommand {
    /// Leave out the pairs
    #[arg(long)]
    quick: bool,
    /// Also renew the tables in docs/prices.md
    #[arg(long)]
    write: bool,
}

/// What a scene costs.
struct Price {
    /// Steps of the integrator, accepted and rejected, and evaluations, in the timed run.
    steps: f64,
    rejected: f64,
    evaluations: f64,
    /// Simulated over elapsed time.
    real_time: f64,
    /// Instructions per communication step, and per evaluation.
    per_step: f64,
    per_evaluation: f64,
}

/// The program that is measured.
struct Measured {
    program: PathBuf,
    vectors: Vectors,
}

impl PricesCommand {
    /// Runs it.
    pub fn run(&self) -> Result<()> {
        let progress = Progress::start("building the stepping program");
        let program = stepping::build(true, "full")?;
        let (_, page) = stepping::counted(|vectors| {
            let measured = Measured { program: program.clone(), vectors };
            page(&measured, &progress, self.quick)
        })?;
        progress.finish();
        println!("{}", for_terminal(&page));
        if self.write {
            ensure!(!self.quick, "--write needs the pairs: leave out --quick");
            sections::renew(DOCUMENT, MARKS, &page)?;
        }
        Ok(())
    }
}

/// All tables.
fn page(measured: &Measured, progress: &Progress, quick: bool) -> Result<String> {
    let price = |name: &str, options: &[&str]| {
        progress.stage(&format!("counting {name}"));
        measured.price(options)
    };
    let plain = price("plain teeth", &[])?;
    let mut alone = table("over plain");
    alone.push(cells("nothing", &plain, None));
    // by how much an evaluation costs more than one of plain teeth
    let mut extra = 0.0;
    let singles: Vec<(&str, Price)> = ["line"]
        .into_iter()
        .chain(EFFECTS.iter().map(|effect| effect.name))
        .map(|name| Ok((name, price(name, &[name])?)))
        .collect::<Result<_>>()?;
    for (name, single) in &singles {
        alone.push(cells(&format!("`{name}`"), single, Some(&plain)));
        if ALL.contains(name) {
            extra += single.per_evaluation / plain.per_evaluation - 1.0;
        }
    }
    let all = price("all together", &ALL)?;
    alone.push(cells("all together", &all, Some(&plain)));
    let mut page = format!(
        "Each alone, and all together: {}.\n\n{}\nAll together an evaluation costs {} times that of plain teeth; 1 and what each \
         adds alone make {}.\n",
        ALL.map(|name| format!("`{}`", name.replace('=', " = "))).join(", "),
        alone.markdown(),
        significant(all.per_evaluation / plain.per_evaluation, 3),
        significant(1.0 + extra, 3),
    );
    if !quick {
        page += &format!("\nEach pair.\n\n{}", pairs(&singles, &plain, &price)?.markdown());
    }
    let vectors = match measured.vectors {
        Vectors::Wide => "the widest vectors of the processor",
        Vectors::Narrow => "vectors that every processor has",
    };
    page += &format!("\nInstructions with {vectors}. Times with the widest: {}.\n", machine());
    Ok(page)
}

/// The table of each pair of effects, with what the pair costs over the sum of both.
fn pairs(singles: &[(&str, Price)], plain: &Price, price: &impl Fn(&str, &[&str]) -> Result<Price>) -> Result<Table> {
    let mut table = table("over the sum");
    for (i, (first, one)) in singles.iter().enumerate() {
        for (second, other) in &singles[i + 1..] {
            let both = price(&format!("{first}, {second}"), &[first, second])?;
            let sum = one.per_evaluation + other.per_evaluation - plain.per_evaluation;
            table.push(cells(&format!("`{first}`, `{second}`"), &both, Some(&Price { per_evaluation: sum, ..*plain })));
        }
    }
    Ok(table)
}

fn table(over: &str) -> Table {
    let head = [
        "on",
        "steps",
        "rejected",
        "evaluations",
        "instructions per evaluation",
        over,
        "instructions per 1 ms",
        "× real time",
    ];
    Table::new(head).left([0])
}

/// A row: `price`, and its instructions per evaluation over those of `sum`.
fn cells(name: &str, price: &Price, sum: Option<&Price>) -> [String; 8] {
    let over = sum.map_or(String::new(), |sum| format!("{:.2}", price.per_evaluation / sum.per_evaluation));
    let whole = |x: f64| format!("{x:.0}");
    [
        name.to_owned(),
        whole(price.steps),
        whole(price.rejected),
        whole(price.evaluations),
        whole(price.per_evaluation),
        over,
        whole(price.per_step),
        significant(price.real_time, 2),
    ]
}

impl Measured {
    fn price(&self, options: &[&str]) -> Result<Price> {
        let per_step = stepping::instructions(&self.program, self.vectors, SCENE, options)?;
        let evaluations = stepping::COUNTED.map(|steps| Ok(counts(&self.program, steps, options)?[2]));
        let [first, last]: [Result<f64>; 2] = evaluations;
        let steps = f64::from(stepping::COUNTED[1] - stepping::COUNTED[0]);
        let per_evaluation = per_step * steps / (last? - first?);
        let runs = (0..REPEATED).map(|_| counts(&self.program, TIMED, options)).collect::<Result<Vec<_>>>()?;
        let seconds = Spread::of(&runs.iter().map(|run| run[3]).collect::<Vec<_>>()).median;
        let [steps, rejected, evaluations, _] = runs[0];
        let real_time = f64::from(TIMED) * STEP / seconds;
        Ok(Price { steps, rejected, evaluations, real_time, per_step, per_evaluation })
    }
}

/// Steps accepted and rejected, evaluations, and seconds of a run of `steps` communication steps.
fn counts(program: &Path, steps: u32, options: &[&str]) -> Result<[f64; 4]> {
    let output = Command::new(program).args([SCENE, &steps.to_string(), "unread", "counts"]).args(options).output()?;
    ensure!(output.status.success(), "{options:?}: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout);
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|number| number.parse().ok()).collect();
    numbers.try_into().ok().context("the stepping program printed no counts")
}
