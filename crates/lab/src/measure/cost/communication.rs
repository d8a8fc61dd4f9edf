//! The communication step: error of a coupled run against the host's step, with and without rollback.

use anyhow::Result;
use cpu_time::ThreadTime;

use super::cases::{Fidelity, Sample};
use super::coupling::{self, CoupledSystem, Coupling};
use super::measure::{self, TimedJob, cells};
use super::reference::errors;
use super::{CostPlan, measured_here, vehicle};
use answers::text::csv_file::number;
use answers::text::numbers::Spread;

/// The columns.
pub const COLUMNS: &str = "coupling,fidelity,h_s,status,message,runs,cpu_s,cpu_s_low,cpu_s_high,cost,speed_error,\
    force_error,order,steps,rhs_calls";

/// What is run: a coupling at a fidelity.
const RUNS: [(Coupling, Fidelity, &str); 6] = [
    (Coupling::Plain, Fidelity::Impact, "plain"),
    (Coupling::Rollback(1), Fidelity::Impact, "rollback_once"),
    (Coupling::Rollback(2), Fidelity::Impact, "rollback_twice"),
    (Coupling::None, Fidelity::Impact, "constant_inputs"),
    (Coupling::Plain, Fidelity::Ideal, "plain"),
    (Coupling::Rollback(2), Fidelity::Ideal, "rollback_twice"),
];
/// The step whose cost, in plain stepping with teeth, is the unit [s].
const UNIT: f64 = 1e-3;
/// Tolerance of the differential: small enough for the errors of coupling to show.
const TOLERANCE: f64 = 1e-9;
/// Tolerance of the reference without coupling.
const FINEST: f64 = 1e-11;

/// A run.
struct CouplingRun {
    run: usize,
    h: f64,
    outcome: Result<CouplingResult, String>,
}

struct CouplingResult {
    seconds: Spread,
    errors: [f64; 2],
    counts: [u64; 2],
}

/// Measures, and returns the CSV file. `report` receives the fraction done and the current job.
pub fn measure(form: &CostPlan, report: &mut dyn FnMut(f64, &str)) -> Result<String> {
    let mut rows = Vec::new();
    let mut firsts = Vec::new();
    let starts: Vec<CoupledSystem> =
        RUNS.iter().map(|(_, fidelity, _)| CoupledSystem::start(*fidelity, TOLERANCE)).collect::<Result<_>>()?;
    let share = 1.0 / (1.0 + form.runs as f64);
    report(0.0, "coupled run in one piece");
    let references: Vec<Vec<Sample>> = RUNS
        .iter()
        .map(|(coupling, fidelity, _)| match coupling {
            Coupling::None => {
                let finest = CoupledSystem::start(*fidelity, FINEST)?.samples(coupling::TIMES[0], *coupling);
                finest.map(|found| found.0).map_err(|why| anyhow::anyhow!("run with constant inputs: {why}"))
            }
            _ => coupling::in_one_piece(*fidelity),
        })
        .collect::<Result<_>>()?;
    for (run, (coupling, ..)) in RUNS.iter().enumerate() {
        report(share * run as f64 / RUNS.len() as f64, "coupled runs: errors");
        for &h in form.communication_steps {
            let begun = ThreadTime::now();
            let outcome = starts[run].clone().samples(h, *coupling).and_then(|(samples, counts)| {
                let errors = errors(&references[run], &samples);
                let finite = errors.iter().all(|error| error.is_finite());
                finite
                    .then_some(CouplingResult { seconds: Spread::of(&[]), errors, counts })
                    .ok_or_else(|| "results are no numbers".to_owned())
            });
            firsts.push(begun.elapsed().as_secs_f64());
            rows.push(CouplingRun { run, h, outcome });
        }
    }
    let mut jobs = Vec::new();
    for (row, first) in rows.iter().zip(&firsts).filter(|(row, _)| row.outcome.is_ok()) {
        let (start, coupling, h) = (&starts[row.run], RUNS[row.run].0, row.h);
        let run = Box::new(move || {
            // it has run to its end before
            let _ = start.clone().run(h, coupling, |_| {});
        });
        jobs.push(TimedJob { run, first: *first });
    }
    let times = measure::time(&mut jobs, form.runs, &mut |done| {
        report(share + (1.0 - share) * done, "coupled runs: times");
    });
    drop(jobs);
    let measured = rows.iter_mut().filter_map(|row| row.outcome.as_mut().ok());
    measured.zip(times).for_each(|(measured, seconds)| measured.seconds = seconds);
    text(&rows)
}

fn text(rows: &[CouplingRun]) -> Result<String> {
    let of = |run: usize, h: f64| {
        let row = rows.iter().find(|row| row.run == run && row.h == h);
        row.and_then(|row| row.outcome.as_ref().ok())
    };
    let unit = of(0, UNIT).map_or(f64::NAN, |m| m.seconds.median);
    let mut out = measured_here(
        COLUMNS,
        &[
            "a car accelerates with its left wheel on ice; tyres and car in the host, differential and wheels in the FMU",
            "errors against the whole in one piece (classical Runge-Kutta), of constant_inputs against tolerance 1e-11",
            "cost: cpu_s over that of plain stepping with teeth at 1e-3 s; order: between this step and the next smaller",
            "steps, rhs_calls: of steps that were kept; those taken back are in the times only",
            &format!("longest stable plain step by the tyre's slope, s: {}", number(vehicle::longest_stable_step())),
        ],
    )?;
    for (i, row) in rows.iter().enumerate() {
        let (_, fidelity, name) = RUNS[row.run];
        let (status, message, numbers) = match &row.outcome {
            Ok(m) => {
                let before = i.checked_sub(1).map(|i| &rows[i]).filter(|before| before.run == row.run);
                let order = before.and_then(|before| {
                    let errors = m.errors[0] / before.outcome.as_ref().ok()?.errors[0];
                    Some(errors.ln() / (row.h / before.h).ln())
                });
                let [median, low, high, count] = cells(&m.seconds);
                let mut cells = vec![count, median, low, high, number(m.seconds.median / unit)];
                cells.extend(m.errors.map(number));
                cells.push(number(order.unwrap_or(f64::NAN)));
                cells.extend(m.counts.map(|n| n.to_string()));
                ("ok", "", cells)
            }
            Err(why) => ("failed", why.as_str(), [vec!["0".to_owned()], vec!["nan".to_owned(); 9]].concat()),
        };
        let texts = [name, fidelity.name(), &number(row.h), status, message].map(str::to_owned);
        out.push(texts.into_iter().chain(numbers))?;
    }
    out.text()
}
