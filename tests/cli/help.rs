//! The help texts, word by word.

use crate::called;

fn help(arguments: &str) -> String {
    let output = called(arguments).output().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_program() {
    insta::assert_snapshot!(help("--help"));
}

#[test]
fn view() {
    insta::assert_snapshot!(help("view --help"));
}

#[test]
fn run() {
    insta::assert_snapshot!(help("run --help"));
}

#[test]
fn trials() {
    insta::assert_snapshot!(help("trials --help"));
}

#[test]
fn shell() {
    insta::assert_snapshot!(help("shell --help"));
}

#[test]
fn controllers() {
    insta::assert_snapshot!(help("controllers --help"));
}

#[test]
fn compare() {
    insta::assert_snapshot!(help("compare --help"));
}

#[test]
fn render() {
    insta::assert_snapshot!(help("render --help"));
}

#[test]
fn export() {
    insta::assert_snapshot!(help("export --help"));
}

#[test]
fn reproduce() {
    insta::assert_snapshot!(help("reproduce --help"));
}

#[test]
fn the_version_is_the_packages() {
    assert_eq!(
        help("--version"),
        concat!("aplomb ", env!("CARGO_PKG_VERSION"), "\n")
    );
}
