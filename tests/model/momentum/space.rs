//! Point and direction of a tooth force, computed only from the geometry of the teeth.
//!
//! The frame of a mesh has its origin at the apex. The planet's axis is z and the side gear's axis is x, both from apex
//! to heel. On the path, the line of action is the great circle through the pitch line P₀ along T₀, which leans by α
//! toward the planet's tip: C = cos s P₀ + sin s T₀ with the normal dC/ds. A corner beyond an end of the path has
//! turned about the axis of its gear by Δ/sinδ_b. The normal at the corner is perpendicular to its ray, and its arm
//! about the mate's axis is sinδ_b, as for an involute.

use bevel_differential::contact::pairs::Spot;
use bevel_differential::geometry::Pair;
use bevel_differential::model::ToothLoad;
use nalgebra::{Rotation3, Unit, Vector3};

type V3 = Vector3<f64>;

/// Unit force of the planet on the side gear.
#[derive(Clone, Copy, Debug)]
pub struct UnitForce {
    /// Direction from the apex to the point at which the force acts.
    pub point: V3,
    /// Direction of the force.
    pub normal: V3,
}

impl UnitForce {
    /// Unit force of the tooth pair with this `load`.
    pub fn of(pair: &Pair, load: &ToothLoad) -> Self {
        let turn = load.turn();
        match load.spot {
            Spot::Path => Self::on_path(pair, load.s, turn),
            Spot::PlanetTip => Self::at_corner(pair, 0, load.spot_arc, turn),
            Spot::SideTip => Self::at_corner(pair, 1, load.spot_arc, turn),
        }
    }

    fn on_path(pair: &Pair, s: f64, turn: f64) -> Self {
        let (delta, alpha) = (pair.gears[0].pitch, pair.pressure_angle);
        let pitch_line = V3::new(delta.sin(), 0.0, delta.cos());
        let line = V3::new(delta.cos() * alpha.sin(), turn * alpha.cos(), -delta.sin() * alpha.sin());
        Self { point: pitch_line * s.cos() + line * s.sin(), normal: line * s.cos() - pitch_line * s.sin() }
    }

    /// Unit force at the tip corner of gear `i`, which has turned by the arc `past` beyond the end of the path.
    fn at_corner(pair: &Pair, i: usize, past: f64, turn: f64) -> Self {
        let axes = [V3::z(), V3::x()];
        let end = Self::on_path(pair, if i == 0 { pair.path.high } else { pair.path.low }, turn);
        // beyond either end, the gear with the corner continues its rotation: the planet up, the side gear down
        let angle = turn * past / pair.gears[i].base.sin();
        let point = Rotation3::from_axis_angle(&Unit::new_normalize(axes[i]), angle) * end.point;
        let mate = axes[1 - i];
        let arm = mate.dot(&end.point.cross(&end.normal));
        // unit vectors at a point, around the mate's axis and away from it
        let around = |p: &V3| mate.cross(p).normalize();
        let away = |p: &V3| around(p).cross(p);
        let share = arm / mate.cross(&point).norm();
        let rest = (1.0 - share * share).max(0.0).sqrt() * end.normal.dot(&away(&end.point)).signum();
        Self { point, normal: around(&point) * share + away(&point) * rest }
    }

    /// Components of the force: along the planet's axis on the planet, along the side gear's axis on the side gear, and
    /// along the carrier's rotation on the side gear `side`. The first two point away from the apex.
    pub fn components(&self, side: usize) -> [f64; 3] {
        // y points against the rotation on the left side, and along it on the right side
        let along = if side == 0 { -self.normal.y } else { self.normal.y };
        [-self.normal.z, self.normal.x, along]
    }
}
