//! The C functions called from outside: at random, and by hosts written in C. Long runs are the commands `fuzz` and `memory`.

use std::ffi::OsString;
use std::process::Command;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use fmu_build::fmu::own;
use lab::check::fuzz::{self, Function, Tally};
use lab::check::memcheck;

/// Calls of the short run.
const CALLS: usize = 4000;
/// Least part of the calls that must be carried out: a run of refusals shows little.
const DONE: f64 = 0.4;
/// Least steps of either kind in a thousand calls.
const STEPS: u64 = 5;

#[test]
fn calls_at_random_keep_every_promise() {
    let mut tally = Tally::default();
    for seed in 1..=(CALLS / fuzz::CALLS) as u64 {
        if let Err(broken) = fuzz::run(seed, fuzz::CALLS, &mut tally) {
            panic!("{broken:?}\nagain: {}", fuzz::again(seed));
        }
    }
    assert_eq!(tally.calls(), CALLS as u64);
    let done: u64 = Function::ALL.iter().map(|&f| tally.returned_ok(f)).sum();
    assert!(done as f64 > DONE * CALLS as f64, "{done} calls of {CALLS} were carried out");
    for step in [Function::fmi2DoStep, Function::fmi2CompletedIntegratorStep] {
        assert!(
            tally.returned_ok(step) * 1000 >= STEPS * CALLS as u64,
            "{step:?}: {} carried out",
            tally.returned_ok(step)
        );
    }
}

/// A round in which a step has more mesh cycles than can be counted one by one.
#[test]
fn a_round_at_absurd_speeds_ends() {
    let (send, outcome) = mpsc::channel();
    thread::spawn(move || send.send(fuzz::run(215, fuzz::CALLS, &mut Tally::default())));
    outcome.recv_timeout(Duration::from_secs(120)).expect("the round hangs").unwrap();
}

#[test]
fn the_same_seed_makes_the_same_calls() {
    let counts = |seed| {
        let mut tally = Tally::default();
        fuzz::run(seed, fuzz::CALLS, &mut tally).unwrap();
        (
            Function::ALL.iter().map(|&f| tally.returned_ok(f)).collect::<Vec<_>>(),
            tally.started_instances,
            tally.compared,
        )
    };
    assert_eq!(counts(5), counts(5));
    assert_ne!(counts(5), counts(6));
}

#[test]
fn a_tally_says_what_was_called() {
    let mut tally = Tally::default();
    fuzz::run(3, 100, &mut tally).unwrap();
    let tally_json = tally.json();
    let rows = tally_json["rows"].as_array().unwrap();
    let statuses = rows.iter().flat_map(|row| row["statuses"].as_array().unwrap());
    assert_eq!(statuses.map(|count| count.as_u64().unwrap()).sum::<u64>(), 100);
    assert!(tally_json["longest"]["function"].as_str().unwrap().starts_with("fmi2"));
}

#[test]
#[cfg(target_os = "linux")]
fn the_library_exports_the_functions_of_fmi_and_nothing_else() {
    let library = own::beside_program().unwrap();
    let output = Command::new("nm").args(["-D", "--defined-only"]).arg(&library).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let listed = String::from_utf8(output.stdout).unwrap();
    let all = listed.lines().filter_map(|line| line.split_whitespace().last());
    // a test in Python compares the names of FMI 3.0 with fmpy's list
    let (third, mut exported): (Vec<&str>, Vec<&str>) = all.partition(|name| name.starts_with("fmi3"));
    assert_eq!(third.len(), 75, "functions of FMI 3.0.2");
    let mut known: Vec<&str> = Function::ALL.iter().map(|f| f.name()).collect();
    exported.sort_unstable();
    known.sort_unstable();
    assert_eq!(exported, known);
}

/// Runs a host in C on the library and returns what it printed.
#[cfg(target_os = "linux")]
fn host(name: &str, further: &[OsString]) -> String {
    let library = own::beside_program().unwrap();
    let program = memcheck::compiled(name, &[]).unwrap();
    let output = Command::new(&program).args(memcheck::arguments(&library).unwrap()).args(further).output().unwrap();
    std::fs::remove_file(&program).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
#[cfg(target_os = "linux")]
fn a_host_in_c_leads_instances_of_both_kinds_through_their_lives() {
    assert!(host("life", &["2000".into()]).ends_with("messages\n"));
}

#[test]
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
fn what_belongs_to_the_host_stays_as_it_was() {
    let said = host("surroundings", &[memcheck::reference("inertia.left_end").unwrap()]);
    // numbers too small to be normal play no part
    assert!(said.contains("flush_to_zero 0\n"), "{said}");
    // other ways to round move the speed by less than the solver's tolerance
    for mode in ["upward", "downward", "toward_zero"] {
        let moved = said.lines().find_map(|line| line.strip_prefix(mode)).unwrap();
        assert!(moved.trim().parse::<f64>().unwrap() < 1e-6, "{said}");
    }
    // the host may trap invalid operations, divisions by zero and overflows
    assert_eq!(said.matches(" runs\n").count(), 3, "{said}");
}
