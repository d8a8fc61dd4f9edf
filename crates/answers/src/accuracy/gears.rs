//! Levels of tooth contact and laws of a tooth pair: which of them is the richest that a scene's question admits, and which
//! are plainer.

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Parameters};
use bevel_differential::problem::Problem;

use super::switches::{Settled, settled};
use crate::scene::Scene;

/// Parameters whose values make the law of a tooth pair the scene's own.
const OF_THE_LAW: [&str; 3] = ["contact.stiffness", "contact.exponent", "contact.stiffness_from_hertz"];

/// A level with a law, and whether gear bodies give way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gears {
    /// Level.
    pub level: GearContact,
    /// Law; it counts where there are teeth.
    pub law: ContactLaw,
    /// Gear bodies give way.
    pub has_bodies: bool,
}

const fn gears(level: GearContact, law: ContactLaw, has_bodies: bool) -> Gears {
    Gears { level, law, has_bodies }
}

/// All of them, the plainest first. Solid teeth are a worse model of a flank, and not among them.
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
    /// Those of `p`; a law that counts for nothing is that of [`ALL`].
    pub fn of(p: &Parameters) -> Self {
        let level = p.scene.gear_contact;
        let law = if level == GearContact::Tooth { p.contact.law } else { ContactLaw::Impact };
        Self { level, law, has_bodies: p.effects.body_compliance }
    }

    /// `scene` with them; effects that they do not know go.
    pub fn of_scene(self, scene: &Scene) -> Result<Settled, Vec<Problem>> {
        let mut scene = scene.clone();
        let p = &mut scene.parameters;
        (p.scene.gear_contact, p.effects.body_compliance) = (self.level, self.has_bodies);
        if self.level == GearContact::Tooth {
            p.contact.law = self.law;
        }
        settled(&scene)
    }

    /// In words.
    pub fn text(self) -> String {
        let (level, law) = (self.level.literal(), self.law.literal());
        match self.level {
            GearContact::Ideal | GearContact::Lumped => level.into(),
            _ => format!("{level} {law}{}", if self.has_bodies { " + gear bodies" } else { "" }),
        }
    }
}

/// Whether `scene` sets one of `names`.
fn sets(scene: &Scene, names: &[&str]) -> bool {
    scene.settings.iter().any(|setting| names.contains(&setting.row.name))
}

/// The richest that the question of `scene` admits. A level or law that the scene sets to another than the start value, and
/// a law with values of the scene's own, is part of the question; what is left at its start value is replaced by the richest.
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

/// What is plainer than `richest`, the plainest first; laws that are not those of the scene's own values are left out.
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
