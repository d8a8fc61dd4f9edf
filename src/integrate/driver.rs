//! Adaptive stepping to a given time: error control, step-size prediction, statistics by cause.
//!
//! The step size follows Gustafsson's predictive controller (Hairer & Wanner, section IV.8). A step cut short by the end
//! of the interval does not shrink the prediction.

use serde::{Deserialize, Serialize};

use super::rodas::{self, Trial};
use super::system::{Linearisation, Point, Power, SecondOrder};

/// What the step-size controller remembers from one call to the next.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Control {
    /// Predicted size of the next step [s].
    pub next: f64,
    /// Size of the last accepted step [s]; 0 before the first.
    pub last: f64,
    /// Error of the last accepted step, as a fraction of the tolerance.
    pub last_error: f64,
}

impl Control {
    /// A controller whose first step is tried with `first` [s].
    pub fn new(first: f64) -> Self {
        Self { next: first, last: 0.0, last_error: 1.0 }
    }
}

/// Counts of what the integrator did, by cause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics {
    /// Accepted steps.
    pub accepted: u64,
    /// Steps rejected because the local error was too large.
    pub rejected_error: u64,
    /// Steps rejected because a value was not finite or the matrix singular.
    pub rejected_invalid: u64,
    /// Evaluations of the right-hand side, those of linearisations and of the ledger included.
    pub evaluations: u64,
    /// Evaluations of the Jacobian, each with its factorisation.
    pub jacobians: u64,
}

/// An accepted step as its observer sees it.
pub struct Step<'a> {
    /// Step size [s].
    pub h: f64,
    /// Time at the end [s].
    pub time: f64,
    /// State at the end; the observer may wrap positions that are periodic.
    pub end: &'a mut Point,
    /// Ledger rates at begin, middle and end.
    pub power: [Power; 3],
}

/// Why an interval could not be completed; the state is that of the last accepted step.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure<E> {
    /// The step size fell below what time can resolve.
    StepTooSmall {
        /// The step size asked for [s].
        size: f64,
    },
    /// More steps than an interval may take.
    TooManySteps {
        /// Steps taken.
        steps: u64,
    },
    /// The observer of accepted steps refused one.
    Refused(E),
}

const SAFETY: f64 = 0.9;
const LARGEST_GROWTH: f64 = 6.0;
const LARGEST_SHRINK: f64 = 5.0;
/// Steps that one call may take: bounds the time a host can be kept waiting.
const MAX_STEPS: u64 = 3_000_000;

/// Integrates from `time` to `until`, calling `observe` after each accepted step.
#[allow(clippy::too_many_arguments)]
pub fn advance<S: SecondOrder, E>(
    system: &S,
    point: &mut Point,
    time: &mut f64,
    until: f64,
    tolerance: f64,
    control: &mut Control,
    statistics: &mut Statistics,
    mut observe: impl FnMut(Step) -> Result<(), E>,
) -> Result<(), Failure<E>> {
    // what a double can resolve of the time axis
    let resolution = 4.0 * f64::EPSILON * until.abs().max(time.abs()).max(1e-9);
    let mut steps = 0;
    let mut just_rejected = false;
    let mut lin = Linearisation::default();
    system.linearise(point, &mut lin);
    statistics.evaluations += 1;
    statistics.jacobians += 1;
    while until - *time > resolution {
        let remaining = until - *time;
        // two equal steps rather than a long and a tiny one
        let wanted = control.next.max(resolution);
        let (h, cut) = if wanted >= remaining * (1.0 - 1e-9) {
            (remaining, true)
        } else if wanted > 0.5 * remaining {
            (0.5 * remaining, true)
        } else {
            (wanted, false)
        };
        let trial = rodas::step(system, point, &lin, h);
        statistics.evaluations += rodas::EVALUATIONS;
        let error = trial.as_ref().map_or(f64::NAN, |t| error_norm(system, point, t, tolerance));
        if error.is_finite() && error <= 1.0 {
            let Some(trial) = trial else { continue };
            let mut factor = quarter_power(error) / SAFETY;
            if control.last > 0.0 && error > 0.0 {
                let predictive = (control.last / h) * quarter_power(error * error / control.last_error) / SAFETY;
                factor = factor.max(predictive);
            }
            let factor = factor.clamp(1.0 / LARGEST_GROWTH, LARGEST_SHRINK);
            let mut next = h / factor;
            if just_rejected {
                next = next.min(h);
            }
            control.next = if cut { next.max(control.next) } else { next };
            control.last = h;
            control.last_error = error.max(1e-2);
            just_rejected = false;
            statistics.accepted += 1;
            steps += 1;

            let begin = lin.power;
            let mut unused = lin.acceleration;
            let middle = system.evaluate(&trial.middle, &mut unused);
            *point = trial.end;
            lin = Linearisation::default();
            system.linearise(point, &mut lin);
            statistics.evaluations += 2;
            statistics.jacobians += 1;
            *time = if h == remaining { until } else { *time + h };
            observe(Step { h, time: *time, end: point, power: [begin, middle, lin.power] })
                .map_err(Failure::Refused)?;
        } else {
            let shrink = if error.is_finite() {
                statistics.rejected_error += 1;
                (quarter_power(error) / SAFETY).clamp(1.25, LARGEST_SHRINK)
            } else {
                statistics.rejected_invalid += 1;
                LARGEST_SHRINK
            };
            just_rejected = true;
            control.next = h / shrink;
            if control.next <= resolution {
                return Err(Failure::StepTooSmall { size: control.next });
            }
            steps += 1;
        }
        if steps > MAX_STEPS {
            return Err(Failure::TooManySteps { steps });
        }
    }
    Ok(())
}

/// x^(1/(p+1)) for the order p = 3 of the error estimate.
fn quarter_power(x: f64) -> f64 {
    x.sqrt().sqrt()
}

/// Largest component of the error over what is allowed.
#[inline]
fn error_norm<S: SecondOrder>(system: &S, start: &Point, trial: &Trial, tolerance: f64) -> f64 {
    let scale = system.scales(start);
    let mut largest: f64 = 0.0;
    for i in 0..system.dof() {
        let q = trial.error.q[i].abs() / (tolerance * scale.q[i]);
        let v = trial.error.v[i].abs() / (tolerance * scale.v[i]);
        if !(q.is_finite() && v.is_finite() && trial.end.q[i].is_finite() && trial.end.v[i].is_finite()) {
            return f64::NAN;
        }
        largest = largest.max(q).max(v);
    }
    largest
}
