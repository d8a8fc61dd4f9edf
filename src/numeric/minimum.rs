//! A local minimum of a function of a few variables, from its exact gradient and Hessian.
//!
//! Newton's method is damped if the Hessian is not positive definite (Levenberg). The gradient also vanishes at maxima
//! and saddle points. If it vanishes, the Hessian decides, and the search continues along a direction in which the
//! function curves down (J. Nocedal, S. J. Wright, *Numerical Optimization*, 2nd edition, sections 3.4 and 4.3).

use nalgebra::{DMatrix, DVector};

use super::sqrt;

/// A function to be minimised.
pub trait Landscape {
    /// Value of the function at `x`.
    fn value(&self, x: &DVector<f64>) -> f64;
    /// Gradient and Hessian at `x`.
    fn slopes(&self, x: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>);
    /// True if a minimum at `x` would be acceptable. The search fails at the first `x` for which it is false.
    fn is_near(&self, _x: &DVector<f64>) -> bool {
        true
    }
}

/// Settings of the search.
#[derive(Clone, Debug)]
pub struct Search {
    /// Largest change of a variable in one step, so that the search does not leap over a nearby minimum.
    pub longest: f64,
    /// Largest gradient component accepted as a balance.
    pub balance: f64,
    /// Largest gradient component accepted if rounding of the values prevents `balance`.
    pub rough: f64,
    /// Preferred direction in which the search leaves a saddle point.
    pub lean: DVector<f64>,
    /// Known direction of a valley. Damping hardly limits steps along this direction, and variables that nothing else
    /// constrains move along with it.
    pub valley: Option<DVector<f64>>,
}

/// Maximum number of iterations without a known valley. A few are enough.
const MAX_ITERATIONS: usize = 200;
/// Maximum number of iterations along a valley, in which contacts open and close.
const MAX_ITERATIONS_ALONG: usize = 2000;
/// Maximum number of trials of one step, with growing damping or shrinking length.
const TRIALS: usize = 60;
/// Fraction of the damping that acts along a valley.
const EASE: f64 = 1e-4;
/// Curvature relative to the Hessian's diagonal below which the function counts as flat: a flat valley is not a saddle
/// point.
const FLAT: f64 = 1e-9;
/// Number of inverse iterations for the direction of smallest curvature. Each gains at least one digit.
const INVERSE_ITERATIONS: usize = 16;

impl Search {
    /// Returns the minimum reached by descent from `start`. Returns `None` if [`Landscape::is_near`] is false on the
    /// way, if no step decreases the value although the gradient exceeds `rough`, or after too many iterations.
    pub fn minimum(&self, landscape: &dyn Landscape, start: DVector<f64>) -> Option<DVector<f64>> {
        let (mut x, mut damping) = (start, 0.0);
        let mut value = landscape.value(&x);
        let most = if self.valley.is_some() { MAX_ITERATIONS_ALONG } else { MAX_ITERATIONS };
        for _ in 0..most {
            if !landscape.is_near(&x) {
                return None;
            }
            let (gradient, hessian) = landscape.slopes(&x);
            let descended = if gradient.amax() <= self.balance {
                let Some(way) = downward(&hessian, &self.lean) else {
                    return Some(polished(landscape, x, gradient, hessian));
                };
                self.leave(landscape, (&x, value), &way)
            } else {
                self.step(landscape, (&x, value), (&gradient, &hessian), &mut damping)
            };
            let Some(next) = descended else {
                let settled = gradient.amax() <= self.rough && downward(&hessian, &self.lean).is_none();
                return settled.then_some(x);
            };
            (x, value) = next;
        }
        None
    }

    /// Takes a step from a saddle point along `way` that decreases the value. Returns the new point and its value, or
    /// `None` if no step decreases the value.
    fn leave(
        &self,
        landscape: &dyn Landscape,
        (x, value): (&DVector<f64>, f64),
        way: &DVector<f64>,
    ) -> Option<(DVector<f64>, f64)> {
        (0..TRIALS as i32)
            .map(|k| x + way * (self.longest / way.amax() * 0.5f64.powi(k)))
            .map(|trial| {
                let there = landscape.value(&trial);
                (trial, there)
            })
            .find(|&(_, there)| there < value)
    }

