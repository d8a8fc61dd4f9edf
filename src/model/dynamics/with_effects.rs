//! Forces of a scene with effects: meshes (in detail if an effect needs slices of the face), effects on bodies, dry friction.

use super::ledger_rates::LedgerRates;
use super::{Acted, Equations, Jacobian};
use crate::contact::detailed::{LOCAL, WITH_OTHER};
use crate::integrate::{Matrix, Point};
use crate::model::effect_kinds::{Action, Slopes};
use crate::model::scene::CARRIER;
use crate::model::setup::CONTACT_HEAT;
use crate::numeric::Dual;

impl<const N: usize, const G: usize, const WITH_EFFECTS: bool> Equations<'_, N, G, WITH_EFFECTS> {
    /// Adds all forces except commanded torques, and their derivatives if `jacobian` is given.
    #[inline]
    pub(in crate::model) fn act(
        &self,
        at: &Point<N>,
        sum: &mut [f64; N],
        imposed: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
        jacobian: Option<&mut Jacobian<'_, N>>,
    ) {
        match jacobian {
            None => {
                self.act_of_teeth(at, sum, ledger_rates);
                self.act_on_bodies(at, sum, imposed, ledger_rates);
            }
            Some(j) => {
                if self.in_detail() && self.bodies_of_gears().is_some() {
                    self.act_in_detail(at, &self.all_loads::<Dual<WITH_OTHER>>(at), sum, ledger_rates, Some(j));
                } else if self.in_detail() {
                    self.act_in_detail(at, &self.all_loads::<Dual<LOCAL>>(at), sum, ledger_rates, Some(j));
                } else if let Some(bodies) = self.bodies_of_gears() {
                    j.elastic_energy =
                        self.add_shared_forces(bodies, at, sum, [&mut *j.by_position, &mut j.by_rate], ledger_rates);
                    self.add_friction(at, None, sum, ledger_rates);
                    self.friction_slopes_under(at, None, j);
                } else {
                    j.elastic_energy =
                        self.add_linearised(at, sum, [&mut *j.by_position, &mut j.by_rate], ledger_rates);
                    self.add_friction(at, None, sum, ledger_rates);
                    self.friction_slopes_under(at, None, j);
                }
                self.act_on_bodies(at, sum, imposed, ledger_rates);
                let mut imposed_by = [[0.0; N]; 2];
                let mut out = Slopes::new([&mut *j.by_position, &mut *j.by_velocity], &mut imposed_by);
                for effect in self.teeth.effect_terms.body_effects.forces.iter() {
                    effect.slopes(&self.body_motion(at), &mut out);
                }
                j.of_imposed = imposed_by;
            }
        }
    }

    /// Adds the forces of the meshes and the dry friction that depends on them. Returns the torques of the meshes on the side
    /// gears.
    #[inline]
    pub(in crate::model) fn act_of_teeth(
        &self,
        at: &Point<N>,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) -> [f64; 2] {
        if self.in_detail() {
            let loads = self.all_loads::<f64>(at);
            self.act_in_detail(at, &loads, sum, ledger_rates, None);
            let side = self.teeth.sin_base[1];
            return [0, 1].map(|s| self.sum(|g| self.members(g) * side * loads[g][s].force[0]));
        }
        ledger_rates.heat[CONTACT_HEAT] = self.add_tooth_torques(at, sum);
        let on_sides = [sum[0], sum[1]];
        self.add_friction(at, None, sum, ledger_rates);
        on_sides
    }

    /// Adds the forces of the effects on bodies.
    pub(in crate::model) fn act_on_bodies(
        &self,
        at: &Point<N>,
        sum: &mut [f64; N],
        imposed: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) {
        let motion = self.body_motion(at);
        imposed[CARRIER] += motion.input_rates.carrier_speed;
        let mut out = Action {
            force: sum,
            imposed: &mut imposed[CARRIER],
            drive: &mut ledger_rates.drive,
            heat: &mut ledger_rates.heat,
        };
        for effect in self.teeth.effect_terms.body_effects.forces.iter() {
            effect.act(&motion, &mut out);
        }
        if self.has_ends() {
            ledger_rates.shaft = [0, 1].map(|s| self.shaft_torque(at, s));
        }
    }

    /// Torque that the half-shaft of side `s` delivers to the wheel [N·m]; the load torque if the shaft is no degree of freedom.
    pub(in crate::model) fn shaft_torque(&self, at: &Point<N>, s: usize) -> f64 {
        if !self.has_ends() || !self.teeth.plan.shafts[s] {
            return self.acting.inputs.load_torque[s];
        }
        let end = self.end(s);
        self.teeth.effect_terms.body_effects.half_shafts.torque(s, at.q[end], at.v[s] - at.v[end])
    }

    /// Forces of meshes, pins and seats at rest and their derivatives by positions, for the static equilibrium.
    pub(in crate::model) fn static_forces(&self, at: &Point<N>) -> ([f64; N], Matrix<N>) {
        let (mut sum, mut by_position, mut by_velocity) = ([0.0; N], [[0.0; N]; N], [[0.0; N]; N]);
        let j = Jacobian::new([&mut by_position, &mut by_velocity]);
        let mut ledger_rates = LedgerRates::default();
        let still = Point { q: at.q, v: [0.0; N] };
        let loads = self.all_loads::<Dual<WITH_OTHER>>(&still);
        self.add_forces(|g, s| [loads[g][s].force[0].v, loads[g][s].force[1].v], &mut sum);
        if self.has_pins() {
            for s in 0..2 {
                sum[self.seat(s)] += self.sum(|g| self.members(g) * loads[g][s].force[2].v);
            }
        }
        let blocks = self
            .by_group(|g| [0, 1].map(|s| self.local_block(s, &loads[g][s].force.map(|f| [f.d[0], f.d[1], f.d[2]]))));
        self.add_blocks::<false>(&blocks, j.by_position);
        if self.bodies_of_gears().is_some() {
            self.add_blocks::<true>(&self.cross_blocks(&loads), j.by_position);
        }
        let mut carrier = 0.0;
        let motion = self.body_motion(&still);
        let mut action = Action {
            force: &mut sum,
            imposed: &mut carrier,
            drive: &mut ledger_rates.drive,
            heat: &mut ledger_rates.heat,
        };
        let mut unused = [[0.0; N]; 2];
        let mut slopes = Slopes::new([&mut *j.by_position, &mut *j.by_velocity], &mut unused);
        for effect in self.teeth.effect_terms.body_effects.forces.iter().filter(|e| e.is_structure()) {
            effect.act(&motion, &mut action);
            effect.slopes(&motion, &mut slopes);
        }
        (sum, by_position)
    }

    /// Elastic energy of meshes, pins and seats [J]; with `all` also of half-shafts and stuck friction.
    pub(in crate::model) fn stored_energy(&self, at: &Point<N>, all: bool) -> f64 {
        let teeth = if self.in_detail() {
            self.sum(|g| self.members(g) * self.planet_energy(at, g))
        } else {
            self.elastic_energy(at)
        };
        teeth + self.stored_energy_of_bodies(at, all)
    }

    /// Elastic energy of pins and seats [J]; with `all` also of half-shafts and stuck friction.
    pub(in crate::model) fn stored_energy_of_bodies(&self, at: &Point<N>, all: bool) -> f64 {
        let forces = &self.teeth.effect_terms.body_effects.forces;
        let motion = self.body_motion(at);
        let energy = forces.iter().filter(|e| all || e.is_structure()).map(|e| e.energy(&motion)).sum::<f64>();
        if all { energy + self.friction_energy(at) } else { energy }
    }
}
