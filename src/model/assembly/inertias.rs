//! Moments of inertia of the bodies, assembled from parameters and solids.

use crate::geometry::solid::mass::GearMass;

use crate::model::scene::{CARRIER, ENDS, MAX_DOF, PINION, PROPELLER, Plan};
use crate::model::setup::Parameters;

/// Inertias that the equations of motion need [kg·m²].
///
/// Planet axes are perpendicular to the carrier axis. The kinetic energy is therefore diagonal in the absolute speeds
/// of carrier and side gears and the relative spins of the planets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertias {
    /// Carrier with the transverse inertia of all planets and with a pinion that is rigid with it.
    pub carrier: f64,
    /// Side gears with their rigid ends.
    pub side: [f64; 2],
    /// Wheel-side ends, left and right.
    pub end: [f64; 2],
    /// One planet about its own axis.
    pub planet: f64,
    /// One planet about the carrier's axis.
    pub planet_transverse: f64,
    /// Mass of a side gear [kg], from its solid unless it is given.
    pub side_mass: f64,
    /// Mass of a planet times the distance of its centre of mass from the carrier's axis [kg·m], always from its solid.
    pub planet_mass_moment: f64,
    /// Number of planets.
    pub planets: f64,
}

impl Inertias {
    /// Inertias of the scene from the solids of planet and side gear. A given inertia replaces the inertia of the solid
    /// and scales the planet's transverse inertia, but leaves masses unchanged.
    pub fn new(p: &Parameters, [planet, side]: &[GearMass; 2]) -> Self {
        let (side_axial, planet_axial) =
            if p.inertia.from_geometry { (side.axial, planet.axial) } else { (p.inertia.side_gear, p.inertia.planet) };
        // an inertia says nothing about a mass, so the mass of the solid remains until another one is given
        let is_mass_given = !p.inertia.from_geometry && p.inertia.side_gear_mass > 0.0;
        let transverse = planet.transverse_at_apex * (planet_axial / planet.axial);
        let end = [p.inertia.left_end, p.inertia.right_end];
        let planets = f64::from(p.geometry.planet_count);
        Self {
            carrier: p.inertia.carrier + planets * transverse,
            side: end.map(|e| side_axial + e),
            end,
            planet: planet_axial,
            planet_transverse: transverse,
            side_mass: if is_mass_given { p.inertia.side_gear_mass } else { side.mass },
            planet_mass_moment: planet.mass * planet.centre,
            planets,
        }
    }

    /// Inertia of the body on which the drive acts [kg·m²].
    pub fn of_port(&self, plan: &Plan) -> f64 {
        plan.attached[PINION..=PROPELLER].iter().flatten().next_back().map_or(self.carrier, |body| body.inertia)
    }

    /// Inertia of each degree of freedom of `plan` [kg·m², for seats kg], for a single planet and pin of each group.
    /// The second value contains the inertias of the ends that are rigid on their side gears [kg·m²].
    pub fn by_freedom(&self, plan: &Plan) -> ([f64; MAX_DOF], [f64; 2]) {
        let layout = plan.layout();
        let mut inertia = [0.0; MAX_DOF];
        let rigid_end = [0, 1].map(|s| if plan.shafts[s] { 0.0 } else { self.end[s] });
        for s in 0..2 {
            inertia[s] = self.side[s] - self.end[s] + rigid_end[s];
            if plan.has_pins {
                inertia[layout.seat(s)] = self.side_mass;
            }
            if layout.has_ends() {
                inertia[layout.end(s)] = self.end[s] - rigid_end[s];
            }
        }
        for (k, body) in plan.attached.iter().enumerate().skip(ENDS) {
            if let Some(body) = body {
                inertia[layout.body(k)] = body.inertia;
            }
        }
        inertia[CARRIER] = self.carrier;
        for g in 0..layout.groups {
            inertia[layout.planet(g)] = self.planet;
            if plan.has_pins {
                inertia[layout.pin(g)] = self.planet_transverse;
            }
        }
        if plan.has_pins {
            inertia[CARRIER] -= self.planets * self.planet_transverse;
        }
        (inertia, rigid_end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pair;
    use crate::geometry::solid::mass::gear_mass;

    #[test]
    fn planets_turn_with_the_carrier_across_their_axes() {
        let mut p = Parameters::default();
        p.geometry.planet_count = 4;
        let pair = Pair::new(&p.geometry);
        let masses = [0, 1].map(|i| gear_mass(&pair, &p.geometry, i, p.material.density));
        let GearMass { axial, transverse_at_apex, mass, centre } = masses[0];
        let j = Inertias::new(&p, &masses);
        assert!((j.carrier / (0.02 + 4.0 * transverse_at_apex) - 1.0).abs() < 1e-12);
        assert_eq!(j.planet, axial);
        // given inertias scale the solid
        p.inertia.from_geometry = false;
        p.inertia.planet = 3.0 * axial;
        p.inertia.left_end = 0.5;
        let j = Inertias::new(&p, &masses);
        assert!((j.carrier / (0.02 + 12.0 * transverse_at_apex) - 1.0).abs() < 1e-12);
        let given = p.inertia.side_gear;
        assert_eq!((j.planet, j.side), (3.0 * axial, [given + 0.5, given]));
        // but neither its mass nor the mass of a side gear
        assert_eq!((j.planet_mass_moment, j.side_mass), (mass * centre, masses[1].mass));
        p.inertia.side_gear_mass = 0.7;
        assert_eq!(Inertias::new(&p, &masses).side_mass, 0.7);
        p.inertia.from_geometry = true;
        assert_eq!(Inertias::new(&p, &masses).side_mass, masses[1].mass);
    }
}
