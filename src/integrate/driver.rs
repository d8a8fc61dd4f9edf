//! Adaptive stepping to a given time, with error control and statistics by cause. A step shortened by the end of the
//! interval does not reduce the predicted step size.

use super::control::{Control, SAFETY};
use super::{
    Attempt, Course, ErrorNorm, Extension, Imbalance, Linearisation, Method, POSITION_ROUNDING, Pending, Point,
    SecondOrder, Statistics, Trial,
};

/// A completed step, as passed to the observer.
pub struct Step<'a, const N: usize, P> {
    /// Step size [s].
    pub h: f64,
    /// Time at the end [s].
    pub time: f64,
    /// State at the start.
    pub start: &'a Point<N>,
    /// State at the end.
    pub end: &'a Point<N>,
    /// Ledger rates at the start, in the middle and at the end.
    pub ledger_rates: [P; 3],
}

/// Decision of the observer after an accepted step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AfterStep {
    /// Continue to the end of the interval.
    Continue,
    /// Stop here: the equations change.
    Stop,
}

/// Cause of an interval that could not be completed. The state is that of the last accepted step.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure<E> {
    /// The step size fell below the resolution of time.
    StepTooSmall {
        /// The step size required [s].
        size: f64,
    },
    /// The budget of attempts was exhausted.
    TooManySteps,
    /// A step of fixed size could not be solved.
    Diverged,
    /// The observer of accepted steps rejected one.
    Refused(E),
    /// The ledger of a step does not close up to the time at which torques change.
    NotClosed,
}

/// Maximum ratio of the fitted to the predicted step size. The margin of [`SAFETY`] covers the larger error.
const LONGEST_FIT: f64 = 1.1;
/// Number of steps before the end of an interval that are made equal.
const LAST_STEPS: f64 = 3.0;
/// Number of attempts to locate a switch by a straight line through the distances at both ends of a step. This line
/// misses the switch if the distance jumps, as it does for a held body whose speed reverses. Further attempts bisect
/// the step.
const CUTS_BY_LINE: u32 = 5;
const LEAST_SHRINK: f64 = 1.25;
pub(super) const LARGEST_SHRINK: f64 = 5.0;
/// Accepted fraction of a step above which the rates at its middle are extrapolated from those of the whole step. The
/// missing rest is then little more than the rounding of times.
const WHOLE: f64 = 1.0 - 1e-5;
/// Allowed imbalance of a step's ledger, as a multiple of the tolerance and relative to the energy exchanged in the
/// step. Heat is a quadrature along the motion, and its kinks affect the motion less.
const LEDGER: f64 = 4.0;
/// Imbalance, as a fraction of the allowed one, above which the ledger of a step after a jump is evaluated with two
/// more points.
const UNREFINED: f64 = 0.05;
/// Maximum number of consecutive attempts whose ledger does not close. After them, a step of the size of the first
/// attempt is accepted, because the remaining imbalance does not depend on the step size.
const UNBALANCED: u32 = 8;
/// Tolerance, step-size control, counters and work budget of an integration.
pub struct SolverContext<'a> {
    /// Relative tolerance of the local error.
    pub tolerance: f64,
    /// Step-size control.
    pub control: &'a mut Control,
    /// Counters.
    pub statistics: &'a mut Statistics,
    /// Number of attempts left.
    pub budget: &'a mut u64,
}

/// Integrates from `time` to `until` [s] with `method`. Calls `observe` after each completed step; the observer may end
/// the integration early. Every attempt at a step is taken from the budget, so the caller bounds the work.
pub fn advance<const N: usize, M: Method, S: SecondOrder<N> + ?Sized, E>(
    method: &M,
    system: &S,
    point: &mut Point<N>,
    time: &mut f64,
    until: f64,
    context: SolverContext,
    mut observe: impl FnMut(Step<N, S::Rates>) -> Result<AfterStep, E>,
) -> Result<(), Failure<E>> {
    let mut course = Course::new(*point, *time, until);
    let outcome = proceed(method, system, &mut course, until, context, |step, _| observe(step));
    (*point, *time) = (course.point, course.time);
    outcome
}

