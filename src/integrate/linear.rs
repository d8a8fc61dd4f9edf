//! LU factorisation with partial pivoting of the small dense matrix of a step.

use super::system::Matrix;

/// Factors of a matrix of order `N`.
pub struct Lu<const N: usize> {
    factors: Matrix<N>,
    pivot: [usize; N],
}

impl<const N: usize> Lu<N> {
    /// Factorises `m`; `None` if it is singular or not finite.
    #[inline]
    pub fn new(mut m: Matrix<N>) -> Option<Self> {
        let mut pivot = [0; N];
        for k in 0..N {
            let mut p = k;
            for i in k + 1..N {
                if m[i][k].abs() > m[p][k].abs() {
                    p = i;
                }
            }
            let largest = m[p][k];
            if largest == 0.0 || !largest.is_finite() {
                return None;
            }
            m.swap(k, p);
            pivot[k] = p;
            let inverse = 1.0 / m[k][k];
            for i in k + 1..N {
                let l = m[i][k] * inverse;
                m[i][k] = l;
                for j in k + 1..N {
                    m[i][j] -= l * m[k][j];
                }
            }
            m[k][k] = inverse;
        }
        Some(Self { factors: m, pivot })
    }

    /// Solves for the right-hand side `b` in place.
    #[inline]
    pub fn solve(&self, b: &mut [f64; N]) {
        let m = &self.factors;
        // rows of the factors were exchanged as a whole: exchange the right-hand side alike, then substitute
        for k in 0..N {
            b.swap(k, self.pivot[k]);
        }
        for k in 0..N {
            for i in 0..k {
                b[k] -= m[k][i] * b[i];
            }
        }
        for k in (0..N).rev() {
            for j in k + 1..N {
                b[k] -= m[k][j] * b[j];
            }
            b[k] *= m[k][k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solution_satisfies<const N: usize>(random: &mut impl FnMut() -> f64) {
        let mut m: Matrix<N> = std::array::from_fn(|_| std::array::from_fn(|_| random()));
        if N > 1 {
            m[0][0] = 0.0; // forces a row exchange
        }
        let b: [f64; N] = std::array::from_fn(|_| random());
        let mut x = b;
        Lu::new(m).unwrap().solve(&mut x);
        for i in 0..N {
            let residual: f64 = (0..N).map(|j| m[i][j] * x[j]).sum::<f64>() - b[i];
            assert!(residual.abs() < 1e-10, "order {N}: {residual}");
        }
    }

    #[test]
    fn solution_satisfies_the_system() {
        let mut seed = 1u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        for _ in 0..20 {
            solution_satisfies::<1>(&mut random);
            solution_satisfies::<2>(&mut random);
            solution_satisfies::<4>(&mut random);
            solution_satisfies::<7>(&mut random);
        }
        assert!(Lu::new([[0.0; 2]; 2]).is_none());
    }
}
