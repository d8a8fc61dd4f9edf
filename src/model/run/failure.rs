//! Errors of steps that could not be completed, for example because a tooth bends too far.

use std::fmt;

use super::budget::budget;
use super::{effort, hints};
use crate::declaration::SIDES;
use crate::integrate::{Failure, Statistics};
use crate::model::assembly::{Gears, Model};
use crate::model::dynamics::State;
use crate::model::scene::Inputs;

/// Error of a step that could not be completed. The simulation is at the last good time.
#[derive(Clone, Debug, PartialEq)]
pub struct StepFailure {
    /// Last good time [s].
    pub time: f64,
    /// Description of the error, its location and a remedy.
    pub message: String,
}

impl StepFailure {
    /// Error of a step with values that are not finite.
    pub fn not_finite(time: f64) -> Self {
        Self { time, message: "the step gave values that are not finite; look at the inputs".into() }
    }

    /// Error of a step that ended at `reached` [s] instead of `until` [s].
    pub fn not_reached(reached: f64, until: f64) -> Self {
        let message =
            format!("the motion did not reach t = {until} s; this is an error of the program, please report it");
        Self { time: reached, message }
    }
}

impl fmt::Display for StepFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at t = {:?} s: {}", six_digits(self.time), self.message)
    }
}

/// Rounds `value` to six significant digits, for messages.
pub fn six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Cause of a step that could not be completed.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause {
    /// The solver found no step.
    Solver(Failure),
    /// A tooth bends too far in the step.
    Deflection(ExcessiveDeflection),
}

impl From<Failure> for Cause {
    fn from(failure: Failure) -> Self {
        Self::Solver(failure)
    }
}

impl From<ExcessiveDeflection> for Cause {
    fn from(tooth: ExcessiveDeflection) -> Self {
        Self::Deflection(tooth)
    }
}

impl Cause {
    /// Error at `time` [s] with this cause and a remedy. `before` are the statistics at the start of the integration.
    #[cold]
    pub fn explain(
        self,
        time: f64,
        (model, inputs, state): (&Model, &Inputs, &State),
        before: &Statistics,
    ) -> StepFailure {
        let solver = &model.parameters.solver;
        let tolerance = solver.relative_tolerance;
        let message = match self {
            Cause::Deflection(tooth) => tooth.message(model),
            Cause::Solver(Failure::NotClosed) => {
                "the energy balance of the step before a change of torques does not close".into()
            }
            Cause::Solver(Failure::StepTooSmall { size }) => format!(
                "the step size fell to {size:.3e} s, below the resolution of time; look at the inputs, \
                 or loosen solver.relative_tolerance = {tolerance:e}"
            ),
            Cause::Solver(Failure::Diverged) => format!(
                "a step of solver.fixed_step = {:e} s could not be solved; make it shorter, or take solver.method = adaptive",
                solver.fixed_step
            ),
            Cause::Solver(Failure::TooManySteps) => format!(
                "{} attempts at steps, and a tenth of them for each second, were not enough for one communication step: {}; \
                 shorten it, loosen solver.relative_tolerance = {tolerance:e}, or {}",
                budget(model),
                effort::too_many_steps(model, inputs, state, before),
                effort::fewer_steps(model, state)
            ),
        };
        StepFailure { time, message }
    }
}

/// Error of a tooth that bends beyond the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExcessiveDeflection {
    /// Approach of the flanks, as an arc along the line of action [rad].
    pub deflection: f64,
    /// Planet of the mesh.
    pub planet: usize,
    /// Side gear of the mesh.
    pub side: usize,
}

impl ExcessiveDeflection {
    /// Message with the tooth, its deflection and a remedy.
    pub fn message(&self, model: &Model) -> String {
        let (limit, cone) = match &model.gears {
            Gears::Teeth(teeth) => (teeth.deflection_limit, teeth.contact.mesh.whole.cone),
            Gears::Ideal(_) => (0.0, model.pair.mean_cone),
        };
        format!(
            "tooth deflection exceeds {} between planet[{}] and the {} side gear: {:.3} mm along the line of action, \
             at most {:.3} mm; reduce the load or {}; in a coupling, take shorter communication steps",
            limit_name(model),
            self.planet + 1,
            SIDES[self.side],
            self.deflection * cone * 1e3,
            limit * cone * 1e3,
            hints::stiffer_teeth(&model.parameters)
        )
    }
}

/// Name of the limit on the deflection of teeth.
pub fn limit_name(model: &Model) -> &'static str {
    if model.pair.working_depth() <= 0.5 * model.pair.base_pitch { "the working depth" } else { "half the base pitch" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_message_gives_the_time_to_six_digits() {
        for (time, time_text) in [(0.000_003_716_875_526_471_57, "3.71688e-6"), (0.1, "0.1"), (1.234_567_89, "1.23457")]
        {
            assert!(StepFailure::not_finite(time).to_string().starts_with(&format!("at t = {time_text} s: ")));
        }
    }
}
