//! Levels of tooth contact and laws of a tooth pair: the richest that a scene's question admits, and the plainer ones.

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Parameters};
use bevel_differential::problem::Problem;

use super::switches::{Settled, settled};
use crate::scene::Scene;

/// Parameters of the contact law. A scene that sets one of them has a contact law of its own.
const OF_THE_LAW: [&str; 3] = ["contact.stiffness", "contact.exponent", "contact.stiffness_from_hertz"];

/// A level with a law, with rigid or elastic gear bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gears {
    /// Level.
    pub level: GearContact,
    /// Law; only used on the level with teeth.
    pub law: ContactLaw,
    /// True if gear bodies are elastic.
    pub has_bodies: bool,
}

const fn gears(level: GearContact, law: ContactLaw, has_bodies: bool) -> Gears {
    Gears { level, law, has_bodies }
}

/// All levels and laws, the plainest first. Solid teeth are missing because they model a flank less accurately.
const ALL: [Gears; 7] = [
    gears(GearContact::Ideal, ContactLaw::Impact, false),
    gears(GearContact::Lumped, ContactLaw::Impact, false),
    gears(GearContact::Tooth, ContactLaw::Impact, false),
    gears(GearContact::Tooth, ContactLaw::Line, false),
    gears(GearContact::Tooth, ContactLaw::LineWeber, false),
    gears(GearContact::Tooth, ContactLaw::Line, true),
    gears(GearContact::Tooth, ContactLaw::LineWeber, true),
];

impl Gears {
    /// Returns the level and law of `p`; a law that is not used is replaced by the one in [`ALL`].
    pub fn of(p: &Parameters) -> Self {
        let level = p.scene.gear_contact;
        let law = if level == GearContact::Tooth { p.contact.law } else { ContactLaw::Impact };
        Self { level, law, has_bodies: p.effects.body_compliance }
    }

    /// Returns `scene` with this level and law, without effects that they do not support.
    pub fn of_scene(self, scene: &Scene) -> Result<Settled, Vec<Problem>> {
        let mut scene = scene.clone();
        let p = &mut scene.parameters;
        (p.scene.gear_contact, p.effects.body_compliance) = (self.level, self.has_bodies);
        if self.level == GearContact::Tooth {
            p.contact.law = self.law;
        }
        settled(&scene)
    }

    /// Name of level and law for users.
    pub fn text(self) -> String {
        let (level, law) = (self.level.literal(), self.law.literal());
        match self.level {
            GearContact::Ideal | GearContact::Lumped => level.into(),
            _ => format!("{level} {law}{}", if self.has_bodies { " + gear bodies" } else { "" }),
        }
    }
}

/// True if `scene` sets one of `names`.
fn sets(scene: &Scene, names: &[&str]) -> bool {
    scene.settings.iter().any(|setting| names.contains(&setting.row.name))
}

/// Returns the richest level and law that the question of `scene` admits. A level or law that the scene changes from
/// its start value is part of the question; so is a law whose parameters the scene sets. Others are replaced by the
/// richest.
pub fn richest(scene: &Scene) -> Gears {
    let (own, start) = (Gears::of(&scene.parameters), Gears::of(&Parameters::default()));
    let level = match own.level {
        GearContact::Solid => GearContact::Tooth,
        level => level,
    };
    let is_own = level != GearContact::Tooth || own.law != start.law || sets(scene, &OF_THE_LAW);
    let law = if is_own { own.law } else { ContactLaw::LineWeber };
    let bodies_set_off = !own.has_bodies && sets(scene, &["effects.body_compliance"]);
    let has_bodies = level == GearContact::Tooth && law != ContactLaw::Impact && !bodies_set_off;
    Gears { level, law, has_bodies }
}

/// Returns levels and laws plainer than `richest`, the plainest first. If the scene sets parameters of its law, other
/// laws are left out.
pub fn plainer(scene: &Scene, richest: Gears) -> Vec<Gears> {
    let own_law = sets(scene, &OF_THE_LAW);
    let known = ALL.iter().take_while(|&&gears| gears != richest).copied();
    let fits = |gears: &Gears| {
        let teeth = gears.level == GearContact::Tooth;
        let as_rich = |law: ContactLaw| (law as i32) <= (richest.law as i32);
        let of_law = if own_law { gears.law == richest.law } else { as_rich(gears.law) };
        !teeth || of_law && (richest.has_bodies || !gears.has_bodies)
    };
    let lower = |gears: &Gears| (gears.level as i32) <= (richest.level as i32);
    known.filter(|gears| lower(gears) && fits(gears)).collect()
}
