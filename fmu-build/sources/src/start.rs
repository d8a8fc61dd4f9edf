//! How an instance begins.

use crate::{messages, reason, room};

/// Makes room and keeps reasons: the first call of all.
#[unsafe(no_mangle)]
pub extern "C" fn source_start() {
    reason::keep();
    room::make();
    messages::make();
}
