//! Every study shown in the book and in the README is one that the reader takes without a word.
//!
//! A block of TOML with `schema = 1` is a study; one without is a part of a study, read as if it
//! stood at the end of the study before it. A first line `# file: NAME` names a file of the page,
//! study or table, which the studies of the page may read.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_study::load_study;
use std::fs;
use std::path::{Path, PathBuf};

/// A block of code of a page.
struct Block {
    language: String,
    line: usize,
    text: String,
}

fn blocks(page: &str) -> Vec<Block> {
    let mut found: Vec<Block> = Vec::new();
    let mut is_inside = false;
    for (index, line) in page.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if is_inside => is_inside = false,
            Some(language) => {
                is_inside = true;
                found.push(Block {
                    language: language.trim().to_owned(),
                    line: index + 1,
                    text: String::new(),
                });
            }
            None if is_inside => {
                let block = found.last_mut().unwrap();
                block.text.push_str(line);
                block.text.push('\n');
            }
            None => {}
        }
    }
    assert!(!is_inside, "a block of code is not closed");
    found
}

impl Block {
    /// The file that the first line names.
    fn file_name(&self) -> Option<&str> {
        self.text.lines().next()?.strip_prefix("# file: ")
    }

    fn is_study(&self) -> bool {
        self.text.lines().any(|line| line == "schema = 1")
    }
}

fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut pages: Vec<PathBuf> = fs::read_dir(root.join("book/src"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|kind| kind == "md"))
        .collect();
    pages.push(root.join("README.md"));
    pages
}

/// Checks the studies of a page; returns how many there are, parts included.
fn check_page(page: &Path) -> usize {
    let blocks = blocks(&fs::read_to_string(page).unwrap());
    let directory = tempfile::tempdir().unwrap();
    for block in &blocks {
        if let Some(name) = block.file_name() {
            fs::write(directory.path().join(name), &block.text).unwrap();
        }
    }
    let mut before = None;
    let mut checked = 0;
    for block in blocks.iter().filter(|block| block.language == "toml") {
        let place = format!("{}:{}", page.display(), block.line);
        let text = if block.is_study() {
            before = Some(&block.text);
            block.text.clone()
        } else {
            let study = before.unwrap_or_else(|| panic!("{place}: a part of no study"));
            format!("{study}\n{}", block.text)
        };
        let file = directory.path().join("study.toml");
        fs::write(&file, &text).unwrap();
        let study = load_study(&file).unwrap_or_else(|errors| panic!("{place}:\n{errors}"));
        assert!(study.warnings.is_empty(), "{place}: {:?}", study.warnings);
        checked += 1;
    }
    checked
}

#[test]
fn every_study_of_the_book_is_valid() {
    let checked: usize = pages().iter().map(|page| check_page(page)).sum();
    assert!(checked >= 10, "{checked} studies found");
}
