//! Calls of the C functions from outside: at random, and by hosts written in C. The commands `fuzz` and `memcheck` make
//! longer runs.

use std::process::Command;

use bevel_differential::variables::{guid, index_of};
use fmu_build::fmu::libraries::own;
use fmu_build::tools::paths;
use lab::fuzz::{self, Tally, VERSIONS};

/// Number of calls of the short run of each version of FMI, and of one of its rounds.
const CALLS: usize = 4000;
const ROUND: usize = 500;
/// Minimum fraction of calls that must be carried out, because a run with many refusals shows little.
const DONE: f64 = 0.4;
/// Minimum number of steps of either kind, and of updates within steps, in a thousand calls.
const STEPS: u64 = 5;

#[test]
fn calls_at_random_keep_every_promise() {
    for version in VERSIONS {
        let mut tally = Tally::default();
        for seed in 1..=(CALLS / ROUND) as u64 {
            if let Err(broken) = fuzz::run(version, seed, ROUND, &mut tally) {
                let number = version.interface.number;
                panic!(
                    "{broken:?}\nagain: python3 crates/lab/lab.py fuzz --fmi {number} --calls {ROUND} --seed {seed}"
                );
            }
        }
        assert_eq!(tally.calls(), CALLS as u64);
        let done: u64 = version.functions.iter().map(|function| tally.returned_ok(function.name)).sum();
        assert!(done as f64 > DONE * CALLS as f64, "{done} calls of {CALLS} were carried out");
        for step in ["DoStep", "CompletedIntegratorStep"] {
            let done = tally.returned_ok(&format!("fmi{}{step}", version.interface.number));
            assert!(done * 1000 >= STEPS * CALLS as u64, "{step}: {done} carried out");
        }
        let has_updates = tally.updates * 1000 >= STEPS * CALLS as u64;
        assert_eq!(version.interface.number > 2, has_updates, "{} updates within steps", tally.updates);
    }
}

#[test]
fn seeds_take_both_versions_in_turn() {
    let numbers = |given| [1, 2, 3].map(|seed| fuzz::version(seed, given).interface.number);
    assert_eq!(numbers(None), [3, 2, 3]);
    assert_eq!(numbers(Some(2)), [2; 3]);
}

#[test]
fn the_same_seed_makes_the_same_calls() {
    for version in VERSIONS {
        let counts = |seed| {
            let mut tally = Tally::default();
            fuzz::run(version, seed, ROUND, &mut tally).unwrap();
            let done: Vec<u64> = version.functions.iter().map(|function| tally.returned_ok(function.name)).collect();
            (done, tally.started_instances, tally.compared)
        };
        assert_eq!(counts(5), counts(5));
        assert_ne!(counts(5), counts(6));
    }
}

#[test]
fn a_tally_counts_the_called_functions() {
    let mut tally = Tally::default();
    fuzz::run(VERSIONS[1], 3, 100, &mut tally).unwrap();
    let tally_json = tally.json();
    let rows = tally_json["rows"].as_array().unwrap();
    let statuses = rows.iter().flat_map(|row| row["statuses"].as_array().unwrap());
    assert_eq!(statuses.map(|count| count.as_u64().unwrap()).sum::<u64>(), 100);
    assert!(tally_json["longest"]["function"].as_str().unwrap().starts_with("fmi3"));
}

#[test]
#[cfg(target_os = "linux")]
fn the_library_exports_the_functions_of_fmi_and_nothing_else() {
    let library = own::beside_program().unwrap();
    let output = Command::new("nm").args(["-D", "--defined-only"]).arg(&library).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let listed = String::from_utf8(output.stdout).unwrap();
    let all = listed.lines().filter_map(|line| line.split_whitespace().last());
    let mut exported: Vec<&str> = all.collect();
    // a test in Python compares the names of FMI 3.0 with fmpy's list
    assert_eq!(VERSIONS[1].functions.len(), 75, "functions of FMI 3.0.2");
    let mut known: Vec<&str> = VERSIONS.iter().flat_map(|version| version.functions).map(|f| f.name).collect();
    exported.sort_unstable();
    known.sort_unstable();
    assert_eq!(exported, known);
}

/// Value reference of a variable, as an argument.
#[cfg(target_os = "linux")]
fn reference(name: &str) -> String {
    index_of(name).unwrap().to_string()
}

/// Runs a host in C on the library and returns what it printed. The command `memcheck` passes the same arguments.
#[cfg(target_os = "linux")]
fn host(name: &str, further: &[String]) -> String {
    let folder = paths::target().join("memory");
    paths::create_folder(&folder).unwrap();
    // tests compile concurrently: each uses a separate file
    let program = folder.join(format!("{name}-{}", std::process::id()));
    let mut compiler = Command::new("cc");
    compiler.args(["-std=gnu11", "-O1", "-g", "-Wall", "-Wextra", "-Werror", "-o"]).arg(&program);
    compiler.arg(paths::workspace().join("tests/c").join(format!("{name}.c"))).args(["-ldl", "-lm"]);
    let compiled = compiler.output().expect("a C compiler builds the hosts: install one (apt-get install gcc)");
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let references = [reference("left.load_torque"), reference("left.speed")];
    let mut command = Command::new(&program);
    command.arg(own::beside_program().unwrap()).arg(guid()).args(references).args(further);
    let output = command.output().unwrap();
    std::fs::remove_file(&program).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
#[cfg(target_os = "linux")]
fn a_host_in_c_uses_instances_of_both_kinds_from_creation_to_end() {
    assert!(host("life", &[]).ends_with("messages\n"));
}

#[test]
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
fn the_hosts_floating_point_settings_are_preserved() {
    let said = host("surroundings", &[reference("inertia.left_end")]);
    // denormal numbers have no influence
    assert!(said.contains("flush_to_zero 0\n"), "{said}");
    // other rounding modes change the speed by less than the solver's tolerance
    for mode in ["upward", "downward", "toward_zero"] {
        let moved = said.lines().find_map(|line| line.strip_prefix(mode)).unwrap();
        assert!(moved.trim().parse::<f64>().unwrap() < 1e-6, "{said}");
    }
    // the host may trap invalid operations, divisions by zero and overflows
    assert_eq!(said.matches(" runs\n").count(), 3, "{said}");
}
