//! Runs of variants of a scene, with the errors of the wanted quantities relative to the reference and the cost of each
//! run.

use bevel_differential::model::{Method, Parameters};

use super::price;
use super::record::{Effort, Record};
use super::want::Want;
use crate::progress::Progress;
use crate::scene::Scene;

/// Maximum cost of a run, as a multiple of the reference's cost.
const MOST_REFERENCE_RUNS: f64 = 1.5;
/// Number of evaluations that a run may always use, whatever they cost.
const ALWAYS_ALLOWED: f64 = 1e4;

/// A run that finished.
#[derive(Clone)]
pub struct Trial {
    /// The scene as it ran.
    pub scene: Scene,
    /// Reason for the run, in words.
    pub reason: String,
    /// Values of the wanted quantities.
    pub values: Vec<f64>,
    /// Errors of the wanted quantities relative to the reference, as fractions of their scales.
    pub errors: Vec<f64>,
    /// Steps, evaluations and time of the run.
    pub effort: Effort,
    /// Cost of the run by its counts, in evaluations of plain teeth.
    pub cost: f64,
}

impl Trial {
    /// Index of the wanted quantity with the largest error, and that error.
    pub fn worst(&self) -> (usize, f64) {
        let errors = self.errors.iter().copied().enumerate();
        errors.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
    }

    /// The largest error.
    pub fn error(&self) -> f64 {
        self.worst().1
    }
}

/// The reference and all runs that are compared with it.
pub struct Bench<'a, 'w> {
    /// The wanted quantities.
    pub wants: &'a [Want],
    /// Time after which outputs count [s].
    pub from: f64,
    /// Run that all others are compared with: the richest scene at the finest tolerance. Its errors are the changes of
    /// each quantity when only the tolerance changes.
    pub reference: Trial,
    /// Size of 100 % of each quantity.
    pub scales: Vec<f64>,
    /// Finished runs.
    pub trials: Vec<Trial>,
    /// Cost of all runs so far, in evaluations of plain teeth.
    pub spent: f64,
    /// Maximum cost of all runs together.
    pub limit: f64,
    failed: Vec<(Parameters, String)>,
    /// Reports the runs to the caller, who may stop them.
    pub progress: &'a mut Progress<'w>,
}

/// Values of the wanted quantities in `record`.
pub fn values(wants: &[Want], record: &Record) -> Result<Vec<f64>, String> {
    wants.iter().map(|want| want.statistic.of(record, want.output)).collect()
}

impl<'a, 'w> Bench<'a, 'w> {
    /// Creates a bench with a reference and its scales. The search for the reference has cost `spent`; all runs may
    /// cost `limit`.
    pub fn new(
        wants: &'a [Want],
        from: f64,
        (reference, scales): (Trial, Vec<f64>),
        [spent, limit]: [f64; 2],
        progress: &'a mut Progress<'w>,
    ) -> Self {
        Self { wants, from, reference, scales, trials: Vec::new(), spent, limit, failed: Vec::new(), progress }
    }

    /// True if the limit allows one more run of this cost.
    pub fn has_room(&self, cost: f64) -> bool {
        self.spent + cost <= self.limit
    }

    /// Runs `scene`, unless one with the same parameters has run. Returns the index of the run, or the reason of its failure.
    pub fn run(&mut self, scene: &Scene, reason: &str) -> Result<usize, String> {
        let p = scene.parameters;
        if let Some(known) = self.trials.iter().position(|trial| trial.scene.parameters == p) {
            return Ok(known);
        }
        if let Some((_, why)) = self.failed.iter().find(|(other, _)| *other == p) {
            return Err(why.clone());
        }
        self.progress.begin_task(self.spent / self.limit, reason);
        // fixed steps may cost more than the reference, up to the remaining limit
        let is_fixed = p.solver.method == Method::FixedStep;
        let patience = if is_fixed { self.limit - self.spent } else { MOST_REFERENCE_RUNS * self.reference.cost };
        let most = ALWAYS_ALLOWED.max(price::evaluations(&p, patience));
        let figures = Record::of(scene, self.from, most, self.progress).and_then(|record| {
            let cost = price::cost(&p, &record.effort);
            self.spent += cost;
            Ok((values(self.wants, &record)?, record.effort, cost))
        });
        let (values, effort, cost) = match figures {
            Ok(found) => found,
            Err(why) => {
                self.failed.push((p, why.clone()));
                return Err(why);
            }
        };
        let error = |i: usize| Want::error(values[i], self.reference.values[i], self.scales[i]);
        let errors = (0..values.len()).map(error).collect();
        self.trials.push(Trial { scene: scene.clone(), reason: reason.to_owned(), values, errors, effort, cost });
        Ok(self.trials.len() - 1)
    }
}
