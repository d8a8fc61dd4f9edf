//! What completed steps add to beside the state, in scenes that are watched for it.

use serde::{Deserialize, Serialize};

use super::LARGEST;
use crate::integrate::Point;
use crate::model::effects::mesh_history::MeshHistory;
use crate::model::effects::strength::{Fatigue, Rated};
use crate::numeric::Finite;

/// Damage of the teeth, and values over mesh cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Watched {
    /// Damage of the teeth.
    pub fatigue: Fatigue,
    /// Peak-to-peak values over mesh cycles.
    pub mesh_history: MeshHistory,
    /// Loads with which the next step may begin; they follow from the state, and saved states do without.
    #[serde(skip)]
    pub last_loads: Option<LastLoads>,
}

/// Loads of the teeth at the end of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LastLoads {
    /// Where it ended.
    pub at: Point<LARGEST>,
    /// Groups of planets, and whether a tooth is broken: with the point, all that loads depend on.
    pub teeth: (usize, bool),
    /// The loads.
    pub loads: Rated,
}

impl Watched {
    /// Whether a simulation can continue from all numbers.
    pub fn is_valid(&self) -> bool {
        // the last loads are not saved
        let Self { fatigue, mesh_history, last_loads: _ } = self;
        fatigue.is_finite() && mesh_history.is_valid()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damage_that_is_no_number_is_not_valid() {
        assert!(Watched::default().is_valid());
        for bad in [f64::NAN, f64::INFINITY] {
            let mut all = [Watched::default(); 3];
            all[0].fatigue.from = bad;
            all[1].fatigue.planets[1].flanks[0].root.sum = bad;
            all[2].fatigue.utilisation.flank.share = bad;
            assert!(all.iter().all(|watched| !watched.is_valid()), "{bad}");
        }
    }
}
