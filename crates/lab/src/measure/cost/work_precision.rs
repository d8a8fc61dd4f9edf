//! Work and precision: every case by every method, over tolerances and steps, against its reference.

use anyhow::Result;
use bevel_differential::integrate::Statistics;
use bevel_differential::model::Method;
use cpu_time::ThreadTime;

use super::cases::CostCase;
use super::measure::{self, TimedJob, cells};
use super::reference::{self, Reference};
use super::{CostPlan, measured_here};
use answers::text::csv_file::number;
use answers::text::numbers::Spread;

/// The columns.
pub const COLUMNS: &str = "case,motion,fidelity,method,setting,unit,status,message,runs,cpu_s,cpu_s_low,cpu_s_high,\
    cost,speed_error,force_error,steps,rejected,rhs_calls,jacobians,reference,reference_speed_error,\
    reference_force_error";

/// The tolerance that the default method has unless it is set.
pub const DEFAULT_TOLERANCE: f64 = 1e-6;

/// A method with its tolerance, or its step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MethodSetting {
    /// The method.
    pub method: Method,
    /// Tolerance, or fixed step [s].
    pub value: f64,
}

/// What was found of a case with a setting.
pub struct MethodRun {
    /// Number of the case.
    pub case: usize,
    /// The setting.
    pub setting: MethodSetting,
    /// What it took and gave, or why it failed.
    pub outcome: Result<MethodResult, String>,
}

/// A run that came to its end.
pub struct MethodResult {
    /// Seconds on the processor.
    pub seconds: Spread,
    /// Errors of speed and force.
    pub errors: [f64; 2],
    /// What the solver did.
    pub statistics: Statistics,
}

/// All of it.
pub struct WorkPrecision {
    /// Cases with their references.
    pub cases: Vec<(CostCase, Reference)>,
    /// A row for each case and setting.
    pub rows: Vec<MethodRun>,
}

/// The methods, the default first.
pub const METHODS: [(Method, &str); 5] = [
    (Method::Adaptive, "adaptive"),
    (Method::Radau, "radau"),
    (Method::Rodas4, "rodas4"),
    (Method::DormandPrince, "dormand_prince"),
    (Method::FixedStep, "fixed_step"),
];

/// Name of a method, as `solver.method` has it.
pub fn name(method: Method) -> &'static str {
    METHODS.iter().find(|(other, _)| *other == method).map_or("", |(_, name)| name)
}

impl MethodSetting {
    /// All settings.
    pub fn all(form: &CostPlan) -> Vec<Self> {
        let of = |method: Method| {
            let values = if method == Method::FixedStep { form.fixed_steps } else { form.tolerances };
            values.iter().map(move |&value| Self { method, value })
        };
        METHODS.iter().flat_map(|(method, _)| of(*method)).collect()
    }

    /// Unit of the value.
    pub fn unit(&self) -> &'static str {
        if self.method == Method::FixedStep { "s" } else { "1" }
    }

    fn start(&self, case: &CostCase) -> Result<bevel_differential::model::Simulation> {
        // the method with fixed steps has no tolerance, nor the others a step
        case.start(
            self.method,
            if self.method == Method::FixedStep { DEFAULT_TOLERANCE } else { self.value },
            self.value,
        )
    }
}

/// Measures. `report` receives the fraction done and the current job.
pub fn measure(form: &CostPlan, report: &mut dyn FnMut(f64, &str)) -> Result<WorkPrecision> {
    let settings = MethodSetting::all(form);
    let cases = CostCase::all()?;
    let mut found = WorkPrecision { cases: Vec::new(), rows: Vec::new() };
    let mut firsts = Vec::new();
    // running once, for the errors, takes about as long as a round of measuring times
    let share = 1.0 / (1.0 + form.runs as f64);
    for (i, case) in cases.into_iter().enumerate() {
        report(share * i as f64 / 11.0, &format!("{}: errors", case.name()));
        let reference = reference::of(&case)?;
        for &setting in &settings {
            let simulation = setting.start(&case)?;
            let begun = ThreadTime::now();
            let outcome = case.samples(simulation, form.patience).and_then(|(samples, statistics)| {
                let errors = reference.errors(&samples);
                if errors.iter().all(|error| error.is_finite()) {
                    Ok(MethodResult { seconds: Spread::of(&[]), errors, statistics })
                } else {
                    Err("results are no numbers".into())
                }
            });
            firsts.push(begun.elapsed().as_secs_f64());
            found.rows.push(MethodRun { case: i, setting, outcome });
        }
        found.cases.push((case, reference));
    }
    let mut jobs = Vec::new();
    for (row, first) in found.rows.iter().zip(&firsts).filter(|(row, _)| row.outcome.is_ok()) {
        let case = &found.cases[row.case].0;
        let simulation = row.setting.start(case)?;
        let run = Box::new(move || {
            // it has run to its end before
            let _ = case.run(simulation.clone(), f64::INFINITY, |_| {});
        });
        jobs.push(TimedJob { run, first: *first });
    }
    let times =
        measure::time(&mut jobs, form.runs, &mut |done| report(share + (1.0 - share) * done, "measuring times"));
    drop(jobs);
    let measured = found.rows.iter_mut().filter_map(|row| row.outcome.as_mut().ok());
    measured.zip(times).for_each(|(measured, seconds)| measured.seconds = seconds);
    Ok(found)
}

impl WorkPrecision {
    /// Seconds of the default method at its tolerance, in case number `case`.
    pub fn unit(&self, case: usize) -> f64 {
        let default = MethodSetting { method: Method::Adaptive, value: DEFAULT_TOLERANCE };
        let row = self.rows.iter().find(|row| row.case == case && row.setting == default);
        row.and_then(|row| row.outcome.as_ref().ok()).map_or(f64::NAN, |measured| measured.seconds.median)
    }

    /// As CSV.
    pub fn csv(&self) -> Result<String> {
        let mut out = measured_here(
            COLUMNS,
            &[
                "speed_error: largest difference over the largest speed; force_error: over the mean force of a mesh",
                "cost: cpu_s over that of the default, adaptive at 1e-6, in the same case; cpu_s: median, _low and _high quartiles",
                "setting: relative tolerance, or for fixed_step the step in s",
            ],
        )?;
        for row in &self.rows {
            let (case, reference) = &self.cases[row.case];
            let (status, message, numbers) = match &row.outcome {
                Ok(m) => {
                    let [median, low, high, count] = cells(&m.seconds);
                    let s = &m.statistics;
                    let rejected = s.rejected_error + s.rejected_invalid + s.rejected_switch;
                    let mut cells = vec![count, median, low, high, number(m.seconds.median / self.unit(row.case))];
                    cells.extend(m.errors.map(number));
                    cells.extend([s.accepted, rejected, s.evaluations, s.jacobians].map(|n| n.to_string()));
                    ("ok", "", cells)
                }
                Err(why) => ("failed", why.as_str(), [vec!["0".to_owned()], vec!["nan".to_owned(); 10]].concat()),
            };
            let of_case = [&case.name(), case.motion.name(), case.fidelity.name(), name(row.setting.method)];
            let setting = [&number(row.setting.value), row.setting.unit(), status, message];
            let reference = [reference.source.clone(), number(reference.error[0]), number(reference.error[1])];
            let texts = of_case.into_iter().chain(setting).map(str::to_owned);
            out.push(texts.chain(numbers).chain(reference))?;
        }
        out.text()
    }
}
