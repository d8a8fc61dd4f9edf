//! Adaptive steps with error control and statistics by cause: the parts of a loop that tries, judges and completes a
//! step. A step shortened by the end of the interval does not reduce the predicted step size.

use super::control::{Control, LARGEST_SHRINK, SAFETY};
use super::{
    ErrorNorm, Extension, Imbalance, Linearisation, Method, POSITION_ROUNDING, Part, Pending, Point, SecondOrder,
    Statistics, StepOutput, TimedPoint, Trajectory, Trial,
};

/// A completed step.
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
    /// Dense output of the pending step and the fraction of it that was accepted; `None` without dense output.
    pub dense_output: Option<(&'a Extension<N>, f64)>,
}

/// Cause of an interval that could not be completed. The state is that of the last accepted step.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The step size fell below the resolution of time.
    StepTooSmall {
        /// The step size required [s].
        size: f64,
    },
    /// The budget of attempts was exhausted.
    TooManySteps,
    /// A step of fixed size could not be solved.
    Diverged,
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
/// Accepted fraction of a step above which the rates at its middle are extrapolated from those of the whole step. The
/// missing rest is then little more than the rounding of times.
const ALMOST_ALL: f64 = 1.0 - 1e-5;
/// Allowed imbalance of a step's ledger, as a multiple of the tolerance and relative to the energy exchanged in the
/// step. Heat is a quadrature along the motion, and its kinks affect the motion less.
const LEDGER: f64 = 4.0;
/// Imbalance, as a fraction of the allowed one, above which the ledger of a step after a discontinuity is evaluated
/// with two more points.
const UNREFINED: f64 = 0.05;
/// Shortest step that is cut at a kink or judged by its ledger, in resolutions of time. Rounding may leave a point just
/// before its kink. If the force jumps there, the ledger of no step across it closes, but a step as short as this
/// exchanges almost no energy.
const KINK: f64 = 1e3;
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

/// Parts of the loop over steps within one call, with its state: method, equations, control, and circumstances of the
/// next attempt. Steps, their sizes and their counts do not depend on the requested times: a step that ends beyond such
/// a time is only pending, so it changes neither the motion nor the counts of completed steps.
pub struct Solver<'a, const N: usize, M, S: SecondOrder<N> + ?Sized> {
    method: &'a M,
    system: &'a S,
    context: SolverContext<'a>,
    /// Linearisation at the start of the next step.
    lin: Linearisation<N, S::Rates>,
    /// Start of the last completed step.
    start: Point<N>,
    /// Kinetic and stored energy at the start of the next step; `None` if `lin` is not known.
    energy: Option<[f64; 2]>,
    /// True if the evaluation at the start of the next step is counted. It is counted once, even if it is repeated.
    is_counted: bool,
    /// True if the last attempt was rejected.
    after_rejection: bool,
    /// True if an attempt from this point was rejected; its size then determines the next one.
    is_retry: bool,
    /// Number of consecutive attempts rejected for their error.
    rejected: u32,
    /// Number of consecutive attempts whose ledger did not close.
    unbalanced: u32,
    /// Size of the first attempt in a row whose ledger did not close [s].
    first_unbalanced: f64,
    /// Size of the next attempt, which ends at a switch [s]; infinite if none is known.
    switch_at: f64,
    /// Number of consecutive attempts that a switch has cut.
    cuts: u32,
    /// Number of consecutive steps that were cut at a switch but ended before it.
    short: u32,
}

/// A pending step whose end is evaluated.
pub struct Judged<const N: usize, P> {
    /// State at the end.
    pub end: Point<N>,
    /// Ledger rates at the start, in the middle and at the end.
    ledger_rates: [P; 3],
    /// Imbalance of the ledger as a multiple of the allowed one.
    imbalance: f64,
    /// True if the ledger of the step closes, if several shorter steps have not closed it, or if the step is too short to
    /// be judged.
    pub is_balanced: bool,
}

/// Size of an attempt.
struct Size {
    /// Size [s].
    h: f64,
    /// True if it is shorter than the controller allows.
    cut: bool,
    /// True if the attempt ends on a kink.
    to_kink: bool,
}

