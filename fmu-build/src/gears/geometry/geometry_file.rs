//! Files that the command makes.

/// A file to be written.
pub struct GeometryFile {
    /// Its name within the folder.
    pub name: String,
    /// What stands in it.
    pub content: Vec<u8>,
}

impl GeometryFile {
    /// A file of text.
    pub fn text(name: impl Into<String>, content: String) -> Self {
        Self { name: name.into(), content: content.into_bytes() }
    }
}
