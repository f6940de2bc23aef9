//! Has the crate built again when a file of the folders that are part of it comes or goes.

fn main() {
    println!("cargo::rerun-if-changed=clips");
    println!("cargo::rerun-if-changed=learned");
    println!("cargo::rerun-if-changed=repertoires");
    println!("cargo::rerun-if-changed=skills");
}
