//! Paths of input files in a scene that is written to another folder.

use std::path::{Path, absolute};

use anyhow::{Context, Result};
use toml_edit::{DocumentMut, Item, TableLike, Value, value};

/// The text of the scene in `from`, with paths that lead to the same files from where `to` is.
pub fn moved(text: String, from: &Path, to: &Path) -> Result<String> {
    let mut document: DocumentMut = text.parse().context("the scene's file")?;
    let Some(inputs) = document.get_mut("inputs") else { return Ok(text) };
    let folder = |file: &Path| absolute(file).map(|file| file.parent().unwrap_or(&file).to_path_buf());
    let (old, new) = (folder(from)?, folder(to)?);
    let tables: Vec<&mut dyn TableLike> = match inputs {
        Item::ArrayOfTables(tables) => tables.iter_mut().map(|table| table as _).collect(),
        Item::Value(Value::Array(values)) => {
            values.iter_mut().filter_map(Value::as_inline_table_mut).map(|table| table as _).collect()
        }
        _ => Vec::new(),
    };
    for table in tables {
        let Some(file) = table.get("file").and_then(|file| file.as_str()) else { continue };
        let file = old.join(file);
        // there is no way from one drive of Windows to another
        let path = pathdiff::diff_paths(&file, &new).unwrap_or(file);
        table.insert("file", value(path.to_string_lossy().replace('\\', "/")));
    }
    Ok(document.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_scene_finds_the_same_files() -> Result<()> {
        let [from, to] = [Path::new("scenes").join("a.toml"), Path::new("scenes").join("reduced").join("a.toml")];
        for text in ["[[inputs]]\nfile = \"data/cycle.csv\"\n", "inputs = [{ file = \"data/cycle.csv\" }]\n"] {
            let written = moved(text.into(), &from, &to)?;
            assert!(written.contains("\"../data/cycle.csv\""), "{written}");
        }
        assert_eq!(moved("step = 1 # a\n".into(), &from, &to)?, "step = 1 # a\n");
        Ok(())
    }
}
