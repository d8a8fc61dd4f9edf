//! LU factorisation with partial pivoting of the small dense matrix of a step.

use super::system::{MAX_DOF, Matrix, Vector};

/// Factors of a matrix of order `n`.
pub struct Lu {
    n: usize,
    factors: Matrix,
    pivot: [usize; MAX_DOF],
}

impl Lu {
    /// Factorises the leading `n` × `n` block of `m`; `None` if it is singular or not finite.
    #[inline]
    pub fn new(mut m: Matrix, n: usize) -> Option<Self> {
        let mut pivot = [0; MAX_DOF];
        for k in 0..n {
            let mut p = k;
            for i in k + 1..n {
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
            for i in k + 1..n {
                if m[i][k] == 0.0 {
                    continue;
                }
                let l = m[i][k] * inverse;
                m[i][k] = l;
                for j in k + 1..n {
                    m[i][j] -= l * m[k][j];
                }
            }
            m[k][k] = inverse;
        }
        Some(Self { n, factors: m, pivot })
    }

    /// Solves for the right-hand side `b` in place.
    #[inline]
    pub fn solve(&self, b: &mut Vector) {
        let (m, n) = (&self.factors, self.n);
        for k in 0..n {
            b.swap(k, self.pivot[k]);
            for i in 0..k {
                b[k] -= m[k][i] * b[i];
            }
        }
        for k in (0..n).rev() {
            for j in k + 1..n {
                b[k] -= m[k][j] * b[j];
            }
            b[k] *= m[k][k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solution_satisfies_the_system() {
        let mut m = [[0.0; MAX_DOF]; MAX_DOF];
        let mut seed = 1u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        for n in 1..=MAX_DOF {
            for row in m.iter_mut().take(n) {
                row.iter_mut().for_each(|x| *x = random());
            }
            m[0][0] = 0.0; // forces a row exchange
            if n == 1 {
                m[0][0] = 2.0;
            }
            let b: Vector = std::array::from_fn(|_| random());
            let mut x = b;
            Lu::new(m, n).unwrap().solve(&mut x);
            for i in 0..n {
                let residual: f64 = (0..n).map(|j| m[i][j] * x[j]).sum::<f64>() - b[i];
                assert!(residual.abs() < 1e-10, "order {n}: {residual}");
            }
        }
        assert!(Lu::new([[0.0; MAX_DOF]; MAX_DOF], 2).is_none());
    }
}
