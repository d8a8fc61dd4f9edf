//! Records completed steps: work and heat in the ledger, temperatures, mean torques, damage and mesh history.

use super::completed_step::StepMotion;
use super::failure::ExcessiveDeflection;
use super::watching::{self, watch_step};
use crate::integrate::{Curve, Point, SecondOrder, Step};
use crate::model::assembly::Model;
use crate::model::dynamics::ledger_rates::{LedgerRates, simpson};
use crate::model::dynamics::shaft_means::{CycleCounter, StepCurves};
use crate::model::dynamics::shape::Shape;
use crate::model::dynamics::{
    Equations, FrictionEquations, IdealEquations, InputsAndFriction, Largest, MAX_SIZE, Sums,
};
use crate::model::effect_kinds::BUILT;
use crate::model::effects::Memories;
use crate::model::scene::CARRIER;
use crate::model::scene::layout::LEFT;
use crate::model::setup::CONTACT_HEAT;
use crate::numeric::quotient;

/// Simulation time at which the clock of the steps is zero [s], and the sums and memories to which a step adds. Without
/// memories, damage and mesh history are left out.
pub type Recorded<'a> = (f64, &'a mut Sums, Option<&'a mut Memories>);

/// Equations whose completed steps can be recorded in the ledger.
pub trait LedgerEquations<const N: usize>: SecondOrder<N, Rates = LedgerRates> + FrictionEquations<N> {
    /// Returns the meshes whose flanks touch, one bit for each. Fails if the deflection of a tooth exceeds the limit.
    /// The error names mesh and deflection.
    fn check_deflection(&self, at: &Point<N>) -> Result<u8, ExcessiveDeflection>;
    /// Records a completed step, with the dense output of its pending step. Steps of fixed size and steps of the host's
    /// solver are never pending and have no dense output.
    fn record(&self, model: &Model, step: &Step<N, LedgerRates>, to: Recorded);
}

impl<const N: usize, S: Shape<N>> LedgerEquations<N> for Equations<'_, S, N> {
    #[inline]
    fn check_deflection(&self, at: &Point<N>) -> Result<u8, ExcessiveDeflection> {
        let ((approach, g, side), touching) = self.deepest_of_touching(at);
        if approach > self.teeth.deflection_limit {
            return Err(ExcessiveDeflection { deflection: approach, planet: self.teeth.plan.group(g).planet, side });
        }
        Ok(touching)
    }

    #[inline]
    fn record(&self, model: &Model, step: &Step<N, LedgerRates>, (begin, sums, memories): Recorded) {
        sums.add(step, S::MAY_ACT);
        if self.teeth.records_more {
            self.record_more(model, step, (begin, sums, memories));
        }
        if S::MAY_HAVE_ENDS && self.teeth.layout.has_ends() {
            let torque = [0, 1].map(|s| simpson(step, |p| p.shaft[s]));
            let turned = [0, 1].map(|s| step.end.q[s] - step.start.q[s]);
            let cycle = CycleCounter { pitch: model.periods[LEFT] };
            cycle.add(&mut sums.torque_means, turned, (step.h, torque), || self.step_curves(&cycle, step));
        }
    }
}

/// Warms the thermal nodes with the heat of a step, if the scene has such nodes.
#[inline]
fn warm_up<const N: usize>(model: &Model, applied: &InputsAndFriction, step: &Step<N, LedgerRates>, sums: &mut Sums) {
    if let Some(network) = &model.thermal {
        let around = [step.time - 0.5 * step.h, step.time].map(|time| {
            let later = applied.driven.then(|| applied.input_derivatives.after(time, &applied.inputs).0);
            network.around.changed(later.unwrap_or(applied.inputs).changes_outside())
        });
        let turned = (step.end.q[CARRIER] - step.start.q[CARRIER]).abs();
        network.advance(&mut sums.thermal, &sums.heat, step.h, (turned / step.h, around));
    }
}

