//! The ledger, and statistics of the solver.

use crate::model::dynamics::{State, Sums};
use crate::model::outputs::LedgerReadings;
use crate::model::run::Simulation;
use crate::model::run::events::energy;
use crate::model::scene::RubbingKind;
use crate::model::setup::STEP_READINGS;
use crate::model::thermal::of_scene;

impl Simulation {
    /// Kinetic and stored energy at the end of the last step in the ledger [J].
    pub(in crate::model) fn energy(&self, state: &State) -> f64 {
        let known = self.accepted.as_ref().map(|accepted| accepted.applied_to(state));
        energy(&self.model, &self.inputs, known.as_ref().unwrap_or(state))
    }

    /// Ledger and solver statistics.
    pub fn ledger(&mut self) -> LedgerReadings {
        self.remember_damage();
        self.read_present(Self::ledger_of)
    }

    /// Ledger with the sums and the energy at the present.
    fn ledger_of(&self, (sums, energy): (Sums, Option<f64>)) -> LedgerReadings {
        let s = &self.state.statistics;
        let mut readings = [0.0; STEP_READINGS];
        self.read_damage_and_history(&mut readings);
        let network = self.model.thermal.as_deref();
        let heat = network.map(|network| [network.stored(&sums.thermal), sums.thermal.given_off]);
        of_scene::set_readings(&mut readings, &sums.thermal.temperatures(), heat);
        self.read_coupling(&mut readings);
        let held = |kind: RubbingKind| {
            let friction = self.state.friction[kind.numbers()].iter();
            friction.filter(|friction| friction.holds()).count() as f64
        };
        let energy = energy.unwrap_or_else(|| self.energy(&self.state));
        LedgerReadings {
            heat: sums.heat,
            readings,
            held: [RubbingKind::Side, RubbingKind::Planet, RubbingKind::Wheel, RubbingKind::Clutch].map(held),
            energy_residual: energy - self.state.energy_at_start - sums.work + sums.heat.iter().sum::<f64>(),
            steps: s.accepted as f64,
            rejected: (s.rejected_error + s.rejected_ledger + s.rejected_invalid + s.rejected_switch) as f64,
            rhs_calls: s.evaluations as f64,
            step_size: self.state.control.last,
        }
    }

    /// Describes the solver's steps and rejections in one line, by cause.
    pub fn account(&mut self) -> String {
        let energy_residual = self.ledger().energy_residual;
        let s = &self.state.statistics;
        format!(
            "solver: {} steps accepted, {} rejected for their error, {} for their ledger, {} for values that are not \
             finite, {} cut at a switch; {} evaluations of the tooth forces, {} Jacobians; energy residual {energy_residual:e} J",
            s.accepted,
            s.rejected_error,
            s.rejected_ledger,
            s.rejected_invalid,
            s.rejected_switch,
            s.evaluations,
            s.jacobians,
        )
    }
}
