//! A run of a scene: its outputs at the communication points, the rotations of mesh and carrier, and its effort.

use bevel_differential::problem::Problem;
use bevel_differential::variables::{Variable, named};
use cpu_time::ThreadTime;

use crate::progress::Progress;
use crate::scene::Scene;
use crate::scene::run::SceneRun;

/// Times that differ by less than this fraction of a step are equal, because communication points are rounded.
const SAME: f64 = 1e-6;

/// Start of the error of a run that was stopped because it needed too many evaluations.
pub const GIVEN_UP: &str = "given up";

/// Results of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// Times of the communication points [s]. A jump of inputs has two rows at one time.
    pub times: Vec<f64>,
    /// Values in these rows, one series for each output of the scene.
    pub values: Vec<Vec<f64>>,
    /// Phase of the tooth mesh, where a pitch of planet 1 is 2π, and angle of the carrier [rad].
    pub phases: [Vec<f64>; 2],
    /// Effort of the run.
    pub effort: Effort,
    /// Warnings since the start.
    pub warnings: Vec<String>,
}

/// Computational effort of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// Steps to communication points, and to points of tables between them.
    pub points: f64,
    /// Evaluations of the tooth forces.
    pub evaluations: f64,
    /// Accepted steps of the integrator.
    pub steps: f64,
    /// Processor time from the first step to the end, including outputs at communication points [s].
    pub seconds: f64,
    /// Processor time of the start: stiffness of teeth and gear bodies from their geometry, equilibrium [s].
    pub start: f64,
}

/// Variables with the angles by which orders are counted.
fn angles() -> [Option<&'static Variable>; 2] {
    ["planet[1].spin_angle", "carrier.angle"].map(named)
}

impl Record {
    /// Runs `scene` with at most `most` evaluations of the tooth forces, and records it from the time `from` [s] on.
    /// Returns the reason if the run fails.
    pub fn of(scene: &Scene, from: f64, most: f64, progress: &mut Progress) -> Result<Self, String> {
        progress.check_stopped().map_err(|stopped| stopped.to_string())?;
        let begun = ThreadTime::now();
        let mut run = SceneRun::attempt(scene, scene.step).map_err(|found| in_one_line(&found))?;
        let mut record = Self { values: vec![Vec::new(); scene.outputs.len()], ..Self::default() };
        record.effort.start = begun.elapsed().as_secs_f64();
        let teeth = f64::from(scene.parameters.geometry.planet_teeth);
        record.take(scene, &mut run, teeth);
        while !run.is_over() {
            progress.check_stopped().map_err(|stopped| stopped.to_string())?;
            run.advance().map_err(|error| error.root_cause().to_string())?;
            // earlier rows are not needed
            if run.time() > from - 1.5 * scene.step {
                record.take(scene, &mut run, teeth);
            }
            let ledger = run.simulation.ledger();
            let effort = &mut record.effort;
            (effort.points, effort.evaluations, effort.steps) = (run.steps() as f64, ledger.rhs_calls, ledger.steps);
            if effort.evaluations > most {
                return Err(format!("{GIVEN_UP} at {:.3e} s, after {:.0} evaluations", run.time(), effort.evaluations));
            }
        }
        record.cut(from, SAME * scene.step);
        record.warnings = run.warnings_since_start().iter().map(Problem::to_string).collect();
        record.effort.seconds = begun.elapsed().as_secs_f64() - record.effort.start;
        Ok(record)
    }

    /// Leaves the rows from `from` on [s]. The first one is interpolated, or the second row of a jump. Times that differ
    /// by less than `slack` are equal [s].
    fn cut(&mut self, from: f64, slack: f64) {
        let first = self.times.partition_point(|&time| time <= from + slack).saturating_sub(1);
        if from <= 0.0 || first + 1 >= self.times.len() {
            return;
        }
        let (before, after) = (self.times[first], self.times[first + 1]);
        let share = if from - before > slack { (from - before) / (after - before) } else { 0.0 };
        for series in [&mut self.times].into_iter().chain(&mut self.values).chain(&mut self.phases) {
            series.drain(..first);
            series[0] += share * (series[1] - series[0]);
        }
    }

    fn take(&mut self, scene: &Scene, run: &mut SceneRun, teeth: f64) {
        self.times.push(run.time());
        for (series, row) in self.values.iter_mut().zip(&scene.outputs) {
            series.push(run.read(row));
        }
        for ((series, row), per_turn) in self.phases.iter_mut().zip(angles()).zip([teeth, 1.0]) {
            series.push(row.map_or(0.0, |row| per_turn * run.read(row)));
        }
    }
}

/// Joins problems into one line.
pub fn in_one_line(problems: &[Problem]) -> String {
    problems.iter().map(Problem::to_string).collect::<Vec<_>>().join("; ")
}
