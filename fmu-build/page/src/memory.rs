//! Memory in which the page passes values.

/// Allocates `bytes`, aligned for all numbers. [`page_free`] must free it with the same size.
#[unsafe(no_mangle)]
pub extern "C" fn page_allocate(bytes: usize) -> *mut u64 {
    Box::into_raw(vec![0u64; words(bytes)].into_boxed_slice()).cast()
}

/// Frees memory of `bytes` from [`page_allocate`].
///
/// # Safety
/// `place` is from [`page_allocate`] with the same `bytes`, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn page_free(place: *mut u64, bytes: usize) {
    let slice = std::ptr::slice_from_raw_parts_mut(place, words(bytes));
    // SAFETY: guaranteed by the caller
    drop(unsafe { Box::from_raw(slice) });
}

fn words(bytes: usize) -> usize {
    bytes.div_ceil(size_of::<u64>())
}
