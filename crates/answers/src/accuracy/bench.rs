//! Runs of variants of one scene: how far the wanted quantities of each are from the reference, and what it costs.

use bevel_differential::model::Parameters;

use super::price;
use super::record::{Effort, Record};
use super::want::Want;
use crate::scene::Scene;
use crate::watch::Watch;

/// A run may cost this many times the reference, and take at least so many evaluations.
const PATIENCE: f64 = 1.5;
const FREE: f64 = 1e4;
/// Runs are repeated until they are as long together [s], or as often, for their time; clocks are coarser than a short run.
const LONG_ENOUGH: f64 = 0.05;
const OFTEN: usize = 5;

/// A run that came to its end.
#[derive(Clone)]
pub struct Trial {
    /// What ran.
    pub scene: Scene,
    /// Why it was tried.
    pub what: String,
    /// Values of the wanted quantities.
    pub values: Vec<f64>,
    /// Their errors.
    pub errors: Vec<f64>,
    /// What it took.
    pub effort: Effort,
    /// Price by its counts, in evaluations of plain teeth.
    pub cost: f64,
}

impl Trial {
    /// The largest error, with the number of its want.
    pub fn worst(&self) -> (usize, f64) {
        let errors = self.errors.iter().copied().enumerate();
        errors.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
    }

    /// The largest error.
    pub fn error(&self) -> f64 {
        self.worst().1
    }
}

/// All runs.
pub struct Bench<'a, 'w> {
    /// What is wanted.
    pub wants: &'a [Want],
    /// Time from which on outputs count [s].
    pub from: f64,
    /// What runs are compared with: the richest scene at the finest tolerance. Its errors are how far each quantity strays when
    /// nothing but the integrator changes.
    pub reference: Trial,
    /// What 100 % of each quantity is.
    pub scales: Vec<f64>,
    /// Runs that came to their end.
    pub trials: Vec<Trial>,
    /// Price of all runs so far, and how much it may be.
    pub spent: f64,
    /// See above.
    pub limit: f64,
    failed: Vec<(Parameters, String)>,
    /// Who waits.
    pub watch: &'a mut Watch<'w>,
}

/// Figures of the wanted quantities in `record`.
pub fn values(wants: &[Want], record: &Record) -> Result<Vec<f64>, String> {
    wants.iter().map(|want| want.statistic.of(record, want.output)).collect()
}

impl<'a, 'w> Bench<'a, 'w> {
    /// Begins with a reference that cost `spent` to find; `limit` for all.
    pub fn new(
        wants: &'a [Want],
        from: f64,
        (reference, scales): (Trial, Vec<f64>),
        [spent, limit]: [f64; 2],
        watch: &'a mut Watch<'w>,
    ) -> Self {
        Self { wants, from, reference, scales, trials: Vec::new(), spent, limit, failed: Vec::new(), watch }
    }

    /// Whether there is room for one more run like `trial`.
    pub fn has_room(&self, cost: f64) -> bool {
        self.spent + cost <= self.limit
    }

    /// Runs `scene` unless it has run: its number, or why it has no figures.
    pub fn run(&mut self, scene: &Scene, what: &str) -> Result<usize, String> {
        let p = scene.parameters;
        if let Some(known) = self.trials.iter().position(|trial| trial.scene.parameters == p) {
            return Ok(known);
        }
        if let Some((_, why)) = self.failed.iter().find(|(other, _)| *other == p) {
            return Err(why.clone());
        }
        self.watch.say(self.spent / self.limit, what);
        let most = FREE.max(price::evaluations(&p, PATIENCE * self.reference.cost));
        let figures = Record::of(scene, self.from, most, self.watch).and_then(|record| {
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
        self.trials.push(Trial { scene: scene.clone(), what: what.to_owned(), values, errors, effort, cost });
        Ok(self.trials.len() - 1)
    }

    /// Time of a run on the processor, the least of some [s].
    pub fn seconds(&mut self, scene: &Scene) -> f64 {
        let (mut least, mut total) = (f64::INFINITY, 0.0);
        for _ in 0..OFTEN {
            let Ok(record) = Record::of(scene, self.from, f64::INFINITY, self.watch) else { break };
            (least, total) = (least.min(record.effort.seconds), total + record.effort.seconds);
            if total > LONG_ENOUGH {
                break;
            }
        }
        least
    }
}
