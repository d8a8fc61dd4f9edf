//! Initialises one instance a number of times with fmi2Reset in between: for counting the instructions of a first and of a
//! repeated initialisation.
//!
//! Arguments: number of initialisations, then variables as name=value (Booleans and choices as numbers).

#[path = "../tests/common/mod.rs"]
mod common;

use bevel_differential::fmi2::Status;
use bevel_differential::variables::{Access, named};
use common::Host;

/// A function of its own, so that its instructions can be counted.
#[inline(never)]
fn one_initialisation(host: &Host, set: &[(&str, f64)]) {
    for &(name, value) in set {
        let row = named(name).unwrap_or_else(|| panic!("no variable {name}"));
        let status = match row.access {
            Access::Integer(_) | Access::Enumeration(..) => host.set_integer(name, value as i32),
            Access::Boolean(_) => host.set_boolean(name, value as i32),
            _ => host.set(name, value),
        };
        assert_eq!(status, Status::Ok, "{name}");
    }
    host.start();
}

fn main() {
    // `cargo bench` calls every bench with this
    if std::env::args().any(|a| a == "--bench") {
        return;
    }
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [runs, set @ ..] = arguments.as_slice() else { panic!("number of initialisations") };
    let set: Vec<(&str, f64)> = set
        .iter()
        .map(|one| one.split_once('=').expect("name=value"))
        .map(|(name, value)| (name, value.parse().expect("a number")))
        .collect();
    let host = Host::with_logging(0);
    for run in 0..runs.parse::<u32>().expect("a number of initialisations") {
        if run > 0 {
            assert_eq!(host.reset(), Status::Ok);
        }
        one_initialisation(&host, &set);
    }
}
