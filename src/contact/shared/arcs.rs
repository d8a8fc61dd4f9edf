//! Own arcs a_k and loads ω_k of pairs that move each other: solves a_k + Σ t_kl ω_l(a_l) = A_k.

use super::Couplings;

/// Maximum number of Newton steps; usually a few suffice.
const STEPS: usize = 40;
/// Residual of a solved equation, relative to the largest arc. With more than [`FEW`] loads, it grows with their
/// number.
const SOLVED: f64 = 4e-15;
/// Number of loads up to which the residual does not grow.
const FEW: usize = 8;
/// Maximum number of consecutive Newton steps that do not reduce the residual.
const VAIN: i32 = 3;
/// Number of Gauss-Seidel rounds after such steps.
const ROUNDS: usize = 50;
/// Accepted residual if rounding prevents convergence, relative to the largest arc.
const ROUNDED: f64 = 1e-13;
/// Smallest arc to which a residual is relative [rad]; it is the arc under a light load.
const SMALLEST_ARC: f64 = 1e-4;

/// Own arcs of pairs with their loads.
#[derive(Clone, Copy, Debug)]
pub struct OwnArcs<const K: usize> {
    /// a_k [rad].
    pub arc: [f64; K],
    /// Load ω_k per cone distance [N/m²].
    pub load: [f64; K],
    /// ∂ω_k/∂a_k.
    pub stiffness: [f64; K],
}

impl<const K: usize> OwnArcs<K> {
    /// Solves for a law that is linear at positive arcs. If all pairs are loaded, one linear system gives the solution.
    /// Otherwise, [`Self::new`] iterates.
    #[inline(always)]
    pub fn linear(couplings: &Couplings<K>, arcs: &[f64; K], law: impl Fn(usize, f64) -> [f64; 2]) -> Self {
        let mut own = Self { arc: *arcs, load: [0.0; K], stiffness: [0.0; K] };
        let (mut right, mut carry) = ([[0.0]; K], true);
        for k in 0..K {
            own.stiffness[k] = law(k, 1.0)[1];
            right[k][0] = arcs[k];
        }
        own.solve(couplings, &mut right);
        for k in 0..K {
            own.arc[k] = right[k][0];
            own.load[k] = own.stiffness[k] * own.arc[k];
            carry &= own.arc[k] > 0.0;
        }
        if carry { own } else { Self::new(couplings, arcs, law) }
    }

    /// Solves for pairs whose arcs A_k are `arcs`. `law` returns the load of pair `k` at its own arc, and the slope of
    /// the load.
    ///
    /// The loads minimise ΣΦ*(ω_k) + ½Σt_kl ω_k ω_l − ΣA_k ω_k with the complementary energy Φ* of a pair. Elastic
    /// bodies make the sum convex. Newton's method converges quickly unless pairs alternately gain and lose contact.
    /// Gauss-Seidel rounds always descend.
    #[inline(always)]
    pub fn new(couplings: &Couplings<K>, arcs: &[f64; K], law: impl Fn(usize, f64) -> [f64; 2]) -> Self {
        let mut own = Self { arc: *arcs, load: [0.0; K], stiffness: [0.0; K] };
        // the residual also contains the rounding of the flanks' openings
        let scale = arcs.iter().fold(SMALLEST_ARC, |most, arc| most.max(arc.abs()));
        let solved = SOLVED * scale * K.div_ceil(FEW) as f64;
        let (mut last, mut part, mut vain) = (f64::INFINITY, 1.0, 0);
        for step in 0..STEPS {
            for k in 0..K {
                [own.load[k], own.stiffness[k]] = law(k, own.arc[k]);
            }
            let moved = couplings.moved(&own.load);
            let (mut left, mut most) = ([[0.0]; K], 0.0f64);
            for k in 0..K {
                left[k][0] = arcs[k] - moved[k] - own.arc[k];
                most = most.max(left[k][0].abs());
            }
            if most <= solved || K < 2 || step == STEPS - 1 {
                break;
            }
            // if pairs alternately gain and lose contact, the step is halved
            (part, vain) = if most < last { (1.0, 0) } else { (0.5 * part, vain + 1) };
            last = most;
            if vain > VAIN {
                if most <= ROUNDED * scale {
                    break;
                }
                own.go_round(couplings, arcs, &law);
                (last, vain) = (f64::INFINITY, 0);
                continue;
            }
            own.solve(couplings, &mut left);
            for k in 0..K {
                own.arc[k] += part * left[k][0];
            }
        }
        own
    }

    /// Gauss-Seidel iteration: updates the arc and load of each pair in turn from the loads of the others.
    #[cold]
    fn go_round(&mut self, couplings: &Couplings<K>, arcs: &[f64; K], law: &dyn Fn(usize, f64) -> [f64; 2]) {
        for _ in 0..ROUNDS {
            for (k, row) in couplings.value.iter().enumerate() {
                let moved: f64 = row.iter().zip(&self.load).map(|(t, load)| t * load).sum();
                self.arc[k] = arcs[k] - moved;
                self.load[k] = law(k, self.arc[k])[0];
            }
        }
    }

    /// Solves (1 + t diag(∂ω/∂a)) x = `right`. Apart from a positive factor of each column, the matrix is positive
    /// definite, so elimination needs no pivoting.
    #[inline(always)]
    pub fn solve<const R: usize>(&self, couplings: &Couplings<K>, right: &mut [[f64; R]; K]) {
        let mut matrix = [[0.0; K]; K];
        for (row, t) in matrix.iter_mut().zip(&couplings.value) {
            for k in 0..K {
                row[k] = t[k] * self.stiffness[k];
            }
        }
        for p in 0..K {
            let pivot = 1.0 / (1.0 + matrix[p][p]);
            for i in p + 1..K {
                let factor = matrix[i][p] * pivot;
                if factor != 0.0 {
                    for j in p + 1..K {
                        matrix[i][j] -= factor * matrix[p][j];
                    }
                    for r in 0..R {
                        right[i][r] -= factor * right[p][r];
                    }
                }
            }
            matrix[p][p] = pivot;
        }
        for p in (0..K).rev() {
            for r in 0..R {
                let mut sum = right[p][r];
                for j in p + 1..K {
                    sum -= matrix[p][j] * right[j][r];
                }
                right[p][r] = sum * matrix[p][p];
            }
        }
    }
}
