//! An allocator that counts the allocations of each thread. A test program installs it with `#[global_allocator]`.
#![allow(dead_code)] // each test program uses only some items

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
    static ALLOCATED_BYTES: Cell<usize> = const { Cell::new(0) };
    static LIVE_BYTES: Cell<isize> = const { Cell::new(0) };
}

/// Number of allocations of this thread.
pub fn allocations() -> usize {
    ALLOCATIONS.get()
}

/// Number of bytes that this thread has allocated, whether freed or not.
pub fn allocated_bytes() -> usize {
    ALLOCATED_BYTES.get()
}

/// Number of bytes that this thread has allocated and not freed.
pub fn live_bytes() -> isize {
    LIVE_BYTES.get()
}

fn count(allocations: usize, bytes: isize) {
    ALLOCATIONS.set(ALLOCATIONS.get() + allocations);
    ALLOCATED_BYTES.set(ALLOCATED_BYTES.get() + usize::try_from(bytes).unwrap_or(0));
    LIVE_BYTES.set(LIVE_BYTES.get() + bytes);
}

/// The system's allocator, with counters.
pub struct CountingAllocator;

// SAFETY: passes every call to the system's allocator; counting does not allocate
unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(1, layout.size() as isize);
        // SAFETY: the caller's promise
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(0, -(layout.size() as isize));
        // SAFETY: the caller's promise
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(1, size as isize - layout.size() as isize);
        // SAFETY: the caller's promise
        unsafe { System.realloc(pointer, layout, size) }
    }
}
