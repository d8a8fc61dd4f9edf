//! What effects cost when they are on: each alone, each pair, and all together.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use bevel_differential::model::EFFECTS;
use clap::Args;

use crate::check::stepping::{self, Vectors};
use crate::tools::machine::machine;
use fmu_build::tools::numbers::{Spread, significant};
use fmu_build::tools::progress::Progress;
use fmu_build::tools::table::{Table, for_terminal};
use fmu_build::tools::{paths, sections};

const DOCUMENT: &str = "docs/prices.md";
/// The same prices for the command `accuracy`, which counts by them.
const DATA: &str = "fmu-build/data/prices.csv";
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
/// Levels and laws beside plain teeth, with the options that choose them.
const LEVELS: [(&str, &str); 5] = [
    ("ideal", "scene.gear_contact=1"),
    ("lumped", "scene.gear_contact=2"),
    ("line", "line"),
    ("line_weber", "line_weber"),
    ("solid", "solid=32"),
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
        let (_, (page, data)) = stepping::counted(|vectors| {
            let measured = Measured { program: program.clone(), vectors };
            page(&measured, &progress, self.quick)
        })?;
        progress.finish();
        println!("{}", for_terminal(&page));
        if self.write {
            ensure!(!self.quick, "--write needs the pairs: leave out --quick");
            sections::renew(DOCUMENT, MARKS, &page)?;
            std::fs::write(paths::workspace().join(DATA), data).with_context(|| format!("{DATA} cannot be written"))?;
        }
        Ok(())
    }
}

/// All tables, and the prices of each alone as CSV.
fn page(measured: &Measured, progress: &Progress, quick: bool) -> Result<(String, String)> {
    let price = |name: &str, options: &[&str]| {
        progress.stage(&format!("counting {name}"));
        measured.price(options)
    };
    let plain = price("plain teeth", &[])?;
    let mut alone = table("over plain");
    alone.push(cells("nothing", &plain, None));
    // by how much an evaluation costs more than one of plain teeth
    let mut extra = 0.0;
    let levels = LEVELS.iter().map(|&(name, option)| Ok((name, price(name, &[option])?)));
    let levels: Vec<(&str, Price)> = levels.collect::<Result<_>>()?;
    let own = EFFECTS.iter().map(|effect| Ok((effect.name, price(effect.name, &[effect.name])?)));
    let own: Vec<(&str, Price)> = own.collect::<Result<_>>()?;
    let singles: Vec<&(&str, Price)> = levels.iter().chain(&own).collect();
    let data = data(&plain, &singles)?;
    for (name, single) in singles {
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
        let line = levels.iter().find(|(name, _)| *name == "line");
        let all: Vec<&(&str, Price)> = line.into_iter().chain(&own).collect();
        page += &format!("\nEach pair.\n\n{}", pairs(&all, &plain, &price)?.markdown());
    }
    let vectors = match measured.vectors {
        Vectors::Wide => "the widest vectors of the processor",
        Vectors::Narrow => "vectors that every processor has",
    };
    page += &format!("\nInstructions with {vectors}. Times with the widest: {}.\n", machine());
    Ok((page, data))
}

/// Prices of plain teeth, levels, laws and effects alone.
fn data(plain: &Price, singles: &[&(&str, Price)]) -> Result<String> {
    let mut rows = csv::Writer::from_writer(Vec::new());
    rows.write_record(["on", "instructions_per_evaluation", "instructions_per_step"])?;
    for (name, price) in [("nothing", plain)].into_iter().chain(singles.iter().map(|(name, price)| (*name, price))) {
        let numbers = [price.per_evaluation, price.per_step].map(|x| format!("{x:.0}"));
        rows.write_record([name, &numbers[0], &numbers[1]])?;
    }
    String::from_utf8(rows.into_inner()?).context("prices are text")
}

/// The table of each pair of effects, with what the pair costs over the sum of both.
fn pairs(singles: &[&(&str, Price)], plain: &Price, price: &impl Fn(&str, &[&str]) -> Result<Price>) -> Result<Table> {
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
    let sum = sum.filter(|_| price.per_evaluation > 0.0);
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
        let evaluated = last? - first?;
        // without teeth nothing is evaluated
        let per_evaluation = if evaluated > 0.0 { per_step * steps / evaluated } else { 0.0 };
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
