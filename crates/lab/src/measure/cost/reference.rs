//! What errors are measured against, and how far that can be trusted.
//!
//! A reference should come from equations and a solver that are not the program's: the files tests/data/reference_*.csv
//! are a plain model in Python as scipy integrates it at 1e-12. Where there is none, two methods of this program that
//! share no code but the equations stand in, at 1e-11; the source is recorded with its error.

use std::fs;

use anyhow::{Context, Result, anyhow};
use bevel_differential::model::Method;

use super::cases::{CaseMotion, CostCase, Fidelity, Sample};
use super::measure::largest_error;
use fmu_build::tools::paths;

/// Tolerance of the methods that replace a reference.
const TOLERANCE: f64 = 1e-11;
/// Times that differ by less are the same [s].
const SAME: f64 = 1e-9;
/// Columns of a file that are compared, as `Sample` has them.
const COLUMNS: [&str; 4] = ["left.speed", "right.speed", "planet[1].left_normal_force", "planet[1].right_normal_force"];

/// A solution to compare with.
pub struct Reference {
    /// At the times of the case.
    pub samples: Vec<Sample>,
    /// Where it comes from.
    pub source: String,
    /// Its own error, in the same measure.
    pub error: [f64; 2],
}

/// The reference for `case`.
pub fn of(case: &CostCase) -> Result<Reference> {
    if let (CaseMotion::Turn, Fidelity::Ideal) = (case.motion, case.fidelity) {
        return closed_form(case);
    }
    match file(case) {
        Some(name) => from_file(case, name),
        None => by_two_methods(case),
    }
}

/// Name of the file for `case`, if there is one.
fn file(case: &CostCase) -> Option<String> {
    let name = match (case.motion, case.fidelity) {
        (CaseMotion::Turn, Fidelity::Impact) => "turn_equilibrium",
        (CaseMotion::Blow, Fidelity::Impact) => "turn_rolling",
        _ => return None,
    };
    let name = format!("reference_{name}.csv");
    paths::workspace().join("tests").join("data").join(&name).is_file().then_some(name)
}

/// Nothing is solved in a turn of ideal gears with imposed speeds: Willis' equation and static forces.
fn closed_form(case: &CostCase) -> Result<Reference> {
    let simulation = case.start(Method::Adaptive, TOLERANCE, 1.0)?;
    let ratio = f64::from(case.parameters.geometry.planet_teeth) / f64::from(case.parameters.geometry.side_teeth);
    let [mean, half] = [case.then.carrier_speed, ratio * case.then.planet_spin];
    let force = simulation.clone().forces().mesh[0].map(|mesh| mesh.normal);
    let sample = Sample { speed: [mean + half, mean - half], force };
    Ok(Reference::new(vec![sample; case.times.len()], "closed form".into(), [0.0; 2]))
}

fn from_file(case: &CostCase, name: String) -> Result<Reference> {
    let path = paths::workspace().join("tests").join("data").join(&name);
    let text = fs::read_to_string(&path).with_context(|| format!("{name} cannot be read"))?;
    let samples = parse(&text, &case.times).with_context(|| name.clone())?;
    // the file states how far scipy's Radau is from its DOP853, by column
    let stray = |column: &str| -> Option<f64> {
        let (_, rest) = text
            .lines()
            .find(|l| l.starts_with('#') && l.contains(&format!("{column} ")) && l.contains("e-"))?
            .split_once(&format!("{column} "))?;
        rest.split([',', ' ']).next()?.parse().ok()
    };
    let worst = |columns: &[&str]| columns.iter().filter_map(|column| stray(column)).fold(0.0, f64::max);
    let error = [worst(&COLUMNS[..2]), worst(&COLUMNS[2..])];
    Ok(Reference::new(samples, format!("scipy DOP853 1e-12 on a plain model ({name})"), error))
}

/// Samples at `times` from the text of a file.
fn parse(text: &str, times: &[f64]) -> Result<Vec<Sample>> {
    let mut file = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let names = file.headers()?.clone();
    let place = |name: &str| names.iter().position(|n| n == name).with_context(|| format!("has no column {name}"));
    let columns = COLUMNS.into_iter().map(place).collect::<Result<Vec<_>>>()?;
    let rows = file.deserialize().collect::<Result<Vec<Vec<f64>>, _>>()?;
    let sample = |&time: &f64| {
        let row = rows.iter().find(|row| (row[0] - time).abs() < SAME);
        let row = row
            .with_context(|| format!("has no row for {time} s: renew the file with tests/python/make_reference.py"))?;
        let [speed, force] = [0, 2].map(|k| [row[columns[k]], row[columns[k + 1]]]);
        Ok(Sample { speed, force })
    };
    times.iter().map(sample).collect()
}

