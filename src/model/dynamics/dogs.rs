//! Dog clutches in the equations: when they switch, and what a switch does.

use super::FrictionEquations;
use crate::integrate::{Point, SecondOrder, TimedPoint};
use crate::model::scene::{Dog, DogMotion, Dogs, Inputs};

/// Equations of gears with dog clutches between side gears and half-shafts.
pub trait DogEquations<const N: usize>: FrictionEquations<N> {
    /// Dog clutch of side `s`, if there is one.
    fn dog(&self, s: usize) -> Option<&Dog> {
        self.body_effects()?.half_shafts.dogs[s].as_ref()
    }

    /// Motion across the dog clutch of side `s`.
    fn dog_motion(&self, s: usize, at: &Point<N>) -> DogMotion {
        let end = self.layout().end(s);
        let (twist, rate, dogs) = (at.q[end], at.v[s] - at.v[end], &self.applied().dogs);
        let torque = self.body_effects().map_or(0.0, |all| all.half_shafts.torque(s, [twist, rate], dogs));
        DogMotion { twist, rate, torque }
    }

    /// Distance of each dog clutch from its switch, negative if it is due; `None` if it does not switch.
    fn dog_margins(&self, at: &Point<N>) -> [Option<f64>; 2] {
        [0, 1].map(|s| {
            let dog = self.dog(s)?;
            let margin = dog.margin(self.applied().dogs.of(s), &self.dog_motion(s, at));
            Some(margin).filter(|margin| margin.is_finite())
        })
    }

    /// Fraction of a step after which friction or a dog clutch switches, or `None` if neither does.
    fn switch_crossing(&self, start: TimedPoint<N>, end: TimedPoint<N>) -> Option<f64> {
        let of = |s: usize| {
            let dog = self.dog(s)?;
            let motions = [start, end].map(|at| self.dog_motion(s, at.point));
            dog.crossing(self.applied().dogs.of(s), motions.each_ref())
        };
        self.friction_crossing(start, end).into_iter().chain((0..2).filter_map(of)).reduce(f64::min)
    }

    /// True if friction or a dog clutch is due to switch at `at`, `time` [s] after the inputs were set.
    #[inline]
    fn is_switch_due(&self, at: &Point<N>, time: f64) -> bool {
        self.is_friction_due(at, time) || self.dog_margins(at).iter().flatten().any(|&margin| margin <= 0.0)
    }

    /// Switches the dog clutches that are due at `at`. The energy of a released twist becomes heat.
    fn settle_dogs(&mut self, at: &Point<N>, heat: &mut [f64])
    where
        Self: SecondOrder<N>,
    {
        for s in 0..2 {
            let Some(&dog) = self.dog(s) else { continue };
            let state = self.applied().dogs.of(s);
            let Some(after) = dog.switched(state, &self.dog_motion(s, at)) else { continue };
            let before = self.energy(at)[1];
            self.applied_mut().dogs.closed[s] = after;
            heat[dog.heat_index] += before - self.energy(at)[1];
        }
    }

    /// Passes the commands of `inputs` to the dog clutches.
    fn command_dogs(&mut self, inputs: &Inputs) {
        self.applied_mut().dogs.commanded = Dogs::commands(inputs);
    }
}

impl<const N: usize, E: FrictionEquations<N> + ?Sized> DogEquations<N> for E {}
