//! Integration of a stretch of time, with its ledger: work, heat, mesh cycles, fatigue, switches of dry friction.

use super::causes::CAUSES;
use super::constants::Model;
use super::equations::{Equations, Power};
use super::failure::StepFailure;
use super::rigid::RigidEquations;
use super::state::State;
use super::strength::MeshLoad;
use crate::integrate::{self, Effort, Failure, Flow, Rodas5P, Step};

/// Attempts at steps granted to one call: bounds the time that a host can be kept waiting to some seconds.
pub const BUDGET: u64 = 2_000_000;

/// Why an accepted step is refused: a tooth bent beyond what teeth can bend.
struct Jump {
    deflection: f64,
    planet: usize,
    side: usize,
}

/// Simpson's rule on begin, middle and end of a step.
#[inline(always)]
fn simpson<const N: usize>(step: &Step<N, Power>, of: impl Fn(&Power) -> f64) -> f64 {
    let [a, m, b] = &step.power;
    step.h / 6.0 * (of(a) + 4.0 * of(m) + of(b))
}

/// Books work and heat of a step; the causes of heat beside contact only where there can be any.
#[inline(always)]
fn book<const N: usize>(step: &Step<N, Power>, work: &mut f64, heat: &mut [f64; CAUSES], all: bool) {
    *work += simpson(step, |p| p.input);
    for i in 0..if all { CAUSES } else { 1 } {
        heat[i] += simpson(step, |p| p.heat[i]);
    }
}

/// Integrates a differential with teeth to `until`.
pub fn teeth_stretch<const N: usize, const G: usize, const P: usize, const FULL: bool>(
    mut equations: Equations<N, G, P, FULL>,
    model: &Model,
    state: &mut State,
    until: f64,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let teeth = equations.teeth;
    let tolerance = model.parameters.solver.relative_tolerance;
    // the equations do not know the time: counted from here it is resolved as finely as steps can get
    let (mut point, mut time) = (state.point(), 0.0);
    let end = until - state.time;
    let mut good = (point, time);
    let mut outcome = Ok(());
    let mut switched = true;
    let cycle = Cycle { pitch: model.periods[teeth.layout.planet(0)] };
    while switched && time < end && outcome.is_ok() {
        switched = false;
        let State { control, statistics, work, heat, bias, fatigue, .. } = state;
        outcome = integrate::advance(
            &Rodas5P,
            &equations,
            &mut point,
            &mut time,
            end,
            Effort { tolerance, control, statistics, budget },
            |step| {
                let (approach, g, side) = equations.deepest(step.end);
                if approach > teeth.jump {
                    let planet = teeth.plan.group(g).planet;
                    return Err(Jump { deflection: approach * teeth.mesh.cone, planet, side });
                }
                book(&step, work, heat, FULL);
                if FULL && Equations::<N, G, P, FULL>::ENDS {
                    let i = Equations::<N, G, P, FULL>::PLANET;
                    let torque = [0, 1].map(|s| simpson(&step, |p| p.shaft[s]));
                    cycle.add(bias, [step.start.q[i], step.end.q[i]], step.h, torque);
                }
                if let (true, Some(strength)) = (FULL, &model.strength) {
                    count_fatigue(&equations, model, strength, &step, fatigue);
                }
                good = (*step.end, step.time);
                if FULL && equations.is_due(step.end) {
                    switched = true;
                    return Ok(Flow::Stop);
                }
                Ok(Flow::Continue)
            },
        );
        if switched {
            equations.settle(&point, heat);
        }
    }
    state.holds = equations.holds;
    state.set_point(&good.0);
    state.time += good.1;
    outcome.map_err(|failure| explain(failure, state.time, tolerance, teeth.jump * teeth.mesh.cone))
}

