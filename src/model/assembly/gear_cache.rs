//! Cache of values that depend only on gears and material, for later starts with the same ones.
//!
//! Masses, gap tables and compliance tables take most of the time of a start, but loads and drives do not change them.
//! The key of each value is the bits of all arguments of the function that computes it. A cached value therefore has
//! the same bits as a recomputed one.

use std::ops::Deref;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::cache::Cache;
use super::solid;
use crate::contact::bodies::{MeshOnBodies, PairCouplings, Support};
use crate::contact::errors::ToothErrorSpec;
use crate::contact::solid::mesh::SolidMesh;
use crate::contact::stiffness::{Elasticity, PairStiffness, RootSpec};
use crate::contact::{Damping, Engagement, Impact};
use crate::geometry::solid::mass::{GearMass, gear_mass};
use crate::geometry::{GearSpec, Pair, checks};
use crate::model::scene::SolidTeeth;
use crate::model::setup::Parameters;
use crate::problem::Problem;

/// Gear pair with the errors and warnings of its geometry.
#[derive(Debug)]
pub struct CheckedPair {
    /// Gear pair.
    pub pair: Pair,
    /// Errors; empty if the pair can be built.
    pub errors: Vec<Problem>,
    /// Warnings.
    pub warnings: Vec<Problem>,
}

/// Tooth pairs of gears with elastic bodies.
#[derive(Debug)]
pub struct OnBodies {
    /// Stiffness of a pair by itself, from teeth and bodies.
    pub stiffness: PairStiffness,
    /// Couplings by which pairs move each other.
    pub couplings: Arc<PairCouplings>,
}

/// Cache of values that depend only on gears and material.
#[derive(Debug, Default)]
pub struct GearCache {
    pairs: Cache<Arc<CheckedPair>>,
    masses: Cache<[GearMass; 2]>,
    engagements: Cache<Engagement>,
    stiffness: Cache<Result<Arc<PairStiffness>, Problem>>,
    bodies: Cache<Result<Arc<OnBodies>, Problem>>,
    means: Cache<Result<f64, Problem>>,
    solids: Cache<SolidMesh>,
}

impl GearCache {
    /// Gear pair of `spec`, whose pitch angles must be below 90°.
    pub fn pair(&self, spec: &GearSpec) -> Arc<CheckedPair> {
        self.pairs.get(spec, || {
            let pair = Pair::new(spec);
            let (errors, warnings) = (checks::errors(spec, &pair), checks::warnings(spec, &pair));
            Arc::new(CheckedPair { pair, errors, warnings })
        })
    }

    /// Mass properties of planet and side gear of `pair`, which was built from `spec`, at the density `density`
    /// [kg/m³].
    pub fn masses(&self, pair: &Pair, spec: &GearSpec, density: f64) -> [GearMass; 2] {
        self.masses.get(&(pair, spec, density), || [0, 1].map(|i| gear_mass(pair, spec, i, density)))
    }

    /// Engagement of the tooth pairs of `pair` for approaches up to `reach` [rad].
    pub fn engagement(&self, pair: &Pair, corner_contact: bool, reach: f64) -> Engagement {
        self.engagements.get(&(pair, corner_contact, reach), || Engagement::new(pair, corner_contact, reach))
    }

    /// Stiffness of the tooth pairs of `pair` in the scene `p`. Fails if material, root fillet or reference line load
    /// give teeth without a valid stiffness.
    pub fn stiffness(&self, p: &Parameters, pair: &Pair) -> Result<Arc<PairStiffness>, Problem> {
        let (fillet, [young, poisson, load]) = (p.geometry.root_fillet, elasticity(p));
        self.stiffness.get(&(pair, fillet, young, poisson, load), || {
            PairStiffness::new(pair, &RootSpec { fillet }, young, poisson, load).map(Arc::new)
        })
    }

    /// Tooth pairs of `pair` on elastic gear bodies in the scene `p`. Side gears are held by splines, and planets by
    /// pins that transmit no torque. Fails as [`Self::stiffness`] does, or if a bore leaves no body below the teeth.
    pub fn on_bodies(&self, p: &Parameters, pair: &Pair) -> Result<Arc<OnBodies>, Problem> {
        let (fillet, [young, poisson, load]) = (p.geometry.root_fillet, elasticity(p));
        let (bores, planets) = ([p.geometry.planet_bore, p.geometry.side_bore], p.geometry.planet_count.unsigned_abs());
        self.bodies.get(&(pair, fillet, [young, poisson, load], bores, planets), || {
            let teeth = PairStiffness::teeth(pair, &RootSpec { fillet }, Elasticity { young, poisson })?;
            let supports = [Support::FreeBore(bores[0]), Support::Bore(bores[1])];
            let mesh = MeshOnBodies::new(pair, &teeth, supports, planets)?;
            let stiffness = PairStiffness::of_gears(pair, &teeth, load, |i, roll| mesh.gear(i, roll))?;
            let couplings = Arc::new(PairCouplings::new(
                &mesh,
                [stiffness.path, stiffness.range],
                (pair.centred_position(), pair.base_pitch),
            ));
            Ok(Arc::new(OnBodies { stiffness, couplings }))
        })
    }

