//! Transformation between bodies and meshes: mesh coordinates from the motion of the bodies, and mesh forces and their
//! derivatives on the bodies.
//!
//! Mesh coordinates are q = sinδ_bs α − σ sinδ_bp ψ, x = σ sinδ_bp ψ + h, and the displacement w of the side gear along
//! its axis. The sign σ is +1 left and −1 right. A force (F_q, F_x, F_w) acts on the side gear with sinδ_bs F_q, on the
//! planet with σ sinδ_bp (F_x − F_q), and on the seat with F_w. Its reaction acts on the carrier, or on the pin if pins
//! move.

use super::Equations;
use super::shape::Shape;
use crate::contact::detailed::WITH_OTHER;
use crate::contact::mesh::MeshState;
use crate::contact::planet::{COORDINATES, PlanetState, Q, W, X};
use crate::integrate::{Matrix, Point};
use crate::model::assembly::SIGMA;
use crate::model::scene::CARRIER;

/// Derivatives of the forces of a mesh with respect to mesh coordinates.
type Block = [[f64; COORDINATES]; COORDINATES];

impl<const N: usize, S: Shape<N>> Equations<'_, S, N> {
    /// State of the mesh of group `g` with side `s`.
    #[inline]
    pub fn mesh_state(&self, at: &Point<N>, g: usize, s: usize) -> MeshState {
        let [planet, side] = self.teeth.sin_base;
        let turn = SIGMA[s] * planet;
        let (travel, travel_rate) = (turn * at.q[self.planet(g)], turn * at.v[self.planet(g)]);
        let (angle, speed) = if !self.has_pins() {
            (at.q[s], at.v[s] - at.v[CARRIER])
        } else {
            (at.q[s] - at.q[self.pin(g)], at.v[s] - at.v[self.pin(g)])
        };
        MeshState {
            position: [side * angle - travel + self.offset[g][s], travel + self.teeth.plan.group(g).phase[s]],
            rate: [side * speed - travel_rate, travel_rate],
            which: [self.teeth.plan.group(g).planet, s],
        }
    }

    /// State of both meshes of group `g`.
    #[inline(always)]
    pub(in crate::model) fn planet_state(&self, at: &Point<N>, g: usize) -> PlanetState {
        let [left, right] = [self.mesh_state(at, g, 0), self.mesh_state(at, g, 1)];
        let seat = |of: &[f64; N], s: usize| if self.has_pins() { of[self.seat(s)] } else { 0.0 };
        let coordinates = |[q, x]: [f64; 2], of: &[f64; N], s: usize| [q, x, seat(of, s)];
        PlanetState {
            planet: self.teeth.plan.group(g).planet,
            position: [coordinates(left.position, &at.q, 0), coordinates(right.position, &at.q, 1)],
            rate: [coordinates(left.rate, &at.v, 0), coordinates(right.rate, &at.v, 1)],
            wrapped: [self.wrapped(g, 0), self.wrapped(g, 1)],
        }
    }

    /// Adds the forces of meshes, by group and side, to side gears, carrier or pins, planets and seats.
    #[inline(always)]
    pub(super) fn add_forces(&self, force: impl Fn(usize, usize) -> [f64; COORDINATES], sum: &mut [f64; N]) {
        let [planet, side] = self.teeth.sin_base;
        let on = |s: usize| self.sum(|g| self.members(g) * side * force(g, s)[Q]);
        let on_side = [on(0), on(1)];
        for s in 0..2 {
            sum[s] += on_side[s];
        }
        if !self.has_pins() {
            sum[CARRIER] -= on_side[0] + on_side[1];
        }
        for g in 0..self.groups() {
            let (left, right) = (force(g, 0), force(g, 1));
            sum[self.planet(g)] += planet * ((left[X] - left[Q]) - (right[X] - right[Q]));
            if self.has_pins() {
                sum[self.pin(g)] -= side * left[Q] + side * right[Q];
            }
        }
        if self.has_pins() {
            for s in 0..2 {
                sum[self.seat(s)] += self.sum(|g| self.members(g) * force(g, s)[W]);
            }
        }
    }

    /// ∂(F_α, F_ψ, F_w)/∂(α, ψ, w) of the mesh of side `s` with respect to the coordinates of the mesh of side `other`,
    /// from ∂(F_q, F_x, F_w)/∂(q, x, w).
    #[inline]
    fn on_bodies(&self, s: usize, other: usize, by: &Block) -> Block {
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

    /// Adds derivatives of mesh forces, by group and side, to ∂(sums)/∂(positions) or ∂(sums)/∂(rates). They are
    /// derivatives with respect to the coordinates of the mesh itself or, with `ACROSS`, of the planet's other mesh.
    #[inline(always)]
    pub(super) fn add_block<const ACROSS: bool>(&self, by: impl Fn(usize, usize) -> Block, m: &mut Matrix<N>) {
        let other = |s: usize| if ACROSS { 1 - s } else { s };
        let blocks = self.by_group([[[0.0; COORDINATES]; COORDINATES]; 2], |g| {
            [0, 1].map(|s| self.on_bodies(s, other(s), &by(g, s)))
        });
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

    /// Adds derivatives with respect to q, x, w, or to their rates, of all meshes of side `s` to the row `row`. The
    /// caller includes the number of members of a group in its slopes. `part` is the index of the first of the three
    /// slopes.
    #[inline]
    pub(super) fn spread(
        &self,
        (row, sign): (usize, f64),
        s: usize,
        (slopes, part): (&S::ByGroup<[f64; WITH_OTHER]>, usize),
        m: &mut Matrix<N>,
    ) {
        let [planet, side] = self.teeth.sin_base;
        let turn = SIGMA[s] * planet;
        m[row][s] += sign * self.sum(|g| side * slopes[g][part + Q]);
        for g in 0..self.groups() {
            m[row][self.planet(g)] += sign * turn * (slopes[g][part + X] - slopes[g][part + Q]);
            if self.has_pins() {
                m[row][self.pin(g)] -= sign * side * slopes[g][part + Q];
            }
        }
        if self.has_pins() {
            m[row][self.seat(s)] += sign * self.sum(|g| slopes[g][part + W]);
        }
    }

    /// Degree of freedom that moves the planets of group `g` around the carrier's axis: their pin, or the carrier.
    pub(super) fn orbit(&self, g: usize) -> usize {
        if self.has_pins() { self.pin(g) } else { CARRIER }
    }

    /// Centrifugal force m r ω² of a planet of group `g`, away from the apex [N], and its derivative with respect to ω
    /// [N·s/rad].
    pub(super) fn centrifugal(&self, at: &Point<N>, g: usize) -> [f64; 2] {
        let per_speed = self.teeth.effect_terms.planet_mass_moment * at.v[self.orbit(g)];
        [per_speed * at.v[self.orbit(g)], 2.0 * per_speed]
    }

    /// Kinetic energy [J].
    pub fn kinetic_energy(&self, at: &Point<N>) -> f64 {
        let twice_energy = |i: usize| self.teeth.inertia[i] * at.v[i] * at.v[i];
        let planets = self.sum(|g| {
            self.members(g)
                * (twice_energy(self.planet(g)) + if self.has_pins() { twice_energy(self.pin(g)) } else { 0.0 })
        });
        let others = |range: std::ops::Range<usize>| range.map(twice_energy).sum::<f64>();
        let behind = self.planets_and_pins().end;
        0.5 * (others(0..self.planet(0)) + planets + others(behind..self.count()))
    }

    /// Largest approach of any flank pair [rad], negative inside the backlash, with its group and side.
    #[inline]
    pub fn deepest(&self, at: &Point<N>) -> (f64, usize, usize) {
        self.deepest_of_touching(at).0
    }

    /// Largest approach of any flank pair as in [`Self::deepest`], and the meshes whose flanks touch, one bit for each.
    #[inline]
    pub fn deepest_of_touching(&self, at: &Point<N>) -> ((f64, usize, usize), u8) {
        let (mut deepest, mut touching) = ((f64::NEG_INFINITY, 0, 0), 0);
        for g in (0..self.groups()).filter(|&g| self.twin(at, g).is_none()) {
            for s in 0..2 {
                let approach = self.teeth.contact.mesh.approach(self.mesh_state(at, g, s).position[Q]);
                touching |= u8::from(approach > 0.0) << (2 * g + s);
                if approach > deepest.0 {
                    deepest = (approach, g, s);
                }
            }
        }
        (deepest, touching)
    }
}