impl<'a, const N: usize, M: Method, S: SecondOrder<N> + ?Sized> Solver<'a, N, M, S> {
    /// Returns a solver that continues `trajectory`. Every attempt at a step is taken from the budget of `context`, so
    /// the caller bounds the work.
    #[inline(always)]
    pub fn new(method: &'a M, system: &'a S, context: SolverContext<'a>, trajectory: &Trajectory<N, S::Rates>) -> Self {
        Self {
            method,
            system,
            context,
            lin: Linearisation::default(),
            start: Point::ZERO,
            energy: None,
            is_counted: trajectory.pending.is_some(),
            after_rejection: false,
            is_retry: false,
            rejected: 0,
            unbalanced: 0,
            first_unbalanced: 0.0,
            switch_at: f64::INFINITY,
            cuts: 0,
            short: 0,
        }
    }

    /// Tries a step from the end of the last completed one. It becomes the pending step if its error is small enough,
    /// and if no switch is inside.
    #[inline(always)]
    pub fn attempt(&mut self, trajectory: &mut Trajectory<N, S::Rates>) -> Result<(), Failure> {
        let system = self.system;
        *self.context.budget = self.context.budget.checked_sub(1).ok_or(Failure::TooManySteps)?;
        let energy = match self.energy {
            Some(energy) => energy,
            None => {
                let is_new = !std::mem::replace(&mut self.is_counted, true);
                self.linearise(&trajectory.point, trajectory.time, is_new)
            }
        };
        let Size { h, cut, to_kink } = self.next_size(trajectory);
        let Trajectory { point, time, extension, resolution, .. } = trajectory;
        let norm = ErrorNorm { weights: system.weights(point), tolerance: self.context.tolerance };
        let start = TimedPoint { point, time: *time };
        let to = StepOutput { counts: self.context.statistics, extension };
        let trial = self.method.step(system, start, &self.lin, h, &norm, to);
        let mut error = trial.as_ref().map_or(f64::NAN, |trial| trial.size);
        if let Some(Trial { halfway: Some(halfway), .. }) = trial {
            let crossing = system.crossing(start, TimedPoint { point: &extension.end, time: *time + h });
            if let Some(fraction) = crossing.filter(|_| h > *resolution) {
                self.cut_at_switch(h, fraction, *resolution);
                return Ok(());
            }
            // NaN if either is NaN
            error = if halfway.size < error { error } else { halfway.size };
            if error <= 1.0 {
                self.short = if h == self.switch_at { self.short + 1 } else { 0 };
                (self.switch_at, self.rejected, self.cuts) = (f64::INFINITY, 0, 0);
                let Self { after_rejection, unbalanced, first_unbalanced, short, .. } = *self;
                let ledger_rates = [self.lin.ledger_rates, halfway.ledger_rates];
                trajectory.pending = Some(Pending {
                    h,
                    error,
                    cut,
                    to_kink,
                    after_rejection,
                    unbalanced,
                    first_unbalanced,
                    short,
                    ledger_rates,
                    energy,
                });
                (trajectory.accepted_fraction, trajectory.acceleration_change) = (1.0, None);
                return Ok(());
            }
        }
        self.reject_error(h, error, *resolution)
    }

    /// Size of the next attempt: the predicted size, fitted to the end of the equations, to a switch or to a kink.
    #[inline(always)]
    fn next_size(&self, trajectory: &Trajectory<N, S::Rates>) -> Size {
        let Trajectory { point, longest, resolution, .. } = trajectory;
        let wanted = self.context.control.wanted(self.is_retry);
        let (h, cut) = fit(wanted.min(*longest).max(*resolution), trajectory.remaining());
        if h > self.switch_at {
            return Size { h: self.switch_at, cut: true, to_kink: false };
        }
        let is_worthwhile = |fraction: &f64| h * fraction > KINK * *resolution && moves(point, h * fraction);
        match self.system.kink(point, h).filter(is_worthwhile) {
            Some(fraction) => Size { h: h * fraction, cut: true, to_kink: true },
            None => Size { h, cut, to_kink: false },
        }
    }

    /// Lets the next attempt end at a switch, which an attempt of size `h` [s] passes at about this `fraction`.
    #[inline(always)]
    fn cut_at_switch(&mut self, h: f64, fraction: f64, resolution: f64) {
        self.context.statistics.rejected_switch += 1;
        self.cuts += 1;
        let most = if self.cuts > CUTS_BY_LINE { 0.5 } else { 1.0 };
        let least = if self.short > CUTS_BY_LINE { 0.5 } else { 0.0 };
        self.switch_at = (h * fraction.clamp(least, most)).max(resolution);
    }

