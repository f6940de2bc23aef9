//! `reproduce`.

use std::fs::read_to_string;

use crate::{called, refusal};

#[test]
fn studies_are_listed() {
    let output = called("reproduce --list").output().unwrap();
    insta::assert_snapshot!(String::from_utf8(output.stdout).unwrap());
}

#[test]
fn a_study_writes_its_page_and_is_not_run_again() {
    let folder = tempfile::tempdir().unwrap();
    let readme = folder.path().join("README.md");
    let marks = "<!-- results -->\n<!-- /results -->\n";
    std::fs::write(&readme, marks).unwrap();
    let run = |out: &str| {
        let mut call = called("reproduce push_limits --quick --seed 5");
        let call = call.args(["--out", out]).current_dir(folder.path());
        let output = call.output().unwrap();
        assert!(output.status.success(), "{output:?}");
        let page = read_to_string(folder.path().join(out).join("push_limits.md")).unwrap();
        (page, String::from_utf8(output.stderr).unwrap())
    };
    let (page, told) = run("a");
    let command = "aplomb run --push 1:torso:I --duration 12";
    for part in [
        "# Push limits\n",
        "--quick --seed 5`",
        env!("CARGO_PKG_VERSION"),
        "\n| forward | ",
        "\n| backward | ",
        command,
    ] {
        assert!(page.contains(part), "{part} is not in\n{page}");
    }
    assert!(told.contains(command), "{told}");
    // Everything is kept: nothing is run, and the page is the same wherever it is written.
    assert_eq!(run("b"), (page, String::new()));
    // A quick run's figures are no results.
    assert_eq!(read_to_string(&readme).unwrap(), marks);
}

#[test]
fn an_unknown_study_comes_with_the_nearest() {
    let folder = tempfile::tempdir().unwrap();
    let error = refusal(folder.path(), &["reproduce", "push_limit"]);
    assert!(error.contains("did you mean 'push_limits'?"), "{error}");
    assert!(!folder.path().join("out").exists());
}
