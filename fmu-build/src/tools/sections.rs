//! Marked sections of documents, which commands renew.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::tools::paths;

/// Whether a document has `text` between the lines `marks`.
pub fn is_current(document: &str, marks: [&str; 2], text: &str) -> Result<bool> {
    let file = paths::workspace().join(document);
    let old = fs::read_to_string(&file).with_context(|| format!("{document} cannot be read"))?;
    Ok(replaced(&old, marks, text).is_some_and(|renewed| renewed == old))
}

/// Puts `text` between the two lines `marks` of `document`, a path in the workspace.
pub fn renew(document: &str, marks: [&str; 2], text: &str) -> Result<()> {
    let file = paths::workspace().join(document);
    let old = fs::read_to_string(&file).with_context(|| format!("{document} cannot be read"))?;
    let renewed = replaced(&old, marks, text).with_context(|| {
        format!("{document} has no marked section; add the lines \"{}\" and \"{}\"", marks[0], marks[1])
    })?;
    fs::write(&file, renewed).with_context(|| format!("{document} cannot be written"))
}

/// Copies the pictures of `folder` to docs/figures.
pub fn copy_pictures(folder: &Path) -> Result<()> {
    let figures = paths::workspace().join("docs").join("figures");
    paths::create_folder(&figures)?;
    for entry in fs::read_dir(folder).with_context(|| format!("{} cannot be read", paths::shown(folder)))? {
        let path = entry?.path();
        if let (Some("png"), Some(name)) = (path.extension().and_then(|e| e.to_str()), path.file_name()) {
            fs::copy(&path, figures.join(name)).with_context(|| format!("{} cannot be copied", paths::shown(&path)))?;
        }
    }
    Ok(())
}

/// `old` with `text` between the marks.
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