/// Integrates until the pending step of `course` contains `until` [s], or until the equations end. Calls `observe`
/// after each completed step, with its dense output and the fraction of the step that was accepted. The observer may
/// end the integration early.
///
/// Steps, their sizes and their counts do not depend on the requested times. A step that ends beyond `until` is only
/// pending, so it changes neither the state nor the counts of completed steps.
#[inline]
pub fn proceed<const N: usize, M: Method, S: SecondOrder<N> + ?Sized, E>(
    method: &M,
    system: &S,
    course: &mut Course<N, S::Rates>,
    until: f64,
    context: SolverContext,
    mut observe: impl FnMut(Step<N, S::Rates>, (&Extension<N>, f64)) -> Result<AfterStep, E>,
) -> Result<(), Failure<E>> {
    let SolverContext { tolerance, control, statistics, budget } = context;
    let resolution = course.resolution;
    let ends = until + resolution >= course.end;
    let mut after_rejection = false;
    // true if an attempt from this point was rejected; its size then determines the next one
    let mut retries = false;
    // number of consecutive attempts whose ledger did not close, and size of the first of them
    let (mut unbalanced, mut whole) = (0, 0.0);
    let (mut in_a_row, mut cuts) = (0, 0);
    // number of consecutive steps that were cut at a switch but ended before it
    let mut short = 0;
    let mut switch_at = f64::INFINITY;
    let mut lin = Linearisation::default();
    // energies at the point of the linearisation, if the next step starts there
    let mut begin: Option<[f64; 2]> = None;
    // the start of a step is counted once, even if it is linearised again
    let mut is_counted = course.pending.is_some();
    loop {
        if let Some(pending) = &course.pending {
            let Attempt { h: size, error, cut, to_kink, .. } = pending.attempt;
            short = pending.attempt.short;
            let h = size * pending.accepted_fraction;
            let mut reached = course.time + h;
            let done = course.end - reached <= resolution;
            if reached + resolution >= until && !(done && ends) {
                return Ok(());
            }
            if done {
                reached = course.end;
            }
            let end = course.extension.at(pending.accepted_fraction);
            let mut halfway = if pending.accepted_fraction > WHOLE {
                pending.ledger_rates[1]
            } else {
                statistics.evaluations += 1;
                let middle = course.extension.at(0.5 * pending.accepted_fraction);
                let mut rates = system.evaluate_at(&middle, course.time + 0.5 * h).1;
                if pending.jump.is_some() {
                    system.undo_torque_change(&middle, &mut rates);
                }
                rates
            };
            begin = (!done).then(|| linearise(system, (&end, reached), &mut lin, Some(statistics)));
            let (mut last, energy) = match begin {
                Some(energy) => (lin.ledger_rates, energy),
                None => (system.evaluate_at(&end, reached).1, system.energy(&end)),
            };
            statistics.evaluations += u64::from(done);
            if pending.jump.is_some() {
                system.undo_torque_change(&end, &mut last);
            }
            if pending.accepted_fraction > WHOLE && pending.accepted_fraction < 1.0 {
                let (first, ends) = (&pending.ledger_rates[0], 0.5 * (pending.accepted_fraction - 1.0));
                halfway = system.combined([(-ends, first), (0.0, first), (1.0, &halfway), (0.0, &last), (ends, &last)]);
            }
            let mut ledger_rates = [pending.ledger_rates[0], halfway, last];
            let mut ledger = system.imbalance([pending.energy, energy], h, &ledger_rates);
            let mut imbalance = ledger.relative() / (LEDGER * tolerance);
            if control.follows_jump() && (imbalance > UNREFINED || ledger == Imbalance::NONE) {
                statistics.evaluations += 2;
                ledger_rates[1] = refined(system, course, h, &ledger_rates);
                ledger = system.imbalance([pending.energy, energy], h, &ledger_rates);
                imbalance = ledger.relative() / (LEDGER * tolerance);
            }
            if imbalance > 1.0 {
                // copies, so that both points can stay in registers
                let ends = [course.point, end];
                let floor = system.energy_floor([&ends[0], &ends[1]], tolerance, ledger.residual);
                // a floor of 0 is skipped, because a host may trap divisions by zero
                if floor > 0.0 {
                    imbalance = imbalance.min(ledger.residual / floor);
                }
            }
            if imbalance > 1.0 && pending.attempt.unbalanced < UNBALANCED {
                if pending.jump.is_some() {
                    return Err(Failure::NotClosed);
                }
                unbalanced = pending.attempt.unbalanced + 1;
                // after the last of these attempts, the whole step is accepted, and its error allows a longer step
                // after it
                (after_rejection, retries) = (unbalanced < UNBALANCED, true);
                whole = if unbalanced == 1 { h } else { pending.attempt.whole };
                statistics.rejected_ledger += 1;
                control.reject(if unbalanced < UNBALANCED {
                    h / (method.root(imbalance) / SAFETY).clamp(LEAST_SHRINK, LARGEST_SHRINK)
                } else {
                    whole
                });
                (course.pending, begin) = (None, None);
                continue;
            }
            (unbalanced, after_rejection, retries) = (0, false, false);
            control.accept(method, size, cut, error, pending.attempt.after_rejection);
            control.on_kink = to_kink && pending.accepted_fraction == 1.0;
            if pending.jump.is_some() {
                control.jump(pending.jump);
            }
            statistics.accepted += 1;
            let start = std::mem::replace(&mut course.point, end);
            course.time = reached;
            let step = Step { h, time: reached, start: &start, end: &end, ledger_rates };
            let flow = observe(step, (&course.extension, pending.accepted_fraction));
            course.pending = None;
            let flow = flow.map_err(Failure::Refused)?;
            if done || flow == AfterStep::Stop {
                return Ok(());
            }
        }
        *budget = budget.checked_sub(1).ok_or(Failure::TooManySteps)?;
        let point = &course.point;
        let energy = *begin.get_or_insert_with(|| {
            let counts = (!std::mem::replace(&mut is_counted, true)).then_some(&mut *statistics);
            linearise(system, (point, course.time), &mut lin, counts)
        });
        let wanted = control.wanted(retries);
        let remaining = course.remaining();
        let (mut h, mut cut) = fit(wanted.min(course.longest).max(resolution), remaining);
        let mut to_kink = false;
        if h > switch_at {
            (h, cut) = (switch_at, true);
        } else if let Some(fraction) = system.kink(point, h).filter(|fraction| moves(point, h * fraction)) {
            (h, cut, to_kink) = (h * fraction, true, true);
        }
        let norm = ErrorNorm { weights: system.weights(point), tolerance };
        let to = (&mut *statistics, &mut course.extension);
        let trial = method.step(system, (point, course.time), &lin, h, &norm, to);
        let mut error = trial.as_ref().map_or(f64::NAN, |trial| trial.size);
        if let Some(Trial { halfway: Some(halfway), .. }) = trial {
            let ends = ((point, course.time), (&course.extension.end, course.time + h));
            if let Some(fraction) = system.crossing(ends.0, ends.1).filter(|_| h > resolution) {
                statistics.rejected_switch += 1;
                cuts += 1;
                let most = if cuts > CUTS_BY_LINE { 0.5 } else { 1.0 };
                let least = if short > CUTS_BY_LINE { 0.5 } else { 0.0 };
                switch_at = (h * fraction.clamp(least, most)).max(resolution);
                continue;
            }
            // NaN if either is NaN
            error = if halfway.size < error { error } else { halfway.size };
            if error <= 1.0 {
                short = if h == switch_at { short + 1 } else { 0 };
                (switch_at, in_a_row, cuts) = (f64::INFINITY, 0, 0);
                let attempt = Attempt { h, error, cut, to_kink, after_rejection, unbalanced, whole, short };
                let (ledger_rates, energy) = ([lin.ledger_rates, halfway.ledger_rates], energy);
                course.pending = Some(Pending { attempt, ledger_rates, energy, accepted_fraction: 1.0, jump: None });
                continue;
            }
        }
        (after_rejection, retries) = (true, true);
        switch_at = f64::INFINITY;
        let shrink = if error.is_finite() {
            statistics.rejected_error += 1;
            in_a_row += 1;
            let least = (0..in_a_row).fold(1.0, |least, _| LEAST_SHRINK * least).min(LARGEST_SHRINK);
            (method.root(error) / SAFETY).clamp(least, LARGEST_SHRINK)
        } else {
            statistics.rejected_invalid += 1;
            LARGEST_SHRINK
        };
        control.reject(h / shrink);
        if control.next <= resolution {
            return Err(Failure::StepTooSmall { size: control.next });
        }
    }
}