    /// Mean stiffness of the mesh of `pair` per unit of width [Pa] in the scene `p`. Fails as [`Self::stiffness`] does.
    pub fn mesh_mean(&self, p: &Parameters, pair: &Pair) -> Result<f64, Problem> {
        let key = (pair, p.geometry.root_fillet, elasticity(p));
        self.means.get(&key, || Ok(self.stiffness(p, pair)?.mesh_mean()))
    }

    /// Solid teeth of `pair` with given facets and errors, pressed together by the law `elastic` and `damping`.
    pub fn solid(
        &self,
        pair: &Pair,
        (spec, teeth, errors): (&GearSpec, &SolidTeeth, &ToothErrorSpec),
        elastic: Impact,
        damping: Damping,
    ) -> SolidMesh {
        let key = (pair, spec, teeth, errors);
        let mut mesh = self.solids.get(&key, || solid::mesh(pair, (spec, teeth, errors), elastic, damping));
        // the surfaces do not depend on the law
        (mesh.elastic, mesh.damping) = (elastic, damping);
        mesh
    }
}

/// Young's modulus [Pa], Poisson's ratio and the reference line load [N/m] of the scene `p`.
fn elasticity(p: &Parameters) -> [f64; 3] {
    [p.material.young_modulus, p.material.poisson_ratio, p.contact.reference_line_load]
}

/// Shared cache, and the number of its users.
struct Common {
    /// Number of handles.
    shares: usize,
    /// Cache; `None` without handles.
    cache: Option<Arc<GearCache>>,
}

static COMMON: Mutex<Common> = Mutex::new(Common { shares: 0, cache: None });

fn common() -> MutexGuard<'static, Common> {
    COMMON.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Handle of the shared cache, which is released with its last handle.
#[derive(Debug)]
pub struct Share(Arc<GearCache>);

impl Share {
    /// Returns a handle of the shared cache.
    #[expect(clippy::new_without_default, reason = "shares are counted")]
    pub fn new() -> Self {
        let mut common = common();
        common.shares += 1;
        Self(common.cache.get_or_insert_default().clone())
    }
}

impl Deref for Share {
    type Target = GearCache;

    fn deref(&self) -> &GearCache {
        &self.0
    }
}

impl Drop for Share {
    fn drop(&mut self) {
        let mut common = common();
        common.shares -= 1;
        if common.shares == 0 {
            common.cache = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_a_parameter_does_not_change_are_shared() {
        let (cache, p) = (GearCache::default(), Parameters::default());
        let pair = cache.pair(&p.gears());
        let stiffness = |p: &Parameters, pair: &Pair| cache.stiffness(p, pair).expect("a stiffness");
        let here = stiffness(&p, &pair.pair);
        let mut changed = p;
        (changed.material.density, changed.contact.damping, changed.geometry.planet_count) = (8000.0, 1.0, 4);
        assert!(Arc::ptr_eq(&here, &stiffness(&changed, &cache.pair(&changed.gears()).pair)));
        assert!(Arc::ptr_eq(&pair, &cache.pair(&p.gears())));
        let changes: [fn(&mut Parameters); 6] = [
            |p| p.geometry.module *= 1.001,
            |p| p.geometry.root_fillet *= 1.001,
            |p| p.material.young_modulus *= 1.001,
            |p| p.material.poisson_ratio *= 1.001,
            |p| p.contact.reference_line_load *= 1.001,
            |p| p.effects.teeth.backlash = !p.effects.teeth.backlash,
        ];
        for change in changes {
            let mut changed = p;
            change(&mut changed);
            assert!(!Arc::ptr_eq(&here, &stiffness(&changed, &cache.pair(&changed.gears()).pair)));
        }
    }

    #[test]
    fn cached_solid_teeth_have_the_requested_law() {
        let (cache, p) = (GearCache::default(), Parameters::default());
        let pair = Pair::new(&p.gears());
        let mesh = |stiffness: f64, coefficient: f64| {
            let elastic = Impact { stiffness, exponent: 1.5, damping: 0.0, per_full_depth: 1e4 };
            let damping = Damping::Step { coefficient, per_full_depth: 1e4 };
            let mesh = cache.solid(&pair, (&p.geometry, &p.solid, &solid::errors(&p)), elastic, damping);
            (mesh.elastic.stiffness, mesh.damping)
        };
        let damping = |coefficient: f64| Damping::Step { coefficient, per_full_depth: 1e4 };
        assert_eq!([mesh(1e9, 5.0), mesh(2e9, 6.0)], [(1e9, damping(5.0)), (2e9, damping(6.0))]);
    }
}
