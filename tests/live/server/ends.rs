//! How the program begins and ends.

use std::net::TcpListener;
use std::process::Command;

use crate::program::{Program, until, view};

#[test]
fn ctrl_c_ends_it_well() {
    let mut program = Program::start(&[]);
    let pid = program.child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &pid]).status().unwrap();
    assert!(sent.success());
    let status = until("its end", || program.child.try_wait().unwrap());
    assert_eq!(status.code(), Some(0));
}

#[test]
fn a_port_that_is_taken_is_a_clear_error() {
    let taken = TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let port = taken.local_addr().unwrap().port();
    let output = view(port, &[]).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(
        told.contains(&format!("127.0.0.1:{port}")) && told.contains("in use"),
        "{told}"
    );
    assert!(output.stdout.is_empty());
}

#[test]
fn a_scene_that_is_none_is_refused_before_anything_is_served() {
    let output = view(0, &["nowhere"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(told.contains("nowhere"), "{told}");
}