impl<const N: usize, P> Course<N, P> {
    /// Time left until the equations end, or are expected to end [s].
    #[inline]
    fn remaining(&self) -> f64 {
        let is_ahead = self.expected > self.time + self.resolution;
        (if is_ahead { self.expected.min(self.end) } else { self.end }) - self.time
    }
}

/// Ledger rates that replace the halfway rates of the pending step. With them, Simpson's rule gives the result of
/// Boole's rule with two more points. Three points are too few for the heat of a fast motion that decays.
#[inline(never)]
fn refined<const N: usize, S: SecondOrder<N> + ?Sized>(
    system: &S,
    course: &Course<N, S::Rates>,
    h: f64,
    [first, halfway, last]: &[S::Rates; 3],
) -> S::Rates {
    let Some(pending) = &course.pending else { return *halfway };
    let at = |fraction: f64| {
        let point = course.extension.at(fraction * pending.accepted_fraction);
        let mut rates = system.evaluate_at(&point, course.time + fraction * h).1;
        if pending.jump.is_some() {
            system.undo_torque_change(&point, &mut rates);
        }
        rates
    };
    let [quarter, three_quarters] = [at(0.25), at(0.75)];
    let [ends, quarters, middle] = [-12.0 / 90.0, 48.0 / 90.0, 18.0 / 90.0];
    system.combined([(ends, first), (quarters, &quarter), (middle, halfway), (quarters, &three_quarters), (ends, last)])
}

