//! The equations of motion with teeth, linearised: exact derivatives of the accelerations.

use super::ledger_rates::LedgerRates;
use super::{Equations, Jacobian};
use crate::integrate::{Linearisation, Matrix, Point, SecondOrder};
use crate::model::scene::CARRIER;

impl<const N: usize, const G: usize, const WITH_EFFECTS: bool> Equations<'_, N, G, WITH_EFFECTS> {
    fn divide_by_inertia(&self, m: &mut Matrix<N>) {
        for (row, inverse) in m[..self.count()].iter_mut().zip(&self.teeth.inverse_inertia) {
            row.iter_mut().for_each(|x| *x *= inverse);
        }
    }

    /// ∂(tooth torques)/∂q, for the static equilibrium.
    pub fn tooth_torque_slopes(&self, at: &Point<N>) -> Matrix<N> {
        let mut m = [[0.0; N]; N];
        let mut by = [[[[0.0; 3]; 3]; 2]; G];
        if let Some(bodies) = self.bodies_of_gears() {
            let still = Point { q: at.q, v: [0.0; N] };
            let shared = self.by_group(|g| self.linearised_on_bodies(bodies, &self.mesh_states(&still, g), g));
            self.add_shared_blocks(&shared, &mut m);
            return m;
        }
        for g in 0..self.groups() {
            for s in 0..2 {
                let mut state = self.mesh_state(at, g, s);
                state.rate = [0.0; 2];
                by[g][s] = self.block(s, &self.teeth.mesh.linearise_apart(&state).1.by_position);
            }
        }
        self.add_blocks::<false>(&by, &mut m);
        m
    }

    /// Writes the equations linearised to `lin`; returns the elastic energy of all meshes [J].
    #[inline]
    pub(in crate::model) fn linearise_and_store(&self, at: &Point<N>, lin: &mut Linearisation<N, LedgerRates>) -> f64 {
        (lin.acceleration, lin.ledger_rates) = ([0.0; N], LedgerRates::default());
        // rows beyond are never anything but zero
        for i in 0..self.count() {
            (lin.by_position[i], lin.by_velocity[i]) = ([0.0; N], [0.0; N]);
        }
        if WITH_EFFECTS { self.linearise_all(at, lin) } else { self.linearise_teeth(at, lin) }
    }

    /// Adds to `lin` the equations of teeth without effects, linearised; returns the elastic energy [J].
    #[inline]
    fn linearise_teeth(&self, at: &Point<N>, lin: &mut Linearisation<N, LedgerRates>) -> f64 {
        let Linearisation { acceleration, by_position, by_velocity, ledger_rates } = lin;
        let energy = self.add_linearised(at, acceleration, [&mut *by_position, &mut *by_velocity], ledger_rates);
        // α̇ = ω_s − ω_c
        self.times_rates(by_velocity);
        self.divide_by_inertia(by_position);
        self.divide_by_inertia(by_velocity);
        self.finish(at, acceleration, &[0.0; N], ledger_rates);
        energy
    }

    /// Adds to `lin` the equations with all effects, linearised; returns the elastic energy of all meshes [J].
    #[inline]
    fn linearise_all(&self, at: &Point<N>, lin: &mut Linearisation<N, LedgerRates>) -> f64 {
        let Linearisation { acceleration, by_position, by_velocity, ledger_rates } = lin;
        let mut imposed = [0.0; N];
        let mut jacobian = Jacobian::new([&mut *by_position, &mut *by_velocity]);
        self.act(at, acceleration, &mut imposed, ledger_rates, Some(&mut jacobian));
        let Jacobian { mut by_rate, of_imposed, elastic_energy, .. } = jacobian;
        self.times_rates(&mut by_rate);
        for i in 0..self.count() {
            for j in 0..N {
                by_velocity[i][j] += by_rate[i][j];
            }
        }
        self.divide_by_inertia(by_position);
        self.divide_by_inertia(by_velocity);
        if self.teeth.plan.carrier_imposed {
            (by_position[CARRIER], by_velocity[CARRIER]) = (of_imposed[0], of_imposed[1]);
        }
        self.finish(at, acceleration, &imposed, ledger_rates);
        elastic_energy
    }
}