/// Not compiled into the loop of steps, which is the same whether a scene asks for strength or not.
#[inline(never)]
fn count_fatigue<const N: usize, const G: usize, const P: usize, const FULL: bool>(
    equations: &Equations<N, G, P, FULL>,
    model: &Model,
    strength: &super::strength::Strength,
    step: &Step<N, Power>,
    fatigue: &mut super::state::Fatigue,
) {
    let mut loads = [[MeshLoad::default(); 2]; G];
    let first = Equations::<N, G, P, FULL>::PLANET;
    let spin: [f64; G] = std::array::from_fn(|g| step.end.q[first + g] - step.start.q[first + g]);
    let roll = [0, 1].map(|s| step.end.q[s] - step.start.q[s]);
    let members: [f64; G] = std::array::from_fn(|g| equations.teeth.layout.members[g]);
    for g in 0..G {
        for s in 0..2 {
            equations.tooth_loads(&model.pair, step.end, g, s, |load| loads[g][s].add(strength, load));
        }
    }
    strength.count(fatigue, &spin, roll, &loads, &members);
}

/// Integrates an ideal differential with effects to `until`; as [`teeth_stretch`].
pub fn rigid_stretch<const N: usize>(
    mut equations: RigidEquations<N>,
    model: &Model,
    state: &mut State,
    until: f64,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let tolerance = model.parameters.solver.relative_tolerance;
    let (mut point, mut time) = (state.point(), 0.0);
    let end = until - state.time;
    let mut outcome: Result<(), Failure<Jump>> = Ok(());
    let mut good = (point, time);
    let mut switched = true;
    while switched && time < end && outcome.is_ok() {
        switched = false;
        let State { control, statistics, work, heat, .. } = state;
        outcome = integrate::advance(
            &Rodas5P,
            &equations,
            &mut point,
            &mut time,
            end,
            Effort { tolerance, control, statistics, budget },
            |step| {
                book(&step, work, heat, true);
                good = (*step.end, step.time);
                if equations.is_due(step.end) {
                    switched = true;
                    return Ok(Flow::Stop);
                }
                Ok(Flow::Continue)
            },
        );
        if switched {
            equations.settle(&point, heat);
        }
    }
    state.holds = equations.holds;
    state.set_point(&good.0);
    state.time += good.1;
    outcome.map_err(|failure| explain(failure, state.time, tolerance, f64::INFINITY))
}

fn explain(failure: Failure<Jump>, time: f64, tolerance: f64, limit: f64) -> StepFailure {
    let message = match failure {
        Failure::Refused(Jump { deflection, planet, side }) => format!(
            "a tooth would jump between planet[{}] and the {} side gear: deflection {:.3} mm along the line of action exceeds the limit {:.3} mm; \
             reduce the load or raise contact.stiffness",
            planet + 1,
            ["left", "right"][side],
            deflection * 1e3,
            limit * 1e3
        ),
        Failure::StepTooSmall { size } => format!(
            "the step size fell to {size:.3e} s, below what time can resolve; look at the inputs, \
             or loosen solver.relative_tolerance = {tolerance:e}"
        ),
        Failure::TooManySteps => format!(
            "{BUDGET} attempts at steps were not enough for one communication step; shorten it, \
             loosen solver.relative_tolerance = {tolerance:e}, or add contact.damping"
        ),
    };
    StepFailure { time, message }
}

/// Watches planets pass from one mesh cycle to the next, and keeps the means of shaft torques over whole ones.
///
/// Wrapping takes out whole pitches, so that the boundaries of cycles stay where they are.
struct Cycle {
    pitch: f64,
}

impl Cycle {
    /// Adds the impulses `torque` [N·m·s] of a step of size `h` in which the planet went from one position to another.
    fn add(&self, bias: &mut super::state::Bias, position: [f64; 2], h: f64, torque: [f64; 2]) {
        let place = position.map(|q| q / self.pitch);
        let cycle = place.map(libm::floor);
        let mut left = 1.0;
        if cycle[0] != cycle[1] {
            // the part of the step before the boundary belongs to the cycle that ends
            let boundary = cycle[0].max(cycle[1]);
            let part = ((boundary - place[0]) / (place[1] - place[0])).clamp(0.0, 1.0);
            let time = bias.time + part * h;
            let sum = [0, 1].map(|s| bias.sum[s] + part * torque[s]);
            if bias.whole && time > 0.0 {
                bias.last = Some((sum.map(|x| x / time), time));
            }
            *bias = super::state::Bias { sum: [0.0; 2], time: 0.0, whole: true, last: bias.last };
            left = 1.0 - part;
        }
        bias.time += left * h;
        for s in 0..2 {
            bias.sum[s] += left * torque[s];
        }
    }
}
