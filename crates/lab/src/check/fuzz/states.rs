//! Calls that save and deserialise states. States and serialised states pass between instances.

use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::variables::fnv1a;

use super::arguments::{CallResult, Flaws};
use super::instance::serialised;
use super::random::Random;

/// Most states that are held at a time, and most blobs.
pub const HELD: usize = 12;

/// Saved states that any instance may be given.
#[derive(Default)]
pub struct HeldStates {
    /// States, each with its bytes.
    pub states: Vec<(FmuState, Vec<u8>)>,
    /// Serialised states.
    pub blobs: Vec<Vec<u8>>,
}

/// A state of any instance, or none.
pub fn a_state(r: &mut Random, f: &mut Flaws, held: &HeldStates) -> (FmuState, Vec<u8>) {
    if held.states.is_empty() || r.chance(20) {
        f.any = true;
        return (if r.chance(2) { ptr::null_mut() } else { ptr::without_provenance_mut(1) }, Vec::new());
    }
    held.states[r.below(held.states.len())].clone()
}

pub fn get_state(c: ComponentPointer, r: &mut Random, f: &mut Flaws, held: &mut HeldStates) -> CallResult {
    let fresh = held.states.len() < HELD && (held.states.is_empty() || r.chance(2));
    let mut made = ptr::null_mut();
    let at = r.below(held.states.len());
    let place = if fresh { &raw mut made } else { &raw mut held.states[at].0 };
    let place = f.place(r, place, true);
    // SAFETY: a live component and a place for a state
    let mut outcome = CallResult::of(unsafe { fmi2GetFMUstate(c, place) }, f);
    if outcome.status == Status::Ok {
        let state = if fresh { made } else { held.states[at].0 };
        match serialised(c, state) {
            None => outcome.broken = Some("a state was made that cannot be serialised".into()),
            Some(bytes) if fresh => held.states.push((state, bytes)),
            Some(bytes) => held.states[at].1 = bytes,
        }
        if let Some((_, bytes)) = held.states.get(at).filter(|_| held.blobs.len() < HELD) {
            held.blobs.push(bytes.clone());
        }
    }
    outcome
}

/// How a blob differs from what was serialised.
enum Damage {
    None,
    /// A bit flipped, the end cut off, or a byte added: must be refused.
    Plain,
    /// Bits of the payload flipped and the checksum made to fit: may be refused; if accepted, the state must work.
    Covered,
}

pub fn deserialize(c: ComponentPointer, r: &mut Random, f: &mut Flaws, held: &mut HeldStates) -> CallResult {
    let mut blob = if held.blobs.is_empty() { Vec::new() } else { r.pick_clone(&held.blobs) };
    let damage = match r.below(4) {
        _ if blob.is_empty() => Damage::Plain,
        0 => Damage::None,
        1 => Damage::Plain,
        _ => Damage::Covered,
    };
    match damage {
        Damage::None => {}
        Damage::Plain => match r.below(3) {
            0 => blob.truncate(r.below(blob.len())),
            1 => blob.push(r.bits() as u8),
            _ if blob.is_empty() => {}
            _ => {
                let at = r.below(blob.len());
                blob[at] ^= 1 << r.below(8);
            }
        },
        Damage::Covered => {
            let end = blob.len() - size_of::<u64>();
            for _ in 0..=r.below(3) {
                let at = HEADER + r.below(end - HEADER);
                blob[at] ^= r.bits() as u8;
            }
            let sum = fnv1a(blob[..end].iter().copied());
            blob[end..].copy_from_slice(&sum.to_le_bytes());
        }
    }
    f.any |= matches!(damage, Damage::Plain);
    let full = held.states.len() >= HELD;
    let at = r.below(held.states.len());
    let mut made = ptr::null_mut();
    let place = if full { &raw mut held.states[at].0 } else { &raw mut made };
    let place = f.place(r, place, true);
    let bytes = f.pointer(r, blob.as_ptr(), true);
    // SAFETY: a live component, the bytes passed, and a place for a state
    let mut outcome = CallResult::of(unsafe { fmi2DeSerializeFMUstate(c, bytes.cast(), blob.len(), place) }, f);
    if outcome.status == Status::Ok {
        let state = if full { held.states[at].0 } else { made };
        let again = serialised(c, state);
        if matches!(damage, Damage::None) && again.as_ref() != Some(&blob) {
            outcome.broken = Some("the state that was read is written with other bytes".into());
        }
        let entry = (state, again.unwrap_or_default());
        if full { held.states[at] = entry } else { held.states.push(entry) }
    }
    outcome
}

/// Bytes before the payload of a serialised state.
const HEADER: usize = 28;
