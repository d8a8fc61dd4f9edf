//! Rattle: unloaded flanks touch and separate repeatedly. Impacts, and the steps spent on them, are counted here.

use serde::{Deserialize, Serialize};

/// Number of steps after an impact that belong to it: contact, separation, and the following vibration.
const STEPS_OF_AN_IMPACT: u32 = 64;

/// Counts of impacts and of the steps spent on them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rattle {
    /// Number of times that flanks of a mesh touched after a separation.
    pub impacts: u64,
    /// Number of steps that belong to impacts.
    pub steps: u64,
    /// Number of steps that still belong to the last impact.
    left: u32,
    /// Meshes whose flanks touch, one bit for each.
    touching: u8,
}

impl Rattle {
    /// Adds a completed step. Bits of `touching` mark the meshes whose flanks touch at its end.
    #[inline]
    pub fn add_step(&mut self, touching: u8) {
        if touching & !self.touching != 0 {
            self.impacts += 1;
            self.left = STEPS_OF_AN_IMPACT;
        }
        if self.left > 0 {
            self.left -= 1;
            self.steps += 1;
        }
        self.touching = touching;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_near_impacts_are_counted_and_no_others() {
        let mut rattle = Rattle::default();
        // loaded from the start: one impact
        (0..1000).for_each(|_| rattle.add_step(0b11));
        assert_eq!((rattle.impacts, rattle.steps), (1, 64));
        // the second mesh separates and touches every ten steps
        (0..1000).for_each(|k| rattle.add_step(if k % 10 < 5 { 0b01 } else { 0b11 }));
        assert_eq!(rattle.impacts, 101);
        assert_eq!(rattle.steps, 64 + 995);
    }
}
