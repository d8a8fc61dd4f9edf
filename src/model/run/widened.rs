//! Equations of ideal gears, padded to the size of equations that are called through a trait object.
//!
//! Methods other than the default are not monomorphised for ideal gears. They use equations of this size, as they do
//! for most teeth. Values beyond the degrees of freedom are zero and have no effect.

use std::ops::Range;

use super::failure::ExcessiveDeflection;
use super::ledger::{LedgerEquations, LedgerSums, record_without_teeth};
use crate::integrate::{Imbalance, Linearisation, Matrix, Point, SecondOrder, Step, TimedPoint};
use crate::model::assembly::Model;
use crate::model::assembly::ideal_with_effects::IDEAL_SIZE;
use crate::model::dynamics::ledger_rates::LedgerRates;
use crate::model::dynamics::shape::MEDIUM_SIZE;
use crate::model::dynamics::{FrictionEquations, IdealEquations, InputsAndFriction};
use crate::model::effect_kinds::{FrictionSource, SurfaceLoad};
use crate::model::scene::{FRICTION_BODIES, Layout, Plan};

/// Equations of ideal gears, padded with zeros beyond their degrees of freedom.
pub struct Widened<'a>(pub IdealEquations<'a>);

fn narrow(at: &Point<MEDIUM_SIZE>) -> Point<IDEAL_SIZE> {
    Point::of([&at.q, &at.v])
}

fn wide(values: &[f64; IDEAL_SIZE]) -> [f64; MEDIUM_SIZE] {
    std::array::from_fn(|i| values.get(i).copied().unwrap_or(0.0))
}

fn wide_matrix(m: &Matrix<IDEAL_SIZE>) -> Matrix<MEDIUM_SIZE> {
    std::array::from_fn(|i| m.get(i).map_or([0.0; MEDIUM_SIZE], wide))
}

impl FrictionEquations<MEDIUM_SIZE> for Widened<'_> {
    fn applied(&self) -> &InputsAndFriction {
        self.0.applied()
    }

    fn applied_mut(&mut self) -> &mut InputsAndFriction {
        self.0.applied_mut()
    }

    fn friction_sources(&self) -> &[FrictionSource] {
        self.0.friction_sources()
    }

    fn plan(&self) -> &Plan {
        self.0.plan()
    }

    fn layout(&self) -> &Layout {
        self.0.layout()
    }

    fn has_dry_friction(&self) -> bool {
        self.0.has_dry_friction()
    }

    fn has_ends(&self) -> bool {
        self.0.has_ends()
    }

    fn sticking(&self) -> &[f64] {
        self.0.sticking()
    }

    fn mesh_loads(&self, at: &Point<MEDIUM_SIZE>) -> [SurfaceLoad; FRICTION_BODIES] {
        self.0.mesh_loads(&narrow(at))
    }

    fn acceleration_at(&self, at: &Point<MEDIUM_SIZE>, time: f64) -> [f64; MEDIUM_SIZE] {
        wide(&self.0.acceleration_at(&narrow(at), time))
    }

    fn acceleration_by_inputs(&self, at: &Point<MEDIUM_SIZE>) -> [f64; MEDIUM_SIZE] {
        wide(&self.0.acceleration_by_inputs(&narrow(at)))
    }

    fn is_friction_due(&self, at: &Point<MEDIUM_SIZE>, time: f64) -> bool {
        self.0.is_friction_due(&narrow(at), time)
    }

    fn drag_anchors(&self, at: &Point<MEDIUM_SIZE>, ledger_rates: &LedgerRates, anchors: &mut [f64; FRICTION_BODIES]) {
        self.0.drag_anchors(&narrow(at), ledger_rates, anchors);
    }

    fn settle_friction(&mut self, at: &Point<MEDIUM_SIZE>, time: f64, bodies: Range<usize>, heat: &mut [f64]) {
        self.0.settle_friction(&narrow(at), time, bodies, heat);
    }
}