impl<const N: usize> LedgerEquations<N> for IdealEquations<'_, N> {
    fn check_deflection(&self, _: &Point<N>) -> Result<u8, ExcessiveDeflection> {
        Ok(0)
    }

    fn record(&self, model: &Model, step: &Step<N, LedgerRates>, (_, sums, _): Recorded) {
        sums.add(step, true);
        warm_up(model, self.applied(), step, sums);
    }
}

impl<const N: usize, S: Shape<N>> Equations<'_, S, N> {
    /// Rolling and shaft torques within a completed step. Torques that do not follow from the dense output follow the
    /// parabola through the ledger rates.
    #[inline(never)]
    fn step_curves(&self, cycle: &CycleCounter, step: &Step<N, LedgerRates>) -> StepCurves {
        let rolling = |at: &Point<N>| cycle.rolling([at.q[0], at.q[1]]);
        let torque = |s: usize| match step.dense_output {
            Some((extension, accepted_fraction)) if self.teeth.plan.shafts[s] => {
                Curve::of(extension, |at| self.shaft_torque(at, s)).up_to(accepted_fraction)
            }
            _ => Curve::parabola(step.ledger_rates.each_ref().map(|rates| rates.shaft[s])),
        };
        let rolling = match step.dense_output {
            Some((extension, accepted_fraction)) => Curve::of(extension, rolling).up_to(accepted_fraction),
            None => Curve::line(rolling(step.start), rolling(step.end)),
        };
        StepCurves { rolling, torque: [torque(0), torque(1)] }
    }

    /// Records what few scenes need: jumps of elastic energy, temperatures, damage, mesh history. None of these changes
    /// a force of the plain equations, so scenes with only these effects use the plain equations.
    #[inline(never)]
    fn record_more(&self, model: &Model, step: &Step<N, LedgerRates>, (begin, sums, memories): Recorded) {
        if !self.teeth.contact.mesh.engagement.corner_contact() {
            let ends = [step.start, step.end].map(|at| Point::of([&at.q, &at.v]));
            sums.heat[CONTACT_HEAT] -= self.largest().energy_of_abrupt_contact(ends.each_ref());
        }
        if BUILT {
            warm_up(model, &self.applied, step, sums);
        }
        if let (true, Some(memories)) = (BUILT, memories)
            && watching::records_steps(model, memories)
        {
            let completed = StepMotion::new(self, step, begin);
            watch_step(&self.largest(), model, &completed, memories);
        }
    }
}

impl Largest<'_> {
    /// Elastic energy that deflected pairs gain or lose in a step when they enter or leave contact abruptly, without
    /// corner contact [J].
    #[inline(never)]
    fn energy_of_abrupt_contact(&self, [start, end]: [&Point<MAX_SIZE>; 2]) -> f64 {
        let between = |t: f64| Point {
            q: std::array::from_fn(|i| start.q[i] + t * (end.q[i] - start.q[i])),
            v: std::array::from_fn(|i| start.v[i] + t * (end.v[i] - start.v[i])),
        };
        let mut energy = 0.0;
        for g in 0..self.groups() {
            for s in 0..2 {
                let [from, to] = [start, end].map(|at| self.mesh_state(at, g, s).position);
                let change = [to[0] - from[0], to[1] - from[1]];
                // in a very short step, this fraction of the step would be lost in rounding
                let half_width = CONTACT_CHANGE_HALF_WIDTH.max(quotient(LEAST_ARC, change[1].abs()).unwrap_or(1.0));
                self.teeth.contact.mesh.engagement.passages_of_ends(from, change, |t| {
                    let [before, after] = [t - half_width, t + half_width].map(between);
                    energy += self.members(g) * self.energy_brought([&before, &after], g, s);
                });
            }
        }
        energy
    }
}

/// Fraction of a step before and after the instant at which a pair enters or leaves contact. The jump is the difference
/// of the energies at both times.
const CONTACT_CHANGE_HALF_WIDTH: f64 = 1e-9;
/// Smallest arc along the line of action that rounding resolves [rad].
const LEAST_ARC: f64 = 1e-13;
