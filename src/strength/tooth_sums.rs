//! Damage sums of each tooth of a gear, in an array of fixed size. Zeros after the last used tooth are not saved.
//!
//! Stacks are small on the target systems, and few gears of differentials have more than [`MAX_SUMS`] teeth. In a
//! larger gear, neighbouring teeth share a sum, their mean.

use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::numeric::Finite;

/// Maximum number of sums of a gear.
pub const MAX_SUMS: usize = 64;

/// Damage of both roots of each tooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothSums([[f64; 2]; MAX_SUMS]);

impl Default for ToothSums {
    fn default() -> Self {
        Self([[0.0; 2]; MAX_SUMS])
    }
}

impl Finite for ToothSums {
    fn is_finite(&self) -> bool {
        let Self(sums) = self;
        sums.is_finite()
    }
}

impl ToothSums {
    /// Adds damage to both roots of a tooth of a gear with `teeth` teeth. A tooth out of range has no effect.
    pub fn add(&mut self, (tooth, teeth): (usize, usize), roots: [f64; 2]) {
        let share = sharing(teeth);
        for (sum, root) in self.0.get_mut(tooth / share).into_iter().flatten().zip(roots) {
            *sum += root / share as f64;
        }
    }

    /// Damage of both roots of a tooth of a gear with `teeth` teeth.
    pub fn of(&self, (tooth, teeth): (usize, usize)) -> [f64; 2] {
        self.0.get(tooth / sharing(teeth)).copied().unwrap_or_default()
    }

    /// Largest sum at each of the two roots.
    pub fn worst(&self) -> [f64; 2] {
        self.0.iter().fold([0.0; 2], |worst, roots| [worst[0].max(roots[0]), worst[1].max(roots[1])])
    }
}

/// Number of teeth that share a sum.
fn sharing(teeth: usize) -> usize {
    teeth.div_ceil(MAX_SUMS).max(1)
}

impl Serialize for ToothSums {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let used = self.0.iter().rposition(|roots| *roots != [0.0; 2]).map_or(0, |last| last + 1);
        serializer.collect_seq(&self.0[..used])
    }
}

impl<'de> Deserialize<'de> for ToothSums {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Teeth)
    }
}

/// Deserialises the teeth one by one.
struct Teeth;

impl<'de> Visitor<'de> for Teeth {
    type Value = ToothSums;

    fn expecting(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(formatter, "up to {MAX_SUMS} damage sums")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut teeth: A) -> Result<ToothSums, A::Error> {
        let mut sums = ToothSums::default();
        let mut place = 0;
        while let Some(roots) = teeth.next_element()? {
            *sums.0.get_mut(place).ok_or_else(|| A::Error::invalid_length(place + 1, &self))? = roots;
            place += 1;
        }
        Ok(sums)
    }
}
