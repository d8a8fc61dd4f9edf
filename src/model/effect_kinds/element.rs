//! Elements between bodies: the law of a part is written once, for numbers with and without derivatives, and an element
//! puts it between two degrees of freedom.
//!
//! The law resists the coordinate z with the force f(z, ż): f acts on the base and −f on the body, with z = q_i and
//! ż = v_body − v_base. An element of planets has one part for each group; the forces of all planets act on the base.

use std::fmt::Debug;

use super::{Action, BodyEffect, BodyMotion, Slopes};
use crate::model::scene::layout::over_groups;
use crate::model::scene::{MAX_GROUPS, Viscosity};
use crate::numeric::{Dual, Scalar};

/// Law of a part that resists a displacement z [rad or m], its rate ż, or both.
pub trait Law: Debug + Send + Sync {
    /// True if the derivatives of the force are constant.
    const IS_LINEAR: bool = false;

    /// Force or torque against the displacement and its rate, with the viscosity of the oil, if an effect needs it.
    fn force<T: Scalar>(&self, displacement: T, rate: T, oil: Option<Viscosity>) -> T;

    /// Energy stored at the displacement [J].
    fn energy(&self, _displacement: f64) -> f64 {
        0.0
    }

    /// Power that becomes heat at this rate [W]. `force` is the force at this instant.
    fn heat(&self, rate: f64, force: f64) -> f64 {
        force * rate
    }
}

/// Spring and damper in parallel: f = k z + c ż.
#[derive(Clone, Copy, Debug)]
pub struct Spring {
    /// Stiffness k [N·m/rad or N/m].
    pub stiffness: f64,
    /// Damping c [N·m·s/rad or N·s/m].
    pub damping: f64,
}

impl Law for Spring {
    const IS_LINEAR: bool = true;

    #[inline]
    fn force<T: Scalar>(&self, displacement: T, rate: T, _: Option<Viscosity>) -> T {
        displacement * self.stiffness + rate * self.damping
    }

    #[inline]
    fn energy(&self, displacement: f64) -> f64 {
        0.5 * self.stiffness * displacement * displacement
    }

    #[inline]
    fn heat(&self, rate: f64, _: f64) -> f64 {
        self.damping * rate * rate
    }
}

/// A law between a body and its base.
#[derive(Clone, Copy, Debug)]
pub struct Part<L> {
    /// Law.
    pub law: L,
    /// Degree of freedom whose position is the displacement; `None` if only the rate counts.
    pub displacement: Option<usize>,
    /// Degree of freedom of the body, whose speed counts positive.
    pub body: usize,
    /// Degree of freedom of the base; `None` for the housing.
    pub base: Option<usize>,
}

/// Parts with laws of one kind, which act together.
#[derive(Clone, Debug)]
pub struct Element<L> {
    /// Parts. The first ones belong to the groups of planets, if [`Self::groups`] is not 0.
    pub parts: Vec<Part<L>>,
    /// Number of groups of planets, whose base is the carrier.
    pub groups: usize,
    /// Number of planets in each group.
    pub members: [f64; MAX_GROUPS],
    /// True if it is part of the structure that supports static loads.
    pub is_structure: bool,
    /// Index of its heat in the ledger.
    pub heat_index: usize,
}

impl<L: Law> Part<L> {
    /// Displacement and its rate.
    #[inline]
    fn local(&self, at: &BodyMotion) -> [f64; 2] {
        let rate = at.v[self.body] - self.base.map_or(0.0, |base| at.v[base]);
        [self.displacement.map_or(0.0, |i| at.q[i]), rate]
    }

    /// Derivatives of the force with respect to the displacement and its rate.
    #[inline]
    fn slopes(&self, at: &BodyMotion) -> [f64; 2] {
        let [displacement, rate] = self.local(at);
        self.law.force(Dual::<2>::variable(displacement, 0), Dual::variable(rate, 1), at.oil_viscosity).d
    }
}

impl<L: Law> Element<L> {
    /// Element of `parts` that belong to no planets.
    pub fn new(parts: Vec<Part<L>>, heat_index: usize) -> Self {
        Self { parts, groups: 0, members: [0.0; MAX_GROUPS], is_structure: false, heat_index }
    }

    /// Base of the parts that belong to planets, if there are any.
    #[inline]
    fn base_of_planets(&self) -> Option<usize> {
        self.parts[..self.groups].first().and_then(|part| part.base)
    }
}

impl<L: Law> BodyEffect for Element<L> {
    fn act(&self, at: &BodyMotion, out: &mut Action) {
        let mut of_groups = [[0.0; 2]; MAX_GROUPS];
        for (k, part) in self.parts.iter().enumerate() {
            let [displacement, rate] = part.local(at);
            let force = part.law.force(displacement, rate, at.oil_viscosity);
            let heat = part.law.heat(rate, force);
            out.force[part.body] -= force;
            if k < self.groups {
                of_groups[k] = [self.members[k] * force, self.members[k] * heat];
                continue;
            }
            if let Some(base) = part.base {
                out.force[base] += force;
            }
            out.heat[self.heat_index] += heat;
        }
        if let Some(base) = self.base_of_planets() {
            out.force[base] += over_groups(self.groups, |g| of_groups[g][0]);
            out.heat[self.heat_index] += over_groups(self.groups, |g| of_groups[g][1]);
        }
    }

    fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
        let mut of_groups = [0.0; MAX_GROUPS];
        for (k, part) in self.parts.iter().enumerate() {
            let ([by_displacement, by_rate], body) = (part.slopes(at), part.body);
            out.velocity(body, body, -by_rate);
            if let Some(i) = part.displacement {
                out.position(body, i, -by_displacement);
            }
            let Some(base) = part.base else { continue };
            out.velocity(body, base, by_rate);
            let count = if k < self.groups { self.members[k] } else { 1.0 };
            out.velocity(base, body, count * by_rate);
            if let Some(i) = part.displacement {
                out.position(base, i, count * by_displacement);
            }
            if k < self.groups {
                of_groups[k] = count * by_rate;
            } else {
                out.velocity(base, base, -by_rate);
            }
        }
        if let Some(base) = self.base_of_planets() {
            out.velocity(base, base, -over_groups(self.groups, |g| of_groups[g]));
        }
    }

    fn is_structure(&self) -> bool {
        self.is_structure
    }

    fn heat_of_springs(&self) -> Option<usize> {
        L::IS_LINEAR.then_some(self.heat_index)
    }

    fn energy(&self, at: &BodyMotion) -> f64 {
        let energy = |part: &Part<L>| part.law.energy(part.local(at)[0]);
        let (planets, others) = self.parts.split_at(self.groups);
        let others = others.iter().map(energy).sum::<f64>();
        if planets.is_empty() {
            return others;
        }
        over_groups(self.groups, |g| self.members[g] * energy(&planets[g])) + others
    }
}
