//! Runs of variants of one scene: how far each is from the references, and what it costs.

use bevel_differential::model::CostClass;
use bevel_differential::problem::Problem;

use super::change::{Change, Scale, scales, statistics};
use super::record::Record;
use crate::gears::scene::Scene;

/// Number of the run of the scene as written.
pub const WRITTEN: usize = 0;
/// Number of the run of the fullest scene.
pub const FULL: usize = 1;

/// Runs shorter than this are repeated until they are as long together [s]; clocks of processors are coarser than that.
const SHORTEST: f64 = 0.02;
/// Time for measuring times [s], as far as it goes with the fewest rounds.
const BUDGET: f64 = 20.0;
/// Rounds through all runs.
const ROUNDS: [f64; 2] = [3.0, 9.0];

/// A run, its series of values left behind.
#[derive(Clone)]
pub struct Variant {
    /// What ran.
    pub scene: Scene,
    /// Changes from [`WRITTEN`] and from [`FULL`].
    pub changes: [Change; 2],
    /// Statistics of each output.
    pub statistics: Vec<[f64; 4]>,
    /// Evaluations of the tooth forces.
    pub evaluations: f64,
    /// Accepted steps.
    pub steps: f64,
    /// The dearest kind of step in it.
    pub class: CostClass,
    /// Seconds on the processor for a run, by round.
    pub seconds: Vec<f64>,
    first: f64,
}

/// All runs.
#[derive(Clone)]
pub struct Bench {
    /// They, [`WRITTEN`] and [`FULL`] in front.
    pub runs: Vec<Variant>,
    /// Scales of the outputs.
    pub scales: Vec<Scale>,
    /// Time from which on outputs count [s].
    pub from: f64,
    /// Evaluations after which a run is given up.
    pub most: f64,
    references: [Record; 2],
    failed: Vec<(Scene, String)>,
}

/// How many times dearer one run is than another.
#[derive(Clone, Copy, Debug)]
pub struct Ratio {
    /// Median over the rounds.
    pub median: f64,
    /// Half the range of the middle half of the rounds.
    pub spread: f64,
}

/// Runs `scene`: record from after `from` [s] on, and seconds on the processor.
pub fn of(scene: &Scene, from: f64, most: f64) -> Result<(Record, f64), String> {
    Record::of(scene, from, most).map(|(record, taken)| (record, taken.seconds))
}

/// Problems in one line.
pub fn told(problems: &[Problem]) -> String {
    problems.iter().map(Problem::to_string).collect::<Vec<_>>().join("; ")
}

impl Bench {
    /// Begins with the references.
    pub fn new(from: f64, scene: &Scene, written: (Record, f64), full_scene: &Scene, full: (Record, f64)) -> Self {
        let mut bench = Self {
            from,
            runs: Vec::new(),
            scales: scales(&scene.outputs, &full.0),
            most: f64::INFINITY,
            references: [written.0.clone(), full.0.clone()],
            failed: Vec::new(),
        };
        bench.keep(scene, written);
        bench.keep(full_scene, full);
        bench
    }

    /// Runs `scene` unless it has run: its number, or why it does not come to its end.
    pub fn run(&mut self, scene: &Scene) -> Result<usize, String> {
        let same = |other: &Scene| other.parameters == scene.parameters;
        if let Some(known) = self.runs.iter().position(|run| same(&run.scene)) {
            return Ok(known);
        }
        if let Some((_, why)) = self.failed.iter().find(|(other, _)| same(other)) {
            return Err(why.clone());
        }
        match of(scene, self.from, self.most) {
            Ok(ran) => Ok(self.keep(scene, ran)),
            Err(why) => {
                self.failed.push((scene.clone(), why.clone()));
                Err(why)
            }
        }
    }

    fn keep(&mut self, scene: &Scene, (record, first): (Record, f64)) -> usize {
        let changes = self.references.each_ref().map(|reference| Change::between(reference, &record, &self.scales));
        let statistics = record.values.iter().map(|values| statistics(&record.times, values)).collect();
        self.runs.push(Variant {
            scene: scene.clone(),
            changes,
            statistics,
            evaluations: record.evaluations,
            steps: record.steps,
            class: record.class,
            seconds: Vec::new(),
            first,
        });
        self.runs.len() - 1
    }

    /// Change from a reference to a run.
    pub fn change(&self, run: usize, reference: usize) -> &Change {
        &self.runs[run].changes[reference]
    }

    /// Times the `used` runs in rounds, each run once in each, so that what else the machine does hits all alike.
    pub fn measure(&mut self, used: &[usize], tell: &mut dyn FnMut(f64, &str)) {
        let mut used = used.to_vec();
        used.sort_unstable();
        used.dedup();
        let round: f64 = used.iter().map(|&run| self.runs[run].first.max(SHORTEST)).sum();
        let rounds = (BUDGET / round).clamp(ROUNDS[0], ROUNDS[1]) as usize;
        for k in 0..rounds {
            for (i, &run) in used.iter().enumerate() {
                let done = (k * used.len() + i) as f64 / (rounds * used.len()) as f64;
                tell(done, &format!("measuring times, round {} of {rounds}", k + 1));
                let variant = &mut self.runs[run];
                let (mut total, mut times) = (0.0, 0.0);
                while total < SHORTEST {
                    // it has come to its end before
                    let Ok((_, seconds)) = of(&variant.scene, self.from, f64::INFINITY) else { break };
                    (total, times) = (total + seconds, times + 1.0);
                }
                variant.seconds.push(total / times);
            }
        }
    }

    /// Times of run `a` over those of run `b`, round by round; none before they are measured.
    pub fn ratio(&self, a: usize, b: usize) -> Option<Ratio> {
        let pairs = self.runs[a].seconds.iter().zip(&self.runs[b].seconds);
        let mut ratios: Vec<f64> = pairs.map(|(a, b)| a / b).filter(|ratio| ratio.is_finite()).collect();
        ratios.sort_by(f64::total_cmp);
        let n = ratios.len();
        let median = *ratios.get(n / 2)?;
        Some(Ratio { median, spread: 0.5 * (ratios[(3 * n) / 4] - ratios[n / 4]) })
    }

    /// Evaluations of run `a` over those of run `b`; none where there are none to compare.
    pub fn evaluations(&self, a: usize, b: usize) -> Option<f64> {
        let ratio = self.runs[a].evaluations / self.runs[b].evaluations;
        ratio.is_finite().then_some(ratio)
    }
}
