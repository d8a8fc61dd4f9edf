//! Checked access to the host's memory: NULL, alignment, length.
//!
//! The host promises that a pointer that is not NULL points to what FMI specifies, for as long as the call lasts.
//! Arrays of one call may overlap, for example if a host passes one buffer as `dvKnown` and `dvUnknown`. They are
//! therefore read and written through cells, element by element, and no reference to an element is ever created.

use std::cell::Cell;
use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::slice;

use super::{CallError, CallResult, Text};

/// The host's memory during one call. Everything borrowed from it ends with the call.
pub struct HostMemory(());

/// An array of the host that is read.
#[derive(Clone, Copy)]
pub struct InputArray<'a, T>(&'a [Cell<T>]);

/// An array of the host that is written.
#[derive(Clone, Copy)]
pub struct OutputArray<'a, T>(&'a [Cell<MaybeUninit<T>>]);

/// A single value of the host that is written.
#[derive(Clone, Copy)]
pub struct Output<'a, T>(&'a Cell<MaybeUninit<T>>);

impl<'a, T: Copy> InputArray<'a, T> {
    /// Returns the elements, read one by one.
    pub fn iter(self) -> impl ExactSizeIterator<Item = T> + Clone + 'a {
        self.0.iter().map(Cell::get)
    }

    /// Returns a copy of the whole array, if it has `N` elements.
    pub fn copied<const N: usize>(self) -> Option<[T; N]> {
        let cells: &[Cell<T>; N] = self.0.try_into().ok()?;
        Some(std::array::from_fn(|i| cells[i].get()))
    }

    /// Number of elements.
    pub(crate) fn len(self) -> usize {
        self.0.len()
    }
}

impl<'a, T> OutputArray<'a, T> {
    /// Returns the elements.
    pub fn iter(self) -> impl ExactSizeIterator<Item = Output<'a, T>> {
        self.0.iter().map(Output)
    }

    /// Number of elements.
    pub(crate) fn len(self) -> usize {
        self.0.len()
    }
}

impl<T> OutputArray<'_, T> {
    /// Writes the value of each key, in order. Stops at the first error.
    pub fn write_each<K: Copy>(self, keys: InputArray<K>, mut value: impl FnMut(K) -> CallResult<T>) -> CallResult {
        for (key, slot) in keys.iter().zip(self.iter()) {
            slot.write(value(key)?);
        }
        Ok(())
    }
}

impl<'a, T> Output<'a, T> {
    /// Wraps a value of this library.
    pub fn of(cell: &'a Cell<T>) -> Self {
        // SAFETY: a cell has the layout of its content, and only valid values are written
        Self(unsafe { &*std::ptr::from_ref(cell).cast() })
    }

    /// Writes the value.
    pub fn write(self, value: T) {
        self.0.set(MaybeUninit::new(value));
    }
}

impl HostMemory {
    /// Memory for one call. The caller drops it when the call ends.
    pub(super) fn of_call() -> Self {
        Self(())
    }

    /// Returns an array to read; `pointer` may be NULL if `count` is 0.
    ///
    /// # Safety
    /// If not NULL, `pointer` points to `count` values, and no other thread writes to them during the call.
    pub unsafe fn input<'a, T>(&'a self, name: &str, pointer: *const T, count: usize) -> CallResult<InputArray<'a, T>> {
        // SAFETY: the caller's promise; a cell has the layout of its content, and nothing is written through these
        // cells
        unsafe { self.elements(name, pointer.cast::<Cell<T>>(), count) }.map(InputArray)
    }

    /// Returns an array to write; `pointer` may be NULL if `count` is 0.
    ///
    /// # Safety
    /// If not NULL, `pointer` points to space for `count` values that no other thread uses during the call.
    pub unsafe fn output<'a, T>(&'a self, name: &str, pointer: *mut T, count: usize) -> CallResult<OutputArray<'a, T>> {
        // SAFETY: the caller's promise; contents may be uninitialised
        unsafe { self.elements(name, pointer.cast::<Cell<MaybeUninit<T>>>(), count) }.map(OutputArray)
    }

    /// Returns a single value to write.
    ///
    /// # Safety
    /// If not NULL, `pointer` points to space for a value that no other thread uses during the call.
    pub unsafe fn output_value<'a, T>(&'a self, name: &str, pointer: *mut T) -> CallResult<Output<'a, T>> {
        check(name, pointer, 1)?;
        // SAFETY: not NULL and aligned; the rest is the caller's promise; the content may be uninitialised
        Ok(Output(unsafe { &*pointer.cast() }))
    }

    /// Returns a single value to read and write.
    ///
    /// # Safety
    /// If not NULL, `pointer` points to a value that no other thread uses during the call.
    pub unsafe fn value<'a, T>(&'a self, name: &str, pointer: *mut T) -> CallResult<&'a Cell<T>> {
        check(name, pointer, 1)?;
        // SAFETY: not NULL and aligned; the rest is the caller's promise
        Ok(unsafe { &*pointer.cast() })
    }

    /// Returns bytes to read, which must not be written to while the slice is in use.
    ///
    /// # Safety
    /// If not NULL, `pointer` points to `count` bytes, and no other thread writes to them during the call.
    pub unsafe fn bytes<'a>(&'a self, name: &str, pointer: *const u8, count: usize) -> CallResult<&'a [u8]> {
        // SAFETY: the caller's promise
        unsafe { self.elements(name, pointer, count) }
    }

    /// Returns a string, or `None` for NULL.
    ///
    /// # Safety
    /// If not NULL, `text` ends with NUL and does not change during the call.
    pub unsafe fn string(&self, text: Text) -> Option<&CStr> {
        // SAFETY: not NULL; the rest is the caller's promise
        (!text.is_null()).then(|| unsafe { CStr::from_ptr(text) })
    }

    unsafe fn elements<'a, T>(&'a self, name: &str, pointer: *const T, count: usize) -> CallResult<&'a [T]> {
        if count == 0 {
            return Ok(&[]);
        }
        check(name, pointer, count)?;
        // SAFETY: not NULL, aligned, not too long; the rest is the caller's promise
        Ok(unsafe { slice::from_raw_parts(pointer, count) })
    }
}

/// Refuses a pointer that cannot point to `count` values.
fn check<T>(name: &str, pointer: *const T, count: usize) -> CallResult {
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(CallError::error(format!("{name} is NULL or misaligned, but {count} elements are announced")));
    }
    if count > isize::MAX as usize / size_of::<T>().max(1) {
        return Err(CallError::error(format!("{name}: {count} elements are more than memory can hold")));
    }
    Ok(())
}
