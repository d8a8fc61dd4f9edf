//! Memory that the page passes values in.

/// Room for `bytes`, aligned for all numbers. It is given back by [`page_free`] with the same number.
#[unsafe(no_mangle)]
pub extern "C" fn page_allocate(bytes: usize) -> *mut u64 {
    Box::into_raw(vec![0u64; words(bytes)].into_boxed_slice()).cast()
}

/// Gives back what [`page_allocate`] gave for `bytes`.
///
/// # Safety
/// `place` is from [`page_allocate`] with these `bytes`, and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn page_free(place: *mut u64, bytes: usize) {
    let slice = std::ptr::slice_from_raw_parts_mut(place, words(bytes));
    // SAFETY: the caller's promise
    drop(unsafe { Box::from_raw(slice) });
}

fn words(bytes: usize) -> usize {
    bytes.div_ceil(size_of::<u64>())
}
