//! Command line: `cargo run --release` does the study.

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::{Result, bail};
use fmu_build::check::fuzz::Fuzz;
use fmu_build::check::hosts::Hosts;
use fmu_build::check::{memcheck, platforms, real_time, zero_cost};
use fmu_build::fmu::{describe, package, plain_types, toolchains};
use fmu_build::gears::effects::job::Effects;
use fmu_build::gears::geometry::command::Geometry;
use fmu_build::gears::pattern::Pattern;
use fmu_build::gears::scene::job as scene_job;
use fmu_build::gears::study;
use fmu_build::measure::cost::Cost;
use fmu_build::measure::solids::Solids;
use fmu_build::measure::{compare_simulators, compare_solvers, drivetrain};
use fmu_build::tools::paths;
use fmu_build::tools::progress::Progress;
use fmu_build::tools::python::Environment;
use lexopt::prelude::*;

const USAGE: &str = "\
usage: cargo run --release [-- COMMAND]

  study [--readme]       package the FMU, simulate the study through fmpy, print the comparison (default);
                         --readme: also renew the table in README.md and the pictures in docs/images
  package [--integers]   build target/fmu/BevelDifferential.fmu, for every platform whose tool chain is there; --integers: also
                         BevelDifferential_integers.fmu, described without enumerations for hosts that know none
                         (libcosim, Ecos)
  toolchains [linux64|win64]
                         make the tool chains for old Linux systems and for Windows, with wine, or one of them, in
                         target/toolchains (Debian on x86-64, 400 MB to download, 2 GB on disk); packaging takes them from
                         then on
  platforms [--write]    simulate the same scenes with the library for each platform, Windows under wine, and compare the
                         bits of all outputs; fails if any differ; --write: also renew docs/platforms.md
  describe [--check]     write modelDescription/modelDescription.xml; --check: only tell whether it is stale
  scene [FILE|NAME] [--run] [--csv OUT.csv]
                         tell what a scene simulates; without one list the scenes; --run: simulate it and sum up its
                         outputs; --csv: also record them at each communication point
  loads --scene FILE|NAME --out OUT.csv [--every TIME]
                         record the force of each loaded tooth pair, with its place on both gears, for FEA; every
                         communication step, or every TIME such as 0.1ms
  geometry [--set NAME=VALUE]... [--facets N] [--thicken LENGTH] [--out DIR]
                         derive all dimensions of the gears, make curves and solids for CAD, and look for interference
                         while they turn: files in target/geometry or DIR; --set: a parameter of the gears, such as
                         geometry.module=4mm; --facets: per flank of solids and curves, 32; --thicken: look for
                         interference of teeth thicker by this, such as 0.15mm
  pattern [--scene FILE|NAME]... [--out DIR] [--write]
                         show the contact pattern of solid teeth, aligned and misaligned or in scenes of your own:
                         pressure on the planet's flank over one engagement, figures and CSV in target/pattern or DIR;
                         --write: also renew docs/pattern.md and its figures
  effects --scene FILE|NAME --accuracy 1% [--from TIME] [--as-written] [--csv OUT.csv] [--write [FILE]]
                         run a scene with each effect on and off: what each changes and costs, and which the scene calls
                         for; --from: count outputs from TIME on; --as-written: only look what it can do without, not
                         what it lacks; --csv: all changes by effect and output; --write: save the scene with these
                         effects alone, to reduced/NAME.toml beside it or to FILE
  test-python [ARG]...   package the FMU and run pytest on tests/python, with arguments for pytest
  cost [--quick] [--write] [--out DIR]
                         measure what accuracy costs: figures and CSV in target/cost or DIR; --quick: in under a minute;
                         --write: also renew docs/cost.md and docs/figures
  solids [--quick] [--write] [--out DIR]
                         what facets of solid teeth cost in accuracy and time, in the study's turn: figures and CSV in
                         target/solids or DIR; --quick: 4 to 32 facets over 0.1 s; --write: also renew docs/solids.md, the
                         table in README.md and docs/figures; fails if solids miss the mean force of exact teeth
  off [--quick] [--write]  compare builds that leave effects out with the full one: bits and instructions (needs
                         valgrind); --quick: one build without any; --write: also renew the table in docs/effects.md
  peers [--quick] [--write]  run MuJoCo and Drake beside this program on the study's cases, in an environment of their
                         own (a few minutes); --quick: a few rows, once; --write: also renew docs/compare.md
  foreign [--quick] [--write]  run scipy's LSODA and Radau and CVODE on the same equations beside this program's method
                         (many minutes); --quick: two cases, once; --write: also renew docs/foreign-solvers.md
  hosts [--write] [--require] [--with-fmi-sim]
                         run the FMU in other FMI hosts, all of them on the same scenes, and compare their answers with
                         fmpy's; --require: a host that cannot be loaded is an error; --with-fmi-sim: also hosts in Rust,
                         fmi-sim, fmi-rs and fmu-runner (builds for many minutes); --write: also renew docs/hosts.md
  drivetrain [--quick] [--write]  couple a whole drivetrain from FMUs in two hosts and compare it with all its equations at
                         once, error by communication step (many minutes); --quick: ideal gears, in a minute and a
                         half; --write: also renew docs/coupling.md
  real-time [--write]    count the instructions of every communication step of the fixed-step method; fails if one costs
                         more than twice the median (needs valgrind); --write: also renew the table in docs/cost.md
  fuzz [--calls N] [--seed S]
                         call the C functions at random, a million times or N, and hold every answer against what the FMU
                         promises; --seed: begin with the round of that seed
  memory                 hosts in C and calls at random under memcheck, which must find nothing and no leak (needs valgrind
                         and cc)
  help                   show this";

