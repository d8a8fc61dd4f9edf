//! Heats and readings of the effects, and their positions in the ledger.

use crate::model::effect_kinds::{Changes, Heat, Reading};
use crate::model::effects::EFFECTS;

/// Index of the heat of contact damping, which belongs to no effect.
pub const CONTACT_HEAT: usize = 0;

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

/// Heats of the effects, in the order of the ledger.
pub fn heats() -> impl Iterator<Item = Heat> {
    (0..EFFECTS.len()).filter(|&i| is_first(i)).filter_map(|i| EFFECTS[i].heat)
}

/// Names of the outputs of all heats of the ledger.
pub const HEAT_OUTPUTS: [&str; HEATS] = {
    let (mut outputs, mut place, mut i) = (["heat.contact"; HEATS], CONTACT_HEAT, 0);
    while i < EFFECTS.len() {
        if is_first(i)
            && let Some(heat) = EFFECTS[i].heat
        {
            place += 1;
            outputs[place] = heat.output;
        }
        i += 1;
    }
    outputs
};

/// Index of a heat in the ledger. Without a heat, it is the index of the contact heat.
pub fn heat_index(heat: Option<Heat>) -> usize {
    let place = heat.and_then(|heat| heats().position(|other| other.output == heat.output));
    place.map_or(CONTACT_HEAT, |place| CONTACT_HEAT + 1 + place)
}

/// True for each heat of the ledger that arises within the differential, not at the wheels.
pub const HEATS_WITHIN: [bool; HEATS] = {
    let (mut within, mut place, mut i) = ([true; HEATS], CONTACT_HEAT, 0);
    while i < EFFECTS.len() {
        if is_first(i)
            && let Some(heat) = EFFECTS[i].heat
        {
            place += 1;
            within[place] = !heat.at_wheels;
        }
        i += 1;
    }
    within
};

/// Readings of all effects, in their order.
pub fn readings() -> impl Iterator<Item = &'static Reading> {
    EFFECTS.iter().flat_map(|effect| effect.readings)
}

/// Indices of the readings of the effect `name` among all readings with the same `changes`.
pub const fn places_of(name: &str, changes: Changes) -> std::ops::Range<usize> {
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
