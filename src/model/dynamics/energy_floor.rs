//! Smallest energy that the balance of a step resolves.
//!
//! The balance is relative to the energy exchanged in the step. In a motion that decays to rest, this energy decays as
//! well, so that a purely relative balance would resolve the decay to the last bit. The floor is the sum of two
//! energies:
//!
//!   rounding    Σ |F| δ, with the force F of all springs on a body at the end of the step, and the rounding δ of the
//!               body's position. A shift by δ changes the stored energy by F δ, and no input does this work.
//!   tolerance   ½ Σ J (tol/w)², with the weights w of the error norm at rest, which does not resolve speeds below
//!               tol/w. It counts near rest, where it exceeds the tolerance of the whole kinetic energy, and while no
//!               flanks touch. Otherwise, a small energy may be the beginning of a large one, as at the start of an
//!               impact. Between impacts, only held bodies exchange energy: they ring until they are at rest.

use super::FrictionEquations;
use crate::integrate::{POSITION_ROUNDING, Point, SecondOrder};
use crate::model::scene::layout::LEFT;
use crate::model::scene::{CARRIER, Layout, MAX_DOF};

/// Maximum fraction of the kinetic energy that rounding of positions changes in moving gears. A larger residual is an
/// error of the step, and the forces of the springs need not be evaluated.
const ROUNDED_SHARE: f64 = 1e-9;

/// Returns the energy [J] below which a `residual` [J] of the balance of a step between `ends` is not resolved, if the
/// motion has the relative `tolerance`. `is_apart` is true if no flanks touch at either end. `spring_forces` are the
/// forces on all bodies at the end, at rest and without inputs, and `kinetic_energy` is in J.
pub fn energy_floor<const N: usize>(
    equations: &(impl FrictionEquations<N> + SecondOrder<N>),
    [start, end]: [&Point<N>; 2],
    (tolerance, is_apart): (f64, bool),
    residual: f64,
    spring_forces: impl Fn() -> [f64; MAX_DOF],
    kinetic_energy: impl Fn(&Point<N>) -> f64,
) -> f64 {
    let layout = equations.layout();
    let rest = Point { q: end.q, v: [0.0; N] };
    let unresolved = Point { v: equations.weights(&rest).v.map(|weight| tolerance / weight), ..rest };
    let [unresolved, kinetic] = [&unresolved, end].map(kinetic_energy);
    let is_near_rest = is_apart || tolerance * kinetic < unresolved;
    if !is_near_rest && residual > ROUNDED_SHARE * kinetic {
        return 0.0;
    }
    let (force, rounding) = (spring_forces(), roundings(layout, [start, end]));
    let shifted: f64 = (0..layout.count()).map(|i| layout.bodies(i) * force[i].abs() * rounding[i]).sum();
    if is_near_rest { shifted + unresolved } else { shifted }
}

/// Rounding of the absolute position of each body in a step between `ends` [rad; seats m]. Positions of side gears and
/// pins are relative to the carrier; positions of attached bodies are relative to the body against which they turn.
fn roundings<const N: usize>(layout: &Layout, [start, end]: [&Point<N>; 2]) -> [f64; N] {
    let mut rounding: [f64; N] = std::array::from_fn(|i| POSITION_ROUNDING * start.q[i].abs().max(end.q[i].abs()));
    let on_carrier =
        [LEFT, LEFT + 1].into_iter().chain((0..layout.groups).filter(|_| layout.has_pins).map(|g| layout.pin(g)));
    for i in on_carrier {
        rounding[i] += rounding[CARRIER];
    }
    for (i, to) in layout.attached() {
        rounding[i] += rounding[to];
    }
    rounding
}
