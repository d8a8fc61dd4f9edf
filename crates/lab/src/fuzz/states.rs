//! Calls that save and restore states. States and serialised states are passed between instances.

use std::ptr;

use bevel_differential::instance::{FmuState, Status};
use bevel_differential::variables::fnv1a;

use super::arguments::CallResult;
use super::instance::serialised;
use super::site::Site;
use crate::random::Draws;

/// Maximum number of saved states, and of serialised ones.
const HELD: usize = 12;
/// Length of the header of a serialised state, in bytes.
const HEADER: usize = 28;

/// Draws a state of any instance, or sometimes a null or invalid pointer.
fn a_state(s: &mut Site) -> (FmuState, Vec<u8>) {
    if s.held.states.is_empty() || s.r.chance(20) {
        s.flaws.any = true;
        return (if s.r.chance(2) { ptr::null_mut() } else { ptr::without_provenance_mut(1) }, Vec::new());
    }
    s.r.pick(&s.held.states)
}

/// Saves the state to a new pointer, or replaces a saved state.
pub fn get_state(s: &mut Site) -> CallResult {
    let fresh = s.held.states.len() < HELD && (s.held.states.is_empty() || s.r.chance(2));
    let mut made = ptr::null_mut();
    let at = s.r.below(s.held.states.len());
    let place = if fresh { &raw mut made } else { &raw mut s.held.states[at].0 };
    let place = s.place(place, true);
    // SAFETY: a live component and a place for a state
    let mut outcome = s.result(unsafe { (s.interface.get_state)(s.c, place) });
    if outcome.status == Status::Ok {
        let state = if fresh { made } else { s.held.states[at].0 };
        match serialised(s.interface, s.c, state) {
            None => outcome.broken = Some("a state was made that cannot be serialised".into()),
            Some(bytes) if fresh => s.held.states.push((state, bytes)),
            Some(bytes) => s.held.states[at].1 = bytes,
        }
        if let Some((_, bytes)) = s.held.states.get(at).filter(|_| s.held.blobs.len() < HELD) {
            s.held.blobs.push(bytes.clone());
        }
    }
    outcome
}

/// Restores a state.
pub fn set_state(s: &mut Site) -> CallResult {
    let (state, bytes) = a_state(s);
    // SAFETY: a live component, and a live state or one that the library checks for
    let mut outcome = s.result(unsafe { (s.interface.set_state)(s.c, state) });
    outcome.restored = (outcome.status == Status::Ok).then_some(bytes);
    outcome
}

/// Frees a state or a null state.
pub fn free_state(s: &mut Site) -> CallResult {
    if s.r.chance(4) || s.held.states.len() < HELD / 2 {
        let mut nothing = ptr::null_mut();
        let place = if s.r.chance(2) { ptr::null_mut() } else { &raw mut nothing };
        // SAFETY: a live component, and NULL or a pointer to a null state
        return s.result(unsafe { (s.interface.free_state)(s.c, place) });
    }
    let at = s.r.below(s.held.states.len());
    // SAFETY: a live component and a live state
    let status = unsafe { (s.interface.free_state)(s.c, &mut s.held.states[at].0) };
    let mut outcome = s.result(status);
    if status == Status::Ok {
        let (state, _) = s.held.states.swap_remove(at);
        outcome = outcome.unless(!state.is_null(), "the pointer was not cleared");
    }
    outcome
}

/// Requests the size of a serialised state.
pub fn state_size(s: &mut Site) -> CallResult {
    let (state, bytes) = a_state(s);
    let mut size = 0;
    let place = s.place(&raw mut size, true);
    // SAFETY: a live component, a live state or one that the library must refuse, and room for the size
    let outcome = s.result(unsafe { (s.interface.state_size)(s.c, state, place) });
    outcome.unless(size != bytes.len(), "another size than before")
}

/// Serialises a state.
pub fn serialize(s: &mut Site) -> CallResult {
    let (state, bytes) = a_state(s);
    let mut room = vec![0u8; bytes.len() + 8];
    let size = if s.r.chance(6) { s.r.below(room.len() + 1) } else { bytes.len() };
    s.flaws.any |= size != bytes.len();
    let place = s.place(room.as_mut_ptr(), true);
    // SAFETY: a live component, a live state or one that the library must refuse, and room for the bytes
    let outcome = s.result(unsafe { (s.interface.serialize)(s.c, state, place, size) });
    outcome.unless(room[..size] != bytes, "other bytes than before")
}

/// Damage to a serialised state.
enum Damage {
    None,
    /// A flipped bit, a cut end or an added byte: must be refused.
    Plain,
    /// Flipped bits of the payload with a matching checksum: may be refused; if accepted, the state must work.
    Covered,
}

/// Creates a state from bytes, damaged or not.
pub fn deserialize(s: &mut Site) -> CallResult {
    let mut blob = if s.held.blobs.is_empty() { Vec::new() } else { s.r.pick(&s.held.blobs) };
    let damage = match s.r.below(4) {
        _ if blob.is_empty() => Damage::Plain,
        0 => Damage::None,
        1 => Damage::Plain,
        _ => Damage::Covered,
    };
    match damage {
        Damage::None => {}
        Damage::Plain => match s.r.below(3) {
            0 => blob.truncate(s.r.below(blob.len())),
            1 => blob.push(s.r.u8(..)),
            _ if blob.is_empty() => {}
            _ => {
                let at = s.r.below(blob.len());
                blob[at] ^= 1 << s.r.below(8);
            }
        },
        Damage::Covered => {
            let end = blob.len() - size_of::<u64>();
            for _ in 0..=s.r.below(3) {
                let at = HEADER + s.r.below(end - HEADER);
                blob[at] ^= s.r.u8(..);
            }
            let sum = fnv1a(blob[..end].iter().copied());
            blob[end..].copy_from_slice(&sum.to_le_bytes());
        }
    }
    s.flaws.any |= matches!(damage, Damage::Plain);
    let full = s.held.states.len() >= HELD;
    let at = s.r.below(s.held.states.len());
    let mut made = ptr::null_mut();
    let place = if full { &raw mut s.held.states[at].0 } else { &raw mut made };
    let (place, bytes) = (s.place(place, true), s.read(blob.as_ptr(), true));
    // SAFETY: a live component, the bytes passed, and room for a state
    let mut outcome = s.result(unsafe { (s.interface.deserialize)(s.c, bytes, blob.len(), place) });
    if outcome.status == Status::Ok {
        let state = if full { s.held.states[at].0 } else { made };
        let again = serialised(s.interface, s.c, state);
        let is_changed = matches!(damage, Damage::None) && again.as_ref() != Some(&blob);
        outcome = outcome.unless(is_changed, "the state that was read is written with other bytes");
        let entry = (state, again.unwrap_or_default());
        if full { s.held.states[at] = entry } else { s.held.states.push(entry) }
    }
    outcome
}
