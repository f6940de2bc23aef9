//! The guides do what they say: their files are written and their commands are run in a folder of
//! their own, and what they show of the output is in it.
//!
//! | block | what is done with it |
//! |---|---|
//! | ` ```ron file=nod.ron ` | written as that file |
//! | ` ```toml ` without a file | nothing: for a crate of the reader's own |
//! | ` ```rust file=examples/embed.rs ` | must be that file of the repository, which cargo compiles |
//! | ` ```sh ` | run, a command after the other; `# exits 1` before a command is its exit code |
//! | ` ```text ` after it | an excerpt: its lines are lines of the output, in this order; `…` stands for anything |
//!
//! `cargo run --example NAME` runs that example as it is built; `$APLOMB` is the repository.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::Command;

/// The guides, each with a test below.
const GUIDES: [&str; 6] = [
    "anticipation.md",
    "character.md",
    "controller-in-rust.md",
    "first-skill.md",
    "precondition.md",
    "scenario.md",
];

#[test]
fn first_skill() {
    follow("first-skill.md");
}

#[test]
fn controller_in_rust() {
    follow("controller-in-rust.md");
}

#[test]
fn character() {
    follow("character.md");
}

#[test]
fn scenario() {
    follow("scenario.md");
}

#[test]
fn precondition() {
    follow("precondition.md");
}

#[test]
fn anticipation() {
    follow("anticipation.md");
}

#[test]
fn every_guide_is_tested_and_listed() {
    let folder = repository().join("docs/guide");
    let mut found: Vec<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name != "README.md")
        .collect();
    found.sort();
    assert_eq!(found, GUIDES);
    let list = std::fs::read_to_string(folder.join("README.md")).unwrap();
    for guide in GUIDES {
        assert!(
            list.contains(&format!("({guide})")),
            "{guide} is not listed"
        );
    }
}

#[test]
fn excerpts_are_lines_in_their_order_with_gaps() {
    let output = "one\n  two 2.5 m\nthree\n";
    assert_eq!(missing("one\n…\nthree", output), None);
    assert_eq!(missing("two … m", output), None);
    assert_eq!(missing("two", output), Some("two"), "half a line");
    assert_eq!(missing("three\none", output), Some("one"), "out of order");
    assert_eq!(missing("two … s", output), Some("two … s"));
    assert_eq!(missing("a (…)", "a (b (c))"), None, "the end is the line's");
}

/// A fenced block: the words after its fence, its text, the line that it begins in.
struct Block {
    info: String,
    text: String,
    line: usize,
}

impl Block {
    fn language(&self) -> &str {
        self.info.split_whitespace().next().unwrap_or("")
    }

    fn file(&self) -> Option<&str> {
        self.info
            .split_whitespace()
            .find_map(|word| word.strip_prefix("file="))
    }
}

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn blocks(guide: &str) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut open = false;
    for (i, line) in guide.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if open => open = false,
            Some(info) => {
                open = true;
                let info = info.to_owned();
                blocks.push(Block {
                    info,
                    text: String::new(),
                    line: i + 1,
                });
            }
            None if open => {
                let block = blocks.last_mut().unwrap();
                block.text += line;
                block.text += "\n";
            }
            None => {}
        }
    }
    assert!(!open, "a block is not closed");
    blocks
}

/// Does what a guide says.
fn follow(name: &str) {
    let guide = std::fs::read_to_string(repository().join("docs/guide").join(name)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let (mut output, mut ran) = (None, false);
    for block in blocks(&guide) {
        let place = format!("{name}:{}", block.line);
        match (block.language(), block.file()) {
            ("rust", Some(file)) => {
                let compiled = std::fs::read_to_string(repository().join(file)).unwrap();
                assert_eq!(block.text, compiled, "{place}: not what {file} says");
            }
            ("sh", None) => {
                output = Some(run(&block.text, folder.path(), &place));
                ran = true;
                continue;
            }
            ("text", None) => {
                let output = output.take().expect("an excerpt follows its commands");
                let missing = missing(&block.text, &output);
                assert_eq!(missing, None, "{place}: not in the output:\n{output}");
            }
            (_, Some(file)) => write(&folder.path().join(file), &block.text),
            ("toml", None) => {}
            (language, None) => panic!("{place}: what is to be done with {language}?"),
        }
        output = None;
    }
    assert!(ran, "{name} runs nothing");
}

fn write(path: &Path, text: &str) {
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, text).unwrap();
}

/// Runs commands one by one; returns what they print.
fn run(commands: &str, folder: &Path, place: &str) -> String {
    let (mut printed, mut code) = (String::new(), 0);
    for line in commands.replace("\\\n", " ").lines() {
        if let Some(expected) = line.strip_prefix("# exits ") {
            code = expected.trim().parse().unwrap();
        } else if !line.trim().is_empty() && !line.starts_with('#') {
            let output = command(line)
                .current_dir(folder)
                .envs([("COLUMNS", "100"), ("NO_COLOR", "1")])
                .output()
                .unwrap();
            let said = [output.stdout, output.stderr].map(|s| String::from_utf8(s).unwrap());
            let said = said.concat();
            let ended = output.status.code();
            assert_eq!(ended, Some(code), "{place}: {line}\n{said}");
            printed += &said;
            code = 0;
        }
    }
    printed
}

/// A command for the shell, with the built program first on the path.
fn command(line: &str) -> Command {
    if line.starts_with("cargo run") {
        let mut name = line
            .split_whitespace()
            .skip_while(|word| *word != "--example");
        return Command::new(example(name.nth(1).unwrap()));
    }
    let program = Path::new(env!("CARGO_BIN_EXE_aplomb"));
    let path = format!("{}:{}", program.parent().unwrap().display(), env!("PATH"));
    let mut shell = Command::new("sh");
    shell
        .args(["-euc", line])
        .env("PATH", path)
        .env("APLOMB", repository());
    shell
}

/// An example as it is built; `cargo test` builds all of them, `cargo test --test guide` none.
fn example(name: &str) -> PathBuf {
    let program = Path::new(env!("CARGO_BIN_EXE_aplomb"));
    let built = program.with_file_name("examples").join(name);
    if !built.exists() {
        let cargo = Command::new(env!("CARGO"))
            .current_dir(repository())
            .args(["build", "--quiet", "--workspace", "--example", name])
            .status();
        assert!(cargo.unwrap().success(), "{name} does not compile");
    }
    built
}

/// The first line of an excerpt that is not in the output after those before it.
fn missing<'a>(excerpt: &'a str, output: &str) -> Option<&'a str> {
    let mut rest = output.lines();
    excerpt
        .lines()
        .filter(|line| !line.trim().is_empty() && line.trim() != "…")
        .find(|line| !rest.any(|candidate| matches(line.trim(), candidate.trim())))
}

/// Whether a line is as the excerpt's, in which `…` stands for anything.
fn matches(line: &str, candidate: &str) -> bool {
    let Some((first, others)) = line.split_once('…') else {
        return line == candidate;
    };
    let (between, last) = others.rsplit_once('…').unwrap_or(("", others));
    let Some(mut rest) = candidate
        .strip_prefix(first)
        .and_then(|r| r.strip_suffix(last))
    else {
        return false;
    };
    between.split('…').all(|piece| {
        let at = rest.find(piece);
        rest = at.map_or("", |at| &rest[at + piece.len()..]);
        at.is_some()
    })
}
