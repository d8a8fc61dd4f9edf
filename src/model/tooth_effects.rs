//! Effects on single teeth, set up from the parameters: errors, a broken tooth, friction along the flanks.

use std::sync::Arc;

use super::parameters::{GearContact, Parameters};
use crate::contact::gaps::FlankGaps;
use crate::contact::tooth_friction::ToothFriction;
use crate::geometry::Pair;
use crate::problem::Problem;

/// Slices of the face where loads differ over it.
const SLICES: usize = 8;

/// Gaps of tooth pairs, while sound and once a tooth is broken.
#[derive(Clone, Debug)]
pub struct ToothEffects {
    /// Both states.
    pub gaps: [Option<Arc<FlankGaps>>; 2],
    /// Whether planets differ, so that none may stand for another.
    pub individual: bool,
    /// Whether loads differ over the face.
    sliced: bool,
}

impl ToothEffects {
    /// Effects of the scene.
    pub fn new(p: &Parameters, pair: &Pair) -> Result<Self, Problem> {
        if p.scene.gear_contact == GearContact::Solid {
            return Ok(Self { gaps: [None, None], individual: super::solid::is_individual(p), sliced: false });
        }
        let mut this = Self { gaps: [None, None], individual: false, sliced: p.effects.pin_compliance };
        let _ = (&mut this, pair);
        #[cfg(feature = "tooth_errors")]
        if p.effects.tooth_errors {
            this.add_errors(p, pair)?;
        }
        #[cfg(feature = "tooth_fault")]
        if p.effects.tooth_fault {
            this.add_fault(p, pair)?;
        }
        // cut the face into slices where a law can be cut and something varies over it
        let cones = if this.sliced && p.contact.law != crate::contact::ContactLaw::Impact {
            super::face::slice_cones(pair)
        } else {
            vec![if p.contact.law == crate::contact::ContactLaw::Impact {
                pair.mean_cone
            } else {
                super::face::centroid(pair)
            }]
        };
        for gaps in this.gaps.iter_mut().flatten() {
            Arc::make_mut(gaps).cones = cones.clone();
        }
        Ok(this)
    }

    /// What is unusual about the effects.
    pub fn warning(&self, p: &Parameters, pair: &Pair) -> Option<Problem> {
        let _ = (p, pair);
        #[cfg(feature = "tooth_errors")]
        {
            use crate::contact::errors::pitch::Tolerances;
            let graded = p.effects.tooth_errors && p.tooth_errors.accuracy_grade > 0;
            if graded && !(0..2).all(|i| Tolerances::are_valid(pair, i)) {
                return Some(Problem::new(
                    "tooth_errors.accuracy_grade",
                    "the gears lie outside the ranges for which ISO 17485 gives its tolerances \
                     (mean module 1 to 50 mm, tolerance diameter 5 to 2500 mm, 5 to 400 teeth)",
                ));
            }
        }
        None
    }

    /// Slices wanted over the face.
    pub fn slices(&self) -> usize {
        if self.sliced { SLICES } else { 1 }
    }

    #[cfg(feature = "tooth_errors")]
    fn add_errors(&mut self, p: &Parameters, pair: &Pair) -> Result<(), Problem> {
        use crate::contact::errors::ToothErrors;
        let planets = usize::try_from(p.geometry.planet_count).unwrap_or(1);
        let errors = ToothErrors::new(&p.tooth_errors, pair, planets)?;
        self.individual |= errors.is_individual();
        self.sliced |= !errors.is_uniform_over_face();
        let mut gaps = FlankGaps::perfect(pair, p.geometry.planet_count, Vec::new());
        gaps.least = -p.tooth_errors.most_excess(pair);
        gaps.errors = Some(errors);
        let gaps = Arc::new(gaps);
        self.gaps = [Some(gaps.clone()), Some(gaps)];
        Ok(())
    }

    #[cfg(feature = "tooth_fault")]
    fn add_fault(&mut self, p: &Parameters, pair: &Pair) -> Result<(), Problem> {
        use crate::contact::errors::Chip;
        let planets = usize::try_from(p.geometry.planet_count).unwrap_or(1);
        let sound = self.gaps[0].clone();
        let mut broken = match &sound {
            Some(gaps) => (**gaps).clone(),
            None => FlankGaps::perfect(pair, p.geometry.planet_count, Vec::new()),
        };
        broken.chip = Chip::new(&p.tooth_fault, pair, planets)?;
        self.gaps = [sound, Some(Arc::new(broken))];
        self.individual = true;
        self.sliced = true;
        Ok(())
    }

    /// Friction along the flanks, where the scene asks for it.
    pub fn friction(p: &Parameters, pair: &Pair) -> Option<ToothFriction> {
        let _ = (p, pair);
        #[cfg(feature = "tooth_friction")]
        return p.effects.tooth_friction.then(|| ToothFriction {
            spec: p.tooth_friction,
            modulus: p.material.young_modulus / (2.0 * (1.0 - p.material.poisson_ratio * p.material.poisson_ratio)),
        });
        #[cfg(not(feature = "tooth_friction"))]
        None
    }
}
