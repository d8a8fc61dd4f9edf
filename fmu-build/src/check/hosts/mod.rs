//! The packaged FMU in other hosts: each host on each scene, all compared with fmpy; one table.

mod compare;
mod list;
mod run;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::fmu::{package, plain_types};
use crate::tools::progress::Progress;
use crate::tools::{paths, sections, table};
use compare::{Deviation, Table};
use list::{HOSTS, Host};
use run::{Bench, Outcome, Scene};

/// The document with the table, and the table's place.
const DOCUMENT: &str = "docs/hosts.md";
const MARKS: [&str; 2] = ["<!-- hosts:begin -->", "<!-- hosts:end -->"];
/// Largest deviation between two hosts.
const MOST: f64 = 1e-9;

/// Runs the FMU in other FMI hosts on the same scenes and compares their results with fmpy's
#[derive(Args, Clone, Copy, Debug)]
pub struct HostsCommand {
    /// Fail if a host cannot be loaded
    #[arg(long)]
    require: bool,
    /// Also renew docs/hosts.md
    #[arg(long)]
    write: bool,
    /// Also run hosts in Rust: fmi-sim, fmi-rs and fmu-runner (builds for many minutes)
    #[arg(long = "with-fmi-sim")]
    with_rust: bool,
}

/// A host on all scenes.
struct Hosted {
    host: &'static Host,
    version: String,
    seconds: f64,
    deviations: Vec<Deviation>,
}

impl HostsCommand {
    /// Runs all hosts on all scenes, prints the table, and with `write` puts it into docs/hosts.md.
    pub fn run(self) -> Result<()> {
        let progress = Progress::start("looking for Python");
        let bench = Bench::ready(self.with_rust, |what| progress.tell(what))?;
        progress.tell("packaging the FMU");
        let fmu = package::package()?;
        let plain = plain_types::package(&fmu)?;
        let scenes = run::scenes()?;
        let (mut results, mut absent) = (Vec::new(), Vec::new());
        let mut references: Vec<Table> = Vec::new();
        progress.begin_bar("running hosts");
        for (done, host) in HOSTS.iter().enumerate() {
            progress.advance(done as f64 / HOSTS.len() as f64, host.name);
            let mut result = Hosted { host, version: String::new(), seconds: 0.0, deviations: Vec::new() };
            for (k, scene) in scenes.iter().enumerate() {
                let out = bench.folder.join(format!("{}_{}.csv", scene.name, host.name.replace(", ", "_")));
                let fmu = if host.enumerations { &fmu } else { &plain };
                let ran = match bench.run(host, scene, fmu, &out)? {
                    Outcome::Ran(ran) => ran,
                    Outcome::Absent(why) => {
                        absent.push((host, why));
                        break;
                    }
                };
                let table = Table::read(&out)?;
                if references.len() == k {
                    references.push(table.clone());
                }
                let scale = |name: &str| scene.told.outputs.get(name).copied();
                let deviation = references[k].deviation(&table, !host.reads_start, scale);
                result.deviations.push(deviation.with_context(|| format!("{} on {}", host.name, scene.name))?);
                result.seconds += ran.seconds;
                result.version = ran.version;
            }
            if references.is_empty() {
                let why = absent.last().map_or("", |(_, why)| why.as_str());
                bail!("{}, which the others are compared with, cannot be loaded: {why}", host.name);
            }
            if result.deviations.len() == scenes.len() {
                results.push(result);
            }
        }
        progress.finish();
        print!("{}", table::aligned(&rows(&results, &scenes), &[0, 1, 2, 3]));
        for (host, why) in &absent {
            println!("{}: not run: {why}", host.name);
        }
        println!("\nresults: {}", paths::shown(&bench.folder));
        if self.write {
            sections::renew(DOCUMENT, MARKS, &markdown(&results, &scenes))?;
            println!("renewed: {DOCUMENT}");
        }
        let missing = absent.iter().filter(|(host, _)| !bench.leaves_out(host, self.with_rust));
        let missing: Vec<&str> = missing.map(|(host, _)| host.name).collect();
        if self.require && !missing.is_empty() {
            bail!("not run here, though required: {}", missing.join("; "));
        }
        judge(&results, &scenes)
    }
}

/// An error where a host's answer is another one.
fn judge(results: &[Hosted], scenes: &[Scene]) -> Result<()> {
    let mut wrong = Vec::new();
    for result in results {
        for (deviation, scene) in result.deviations.iter().zip(scenes) {
            if deviation.largest > MOST {
                let Deviation { largest, place, .. } = deviation;
                wrong.push(format!("{} on {}: {largest:.1e}, {place}", result.host.name, scene.name));
            }
        }
    }
    if wrong.is_empty() { Ok(()) } else { bail!("hosts differ by more than {MOST:e}:\n{}", wrong.join("\n")) }
}

/// Head and cells of the table; the first columns are texts.
fn rows(results: &[Hosted], scenes: &[Scene]) -> Vec<Vec<String>> {
    let mut head: Vec<String> = ["host", "version", "language", "import"].map(str::to_owned).to_vec();
    head.extend(scenes.iter().map(|scene| scene.name.clone()));
    head.push("time, s".to_owned());
    let mut rows = vec![head];
    for result in results {
        let Host { name, language, import, .. } = *result.host;
        let mut row = [name, &result.version, language, import].map(str::to_owned).to_vec();
        row.extend(result.deviations.iter().map(cell));
        row.push(format!("{:.2}", result.seconds));
        rows.push(row);
    }
    rows
}

fn cell(deviation: &Deviation) -> String {
    if deviation.different == 0 { "same bits".to_owned() } else { format!("{:.1e}", deviation.largest) }
}

fn markdown(results: &[Hosted], scenes: &[Scene]) -> String {
    let rows = rows(results, scenes);
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let mut text = line(&rows[0]);
    let right = scenes.len() + 1;
    text.push_str(&format!("|{}{}\n", "---|".repeat(4), "---:|".repeat(right)));
    for row in &rows[1..] {
        text.push_str(&line(row));
    }
    text.push_str("\n| host | sets | enumerations | outputs at the start |\n|---|---|---|---|\n");
    for Hosted { host, .. } in results {
        let enumerations = if host.enumerations { "yes" } else { "no: the FMU with integers" };
        let start = if host.reads_start { "yes" } else { "no" };
        text.push_str(&format!("| {} | {} | {enumerations} | {start} |\n", host.name, host.sets));
    }
    text.push_str("\n| scene | what |\n|---|---|\n");
    for Scene { name, told, .. } in scenes {
        text.push_str(&format!("| `{name}` | {}; steps of {} s |\n", told.description, told.step));
    }
    let (compared, different) = results
        .iter()
        .flat_map(|result| &result.deviations)
        .fold((0, 0), |sum, deviation| (sum.0 + deviation.compared, sum.1 + deviation.different));
    text.push_str(&format!(
        "\nDeviations are from fmpy, the largest over all outputs and communication points, relative to the value or, where \
         that is smaller, to the output's natural scale, which the scene tells. {compared} values were compared, {different} \
         of them have other bits.\n"
    ));
    text
}
