//! Integration of a stretch of time, with its ledger: work, heat, mesh cycles, fatigue, switches of dry friction.

use super::causes::CAUSES;
use super::constants::Model;
use super::dry::Hold;
use super::equations::{Equations, Power};
use super::failure::StepFailure;
use super::layout::HOLDS;
use super::parameters::{Method, SolverSpec};
use super::rigid::RigidEquations;
use super::state::{Bias, Fatigue, State};
use super::strength::MeshLoad;
use crate::integrate::{
    self, DormandPrince, Effort, Erased, Failure, Flow, Object, Point, Radau, Rodas4, Rodas5P, SecondOrder, Step,
};

/// Attempts at steps granted to one call: bounds the time that a host can be kept waiting to some seconds.
pub const BUDGET: u64 = 2_000_000;

/// Why an accepted step is refused: a tooth bent beyond what teeth can bend.
pub struct Jump {
    deflection: f64,
    limit: f64,
    planet: usize,
    side: usize,
}

/// What is counted along with the motion.
pub struct Records<'a> {
    bias: &'a mut Bias,
    fatigue: &'a mut Fatigue,
}

/// Equations whose motion can be played over a stretch of time.
pub trait Scene<const N: usize>: SecondOrder<N, Power = Power> {
    /// Whether heat has causes beside contact.
    const ALL_CAUSES: bool;
    /// How dry friction holds bodies.
    fn holds(&self) -> &[Hold; HOLDS];
    /// Whether a hold is due to switch.
    fn is_due(&self, at: &Point<N>) -> bool;
    /// Switches holds that are due and books what their springs give up.
    fn settle(&mut self, at: &Point<N>, heat: &mut [f64; CAUSES]);
    /// Refuses an accepted step that teeth cannot follow, and records what is counted.
    fn record(&self, model: &Model, step: &Step<N, Power>, records: &mut Records) -> Result<(), Jump>;
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

/// Integrates to `until` [s].
pub fn stretch<const N: usize, E: Scene<N>>(
    mut equations: E,
    model: &Model,
    state: &mut State,
    until: f64,
    budget: &mut u64,
) -> Result<(), StepFailure> {
    let solver = &model.parameters.solver;
    // the equations do not know the time: counted from here it is resolved as finely as steps can get
    let (mut point, mut time) = (state.point(), 0.0);
    let end = until - state.time;
    let mut good = (point, time);
    let mut outcome = Ok(());
    let mut switched = true;
    while switched && time < end && outcome.is_ok() {
        switched = false;
        let State { control, statistics, work, heat, bias, fatigue, .. } = state;
        let mut records = Records { bias, fatigue };
        let mut observe = |step: Step<N, Power>| {
            equations.record(model, &step, &mut records)?;
            book(&step, work, heat, E::ALL_CAUSES);
            good = (*step.end, step.time);
            if equations.is_due(step.end) {
                switched = true;
                return Ok(Flow::Stop);
            }
            Ok(Flow::Continue)
        };
        let effort = Effort { tolerance: solver.relative_tolerance, control, statistics, budget };
        outcome = if solver.method == Method::Adaptive {
            integrate::advance(&Rodas5P, &equations, &mut point, &mut time, end, effort, observe)
        } else {
            otherwise(solver, &equations, &mut point, &mut time, end, effort, &mut observe)
        };
        if switched {
            equations.settle(&point, heat);
        }
    }
    state.holds = *equations.holds();
    state.set_point(&good.0);
    state.time += good.1;
    outcome.map_err(|failure| explain(failure, state.time, solver))
}

/// Integrates by another method than the default.
#[inline(never)]
fn otherwise<const N: usize>(
    solver: &SolverSpec,
    system: &dyn Object<N, Power>,
    point: &mut Point<N>,
    time: &mut f64,
    until: f64,
    effort: Effort,
    observe: &mut dyn FnMut(Step<N, Power>) -> Result<Flow, Jump>,
) -> Result<(), Failure<Jump>> {
    let system = &Erased(system);
    match solver.method {
        Method::Adaptive => integrate::advance(&Rodas5P, system, point, time, until, effort, observe),
        Method::Radau => integrate::advance(&Radau, system, point, time, until, effort, observe),
        Method::Rodas4 => integrate::advance(&Rodas4, system, point, time, until, effort, observe),
        Method::DormandPrince => integrate::advance(&DormandPrince, system, point, time, until, effort, observe),
        Method::FixedStep => {
            let counts = (effort.statistics, effort.budget);
            integrate::advance_fixed(system, point, time, until, solver.fixed_step, counts, observe)
        }
    }
}

impl<const N: usize, const G: usize, const P: usize, const FULL: bool> Scene<N> for Equations<'_, N, G, P, FULL> {
    const ALL_CAUSES: bool = FULL;

    fn holds(&self) -> &[Hold; HOLDS] {
        &self.holds
    }

    #[inline(always)]
    fn is_due(&self, at: &Point<N>) -> bool {
        FULL && self.hold_is_due(at)
    }

    fn settle(&mut self, at: &Point<N>, heat: &mut [f64; CAUSES]) {
        self.settle_holds(at, heat);
    }

    #[inline(always)]
    fn record(&self, model: &Model, step: &Step<N, Power>, records: &mut Records) -> Result<(), Jump> {
        let teeth = self.teeth;
        let (approach, g, side) = self.deepest(step.end);
        if approach > teeth.jump {
            let planet = teeth.plan.group(g).planet;
            let [deflection, limit] = [approach, teeth.jump].map(|arc| arc * teeth.mesh.cone);
            return Err(Jump { deflection, limit, planet, side });
        }
        if FULL && Self::ENDS {
            let i = Self::PLANET;
            let torque = [0, 1].map(|s| simpson(step, |p| p.shaft[s]));
            let cycle = Cycle { pitch: model.periods[teeth.layout.planet(0)] };
            cycle.add(records.bias, [step.start.q[i], step.end.q[i]], step.h, torque);
        }
        if let (true, Some(strength)) = (FULL, &model.strength) {
            count_fatigue(self, model, strength, step, records.fatigue);
        }
        Ok(())
    }
}

impl<const N: usize> Scene<N> for RigidEquations<'_, N> {
    const ALL_CAUSES: bool = true;

    fn holds(&self) -> &[Hold; HOLDS] {
        &self.holds
    }

    fn is_due(&self, at: &Point<N>) -> bool {
        self.hold_is_due(at)
    }

    fn settle(&mut self, at: &Point<N>, heat: &mut [f64; CAUSES]) {
        self.settle_holds(at, heat);
    }

    fn record(&self, _: &Model, _: &Step<N, Power>, _: &mut Records) -> Result<(), Jump> {
        Ok(())
    }
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

fn explain(failure: Failure<Jump>, time: f64, solver: &SolverSpec) -> StepFailure {
    let tolerance = solver.relative_tolerance;
    let message = match failure {
        Failure::Refused(Jump { deflection, limit, planet, side }) => format!(
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
        Failure::Diverged => format!(
            "a step of solver.fixed_step = {:e} s could not be solved; make it shorter, or take solver.method = adaptive",
            solver.fixed_step
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
