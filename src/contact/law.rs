//! Laws that a tooth pair can follow: an elastic response, and a damping on top of it.
//!
//! Elastic energy is a function of the penetration d, taken at the cone distance where the pair's resultant acts, and of
//! the place s on the path: U(d, s). Damping scales or adds to the force along d alone.

use super::impact::Force;
use super::{Damping, Impact, Spring};

/// Force of one tooth pair and what depends on its place on the path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    /// Force along d with its derivatives.
    pub force: Force,
    /// ∂U/∂s [J/rad].
    pub by_place: f64,
    /// ∂²U/∂d∂s = ∂F_el/∂s [N/rad].
    pub elastic_by_place: f64,
    /// ∂F/∂s of the damped force [N/rad].
    pub total_by_place: f64,
    /// ∂²U/∂s² [J/rad²].
    pub by_place_twice: f64,
    /// U [J], where it is asked for.
    pub energy: f64,
}

/// Law of a tooth pair at penetration `d` > 0 [m], rate ḋ [m/s] and place `s` [rad].
pub trait PairLaw {
    /// Whether the response depends on the place.
    const PLACED: bool;
    /// Force and its derivatives, and the energy if `STORED`.
    fn respond<const STORED: bool>(&self, d: f64, rate: f64, s: f64) -> Response;
    /// Whether one such law is a whole mesh.
    const SINGLE: bool = false;
    /// Replaces the damping by one of the same kind.
    fn set_damping(&mut self, new: Damping);
}

impl PairLaw for Impact {
    const PLACED: bool = false;
    #[inline(always)]
    fn respond<const STORED: bool>(&self, d: f64, rate: f64, _s: f64) -> Response {
        let energy = if STORED { Impact::energy(self, d) } else { 0.0 };
        Response { force: self.force(d, rate), energy, ..Response::default() }
    }
    fn set_damping(&mut self, new: Damping) {
        if let Damping::Step { coefficient, .. } = new {
            self.damping = coefficient;
        }
    }
}

/// The elastic part of IMPACT with another damping law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DampedImpact {
    /// Elastic part; its own damping is not used.
    pub elastic: Impact,
    /// Damping.
    pub damping: Damping,
}

impl PairLaw for DampedImpact {
    const PLACED: bool = false;
    #[inline(always)]
    fn respond<const STORED: bool>(&self, d: f64, rate: f64, _s: f64) -> Response {
        let elastic = self.elastic.force(d, 0.0);
        let stiffness = self.elastic.exponent * elastic.elastic / d;
        let force = self.damping.apply(elastic.elastic, stiffness, d, rate);
        let energy = if STORED { self.elastic.energy(d) } else { 0.0 };
        Response { force, energy, ..Response::default() }
    }
    fn set_damping(&mut self, new: Damping) {
        self.damping = new;
    }
}

/// A linear spring per mesh: the mean of the tooth pairs along the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lumped {
    /// Stiffness k [N/m] at the cone distance of the mesh.
    pub stiffness: f64,
    /// Damping.
    pub damping: Damping,
}

impl PairLaw for Lumped {
    const PLACED: bool = false;
    const SINGLE: bool = true;
    #[inline(always)]
    fn respond<const STORED: bool>(&self, d: f64, rate: f64, _s: f64) -> Response {
        let force = self.damping.apply(self.stiffness * d, self.stiffness, d, rate);
        Response { force, energy: 0.5 * self.stiffness * d * d, ..Response::default() }
    }
    fn set_damping(&mut self, new: Damping) {
        self.damping = new;
    }
}

/// A pair whose slices over the face width all follow one specific law Φ(p, s), p = d/R: U = J Φ with J = ∫R² dR.
#[derive(Clone, Debug)]
pub struct FaceLaw<S> {
    /// Specific law, per unit of J.
    pub specific: S,
    /// J [m³].
    pub moment: f64,
    /// 1/R_F of the cone distance at which the resultant acts [1/m].
    pub per_cone: f64,
    /// Damping.
    pub damping: Damping,
}

impl<S: Spring> FaceLaw<S> {
    /// The response at the place `place` of the specific law.
    #[inline(always)]
    pub fn respond_at(&self, place: &S::Place, d: f64, rate: f64) -> Response {
        let e = self.specific.respond(place, d * self.per_cone);
        let (per_arc, per_depth) = (self.moment, self.moment * self.per_cone);
        let (elastic, stiffness) = (per_depth * e.torque, per_depth * self.per_cone * e.stiffness);
        let force = self.damping.apply(elastic, stiffness, d, rate);
        let elastic_by_place = per_depth * e.torque_by_place;
        // damping either adds to the elastic force or scales it
        let total_by_place = match self.damping {
            _ if force.total <= 0.0 => 0.0,
            Damping::Step { .. } => elastic_by_place,
            Damping::HuntCrossley { lambda } => elastic_by_place * (1.0 + lambda * rate),
        };
        Response {
            force,
            by_place: per_arc * e.by_place,
            elastic_by_place,
            total_by_place,
            by_place_twice: per_arc * e.by_place_twice,
            energy: per_arc * e.energy,
        }
    }
}

impl<S: Spring> PairLaw for FaceLaw<S> {
    const PLACED: bool = true;
    #[inline(always)]
    fn respond<const STORED: bool>(&self, d: f64, rate: f64, s: f64) -> Response {
        self.respond_at(&self.specific.place(s), d, rate)
    }
    fn set_damping(&mut self, new: Damping) {
        self.damping = new;
    }
}
