//! Stresses above the strength. The first of each kind in a run is recorded.

use serde::{Deserialize, Serialize};

use crate::declaration::SIDES;
use crate::model::scene::{MAX_GROUPS, Plan};
use crate::numeric::{Finite, finite};
use crate::problem::Problem;

/// Kinds of stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stressed {
    /// Bending stress at the root of a planet's tooth.
    PlanetRoot,
    /// Bending stress at the root of a side gear's tooth.
    SideRoot,
    /// Contact stress of the flanks.
    Flanks,
}

impl Stressed {
    /// All kinds of stress.
    pub const ALL: [Self; 3] = [Self::PlanetRoot, Self::SideRoot, Self::Flanks];
}

/// Stress and the corresponding strength.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Overload {
    /// Time [s].
    pub time: f64,
    /// Stress [Pa].
    pub stress: f64,
    /// Strength [Pa].
    pub strength: f64,
    /// Group of planets.
    pub group: usize,
    /// Side gear in mesh.
    pub side: usize,
}

/// First overload of each kind in a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Overloads {
    first: [Option<Overload>; Stressed::ALL.len()],
}

finite!(Overloads { first });

impl Finite for Overload {
    /// True if all numbers are finite, and group and side exist.
    fn is_finite(&self) -> bool {
        let Self { time, stress, strength, group, side } = *self;
        [time, stress, strength].is_finite() && group < MAX_GROUPS && side < 2
    }
}

impl Overloads {
    /// Records `load` if it is the first of its kind above the strength.
    pub fn watch(&mut self, what: Stressed, load: Overload) {
        let first = &mut self.first[what as usize];
        if first.is_none() && load.stress > load.strength {
            *first = Some(load);
        }
    }

    /// First overload of the kind `what`, or `None` if there has been none.
    pub fn of(&self, what: Stressed) -> Option<&Overload> {
        self.first[what as usize].as_ref()
    }
}

impl Overload {
    /// Warning that names gear, stress, strength and time.
    pub fn warning(&self, what: Stressed, plan: &Plan) -> Problem {
        let side = SIDES[self.side];
        let planet = format!("planet[{}]", plan.group(self.group).planet + 1);
        let (variable, stress) = match what {
            Stressed::PlanetRoot => {
                ("strength.bending_strength", format!("root stress of {planet} in mesh with the {side} side gear"))
            }
            Stressed::SideRoot => {
                ("strength.bending_strength", format!("root stress of the {side} side gear in mesh with {planet}"))
            }
            Stressed::Flanks => {
                ("strength.contact_strength", format!("contact stress between {planet} and the {side} side gear"))
            }
        };
        problem!(
            variable,
            "{stress} of {:.1} MPa exceeds the strength of {:.1} MPa at t = {:.6} s; reported once",
            self.stress * 1e-6,
            self.strength * 1e-6,
            self.time
        )
    }
}
