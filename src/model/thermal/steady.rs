//! Steady temperatures, at which the heats of a cycle balance the heat given off. The heats themselves depend on
//! temperature.
//!
//! ```text
//! R(θ) = P(θ) + k − K θ = 0
//! ```
//!
//! with the mean heats P, the matrix K of the conductances and the flow k from ambient. The solution is approached by
//! integrating the network with the implicit Euler method. The steps h grow up to 1e9 s:
//!
//! ```text
//! (C/h + K − ∂P/∂θ) δ = R(θ)
//! ```
//!
//! The solution is therefore the state that the nodes reach when they warm up from a cold start, or cool down from a
//! hot one. If the two states differ, there are several steady states. If no friction depends on temperature, the
//! system is linear: one longest step solves it, and a second one confirms the solution.
//!
//! Source: pseudo-transient continuation, C. T. Kelley and D. E. Keyes, SIAM J. Numerical Analysis 35 (1998), p. 508.

use nalgebra::{SMatrix, SVector};

use super::network::GEARS_TO_CASE;
use super::{CASE, NODES, Network, OIL};
use crate::declaration::Range;
use crate::declaration::units::TEMPERATURES;

/// First and longest steps [s].
const STEPS: [f64; 2] = [60.0, 1e9];
/// Ratio of a step to the previous one.
const GROWTH: f64 = 8.0;
/// Maximum number of steps.
const MOST_STEPS: usize = 60;
/// Temperature increment of the difference quotients that approximate ∂P/∂θ [K].
const DIFFERENCE: f64 = 1.0;
/// Change in the longest step below which temperatures are steady [K].
const STEADY: f64 = 1e-6;

/// Mean heats of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CycleMeans {
    /// Heat that enters each node [W].
    pub power: [f64; NODES],
    /// Magnitude of the mean carrier speed [rad/s].
    pub speed: f64,
}

/// Result of a search for steady temperatures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steady {
    /// Steady temperatures [K].
    At([f64; NODES]),
    /// After a longest step, at least one node is outside the permitted temperature range. Index and temperature [K] of
    /// the node that is farthest outside.
    Beyond(usize, f64),
    /// No steady temperatures were found.
    NotFound,
}

impl<const H: usize> Network<H> {
    /// Returns the steady temperatures that are reached if all nodes start at `begin` [K]. The oil of a given sump
    /// instead starts at the sump temperature and keeps it. `heats` returns the heats of a cycle at given temperatures.
    /// `influential` lists the nodes whose temperatures influence these heats. Fails if `heats` fails.
    pub fn steady<E>(
        &self,
        begin: f64,
        influential: &[usize],
        mut heats: impl FnMut(&[f64; NODES]) -> Result<CycleMeans, E>,
    ) -> Result<Steady, E> {
        let mut at = SVector::<f64, NODES>::repeat(begin);
        at[OIL] = self.around.sump.unwrap_or(begin);
        let [first, longest] = STEPS;
        let mut h = if influential.is_empty() { longest } else { first };
        let Range { min: coldest, max: hottest } = TEMPERATURES;
        // oil laws are not valid far outside this range; iterations may leave the range, but the result must not
        let within = |at: &SVector<f64, NODES>| at.map(|x| x.clamp(coldest, hottest)).into();
        // heats that do not depend on temperature are computed once
        let constant = if influential.is_empty() { Some(heats(&within(&at))?) } else { None };
        for _ in 0..MOST_STEPS {
            let cycle = constant.map_or_else(|| heats(&within(&at)), Ok)?;
            let (mut matrix, flow) = self.conduction(cycle.speed);
            let mut residual = SVector::from(cycle.power) + flow - matrix * at;
            for i in 0..NODES {
                matrix[(i, i)] += self.capacity[i] / h;
            }
            for &j in influential {
                let mut perturbed = at;
                perturbed[j] += DIFFERENCE;
                let power = heats(&within(&perturbed))?.power;
                for i in 0..NODES {
                    matrix[(i, j)] -= (power[i] - cycle.power[i]) / DIFFERENCE;
                }
            }
            if self.around.sump.is_some() {
                (0..NODES).for_each(|j| matrix[(OIL, j)] = 0.0);
                (matrix[(OIL, OIL)], residual[OIL]) = (1.0, 0.0);
            }
            let Some(change) = matrix.lu().solve(&residual) else { return Ok(Steady::NotFound) };
            at += change;
            if h == longest && change.amax() < STEADY {
                return Ok(Steady::At(at.into()));
            }
            let out = |x: f64| (x - x.clamp(coldest, hottest)).abs();
            if h == longest
                && let Some(node) =
                    (0..NODES).filter(|&i| out(at[i]) > 0.0).max_by(|&a, &b| out(at[a]).total_cmp(&out(at[b])))
            {
                return Ok(Steady::Beyond(node, at[node]));
            }
            h = longest.min(GROWTH * h);
        }
        Ok(Steady::NotFound)
    }

    /// Matrix of the conductances [W/K] with the carrier at `speed` [rad/s], and the heat flow from ambient [W].
    fn conduction(&self, speed: f64) -> (SMatrix<f64, NODES, NODES>, SVector<f64, NODES>) {
        let (mut matrix, mut flow) = (SMatrix::zeros(), SVector::zeros());
        for i in GEARS_TO_CASE {
            let g = self.to_oil[i].at(speed);
            for (from, to) in [(i, OIL), (OIL, i)] {
                matrix[(from, from)] += g;
                matrix[(from, to)] -= g;
            }
        }
        let g = self.to_ambient.at(speed);
        matrix[(CASE, CASE)] += g;
        flow[CASE] = g * self.around.ambient;
        (matrix, flow)
    }
}
