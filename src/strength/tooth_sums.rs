//! Damage sums of each tooth of a gear, in an array of fixed size; saved without the zeros behind the last tooth.

use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Most teeth of a gear.
pub const MOST_TEETH: usize = 200;

/// Damage of both roots of each tooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothSums([[f64; 2]; MOST_TEETH]);

impl Default for ToothSums {
    fn default() -> Self {
        Self([[0.0; 2]; MOST_TEETH])
    }
}

impl ToothSums {
    /// Adds to both roots of a tooth; nothing if there is no such tooth.
    pub fn add(&mut self, tooth: usize, roots: [f64; 2]) {
        for (sum, root) in self.0.get_mut(tooth).into_iter().flatten().zip(roots) {
            *sum += root;
        }
    }

    /// Both roots of a tooth.
    pub fn of(&self, tooth: usize) -> [f64; 2] {
        self.0.get(tooth).copied().unwrap_or_default()
    }

    /// Largest sum at each of both roots.
    pub fn worst(&self) -> [f64; 2] {
        self.0.iter().fold([0.0; 2], |worst, roots| [worst[0].max(roots[0]), worst[1].max(roots[1])])
    }
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

/// Reads the teeth one by one.
struct Teeth;

impl<'de> Visitor<'de> for Teeth {
    type Value = ToothSums;

    fn expecting(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(formatter, "damage sums of up to {MOST_TEETH} teeth")
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
