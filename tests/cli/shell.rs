//! `shell`, fed with scripts.

use predicates::prelude::*;

use crate::called;

#[test]
fn a_script_pushes_waits_and_asks() {
    called("shell")
        .write_stdin("# a push\nwait 0.5\npush torso 10\nbalance\nwait 1\nstate\nexplain\nhelp\n")
        .assert()
        .success()
        .stderr("")
        .stdout(predicate::str::contains("0.500 s  push     torso +10 N·s"))
        .stdout(predicate::str::contains("command  balance: taken up"))
        .stdout(predicate::str::contains("1.500 s  standing"))
        .stdout(predicate::str::contains("active: balance"))
        .stdout(predicate::str::contains("wait S "));
}

#[test]
fn a_bad_line_is_reported_and_left_out() {
    called("shell")
        .write_stdin("blance\npush tail 5\npush torso nan\nwait\nwait -1\nwait 1e9\nwait 0.1\nstate\nquit\nx\n")
        .assert()
        .code(2)
        .stderr(predicate::str::contains("line 1: unknown command 'blance' (did you mean 'balance'?)"))
        .stderr(predicate::str::contains("line 2: unknown link 'tail'"))
        .stderr(predicate::str::contains("line 3: impulse 'nan'; accepted"))
        .stderr(predicate::str::contains("line 4: accepted: wait S"))
        .stderr(predicate::str::contains("line 5: wait '-1'; accepted: 0 to 3600 s"))
        .stderr(predicate::str::contains("line 6: wait '1e9'"))
        .stderr(predicate::str::contains("line 10").not())
        .stdout(predicate::str::contains("0.100 s  standing"));
}

#[test]
fn a_session_lasts_an_hour_at_most() {
    called("shell")
        .write_stdin("wait 0.5\nwait 3600\n")
        .assert()
        .code(2)
        .stderr(predicate::str::contains("3599.500 s are left"));
}

#[test]
fn a_session_can_be_recorded() {
    let folder = tempfile::tempdir().unwrap();
    called("shell --record x.trajectory")
        .current_dir(folder.path())
        .write_stdin("wait 0.2\n")
        .assert()
        .success();
    let path = folder.path().join("x.trajectory");
    let recording = aplomb::framework::run::Trajectory::read(&path).unwrap();
    assert_eq!(recording.len(), 200);
}

#[test]
fn input_without_lines_is_refused() {
    called("shell")
        .write_stdin(vec![b'x'; 1 << 20])
        .assert()
        .code(2)
        .stderr(predicate::str::contains("longer than 4096 bytes"));
}
