//! Files that the command makes.

/// A file to be written.
pub struct Made {
    /// Its name within the folder.
    pub name: String,
    /// What stands in it.
    pub content: Vec<u8>,
}

impl Made {
    /// A file of text.
    pub fn text(name: impl Into<String>, content: String) -> Self {
        Self { name: name.into(), content: content.into_bytes() }
    }
}