    /// Shortens the next attempt because the `error` of an attempt of size `h` [s] is too large or not finite. Fails if
    /// time cannot resolve the next size.
    #[inline(always)]
    fn reject_error(&mut self, h: f64, error: f64, resolution: f64) -> Result<(), Failure> {
        let SolverContext { statistics, control, .. } = &mut self.context;
        (self.after_rejection, self.is_retry) = (true, true);
        self.switch_at = f64::INFINITY;
        let shrink = if error.is_finite() {
            statistics.rejected_error += 1;
            self.rejected += 1;
            let least = (0..self.rejected).fold(1.0, |least, _| LEAST_SHRINK * least).min(LARGEST_SHRINK);
            (self.method.root(error) / SAFETY).clamp(least, LARGEST_SHRINK)
        } else {
            statistics.rejected_invalid += 1;
            LARGEST_SHRINK
        };
        control.reject(h / shrink);
        if control.next <= resolution { Err(Failure::StepTooSmall { size: control.next }) } else { Ok(()) }
    }

    /// Evaluates the end of this `part` of the `pending` step, and its ledger. Unless the part is the last one, the next
    /// step can start from this evaluation.
    #[inline(always)]
    pub fn judge(
        &mut self,
        trajectory: &Trajectory<N, S::Rates>,
        pending: &Pending<S::Rates>,
        &Part { h, reached, is_last }: &Part,
    ) -> Judged<N, S::Rates> {
        let system = self.system;
        let Trajectory { accepted_fraction, acceleration_change, extension, .. } = trajectory;
        let first = &pending.ledger_rates[0];
        let end = extension.at(*accepted_fraction);
        let mut halfway = if *accepted_fraction > ALMOST_ALL {
            pending.ledger_rates[1]
        } else {
            self.context.statistics.evaluations += 1;
            trajectory.ledger_rates_at(system, 0.5, h)
        };
        let (mut last, energy);
        if is_last {
            self.energy = None;
            self.context.statistics.evaluations += 1;
            (last, energy) = (system.evaluate_at(&end, reached).1, system.energy(&end));
        } else {
            energy = self.linearise(&end, reached, true);
            last = self.lin.ledger_rates;
        }
        if acceleration_change.is_some() {
            system.undo_torque_change(&end, &mut last);
        }
        if *accepted_fraction > ALMOST_ALL && *accepted_fraction < 1.0 {
            let ends = 0.5 * (accepted_fraction - 1.0);
            halfway = system.combined([(-ends, first), (0.0, first), (1.0, &halfway), (0.0, &last), (ends, &last)]);
        }
        let allowed = LEDGER * self.context.tolerance;
        let mut ledger_rates = [*first, halfway, last];
        let mut ledger = system.imbalance([pending.energy, energy], h, &ledger_rates);
        let mut imbalance = ledger.relative() / allowed;
        if self.context.control.follows_discontinuity() && (imbalance > UNREFINED || ledger == Imbalance::NONE) {
            self.context.statistics.evaluations += 2;
            ledger_rates[1] = refined(system, trajectory, h, &ledger_rates);
            ledger = system.imbalance([pending.energy, energy], h, &ledger_rates);
            imbalance = ledger.relative() / allowed;
        }
        if imbalance > 1.0 {
            // copies, so that both points can stay in registers
            let ends = [trajectory.point, end];
            let floor = system.energy_floor([&ends[0], &ends[1]], self.context.tolerance, ledger.residual);
            // a floor of 0 is skipped, because a host may trap divisions by zero
            if floor > 0.0 {
                imbalance = imbalance.min(ledger.residual / floor);
            }
        }
        let is_refused = imbalance > 1.0 && pending.unbalanced < UNBALANCED && h > KINK * trajectory.resolution;
        Judged { end, ledger_rates, imbalance, is_balanced: !is_refused }
    }

    /// Drops the pending step because the ledger of this `part` does not close, and shortens the next attempt. Fails if
    /// torques change within the step.
    #[inline(always)]
    pub fn reject_ledger(
        &mut self,
        trajectory: &mut Trajectory<N, S::Rates>,
        &Part { h, .. }: &Part,
        &Judged { imbalance, .. }: &Judged<N, S::Rates>,
    ) -> Result<(), Failure> {
        if trajectory.acceleration_change.is_some() {
            return Err(Failure::NotClosed);
        }
        let Some(pending) = trajectory.pending.take() else { return Ok(()) };
        self.unbalanced = pending.unbalanced + 1;
        self.first_unbalanced = if self.unbalanced == 1 { h } else { pending.first_unbalanced };
        // after the last of these attempts, the whole step is accepted, and its error allows a longer step after it
        (self.after_rejection, self.is_retry) = (self.unbalanced < UNBALANCED, true);
        self.context.statistics.rejected_ledger += 1;
        self.context.control.reject(if self.unbalanced < UNBALANCED {
            h / (self.method.root(imbalance) / SAFETY).clamp(LEAST_SHRINK, LARGEST_SHRINK)
        } else {
            self.first_unbalanced
        });
        (self.short, self.energy) = (pending.short, None);
        Ok(())
    }

