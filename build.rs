//! Has the crate built again when a file of the folders that are part of it comes or goes.

fn main() {
    println!("cargo::rerun-if-changed=scenarios");
}
