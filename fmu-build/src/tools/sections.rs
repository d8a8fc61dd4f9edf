//! Marked sections of documents, which commands update.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::tools::files::{copy_file, write_whole};
use crate::tools::lock::Lock;
use crate::tools::paths;

/// True if a document has `text` between the lines `marks`.
pub fn is_current(document: &str, marks: [&str; 2], text: &str) -> Result<bool> {
    let file = paths::workspace().join(document);
    let old = fs::read_to_string(&file).with_context(|| format!("{document} cannot be read"))?;
    Ok(replaced(&old, marks, text).is_some_and(|renewed| renewed == old))
}

/// Replaces the text between the two lines `marks` of `document`, a path in the workspace.
pub fn renew(document: &str, marks: [&str; 2], text: &str) -> Result<()> {
    // another run may update another section at the same time
    let _alone = Lock::of(&paths::target().join("documents"))?;
    let file = paths::workspace().join(document);
    let old = fs::read_to_string(&file).with_context(|| format!("{document} cannot be read"))?;
    let renewed = replaced(&old, marks, text).with_context(|| {
        format!("{document} has no marked section; add the lines \"{}\" and \"{}\"", marks[0], marks[1])
    })?;
    write_whole(&file, renewed.as_bytes())
}

/// Copies the pictures of `folder` to docs/figures.
pub fn copy_pictures(folder: &Path) -> Result<()> {
    let figures = paths::workspace().join("docs").join("figures");
    for entry in fs::read_dir(folder).with_context(|| format!("{} cannot be read", paths::shown(folder)))? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "png") {
            copy_file(&path, &figures)?;
        }
    }
    Ok(())
}

/// Replaces the text between the marks in `old`.
fn replaced(old: &str, marks: [&str; 2], text: &str) -> Option<String> {
    let (before, rest) = old.split_once(marks[0])?;
    let (_, after) = rest.split_once(marks[1])?;
    Some(format!("{before}{}\n{text}{}{after}", marks[0], marks[1]))
}

#[cfg(test)]
mod tests {
    use super::replaced;

    #[test]
    fn the_text_replaces_what_is_between_the_marks() {
        let marks = ["<!-- begin -->", "<!-- end -->"];
        let document = |text: &str| format!("a\n{}\n{text}\n{}\nb\n", marks[0], marks[1]);
        assert_eq!(replaced(&document("old"), marks, "new\n"), Some(document("new")));
        assert_eq!(replaced("no marks", marks, "new\n"), None);
    }
}
