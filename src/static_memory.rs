//! Memory for tables that the first instance builds and that exist as long as the library.
//!
//! The memory is part of the library's own data, so it goes when the host unloads the library. Values on the heap would
//! stay: some hosts load and unload the library for each simulation, and each time would leave the tables behind.
//! Values are `Copy`, so they own nothing on the heap. Nothing is ever freed individually.

use std::alloc::Layout;
use std::cell::UnsafeCell;
use std::mem::MaybeUninit;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Size of the memory [bytes]. Tables of both interfaces take half of it. The system provides only pages that are used.
/// WebAssembly cannot be unloaded, so its values are on the heap.
const SIZE: usize = if cfg!(target_family = "wasm") { 0 } else { 512 * 1024 };

/// Bytes, each handed out once.
#[repr(C, align(64))]
struct Memory(UnsafeCell<[MaybeUninit<u8>; SIZE]>);

// SAFETY: `reserve` hands out each byte to only one caller
#[allow(unsafe_code)]
unsafe impl Sync for Memory {}

static MEMORY: Memory = Memory(UnsafeCell::new([MaybeUninit::uninit(); SIZE]));
/// Number of bytes that are handed out.
static USED: AtomicUsize = AtomicUsize::new(0);

/// Stores `value` as long as the library exists.
pub fn store<T: Copy + Send + Sync>(value: T) -> &'static T {
    &store_all(&[value])[0]
}

/// Stores `text` as long as the library exists.
pub fn store_text(text: &str) -> &'static str {
    std::str::from_utf8(store_all(text.as_bytes())).unwrap_or_default()
}

/// Stores `values` as long as the library exists. If the memory is full, they are leaked on the heap.
pub fn store_all<T: Copy + Send + Sync>(values: &[T]) -> &'static [T] {
    let Some(start) = reserve(Layout::for_value(values)) else { return values.to_vec().leak() };
    let target = MEMORY.0.get().cast::<u8>().wrapping_add(start).cast::<T>();
    // SAFETY: the bytes from `start` on are inside the memory, aligned, large enough, and handed out only here
    #[allow(unsafe_code)]
    unsafe {
        target.copy_from_nonoverlapping(values.as_ptr(), values.len());
        std::slice::from_raw_parts(target, values.len())
    }
}

/// Reserves bytes for `layout`. Returns the index of the first one, or `None` if the memory is full.
fn reserve(layout: Layout) -> Option<usize> {
    if layout.align() > align_of::<Memory>() {
        return None;
    }
    let start = |used: usize| used.next_multiple_of(layout.align());
    let end = |used: usize| start(used).checked_add(layout.size()).filter(|&end| end <= SIZE);
    USED.fetch_update(Ordering::Relaxed, Ordering::Relaxed, end).ok().map(start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_keep_their_bits_next_to_each_other_and_after_the_memory_is_full() {
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[repr(align(32))]
        struct Wide(u8);
        let own = |k: usize| (store(k as u8), store(k as f64), store(Wide(k as u8)), store_text(&k.to_string()));
        let stored: Vec<_> = (0..20_000).map(own).collect();
        assert!(reserve(Layout::new::<[u8; SIZE]>()).is_none() && USED.load(Ordering::Relaxed) <= SIZE);
        for (k, (byte, number, wide, text)) in stored.into_iter().enumerate() {
            assert_eq!((*byte, *number, *wide, text), (k as u8, k as f64, Wide(k as u8), &*k.to_string()));
            assert!(std::ptr::from_ref(wide).is_aligned());
        }
        assert_eq!((store_all::<f64>(&[]), store(())), (&[][..], &()));
    }
}
