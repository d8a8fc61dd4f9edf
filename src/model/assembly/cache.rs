//! A cache of values. The key of a value is the exact bits of everything that it is calculated from.
//!
//! A cache has few places; the least recently used value is replaced. Several threads may share it: one makes a value,
//! the others wait for it.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use serde::Serialize;

use crate::FULL;

/// Places of a cache.
pub const PLACES: usize = 16;
/// The same where memory is little.
const FEW: usize = 2;
/// Bytes that most keys fit in.
const USUAL: usize = 1024;

/// A value, once it is made, and its key: the bits of everything that it is calculated from.
struct Place<V> {
    key: Vec<u8>,
    value: Arc<OnceLock<V>>,
}

/// A cache of values, the last used first.
pub struct Cache<V> {
    places: Mutex<Vec<Place<V>>>,
}

impl<V> Default for Cache<V> {
    fn default() -> Self {
        Self { places: Mutex::default() }
    }
}

impl<V> fmt::Debug for Cache<V> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Cache").field("filled", &self.places().len()).finish()
    }
}

impl<V> Cache<V> {
    /// The places. They are whole even if a thread panicked while it held the lock.
    fn places(&self) -> MutexGuard<'_, Vec<Place<V>>> {
        self.places.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The place of the key `key`, which becomes the first.
    fn place(&self, key: Vec<u8>) -> Arc<OnceLock<V>> {
        let mut places = self.places();
        if let Some(found) = places.iter().position(|place| place.key == key) {
            places[..=found].rotate_right(1);
        } else {
            places.truncate(if FULL { PLACES } else { FEW } - 1);
            places.insert(0, Place { key, value: Arc::default() });
        }
        places[0].value.clone()
    }
}

impl<V: Clone> Cache<V> {
    /// The value of the key `key`; `make` makes it if the cache does not hold it.
    pub fn get(&self, key: &impl Serialize, make: impl FnOnce() -> V) -> V {
        match postcard::to_extend(key, Vec::with_capacity(USUAL)) {
            Ok(key) => self.place(key).get_or_init(make).clone(),
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
    fn a_value_is_made_once_for_the_same_bits_and_anew_for_others() {
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
    fn the_value_not_asked_for_the_longest_makes_way() {
        let (cache, value) = (Cache::default(), Arc::new(()));
        let get = |n: usize| {
            let made = Cell::new(false);
            cache.get(&n, || {
                made.set(true);
                value.clone()
            });
            made.get()
        };
        assert!((0..PLACES).all(get));
        assert!((0..PLACES).all(|n| !get(n)));
        // asked for again, 0 stays, and 1 goes
        assert!(!get(0) && get(PLACES) && !get(0) && get(1));
        assert!((100..1000).all(get));
        assert_eq!((cache.places().len(), Arc::strong_count(&value)), (PLACES, PLACES + 1));
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
            let _held = cache.places();
            panic!("with the places in hand");
        }));
        assert!(poisoned.is_err() && cache.places.is_poisoned());
        assert_eq!([cache.get(&1, || 5), cache.get(&1, || 6)], [5, 5]);
    }
}