/// Radau and Rodas5P of this program; they share the equations and the error control, but no formula of a step.
fn by_two_methods(case: &CostCase) -> Result<Reference> {
    let [radau, rodas] = [Method::Radau, Method::Adaptive].map(|method| -> Result<Vec<Sample>> {
        let simulation = case.start(method, TOLERANCE, 1.0)?;
        case.samples(simulation, f64::INFINITY)
            .map(|found| found.0)
            .map_err(|why| anyhow!("case {}: {why}", case.name()))
    });
    let (radau, rodas) = (radau?, rodas?);
    let mut reference = Reference::new(radau, "own Radau 1e-11, checked by own Rodas5P 1e-11".into(), [0.0; 2]);
    reference.error = reference.errors(&rodas);
    Ok(reference)
}

impl Reference {
    fn new(samples: Vec<Sample>, source: String, error: [f64; 2]) -> Self {
        Self { samples, source, error }
    }

    /// Errors of `samples` in speed and force.
    pub fn errors(&self, samples: &[Sample]) -> [f64; 2] {
        errors(&self.samples, samples)
    }
}

/// Largest speed [rad/s] and mean force [N].
fn scales(samples: &[Sample]) -> [f64; 2] {
    let speeds = samples.iter().flat_map(|s| s.speed);
    let forces = samples.iter().flat_map(|s| s.force);
    let mean = forces.map(f64::abs).sum::<f64>() / (2 * samples.len()) as f64;
    [speeds.map(f64::abs).fold(0.0, f64::max), mean]
}

/// Errors in speed and force: the largest difference, over the largest speed and the mean force of `reference`.
pub fn errors(reference: &[Sample], samples: &[Sample]) -> [f64; 2] {
    let pairs = |of: fn(&Sample) -> [f64; 2]| {
        let both = reference.iter().zip(samples);
        both.flat_map(move |(a, b)| of(a).into_iter().zip(of(b)))
    };
    let [fastest, mean] = scales(reference);
    [largest_error(pairs(|s| s.speed), fastest), largest_error(pairs(|s| s.force), mean)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_relative_to_the_largest_speed_and_the_mean_force() {
        let sample = |speed: f64, force: f64| Sample { speed: [speed, 0.0], force: [force, force] };
        let reference = Reference::new(vec![sample(10.0, 100.0), sample(-20.0, 300.0)], String::new(), [0.0; 2]);
        assert_eq!(scales(&reference.samples), [20.0, 200.0]);
        let errors = reference.errors(&[sample(10.0, 100.0), sample(-19.0, 280.0)]);
        assert_eq!(errors, [0.05, 0.1]);
    }

    #[test]
    fn a_file_is_read_at_the_times_asked_for_and_says_what_it_lacks() {
        let text = "# a line\ntime,left.speed,right.speed,planet[1].left_normal_force,x,planet[1].right_normal_force\n\
                    0,1,2,3,9,4\n0.1,5,6,7,9,8\n";
        let found = parse(text, &[0.1]).expect("parses");
        assert_eq!(found, [Sample { speed: [5.0, 6.0], force: [7.0, 8.0] }]);
        assert!(parse(text, &[0.2]).expect_err("no such time").to_string().contains("0.2 s"));
        assert!(parse("time\n0\n", &[0.0]).expect_err("no such column").to_string().contains("left.speed"));
    }

    #[test]
    fn ideal_gears_in_a_turn_are_their_closed_form() {
        let case = CostCase::new(CaseMotion::Turn, Fidelity::Ideal).expect("case");
        let simulation = case.start(Method::Adaptive, 1e-2, 1.0).expect("starts");
        let (samples, _) = case.samples(simulation, f64::INFINITY).expect("runs");
        let errors = of(&case).expect("reference").errors(&samples);
        assert!(errors.iter().all(|error| *error < 1e-14), "{errors:?}");
    }
}
