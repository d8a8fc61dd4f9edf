//! Where a tooth force acts and in which direction, from the geometry of the teeth alone.
//!
//! Frame of a mesh: apex at the origin, z the planet's axis and x the side gear's, both from apex to heel. On the path
//! the line of action is the great circle through the pitch line P₀ along T₀, which leans by α toward the planet's tip:
//! C = cos s P₀ + sin s T₀ with the normal dC/ds. A corner beyond an end of the path has turned about its own gear's
//! axis by Δ/sinδ_b; the normal there is square to its ray, and has about the mate's axis the arm sinδ_b of an
//! involute.

use bevel_differential::contact::pairs::Spot;
use bevel_differential::geometry::Pair;
use bevel_differential::model::ToothLoad;
use nalgebra::{Rotation3, Unit, Vector3};

type V3 = Vector3<f64>;

/// A unit force of the planet on the side gear.
#[derive(Clone, Copy, Debug)]
pub struct UnitForce {
    /// Direction from the apex to where it acts.
    pub point: V3,
    /// Its direction.
    pub normal: V3,
}

impl UnitForce {
    /// Of the tooth pair that bears `load`.
    pub fn of(pair: &Pair, load: &ToothLoad) -> Self {
        let turn = load.turn();
        match load.spot {
            Spot::Path => Self::on_path(pair, load.s, turn),
            Spot::PlanetTip => Self::at_corner(pair, 0, load.place, turn),
            Spot::SideTip => Self::at_corner(pair, 1, load.place, turn),
        }
    }

    fn on_path(pair: &Pair, s: f64, turn: f64) -> Self {
        let (delta, alpha) = (pair.gears[0].pitch, pair.pressure_angle);
        let pitch_line = V3::new(delta.sin(), 0.0, delta.cos());
        let line = V3::new(delta.cos() * alpha.sin(), turn * alpha.cos(), -delta.sin() * alpha.sin());
        Self { point: pitch_line * s.cos() + line * s.sin(), normal: line * s.cos() - pitch_line * s.sin() }
    }

    /// Corner of gear `i` that has turned by the arc `past` beyond the end of the path.
    fn at_corner(pair: &Pair, i: usize, past: f64, turn: f64) -> Self {
        let axes = [V3::z(), V3::x()];
        let end = Self::on_path(pair, if i == 0 { pair.path.high } else { pair.path.low }, turn);
        // beyond either end the owner of the corner turns as it did on the path: the planet up, the side gear down
        let angle = turn * past / pair.gears[i].base.sin();
        let point = Rotation3::from_axis_angle(&Unit::new_normalize(axes[i]), angle) * end.point;
        let mate = axes[1 - i];
        let arm = mate.dot(&end.point.cross(&end.normal));
        // unit vectors at a point around the mate's axis and away from it
        let around = |p: &V3| mate.cross(p).normalize();
        let away = |p: &V3| around(p).cross(p);
        let share = arm / mate.cross(&point).norm();
        let rest = (1.0 - share * share).max(0.0).sqrt() * end.normal.dot(&away(&end.point)).signum();
        Self { point, normal: around(&point) * share + away(&point) * rest }
    }

    /// Parts along the planet's axis on the planet, along the side gear's axis on the side gear, both away from the
    /// apex, and along the carrier's rotation on the side gear `side`.
    pub fn parts(&self, side: usize) -> [f64; 3] {
        // y points against the rotation at the left, with it at the right
        let along = if side == 0 { -self.normal.y } else { self.normal.y };
        [-self.normal.z, self.normal.x, along]
    }
}