    /// Takes a damped Newton step that decreases the value. Returns the new point and its value, or `None` if no step
    /// decreases the value.
    fn step(
        &self,
        landscape: &dyn Landscape,
        (x, value): (&DVector<f64>, f64),
        (gradient, hessian): (&DVector<f64>, &DMatrix<f64>),
        damping: &mut f64,
    ) -> Option<(DVector<f64>, f64)> {
        let curvature = hessian.diagonal().amax();
        // on a slope without curvature, the damping limits the step
        let size = if curvature > 0.0 { curvature } else { gradient.amax() / self.longest };
        for _ in 0..TRIALS {
            let mut damped = hessian.clone();
            (0..x.len()).for_each(|i| damped[(i, i)] += *damping * size);
            if let Some(valley) = &self.valley {
                damped.ger((EASE - 1.0) * *damping * size / valley.norm_squared(), valley, valley, 1.0);
            }
            let step = damped.cholesky().map(|c| c.solve(gradient));
            if let Some(step) = step.filter(|step| step.amax() < self.longest) {
                let trial = x - step;
                let there = landscape.value(&trial);
                // near the minimum, values differ by less than their rounding
                let level = there <= value + 1e-12 * size;
                if there < value || level && landscape.slopes(&trial).0.norm() < gradient.norm() {
                    *damping = if *damping < 1e-14 { 0.0 } else { *damping * 0.1 };
                    return Some((trial, there));
                }
            }
            *damping = if *damping == 0.0 { 1e-12 } else { *damping * 10.0 };
        }
        None
    }
}

/// Continues Newton's method from `x`, near a minimum, as long as each step at least halves the gradient. At a contact
/// that barely touches, the gradient decreases only linearly.
fn polished(
    landscape: &dyn Landscape,
    mut x: DVector<f64>,
    mut gradient: DVector<f64>,
    mut hessian: DMatrix<f64>,
) -> DVector<f64> {
    while gradient.amax() > 0.0 {
        let Some(cholesky) = hessian.cholesky() else { break };
        let trial = &x - cholesky.solve(&gradient);
        let (next, curvature) = landscape.slopes(&trial);
        // written so that NaN also ends the loop
        let halved = next.amax() <= 0.5 * gradient.amax();
        if !halved {
            break;
        }
        (x, gradient, hessian) = (trial, next, curvature);
    }
    x
}

/// Direction in which a function with this `hessian` curves down, on the side of `lean`. `None` if there is no such
/// direction.
fn downward(hessian: &DMatrix<f64>, lean: &DVector<f64>) -> Option<DVector<f64>> {
    let n = lean.len();
    // variables of different units are scaled by their own curvature, which keeps the signs of all curvatures
    let scale = DVector::from_fn(n, |i, _| {
        let own = hessian[(i, i)].abs();
        if own > 0.0 { 1.0 / sqrt(own) } else { 1.0 }
    });
    let scaled = DMatrix::from_fn(n, n, |i, j| hessian[(i, j)] * scale[i] * scale[j]);
    let shifted = |shift: f64| (&scaled + DMatrix::identity(n, n) * shift).cholesky();
    if shifted(FLAT).is_some() {
        return None;
    }
    // the smallest of these shifts that makes it definite is near the most negative curvature
    let cholesky = (0..=40).map(|k| FLAT * 2f64.powi(k)).find_map(shifted)?;
    let units = (0..n).map(|i| DVector::from_fn(n, |j, _| if i == j { 1.0 } else { 0.0 }));
    std::iter::once(lean.component_div(&scale)).chain(units).find_map(|start| {
        let way = (0..INVERSE_ITERATIONS).fold(start, |way, _| cholesky.solve(&way).normalize());
        (way.dot(&(&scaled * &way)) < 0.0).then(|| way.component_mul(&scale))
    })
}
