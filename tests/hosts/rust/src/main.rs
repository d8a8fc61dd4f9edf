//! The FMU in hosts written in Rust: `rust-hosts fmi-rs|fmi-rs-3|fmu-runner FMU SCENE.json OUT.csv`, as the Python scripts do it.

mod scene;
mod with_fmi_rs;
mod with_fmi_rs_3;
mod with_fmu_runner;

use std::error::Error;
use std::process::ExitCode;
use std::time::Instant;

use scene::{Rows, Scene};

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [host, fmu, scene, out] = arguments.as_slice() else {
        return Err("usage: rust-hosts fmi-rs|fmi-rs-3|fmu-runner FMU SCENE.json OUT.csv".into());
    };
    let (simulate, version): (fn(&str, &Scene) -> Result<Rows, Box<dyn Error>>, _) = match host.as_str() {
        "fmi-rs" => (with_fmi_rs::run, "0.3.4"),
        "fmi-rs-3" => (with_fmi_rs_3::run, "0.3.4"),
        "fmu-runner" => (with_fmu_runner::run, "0.4.4"),
        _ => return Err(format!("there is no host \"{host}\"; there are fmi-rs, fmi-rs-3 and fmu-runner").into()),
    };
    let scene = Scene::read(scene)?;
    let begin = Instant::now();
    let rows = simulate(fmu, &scene)?;
    let seconds = begin.elapsed().as_secs_f64();
    scene.write(&rows, out)?;
    println!("{}", serde_json::json!({ "version": version, "seconds": seconds }));
    Ok(())
}
