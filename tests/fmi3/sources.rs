//! Test that all exports use the function that catches panics.

use std::fs;
use std::path::Path;

/// Allowed entries of an export: three that catch panics, and a constant that cannot panic. Steps enter by `part`.
const ENTRIES: [&str; 5] = ["call!(c, ", " catch(", "{ free(c) }", "c\"3.0\"", "part(c, "];

#[test]
fn every_export_catches_panics() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/fmi3/exports");
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/instance/exports.rs");
    let own = fs::read_dir(folder).expect("the exports").map(|file| file.expect("a file").path());
    let mut seen = 0;
    for file in own.chain([shared]) {
        let text = fs::read_to_string(file).expect("a source");
        for export in text.split("#[unsafe(no_mangle)]").skip(1) {
            let signature = export.lines().nth(1).unwrap_or_default();
            assert!(export.trim_start().starts_with("pub ") && export.contains("extern \"C\" fn"), "{signature}");
            assert!(ENTRIES.iter().any(|entry| export.contains(entry)), "{signature}");
            seen += 1;
        }
    }
    assert!(seen > 30, "{seen}");
}
