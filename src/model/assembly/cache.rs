//! Cache of values. The key of a value is the exact bits of everything from which it is computed.
//!
//! A cache has few entries and replaces the least recently used one. Several threads may share it: one thread computes
//! a value, and the others wait for it.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use serde::Serialize;

use crate::FULL;

/// Number of entries of a cache.
pub const ENTRIES: usize = 16;
/// Number of entries in a build for little memory.
const FEW: usize = 2;
/// Number of bytes that is enough for most keys.
const USUAL: usize = 1024;

/// Value, once it is computed, with its key.
struct Entry<V> {
    key: Vec<u8>,
    value: Arc<OnceLock<V>>,
}

/// Cache of values, the most recently used first.
pub struct Cache<V> {
    entries: Mutex<Vec<Entry<V>>>,
}

impl<V> Default for Cache<V> {
    fn default() -> Self {
        Self { entries: Mutex::default() }
    }
}

impl<V> fmt::Debug for Cache<V> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Cache").field("filled", &self.entries().len()).finish()
    }
}

impl<V> Cache<V> {
    /// Entries of the cache. They are valid even if a thread panicked while it held the lock.
    fn entries(&self) -> MutexGuard<'_, Vec<Entry<V>>> {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the value of the entry with the key `key`, which becomes the first entry.
    fn entry(&self, key: Vec<u8>) -> Arc<OnceLock<V>> {
        let mut entries = self.entries();
        if let Some(found) = entries.iter().position(|entry| entry.key == key) {
            entries[..=found].rotate_right(1);
        } else {
            entries.truncate(if FULL { ENTRIES } else { FEW } - 1);
            entries.insert(0, Entry { key, value: Arc::default() });
        }
        entries[0].value.clone()
    }
}

impl<V: Clone> Cache<V> {
    /// Returns the value of the key `key`. If the cache does not contain it, `make` computes it. A value whose key
    /// cannot be serialised is computed each time.
    pub fn get(&self, key: &impl Serialize, make: impl FnOnce() -> V) -> V {
        match postcard::to_extend(key, Vec::with_capacity(USUAL)) {
            Ok(key) => self.entry(key).get_or_init(make).clone(),
            Err(_) => make(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::sync::Barrier;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn a_value_is_computed_once_for_the_same_bits_and_again_for_others() {
        let (cache, made) = (Cache::default(), Cell::new(0));
        let get = |x: f64, n: i32| {
            cache.get(&(x, n), || {
                made.set(made.get() + 1);
                made.get()
            })
        };
        assert_eq!([get(1.0, 2), get(1.0, 2)], [1, 1]);
        // the next number, the other zero, another integer
        assert_eq!([get(1.0f64.next_up(), 2), get(0.0, 2), get(-0.0, 2), get(1.0, -2)], [2, 3, 4, 5]);
        assert_eq!([get(-0.0, 2), get(1.0, 2), get(f64::NAN, 0), get(f64::NAN, 0)], [4, 1, 6, 6]);
    }

    #[test]
    fn the_least_recently_used_value_is_replaced() {
        let (cache, value) = (Cache::default(), Arc::new(()));
        let get = |n: usize| {
            let made = Cell::new(false);
            cache.get(&n, || {
                made.set(true);
                value.clone()
            });
            made.get()
        };
        assert!((0..ENTRIES).all(get));
        assert!((0..ENTRIES).all(|n| !get(n)));
        // 0 was requested again, so it stays, and 1 is replaced
        assert!(!get(0) && get(ENTRIES) && !get(0) && get(1));
        assert!((100..1000).all(get));
        assert_eq!((cache.entries().len(), Arc::strong_count(&value)), (ENTRIES, ENTRIES + 1));
        drop(cache);
        assert_eq!(Arc::strong_count(&value), 1);
    }

    #[test]
    fn threads_share_one_value() {
        let (cache, made, begin) = (Cache::default(), AtomicUsize::new(0), Barrier::new(8));
        let value = || Arc::new(made.fetch_add(1, Ordering::Relaxed));
        std::thread::scope(|scope| {
            let run = || {
                begin.wait();
                (0..100).map(|n| cache.get(&(n % 10), value)).collect::<Vec<_>>()
            };
            let threads: Vec<_> = (0..8).map(|_| scope.spawn(run)).collect();
            let seen: Vec<_> = threads.into_iter().map(|thread| thread.join().unwrap()).collect();
            assert!(seen.iter().flatten().zip(seen[0].iter().cycle()).all(|(a, b)| Arc::ptr_eq(a, b)));
        });
        assert_eq!(made.load(Ordering::Relaxed), 10);
    }

    #[test]
    fn a_panic_leaves_the_cache_usable() {
        let cache = Cache::default();
        assert!(catch_unwind(AssertUnwindSafe(|| cache.get(&1, || panic!("no value")))).is_err());
        let poisoned = catch_unwind(AssertUnwindSafe(|| {
            let _held = cache.entries();
            panic!("while holding the entries");
        }));
        assert!(poisoned.is_err() && cache.entries.is_poisoned());
        assert_eq!([cache.get(&1, || 5), cache.get(&1, || 6)], [5, 5]);
    }
}
