//! A run of a scene with all that its outputs did, and what it took.

use bevel_differential::model::CostClass;
use cpu_time::ThreadTime;

use crate::gears::scene::Scene;
use crate::gears::scene::run::SceneRun;

/// What a run gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Times of the communication points [s].
    pub times: Vec<f64>,
    /// Values there, a series for each output of the scene.
    pub values: Vec<Vec<f64>>,
    /// Evaluations of the tooth forces.
    pub evaluations: f64,
    /// Accepted steps of the integrator.
    pub steps: f64,
    /// The dearest kind of step in it.
    pub class: CostClass,
}

/// Time that runs of one scene take.
#[derive(Clone, Copy, Debug)]
pub struct Taken {
    /// Seconds on the processor, for one run.
    pub seconds: f64,
}

impl Record {
    /// Runs `scene` and records it from after `from` [s] on, with at most `most` evaluations of the tooth forces; or tells
    /// why it does not come to its end.
    pub fn of(scene: &Scene, from: f64, most: f64) -> Result<(Self, Taken), String> {
        let begun = ThreadTime::now();
        let told = |problems: Vec<bevel_differential::problem::Problem>| {
            problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
        };
        let mut run = SceneRun::attempt(scene, scene.step).map_err(told)?;
        let mut record = Self {
            times: Vec::new(),
            values: vec![Vec::new(); scene.outputs.len()],
            evaluations: 0.0,
            steps: 0.0,
            class: run.simulation.cost(),
        };
        // half a step, as communication points are rounded
        let from = from + 0.5 * scene.step;
        while !run.is_over() {
            run.advance().map_err(|error| error.root_cause().to_string())?;
            record.take(scene, &mut run, from);
            if record.evaluations > most {
                return Err(format!("given up at {:.3e} s, after {:.0} evaluations", run.time(), record.evaluations));
            }
        }
        Ok((record, Taken { seconds: begun.elapsed().as_secs_f64() }))
    }

    fn take(&mut self, scene: &Scene, run: &mut SceneRun, from: f64) {
        let values: Vec<f64> = scene.outputs.iter().map(|row| run.read(row)).collect();
        if run.time() > from {
            self.times.push(run.time());
            for (series, value) in self.values.iter_mut().zip(values) {
                series.push(value);
            }
        }
        let ledger = run.simulation.ledger();
        (self.evaluations, self.steps) = (ledger.rhs_calls, ledger.steps);
        self.class = self.class.max(run.simulation.cost());
    }
}
