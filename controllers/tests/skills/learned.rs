//! The shipped boundaries as files.

use std::path::Path;

use aplomb_framework::control::Boundary;
use aplomb_framework::control::boundary::{DecisionFunction, VERSION};

/// Bytes of a file that is still pleasant to have in a repository.
const LARGEST: u64 = 350_000;

#[test]
fn shipped_boundaries_are_small_and_tell_first_where_they_come_from() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("learned");
    let files = std::fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().path());
    let mut count = 0;
    for file in files {
        let name = file.display();
        let boundary = Boundary::read(&file).unwrap();
        assert_eq!(boundary.version, VERSION, "{name}");
        let size = std::fs::metadata(&file).unwrap().len();
        assert!(size < LARGEST, "{name} has {size} bytes");
        let figures = boundary.figures.unwrap();
        if let DecisionFunction::Gaussian {
            support, weights, ..
        } = &boundary.decision
        {
            assert_eq!(
                (support.len(), weights.len()),
                (figures.support_vectors, support.len()),
                "{name}"
            );
        }
        let text = std::fs::read_to_string(&file).unwrap();
        let at = |field: &str| text.find(field).unwrap();
        assert!(
            at("provenance:") < at("figures:") && at("figures:") < at("controller:"),
            "{name}"
        );
        count += 1;
    }
    assert!(count >= 9, "{count} files");
}
