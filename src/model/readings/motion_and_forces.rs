//! Motion, forces and loads of tooth pairs, from the state and one evaluation of the teeth.

use crate::contact::ToothLoad;
use crate::model::assembly::Gears;
use crate::model::dynamics::{IdealEquations, Largest};
use crate::model::outputs::forces::{Extent, Forces};
use crate::model::outputs::pairs::{PairLines, pair_lines};
use crate::model::outputs::{Motion, forces};
use crate::model::run::Simulation;
use crate::model::scene::{CARRIER, MAX_PLANETS};
use crate::numeric::TAU;
use crate::strength::LineContact;

impl Simulation {
    /// Angles and speeds.
    pub fn motion(&self) -> Motion {
        self.with_inputs_applied().motion_of_state()
    }

    pub(in crate::model) fn motion_of_state(&self) -> Motion {
        let (model, state) = (&self.model, &self.state);
        let plan = &model.ideal.plan;
        let layout = plan.layout();
        let position = |i: usize| state.position(i, &model.periods);
        let v = &state.v;
        let side_angle = [position(CARRIER) + position(0), position(CARRIER) + position(1)];
        // the angle of an end is the angle of the side gear minus the twist
        let by_end = |s: usize| plan.shafts[s].then(|| layout.end(s));
        let (ratio, drives) = (plan.drive_ratio.unwrap_or(1.0), [layout.pinion(), layout.port]);
        let mut motion = Motion {
            drive_angle: drives.map(|i| ratio * layout.angle(i).map(|(k, sign)| sign * position(k)).sum::<f64>()),
            drive_speed: drives.map(|i| ratio * v[i]),
            carrier_angle: position(CARRIER),
            carrier_speed: v[CARRIER],
            side_angle,
            side_speed: [v[0], v[1]],
            wheel_angle: [0, 1].map(|s| side_angle[s] - by_end(s).map_or(0.0, position)),
            wheel_speed: [0, 1].map(|s| v[by_end(s).unwrap_or(s)]),
            spin_angle: [0.0; MAX_PLANETS],
            spin_speed: [0.0; MAX_PLANETS],
            mesh_frequency: f64::from(model.parameters.geometry.planet_teeth) * v[layout.planet(0)].abs() / TAU,
        };
        for i in 0..plan.planets {
            let g = layout.planet(plan.group_of[i]);
            motion.spin_angle[i] = position(g);
            motion.spin_speed[i] = v[g];
        }
        motion
    }

    /// Forces under the present inputs, computed at the first call after a change.
    pub fn forces(&mut self) -> &Forces {
        self.forces_with(Extent::Components)
    }

    /// Forces under the present inputs without the spatial components of normal forces, which cost as much as all other
    /// forces.
    pub fn forces_without_components(&mut self) -> &Forces {
        self.forces_with(Extent::Loads)
    }

    fn forces_with(&mut self, extent: Extent) -> &Forces {
        if self.forces.as_ref().is_none_or(|forces| extent == Extent::Components && !forces.has_components) {
            let forces = self.shown().forces_of_state(extent);
            self.forces = Some(forces);
        }
        self.forces.get_or_insert_default()
    }

    pub(in crate::model) fn forces_of_state(&self, extent: Extent) -> Forces {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        match &model.gears {
            Gears::Ideal(ideal) if ideal.body_effects.have_closed_form(state) => {
                forces::ideal_forces(model, inputs, state)
            }
            Gears::Ideal(ideal) => {
                forces::ideal_forces_with_effects(model, &IdealEquations::new(ideal, inputs, state), inputs, state)
            }
            Gears::Teeth(teeth) => {
                forces::teeth_forces(model, &Largest::new(teeth, inputs, state), inputs, (state, extent))
            }
        }
    }

    /// Equations of the teeth under the present inputs; `None` without teeth.
    pub(in crate::model) fn teeth_equations(&self) -> Option<Largest<'_>> {
        let Gears::Teeth(teeth) = &self.model.gears else { return None };
        Some(Largest::new(teeth, &self.inputs, &self.state))
    }

    /// Loaded tooth pairs of planet 1 with the left side gear under the present inputs.
    pub fn pair_lines(&self) -> PairLines {
        self.with_inputs_applied().pair_lines_of_state()
    }

    pub(in crate::model) fn pair_lines_of_state(&self) -> PairLines {
        let Some(equations) = self.teeth_equations() else { return PairLines::default() };
        let model = &self.model;
        let material = &model.parameters.material;
        let contact = LineContact::new(&model.pair, material.young_modulus, material.poisson_ratio);
        let first = model.ideal.plan.group_of[0];
        pair_lines((&model.pair, &contact), &equations, &self.state.point(), [first, 0])
    }

    /// Visits the load of every tooth pair, for one planet of each group. Without teeth, nothing is visited.
    pub fn tooth_loads(&self, mut visit: impl FnMut(&ToothLoad)) {
        let Some(equations) = self.teeth_equations() else { return };
        let (model, point) = (&self.model, self.state.point());
        for g in 0..model.ideal.plan.groups().len() {
            for s in 0..2 {
                equations.tooth_loads(&model.pair, &point, g, s, &mut visit);
            }
        }
    }

    /// Visits the load of every tooth pair of planet 1 with the left side gear, slice by slice if loads differ over the
    /// face. The second argument of `visit` is then a function that returns the pair's load per width [N/m] at any cone
    /// distance [m]. The components of the normal are left at zero.
    pub fn loads_over_the_face(&self, visit: impl FnMut(&ToothLoad, Option<&dyn Fn(f64) -> f64>)) {
        let Some(equations) = self.teeth_equations() else { return };
        let first = self.model.ideal.plan.group_of[0];
        equations.loads_over_the_face(&self.state.point(), first, 0, visit);
    }
}
