//! Dry friction of all bodies that may stick: side gears on the carrier, planets on their pins, wheels in their brakes.

use super::dry_friction::{DAMPING_TIME, DryFriction};
use super::{FrictionPart, FrictionSource, PlanetFriction, SideFriction, SurfaceLoad, WheelFriction};
use crate::model::scene::{FRICTION_PLANETS, FRICTION_WHEELS, InputDerivatives, Inputs};
use crate::model::thermal::NODES;

/// Friction on each kind of body.
#[derive(Clone, Copy, Debug)]
pub struct Friction {
    /// On each side gear.
    pub side: DryFriction,
    /// On each planet.
    pub planet: DryFriction,
    /// On left and right wheel.
    pub wheel: [DryFriction; 2],
    wheel_limit: Option<fn(&Inputs) -> [f64; 2]>,
}

impl Friction {
    /// No friction.
    pub const NONE: Self =
        Self { side: DryFriction::NONE, planet: DryFriction::NONE, wheel: [DryFriction::NONE; 2], wheel_limit: None };

    /// Friction of `sources` with the lock at `lock` and all nodes at `temperatures` [K], under `inputs` and their derivatives.
    /// Brakes that are off add none.
    pub fn new(
        sources: &[FrictionSource],
        (lock, temperatures): (f64, &[f64; NODES]),
        inputs: &Inputs,
        input_derivatives: &InputDerivatives,
    ) -> Self {
        let mut all = Self::NONE;
        let heat_index_of =
            |of: fn(&FrictionSource) -> bool| sources.iter().find(|s| of(s)).map_or(0, |s| s.heat_index);
        all.side = DryFriction::new(DAMPING_TIME, heat_index_of(|s| s.by_lock));
        all.planet = DryFriction::new(DAMPING_TIME, 0);
        for source in sources {
            if source.by_lock {
                if lock > 0.0 {
                    all.add(&source.scaled(lock), 1.0);
                }
            } else {
                all.add(source, source.factor(temperatures));
            }
            if let Some(wheel) = &source.wheel {
                all.brake(wheel, source, source.factor(temperatures), (inputs, input_derivatives));
            }
        }
        all
    }

    fn add(&mut self, source: &FrictionSource, factor: f64) {
        let &FrictionSource { heat_index, static_ratio, .. } = source;
        let SideFriction { constant, per_thrust, per_torque, stiffness, radius, pressed } = source.side;
        let (law, pv_limit) = (source.law(radius), source.pv_limit(pressed));
        let side = FrictionPart { constant, per_thrust, per_load: per_torque, static_ratio, law, pv_limit, heat_index };
        self.side.push(&[side.times(factor)], stiffness);
        let PlanetFriction { per_pin_force, per_thrust, stiffness, radius, pressed } = source.planet;
        let none = FrictionPart { static_ratio, heat_index, ..FrictionPart::NONE };
        let [pin, washer] = radius.map(|radius| source.law(radius));
        let [pin_limit, washer_limit] = pressed.map(|pressed| source.pv_limit(pressed));
        if pin.is_constant() && pin_limit.is_none() {
            self.planet.push(&[FrictionPart { per_thrust, per_load: per_pin_force, ..none }.times(factor)], stiffness);
        } else {
            let pin = FrictionPart { per_load: per_pin_force, law: pin, pv_limit: pin_limit, ..none };
            let washer = FrictionPart { per_thrust, law: washer, pv_limit: washer_limit, ..none };
            self.planet.push(&[pin.times(factor), washer.times(factor)], stiffness);
        }
    }

    fn brake(
        &mut self,
        wheel: &WheelFriction,
        source: &FrictionSource,
        factor: f64,
        (inputs, input_derivatives): (&Inputs, &InputDerivatives),
    ) {
        let [first, second] = &input_derivatives.rates;
        let limits = [inputs, first, second].map(wheel.limit);
        for s in 0..2 {
            self.wheel[s] = DryFriction::commanded(wheel.damping_time[s], source.heat_index);
            if limits.iter().any(|limit| limit[s] != 0.0) {
                let (static_ratio, law, heat_index) =
                    (source.static_ratio, source.law(wheel.radius), source.heat_index);
                let pv_limit = source.pv_limit(wheel.pressed);
                let part =
                    FrictionPart { per_load: 1.0, static_ratio, law, pv_limit, heat_index, ..FrictionPart::NONE };
                self.wheel[s].push(&[part.times(factor)], wheel.stiffness);
            }
        }
        self.wheel_limit = Some(wheel.limit);
    }

    /// Friction on body `i`, counted among those that may stick.
    #[inline]
    pub fn on(&self, i: usize) -> &DryFriction {
        match i {
            0..FRICTION_PLANETS => &self.side,
            FRICTION_PLANETS..FRICTION_WHEELS => &self.planet,
            _ => &self.wheel[i - FRICTION_WHEELS],
        }
    }

    /// Whether anything may stick.
    pub fn is_any(&self) -> bool {
        self.side.is_on() || self.planet.is_on() || self.wheel[0].is_on() || self.wheel[1].is_on()
    }

    /// Whether limit torques depend on the loads of the meshes.
    pub fn depends_on_load(&self) -> bool {
        self.side.depends_on_load() || self.planet.depends_on_load()
    }

    /// Limit torques of the wheels under `inputs`, as loads.
    #[inline]
    pub fn wheel_loads(&self, inputs: &Inputs) -> [SurfaceLoad; 2] {
        match self.wheel_limit {
            Some(limit) => limit(inputs).map(|load| SurfaceLoad { thrust: 0.0, load }),
            None => [SurfaceLoad::default(); 2],
        }
    }
}