enum Job {
    Study { readme: bool },
    Package { integers: bool },
    Toolchains { platform: Option<String> },
    Platforms { write: bool },
    Describe { check: bool },
    Scene(scene_job::Scene),
    Loads(scene_job::Loads),
    Geometry(Geometry),
    Pattern(Pattern),
    Effects(Effects),
    Cost(Cost),
    Solids(Solids),
    TestPython(Vec<OsString>),
    Off { quick: bool, write: bool },
    Peers { quick: bool, write: bool },
    Foreign { quick: bool, write: bool },
    Drivetrain { quick: bool, write: bool },
    RealTime { write: bool },
    Hosts(Hosts),
    Fuzz(Fuzz),
    Memory,
    Help,
}

fn main() -> ExitCode {
    let job = match parse() {
        Ok(job) => job,
        Err(error) => {
            eprintln!("error: {error:#}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    match run(job) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn parse() -> Result<Job> {
    let mut arguments = lexopt::Parser::from_env();
    let mut job = None;
    while let Some(argument) = arguments.next()? {
        match (argument, &mut job) {
            (Short('h') | Long("help"), _) => return Ok(Job::Help),
            (Value(name), None) => job = Some(command(&name.string()?, &mut arguments)?),
            (Long("readme"), None) => job = Some(Job::Study { readme: true }),
            (Long("readme"), Some(Job::Study { readme })) => *readme = true,
            (Long("quick"), Some(Job::Off { quick, .. } | Job::Peers { quick, .. } | Job::Foreign { quick, .. })) => {
                *quick = true
            }
            (Long("write"), Some(Job::Off { write, .. } | Job::Peers { write, .. } | Job::Foreign { write, .. })) => {
                *write = true
            }
            (Long("quick"), Some(Job::Drivetrain { quick, .. })) => *quick = true,
            (Long("write"), Some(Job::Drivetrain { write, .. })) => *write = true,
            (Long("write"), Some(Job::RealTime { write })) => *write = true,
            (Long("integers"), Some(Job::Package { integers })) => *integers = true,
            (Long("require"), Some(Job::Hosts(hosts))) => hosts.require = true,
            (Long("write"), Some(Job::Hosts(hosts))) => hosts.write = true,
            (Long("with-fmi-sim"), Some(Job::Hosts(hosts))) => hosts.with_rust = true,
            (Value(name), Some(Job::Toolchains { platform })) if platform.is_none() => *platform = Some(name.string()?),
            (Long("write"), Some(Job::Platforms { write })) => *write = true,
            (Long("calls"), Some(Job::Fuzz(fuzz))) => fuzz.calls = arguments.value()?.parse()?,
            (Long("seed"), Some(Job::Fuzz(fuzz))) => fuzz.seed = arguments.value()?.parse()?,
            (Long("worker"), Some(Job::Fuzz(fuzz))) => fuzz.is_worker = true,
            (Long("check"), Some(Job::Describe { check })) => *check = true,
            (Value(name), Some(Job::Scene(scene))) if scene.name.is_none() => scene.name = Some(name.string()?),
            (Long("run"), Some(Job::Scene(scene))) => scene.run = true,
            (Long("csv"), Some(Job::Scene(scene))) => scene.csv = Some(arguments.value()?.into()),
            (Long("scene"), Some(Job::Loads(loads))) => loads.scene = Some(arguments.value()?.string()?),
            (Long("out"), Some(Job::Loads(loads))) => loads.out = Some(arguments.value()?.into()),
            (Long("every"), Some(Job::Loads(loads))) => loads.every = Some(arguments.value()?.string()?),
            (Long("set"), Some(Job::Geometry(geometry))) => geometry.set.push(arguments.value()?.string()?),
            (Long("facets"), Some(Job::Geometry(geometry))) => geometry.facets = Some(arguments.value()?.string()?),
            (Long("thicken"), Some(Job::Geometry(geometry))) => geometry.thicken = Some(arguments.value()?.string()?),
            (Long("out"), Some(Job::Geometry(geometry))) => geometry.out = Some(arguments.value()?.into()),
            (Long("scene"), Some(Job::Pattern(pattern))) => pattern.scenes.push(arguments.value()?.string()?),
            (Long("out"), Some(Job::Pattern(pattern))) => pattern.out = Some(arguments.value()?.into()),
            (Long("write"), Some(Job::Pattern(pattern))) => pattern.write = true,
            (Long("quick"), Some(Job::Cost(cost))) => cost.quick = true,
            (Long("write"), Some(Job::Cost(cost))) => cost.write = true,
            (Long("out"), Some(Job::Cost(cost))) => cost.out = Some(arguments.value()?.into()),
            (Long("quick"), Some(Job::Solids(solids))) => solids.quick = true,
            (Long("write"), Some(Job::Solids(solids))) => solids.write = true,
            (Long("out"), Some(Job::Solids(solids))) => solids.out = Some(arguments.value()?.into()),
            (Long("scene"), Some(Job::Effects(effects))) => effects.scene = Some(arguments.value()?.string()?),
            (Long("accuracy"), Some(Job::Effects(effects))) => effects.accuracy = Some(arguments.value()?.string()?),
            (Long("from"), Some(Job::Effects(effects))) => effects.from = Some(arguments.value()?.string()?),
            (Long("as-written"), Some(Job::Effects(effects))) => effects.as_written = true,
            (Long("csv"), Some(Job::Effects(effects))) => effects.csv = Some(arguments.value()?.into()),
            (Long("write"), Some(Job::Effects(effects))) => {
                effects.write = true;
                effects.file = file_that_follows(&mut arguments)?;
            }
            (argument, _) => return Err(argument.unexpected().into()),
        }
    }
    Ok(job.unwrap_or(Job::Study { readme: false }))
}

/// The value of an option that may go without one.
fn file_that_follows(arguments: &mut lexopt::Parser) -> Result<Option<PathBuf>> {
    if let Some(file) = arguments.optional_value() {
        return Ok(Some(file.into()));
    }
    let follows = arguments.try_raw_args().and_then(|mut rest| {
        let is_file = rest.peek().is_some_and(|next| !next.to_string_lossy().starts_with('-'));
        if is_file { rest.next() } else { None }
    });
    Ok(follows.map(PathBuf::from))
}

fn command(name: &str, arguments: &mut lexopt::Parser) -> Result<Job> {
    Ok(match name {
        "study" => Job::Study { readme: false },
        "package" => Job::Package { integers: false },
        "toolchains" => Job::Toolchains { platform: None },
        "platforms" => Job::Platforms { write: false },
        "describe" => Job::Describe { check: false },
        "scene" => Job::Scene(scene_job::Scene::default()),
        "loads" => Job::Loads(scene_job::Loads::default()),
        "geometry" => Job::Geometry(Geometry::default()),
        "pattern" => Job::Pattern(Pattern::default()),
        "effects" => Job::Effects(Effects::default()),
        "cost" => Job::Cost(Cost::default()),
        "solids" => Job::Solids(Solids::default()),
        "test-python" => Job::TestPython(arguments.raw_args()?.collect()),
        "off" => Job::Off { quick: false, write: false },
        "peers" => Job::Peers { quick: false, write: false },
        "foreign" => Job::Foreign { quick: false, write: false },
        "hosts" => Job::Hosts(Hosts::default()),
        "drivetrain" => Job::Drivetrain { quick: false, write: false },
        "fuzz" => Job::Fuzz(Fuzz::default()),
        "memory" => Job::Memory,
        "real-time" => Job::RealTime { write: false },
        "help" => Job::Help,
        _ => bail!("there is no command \"{name}\""),
    })
}

fn run(job: Job) -> Result<()> {
    match job {
        Job::Help => println!("{USAGE}"),
        Job::Off { quick, write } => zero_cost::run(quick, write)?,
        Job::Peers { quick, write } => compare_simulators::run(quick, write)?,
        Job::Foreign { quick, write } => compare_solvers::run(quick, write)?,
        Job::Hosts(hosts) => hosts.run()?,
        Job::Drivetrain { quick, write } => drivetrain::run(quick, write)?,
        Job::Fuzz(fuzz) => fuzz.run()?,
        Job::Memory => memcheck::run()?,
        Job::RealTime { write } => real_time::run(write)?,
        Job::Study { readme } => study::run(readme)?,
        Job::Package { integers } => {
            let progress = Progress::start("packaging the FMU");
            let packed = package::packed()?;
            let plain = if integers { Some(plain_types::package(&packed.fmu)?) } else { None };
            progress.finish();
            for file in std::iter::once(&packed.fmu).chain(&plain) {
                println!("{}", paths::shown(file));
            }
            if !packed.left_out.is_empty() {
                println!("{}", packed.left_out.join("; "));
            }
        }
        Job::Toolchains { platform } => toolchains::run(platform.as_deref())?,
        Job::Platforms { write } => platforms::run(write)?,
        Job::Describe { check } => {
            let file = paths::model_description();
            if check && describe::is_stale(&file)? {
                bail!("{} is stale; renew it: cargo run --release -- describe", paths::shown(&file));
            } else if !check {
                describe::write(&file)?;
            }
            println!("{} is up to date", paths::shown(&file));
        }
        Job::Scene(scene) => scene.run()?,
        Job::Loads(loads) => loads.run()?,
        Job::Geometry(geometry) => geometry.run()?,
        Job::Pattern(pattern) => pattern.run()?,
        Job::Effects(effects) => effects.run()?,
        Job::Cost(cost) => cost.run()?,
        Job::Solids(solids) => solids.run()?,
        Job::TestPython(arguments) => {
            let progress = Progress::start("looking for Python");
            let environment = Environment::ready(|what| progress.tell(what))?;
            progress.tell("packaging the FMU");
            let fmu = package::package()?;
            progress.tell("running pytest");
            let report = environment.test(&fmu, &arguments)?;
            progress.finish();
            print!("{report}");
        }
    }
    Ok(())
}