/// Returns the size of the next step from the predicted size `wanted` and the time `remaining`, and true if it was
/// fitted to the end. The last few steps are made equal, and slightly longer than predicted if that saves one.
#[inline]
fn fit(wanted: f64, remaining: f64) -> (f64, bool) {
    let steps = remaining / (LONGEST_FIT * wanted);
    if steps <= 1.0 {
        (remaining, true)
    } else if steps < LAST_STEPS {
        (remaining / libm::ceil(steps), true)
    } else {
        (wanted, false)
    }
}

/// True if positions change within `h` [s] by more than rounding. A system at rest on a kink does not leave it by steps
/// that end on the kink.
fn moves<const N: usize>(point: &Point<N>, h: f64) -> bool {
    point.q.iter().zip(&point.v).any(|(q, v)| (h * v).abs() > POSITION_ROUNDING * q.abs())
}

/// Linearises the equations into `lin` and returns the energies.
#[inline(never)]
fn linearise<const N: usize, S: SecondOrder<N> + ?Sized>(
    system: &S,
    (point, time): (&Point<N>, f64),
    lin: &mut Linearisation<N, S::Rates>,
    statistics: Option<&mut Statistics>,
) -> [f64; 2] {
    if let Some(statistics) = statistics {
        statistics.evaluations += 1;
        statistics.jacobians += 1;
    }
    system.linearise_with_energy(point, time, lin)
}
