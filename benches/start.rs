//! Prints the times of starts with gears that were never started before. `cargo bench --bench start -- LAW 1` executes
//! only one start, for counting instructions: LAW is impact, line, line_weber or lumped.

use std::hint::black_box;
use std::time::Instant;

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Inputs, Parameters, Simulation};

/// Number of starts of a law. The median is reported.
const RUNS: usize = 41;

/// The default scene with the law `name`.
fn parameters(name: &str) -> Parameters {
    let mut p = Parameters::default();
    match name {
        "impact" => p.contact.law = ContactLaw::Impact,
        "line" => p.contact.law = ContactLaw::Line,
        "line_weber" => p.contact.law = ContactLaw::LineWeber,
        "lumped" => p.scene.gear_contact = GearContact::Lumped,
        _ => panic!("there is no law {name}"),
    }
    p
}

/// A separate function, so that its instructions can be counted. `Simulation::start` uses no cache.
#[inline(never)]
fn one_start(p: &Parameters, i: &Inputs) {
    black_box(Simulation::start(p, i, 0.0).expect("the scene starts"));
}

fn main() {
    let named: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let inputs = Inputs::default();
    if let [name] = named.as_slice() {
        return one_start(&parameters(name), &inputs);
    }
    for name in ["impact", "line", "line_weber", "lumped"] {
        let p = parameters(name);
        let mut times: Vec<f64> = (0..RUNS)
            .map(|_| {
                let begin = Instant::now();
                one_start(&p, &inputs);
                begin.elapsed().as_secs_f64()
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!("first start, {name}: {:.3} ms", times[RUNS / 2] * 1e3);
    }
}
