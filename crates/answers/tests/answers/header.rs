//! The C header is generated from the source.

use std::fs;

use cbindgen::{Builder, Config, Language};

use crate::workspace;

/// Path of the header.
fn file() -> std::path::PathBuf {
    workspace().join("crates").join("answers").join("include").join("bd_answers.h")
}

#[test]
fn the_header_matches_the_source() {
    let config = Config {
        language: Language::C,
        header: Some(
            "/* Questions to the library of answers. Made from crates/answers/src/ask/c.rs and crates/schedule/src/c.rs; do not edit. */".into(),
        ),
        include_guard: Some("BD_ANSWERS_H".into()),
        cpp_compat: true,
        documentation: true,
        usize_is_size_t: true,
        ..Config::default()
    };
    let crates = workspace().join("crates");
    let made = Builder::new()
        .with_config(config)
        .with_src(crates.join("answers").join("src").join("ask").join("c.rs"))
        .with_src(crates.join("schedule").join("src").join("c.rs"))
        .generate()
        .expect("a header");
    let mut text = Vec::new();
    made.write(&mut text);
    let text = String::from_utf8(text).expect("UTF-8");
    if std::env::var_os("RENEW").is_some() {
        fs::create_dir_all(file().parent().expect("a folder"))
            .and_then(|()| fs::write(file(), &text))
            .expect("written");
    }
    let kept = fs::read_to_string(file()).unwrap_or_default().replace("\r\n", "\n");
    assert!(kept == text, "renew it: RENEW=1 cargo test --release -p answers header");
}
