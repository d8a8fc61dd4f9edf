//! Heats, readings and bodies of the effects, and their positions among those of all effects.

use crate::model::effect_kinds::{Attached, Changes, Heat, Reading, Warmed};
use crate::model::effects::{EFFECTS, EffectEntry};
use crate::model::scene::ATTACHED_COUNT;
use crate::model::thermal::GEARS;

/// Index of the heat of contact damping, which belongs to no effect.
pub const CONTACT_HEAT: usize = 0;

/// Attached bodies of all effects, in the order of their degrees of freedom.
pub const ATTACHED: [&Attached; ATTACHED_COUNT] = {
    let (mut all, mut count, mut i) = ([&Attached::NONE; ATTACHED_COUNT], 0, 0);
    while i < EFFECTS.len() {
        let mut k = 0;
        while k < EFFECTS[i].bodies.len() {
            all[count] = &EFFECTS[i].bodies[k];
            (count, k) = (count + 1, k + 1);
        }
        i += 1;
    }
    assert!(count == ATTACHED_COUNT, "ATTACHED_COUNT is the number of bodies that all effects declare");
    all
};

/// Index of the first body of an effect among all attached bodies.
pub fn body_index(effect: &EffectEntry) -> usize {
    EFFECTS.iter().take_while(|entry| entry.name != effect.name).map(|entry| entry.bodies.len()).sum()
}

/// Number of heats in the ledger: contact, then one for each heat output of the effects.
pub const HEATS: usize = {
    let (mut count, mut i) = (CONTACT_HEAT + 1, 0);
    while i < EFFECTS.len() {
        count += is_first(i) as usize;
        i += 1;
    }
    count
};

/// Number of readings of all effects that change at any instant.
pub const INSTANT_READINGS: usize = counted(false);
/// Number of readings of all effects that change with accepted steps.
pub const STEP_READINGS: usize = counted(true);

const fn counted(by_step: bool) -> usize {
    let (mut count, mut i) = (0, 0);
    while i < EFFECTS.len() {
        count += counted_of(i, by_step);
        i += 1;
    }
    count
}

/// Number of readings of effect `i` that change with accepted steps if `by_step` is true, or at any instant otherwise.
const fn counted_of(i: usize, by_step: bool) -> usize {
    let (mut count, mut j) = (0, 0);
    while j < EFFECTS[i].readings.len() {
        count += (matches!(EFFECTS[i].readings[j].changes, Changes::ByStep) == by_step) as usize;
        j += 1;
    }
    count
}

/// True if effect `i` is the first one that names its heat.
const fn is_first(i: usize) -> bool {
    let Some(heat) = EFFECTS[i].heat else { return false };
    let mut j = 0;
    while j < i {
        if let Some(before) = EFFECTS[j].heat
            && is_same(before.output, heat.output)
        {
            return false;
        }
        j += 1;
    }
    true
}

const fn is_same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

/// Heats of the ledger, in its order.
pub const ALL_HEATS: [Heat; HEATS] = {
    let contact = Heat {
        output: "heat.contact",
        description: "Heat of contact damping since the start",
        warms: Warmed::Node(GEARS),
    };
    let (mut heats, mut index, mut i) = ([contact; HEATS], CONTACT_HEAT, 0);
    while i < EFFECTS.len() {
        if is_first(i)
            && let Some(heat) = EFFECTS[i].heat
        {
            index += 1;
            heats[index] = heat;
        }
        i += 1;
    }
    heats
};

/// Index of a heat in the ledger. Without a heat, it is the index of the contact heat.
pub fn heat_index(heat: Option<Heat>) -> usize {
    let is_its = |other: &Heat| heat.is_some_and(|heat| heat.output == other.output);
    ALL_HEATS.iter().position(is_its).unwrap_or(CONTACT_HEAT)
}

/// Readings of all effects, in their order.
pub fn readings() -> impl Iterator<Item = &'static Reading> {
    EFFECTS.iter().flat_map(|effect| effect.readings)
}

/// Indices of the readings of the effect `name` among all readings with the same `changes`.
pub const fn indices_of(name: &str, changes: Changes) -> std::ops::Range<usize> {
    let (mut before, mut i) = (0, 0);
    while i < EFFECTS.len() {
        let count = counted_of(i, matches!(changes, Changes::ByStep));
        if is_same(EFFECTS[i].name, name) {
            return before..before + count;
        }
        before += count;
        i += 1;
    }
    before..before
}
