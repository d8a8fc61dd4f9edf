//! The packaged FMU in other hosts: each host on each scene, all compared with fmpy; one table.

mod compare;
mod list;
mod run;

use anyhow::{Context, Result, bail};
use clap::Args;

use answers::text::table::Table;
use compare::{Deviation, HostRecord};
use fmu_build::fmu::{package, plain_types};
use fmu_build::tools::progress::Progress;
use fmu_build::tools::{paths, sections};
use list::{HOSTS, Host};
use run::{HostBench, HostOutcome, HostScene};

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
struct HostResults {
    host: &'static Host,
    version: String,
    seconds: f64,
    deviations: Vec<Deviation>,
}

impl HostsCommand {
    /// Runs all hosts on all scenes, prints the table, and with `write` puts it into docs/hosts.md.
    pub fn run(self) -> Result<()> {
        let progress = Progress::start("looking for Python");
        let bench = HostBench::ready(self.with_rust, |what| progress.stage(what))?;
        progress.stage("packaging the FMU");
        let fmu = package::package()?;
        let plain = plain_types::package(&fmu)?;
        let scenes = run::scenes()?;
        let (mut results, mut absent) = (Vec::new(), Vec::new());
        let mut references: Vec<HostRecord> = Vec::new();
        progress.begin_bar("running hosts");
        for (done, host) in HOSTS.iter().enumerate() {
            progress.advance(done as f64 / HOSTS.len() as f64, host.name);
            let mut result = HostResults { host, version: String::new(), seconds: 0.0, deviations: Vec::new() };
            for (k, scene) in scenes.iter().enumerate() {
                let out = bench.folder.join(format!("{}_{}.csv", scene.name, host.name.replace(", ", "_")));
                let fmu = if host.enumerations { &fmu } else { &plain };
                let ran = match bench.run(host, scene, fmu, &out)? {
                    HostOutcome::Ran(ran) => ran,
                    HostOutcome::Absent(why) => {
                        absent.push((host, why));
                        break;
                    }
                };
                let record = HostRecord::read(&out)?;
                if references.len() == k {
                    references.push(record.clone());
                }
                let scale = |name: &str| scene.file.outputs.get(name).copied();
                let deviation = references[k].deviation(&record, !host.reads_start, scale);
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
        print!("{}", deviations(&results, &scenes).terminal());
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
fn judge(results: &[HostResults], scenes: &[HostScene]) -> Result<()> {
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

/// The deviations of each host by scene.
fn deviations(results: &[HostResults], scenes: &[HostScene]) -> Table {
    let head = ["host", "version", "language", "import"].into_iter();
    let mut table =
        Table::new(head.chain(scenes.iter().map(|scene| scene.name.as_str())).chain(["time, s"])).left(0..4);
    for result in results {
        let Host { name, language, import, .. } = *result.host;
        let mut row = [name, &result.version, language, import].map(str::to_owned).to_vec();
        row.extend(result.deviations.iter().map(cell));
        row.push(format!("{:.2}", result.seconds));
        table.push(row);
    }
    table
}

fn cell(deviation: &Deviation) -> String {
    if deviation.different == 0 { "same bits".to_owned() } else { format!("{:.1e}", deviation.largest) }
}

fn markdown(results: &[HostResults], scenes: &[HostScene]) -> String {
    let mut hosts = Table::new(["host", "sets", "enumerations", "outputs at the start"]).all_left();
    for HostResults { host, .. } in results {
        let enumerations = if host.enumerations { "yes" } else { "no: the FMU with integers" };
        hosts.push([host.name, host.sets, enumerations, if host.reads_start { "yes" } else { "no" }]);
    }
    let mut what = Table::new(["scene", "what"]).all_left();
    for HostScene { name, file, .. } in scenes {
        what.push([format!("`{name}`"), format!("{}; steps of {} s", file.description, file.step)]);
    }
    let tables = [deviations(results, scenes), hosts, what].map(|table| table.markdown());
    let (compared, different) = results
        .iter()
        .flat_map(|result| &result.deviations)
        .fold((0, 0), |sum, deviation| (sum.0 + deviation.compared, sum.1 + deviation.different));
    format!(
        "{}\nDeviations are from fmpy, the largest over all outputs and communication points, relative to the value or, where \
         that is smaller, to the output's natural scale, which the scene states. {compared} values were compared, {different} \
         of them have other bits.\n",
        tables.join("\n")
    )
}