    /// Completes this `part` of the pending step: `trajectory` moves to its end, and the controller predicts the next
    /// step.
    #[inline(always)]
    pub fn complete<'s>(
        &'s mut self,
        trajectory: &'s mut Trajectory<N, S::Rates>,
        &Part { h, reached, .. }: &Part,
        Judged { end, ledger_rates, .. }: Judged<N, S::Rates>,
    ) -> Step<'s, N, S::Rates> {
        let Trajectory { point, time, pending, extension, accepted_fraction, acceleration_change, .. } = trajectory;
        let control = &mut *self.context.control;
        if let Some(Pending { h: size, error, cut, to_kink, after_rejection, short, .. }) = *pending {
            (self.unbalanced, self.after_rejection, self.is_retry, self.short) = (0, false, false, short);
            control.accept(self.method, size, cut, error, after_rejection);
            control.on_kink = to_kink && *accepted_fraction == 1.0;
        }
        if acceleration_change.is_some() {
            control.discontinuity(*acceleration_change);
        }
        self.context.statistics.accepted += 1;
        self.start = std::mem::replace(point, end);
        (*time, *pending) = (reached, None);
        let dense_output = Some((&*extension, *accepted_fraction));
        Step { h, time: reached, start: &self.start, end: point, ledger_rates, dense_output }
    }

    /// Linearises the equations at the start of the next step, `point` at `time` [s], and returns the energies.
    /// Counts the evaluation if it is new.
    #[inline(never)]
    fn linearise(&mut self, point: &Point<N>, time: f64, is_new: bool) -> [f64; 2] {
        let statistics = &mut self.context.statistics;
        statistics.evaluations += u64::from(is_new);
        statistics.jacobians += u64::from(is_new);
        let energy = self.system.linearise_with_energy(point, time, &mut self.lin);
        self.energy = Some(energy);
        energy
    }
}

impl<const N: usize, P> Trajectory<N, P> {
    /// Time left until the equations end, or are expected to end [s].
    #[inline]
    fn remaining(&self) -> f64 {
        let is_ahead = self.expected > self.time + self.resolution;
        (if is_ahead { self.expected.min(self.end) } else { self.end }) - self.time
    }

    /// Ledger rates after a `fraction` of the accepted part of the pending step, which has the size `h` [s].
    #[inline(always)]
    fn ledger_rates_at<S: SecondOrder<N, Rates = P> + ?Sized>(&self, system: &S, fraction: f64, h: f64) -> P {
        let point = self.extension.at(fraction * self.accepted_fraction);
        let mut rates = system.evaluate_at(&point, self.time + fraction * h).1;
        if self.acceleration_change.is_some() {
            system.undo_torque_change(&point, &mut rates);
        }
        rates
    }
}

/// Ledger rates that replace the halfway rates of the pending step. With them, Simpson's rule gives the result of
/// Boole's rule with two more points. Three points are too few for the heat of a fast motion that decays.
#[inline(never)]
fn refined<const N: usize, S: SecondOrder<N> + ?Sized>(
    system: &S,
    trajectory: &Trajectory<N, S::Rates>,
    h: f64,
    [first, halfway, last]: &[S::Rates; 3],
) -> S::Rates {
    let [quarter, three_quarters] = [0.25, 0.75].map(|fraction| trajectory.ledger_rates_at(system, fraction, h));
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

/// True if positions change within `h` [s] by more than rounding. Distances to kinks are sums of angles, so the rounding
/// is at least that of 1 rad. Steps that end on a kink do not move a system that rests on the kink, or immediately
/// before it.
fn moves<const N: usize>(point: &Point<N>, h: f64) -> bool {
    point.q.iter().zip(&point.v).any(|(q, v)| (h * v).abs() > POSITION_ROUNDING * q.abs().max(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_below_rounding_does_not_count() {
        // a light pinion at rest: 1e-13 rad/s, and a kink 5 us ahead
        for (q, v, h, does) in [(0.0, 1e-13, 5e-6, false), (0.0, 1e-9, 5e-6, true), (100.0, 1e-9, 5e-6, false)] {
            assert_eq!(moves(&Point { q: [q], v: [v] }, h), does, "{q} {v} {h}");
        }
    }
}