impl SecondOrder<MEDIUM_SIZE> for Widened<'_> {
    type Rates = LedgerRates;

    fn degrees_of_freedom(&self) -> usize {
        self.0.degrees_of_freedom()
    }

    fn rates(&self, v: &[f64; MEDIUM_SIZE]) -> [f64; MEDIUM_SIZE] {
        wide(&self.0.rates(&std::array::from_fn(|i| v[i])))
    }

    fn times_rates(&self, m: &mut Matrix<MEDIUM_SIZE>) {
        let mut rows: Matrix<IDEAL_SIZE> = std::array::from_fn(|i| std::array::from_fn(|j| m[i][j]));
        self.0.times_rates(&mut rows);
        *m = wide_matrix(&rows);
    }

    fn evaluate(&self, at: &Point<MEDIUM_SIZE>) -> ([f64; MEDIUM_SIZE], LedgerRates) {
        let (acceleration, ledger_rates) = self.0.evaluate(&narrow(at));
        (wide(&acceleration), ledger_rates)
    }

    fn linearise(&self, at: &Point<MEDIUM_SIZE>) -> Linearisation<MEDIUM_SIZE, LedgerRates> {
        self.linearise_at(at, 0.0)
    }

    fn is_driven(&self) -> bool {
        self.0.is_driven()
    }

    fn evaluate_at(&self, at: &Point<MEDIUM_SIZE>, time: f64) -> ([f64; MEDIUM_SIZE], LedgerRates) {
        let (acceleration, ledger_rates) = self.0.evaluate_at(&narrow(at), time);
        (wide(&acceleration), ledger_rates)
    }

    fn linearise_at(&self, at: &Point<MEDIUM_SIZE>, time: f64) -> Linearisation<MEDIUM_SIZE, LedgerRates> {
        let Linearisation { acceleration, by_position, by_velocity, ledger_rates } =
            self.0.linearise_at(&narrow(at), time);
        Linearisation {
            acceleration: wide(&acceleration),
            by_position: wide_matrix(&by_position),
            by_velocity: wide_matrix(&by_velocity),
            ledger_rates,
        }
    }

    fn drift(&self, at: &Point<MEDIUM_SIZE>, time: f64) -> [f64; MEDIUM_SIZE] {
        wide(&self.0.drift(&narrow(at), time))
    }

    fn weights(&self, at: &Point<MEDIUM_SIZE>) -> Point<MEDIUM_SIZE> {
        let Point { q, v } = self.0.weights(&narrow(at));
        Point { q: wide(&q), v: wide(&v) }
    }

    fn combined(&self, of: [(f64, &LedgerRates); 5]) -> LedgerRates {
        LedgerRates::combined(of)
    }

    fn undo_torque_change(&self, at: &Point<MEDIUM_SIZE>, ledger_rates: &mut LedgerRates) {
        self.0.undo_torque_change(&narrow(at), ledger_rates);
    }

    fn energy(&self, at: &Point<MEDIUM_SIZE>) -> [f64; 2] {
        self.0.energy(&narrow(at))
    }

    fn imbalance(&self, energies: [[f64; 2]; 2], h: f64, ledger_rates: &[LedgerRates; 3]) -> Imbalance {
        self.0.imbalance(energies, h, ledger_rates)
    }

    fn energy_floor(&self, ends: [&Point<MEDIUM_SIZE>; 2], tolerance: f64, residual: f64) -> f64 {
        let ends = ends.map(narrow);
        self.0.energy_floor([&ends[0], &ends[1]], tolerance, residual)
    }

    fn crossing(&self, start: TimedPoint<MEDIUM_SIZE>, end: TimedPoint<MEDIUM_SIZE>) -> Option<f64> {
        let [first, last] = [start.point, end.point].map(narrow);
        let [start, end] =
            [TimedPoint { point: &first, time: start.time }, TimedPoint { point: &last, time: end.time }];
        self.0.crossing(start, end)
    }
}

impl LedgerEquations<MEDIUM_SIZE> for Widened<'_> {
    fn check_deflection(&self, _: &Point<MEDIUM_SIZE>) -> Result<u8, ExcessiveDeflection> {
        Ok(0)
    }

    fn record(&self, model: &Model, step: &Step<MEDIUM_SIZE, LedgerRates>, sums: &mut LedgerSums) {
        record_without_teeth(model, self.applied(), step, sums);
    }
}
