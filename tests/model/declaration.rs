//! A wrong line of `parameters!` is a compile error at this line.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Program that declares one parameter in lines 5 and 6.
fn program(doc: &str, line: &str) -> String {
    format!(
        "use bevel_differential::declaration::units::{{METRE, MM}};\n\
         bevel_differential::parameters! {{\n\
         /// Group of the test.\n\
         pub struct Spec in \"test\" {{\n\
         {doc}\n\
         {line}\n\
         }}\n\
         }}\n"
    )
}

/// Libraries in `folder` of the crate `name`, newest first. Their names may have a hash.
fn libraries(folder: &Path, name: &str) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "rlib"))
        .filter(|path| path.file_stem().and_then(|stem| stem.to_str()?.split('-').next()) == Some(name))
        .collect();
    found.sort_by_key(|path| std::cmp::Reverse(path.metadata().unwrap().modified().unwrap()));
    found
}

/// Compiles `program` with the libraries of this test program. Returns what the compiler says if it fails.
fn compile(name: &str, program: &str, [library, serde]: [&Path; 2]) -> Result<(), String> {
    let deps = library.parent().unwrap();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let source = folder.join(format!("{name}.rs"));
    std::fs::write(&source, program).unwrap();
    let output = Command::new(std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into()))
        .args(["--edition", "2024", "--crate-type", "lib", "--emit", "metadata", "--out-dir"])
        .arg(folder)
        .arg(format!("--extern=bevel_differential={}", library.display()))
        .arg(format!("--extern=serde={}", serde.display()))
        .arg(format!("-Ldependency={}", deps.display()))
        .arg(&source)
        .output()
        .unwrap();
    if output.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&output.stderr).into_owned()) }
}

const DOC: &str = "/// Length of the part";
const LINE: &str = "length: f64 = 0.1, METRE | MM, 1e-3..=1.0;";

#[test]
fn an_unknown_unit_a_wrong_type_and_a_missing_description_are_compile_errors_at_their_line() {
    let deps = std::env::current_exe().unwrap().parent().unwrap().to_owned();
    // builds with other features leave libraries of the same name, so the right one is the one with which a valid
    // program compiles
    let all = libraries(&deps, "libbevel_differential");
    let serde = libraries(&deps, "libserde");
    let pairs = all.iter().flat_map(|library| serde.iter().map(move |serde| [library.as_path(), serde.as_path()]));
    let mut said = String::new();
    let fits = |pair: &[&Path; 2]| compile("valid", &program(DOC, LINE), *pair).map_err(|text| said = text).is_ok();
    let pair = { pairs }.find(fits).unwrap_or_else(|| panic!("a valid program does not compile: {said}"));
    for (name, doc, line, expected) in [
        ("unit", DOC, LINE.replace("METRE", "FURLONG"), "cannot find value `FURLONG`"),
        ("type", DOC, LINE.replace("0.1", "true"), "mismatched types"),
        ("kind", DOC, LINE.replace("f64", "f32"), "`f32: Declared` is not satisfied"),
        ("doc", "", LINE.to_owned(), "no rules expected"),
    ] {
        let said = compile(name, &program(doc, &line), pair).expect_err(name);
        assert!(said.contains(expected), "{name}: {said}");
        assert!(said.contains(&format!("{name}.rs:6:")), "{name} at another line: {said}");
    }
}
