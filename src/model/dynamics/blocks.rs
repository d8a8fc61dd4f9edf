//! Derivatives of the forces of all meshes by the motion of the bodies, from those of each mesh by its own coordinates.

use super::Equations;
use super::in_detail::Local;
use super::ledger_rates::LedgerRates;
use crate::contact::detailed::{DetailedLoad, LOCAL};
use crate::contact::mesh::MeshForce;
use crate::contact::shared::SharedForce;
use crate::integrate::{Matrix, Point};
use crate::model::assembly::SIGMA;
use crate::model::scene::CARRIER;
use crate::model::setup::CONTACT_HEAT;

/// ∂(F_α, F_ψ, F_w)/∂(α, ψ, w) by group and side.
pub(super) type Blocks<const G: usize> = [[[[f64; 3]; 3]; 2]; G];

/// ∂(F_q, F_x)/∂(q, x) of a mesh whose side gear cannot move along its axis.
fn plain(&[[qq, qx], [xq, xx]]: &[[f64; 2]; 2]) -> [[f64; 3]; 3] {
    [[qq, qx, 0.0], [xq, xx, 0.0], [0.0; 3]]
}

impl<const N: usize, const G: usize, const WITH_EFFECTS: bool> Equations<'_, N, G, WITH_EFFECTS> {
    /// ∂(F_α, F_ψ, F_w)/∂(α, ψ, w) of a mesh of side `s` from ∂(F_q, F_x, F_w)/∂(q, x, w).
    #[inline]
    pub(in crate::model) fn local_block(&self, s: usize, by: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
        self.block_between(s, s, by)
    }

    /// The same of the mesh of side `s` by the coordinates of that of side `other`.
    #[inline]
    pub(in crate::model) fn block_between(&self, s: usize, other: usize, by: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
        let [planet, side] = self.teeth.sin_base;
        let [turn, turned] = [s, other].map(|s| SIGMA[s] * planet);
        let columns = by.map(|[q, x, w]| [side * q, turned * (x - q), w]);
        std::array::from_fn(|row| {
            std::array::from_fn(|c| match row {
                0 => side * columns[0][c],
                1 => turn * (columns[1][c] - columns[0][c]),
                _ => columns[2][c],
            })
        })
    }

    /// The same of a mesh whose side gear cannot move along its axis.
    #[inline]
    pub(in crate::model) fn block(&self, s: usize, by: &[[f64; 2]; 2]) -> [[f64; 3]; 3] {
        self.local_block(s, &plain(by))
    }

    /// Adds the blocks of all meshes to ∂(sums)/∂(positions) or ∂(sums)/∂(rates): those by the coordinates of each mesh itself,
    /// or `ACROSS`, by those of the planet's other mesh.
    #[inline]
    pub(in crate::model) fn add_blocks<const ACROSS: bool>(&self, blocks: &Blocks<G>, m: &mut Matrix<N>) {
        let other = |s: usize| if ACROSS { 1 - s } else { s };
        for g in 0..self.groups() {
            let (i, members) = (self.planet(g), self.members(g));
            for s in 0..2 {
                let (by, t) = (&blocks[g][s], other(s));
                m[s][i] += members * by[0][1];
                m[i][t] += by[1][0];
                m[i][i] += by[1][1];
                if !self.has_pins() {
                    m[CARRIER][i] -= members * by[0][1];
                } else {
                    let (pin, [seat, other_seat]) = (self.pin(g), [s, t].map(|s| self.seat(s)));
                    m[s][pin] -= members * by[0][0];
                    m[seat][pin] -= members * by[2][0];
                    m[seat][i] += members * by[2][1];
                    m[pin][t] -= by[0][0];
                    m[pin][pin] += by[0][0];
                    m[pin][i] -= by[0][1];
                    m[pin][other_seat] -= by[0][2];
                    m[i][pin] -= by[1][0];
                    m[i][other_seat] += by[1][2];
                }
            }
        }
        for s in 0..2 {
            let total = |row: usize, c: usize| self.sum(|g| self.members(g) * blocks[g][s][row][c]);
            let (t, turn) = (other(s), total(0, 0));
            m[s][t] += turn;
            if !self.has_pins() {
                m[CARRIER][t] -= turn;
            } else {
                let [seat, other_seat] = [s, t].map(|s| self.seat(s));
                m[s][other_seat] += total(0, 2);
                m[seat][t] += total(2, 0);
                m[seat][other_seat] += total(2, 2);
            }
        }
    }

    /// ∂(F_α, F_ψ, F_w)/∂(α, ψ, w of the planet's other mesh) of all meshes in detail.
    pub(super) fn cross_blocks<T: Local>(&self, loads: &[[DetailedLoad<T>; 2]; G]) -> [[[[f64; 3]; 3]; 2]; G] {
        self.by_group(|g| {
            [0, 1].map(|s| {
                let by = loads[g][s].force.map(|force| {
                    let slopes = force.slopes();
                    [slopes[LOCAL], slopes[LOCAL + 1], slopes[LOCAL + 2]]
                });
                self.block_between(s, 1 - s, &by)
            })
        })
    }

    /// Adds the forces of all plain meshes and their derivatives by positions and rates; sets their heat. Returns their elastic
    /// energy [J].
    #[inline(always)]
    pub(super) fn add_linearised(
        &self,
        at: &Point<N>,
        sum: &mut [f64; N],
        [by_position, by_rate]: [&mut Matrix<N>; 2],
        ledger_rates: &mut LedgerRates,
    ) -> f64 {
        let mut load = [[MeshForce::default(); 2]; G];
        let (mut position, mut rate) = ([[[[0.0; 3]; 3]; 2]; G], [[[[0.0; 3]; 3]; 2]; G]);
        let mut energy = [0.0; G];
        for g in 0..self.groups() {
            if let Some(twin) = self.twin(at, g) {
                (load[g], position[g], rate[g], energy[g]) = (load[twin], position[twin], rate[twin], energy[twin]);
                continue;
            }
            for s in 0..2 {
                let (force, by) = self.mesh_linearised(&self.mesh_state(at, g, s));
                load[g][s] = force;
                position[g][s] = self.block(s, &by.by_position);
                rate[g][s] = self.block(s, &by.by_rate);
                energy[g] += by.energy;
            }
        }
        self.add_forces(|g, s| load[g][s].force, sum);
        self.add_blocks::<false>(&position, by_position);
        self.add_blocks::<false>(&rate, by_rate);
        ledger_rates.heat[CONTACT_HEAT] = self.sum(|g| self.members(g) * (load[g][0].heat + load[g][1].heat));
        self.sum(|g| self.members(g) * energy[g])
    }

    /// Adds the derivatives of the forces of both plain meshes of all groups by position.
    pub(super) fn add_shared_blocks(&self, shared: &[SharedForce; G], m: &mut Matrix<N>) {
        let own = self.by_group(|g| [0, 1].map(|s| self.block(s, &shared[g].by_position[s][s])));
        self.add_blocks::<false>(&own, m);
        let across = |g: usize, s: usize| self.block_between(s, 1 - s, &plain(&shared[g].by_position[s][1 - s]));
        self.add_blocks::<true>(&self.by_group(|g| [0, 1].map(|s| across(g, s))), m);
    }
}
