//! Recordings, and runs again.

use aplomb_framework::run::Trajectory;

use super::{SCENARIO, simulation};

#[test]
fn a_run_is_recorded_and_read_back_bit_for_bit() {
    let mut simulation = simulation(SCENARIO).unwrap();
    simulation.record("shove", 7);
    simulation.run(0.6);
    let recorded = simulation.recording().unwrap();
    assert_eq!(recorded.len(), 600);
    assert!(recorded.events.len() >= 3, "{:?}", recorded.events);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.aplomb");
    recorded.write(&path).unwrap();
    let read = Trajectory::read(&path).unwrap();
    assert_eq!(
        (&read.header, &read.events),
        (&recorded.header, &recorded.events)
    );
    assert_eq!(read.models, recorded.models);
    assert_eq!(read.digest(), simulation.digest());
    // The last row is what was sensed last.
    let (moment, now) = (read.moment(599, 0), simulation.sensors(0));
    assert!(
        moment
            .q
            .iter()
            .zip(&now.state.q)
            .all(|(a, b)| f64::from(*a) == *b)
    );
    assert!(
        moment
            .qdot
            .iter()
            .zip(&now.state.qdot)
            .all(|(a, b)| f64::from(*a) == *b)
    );
    assert_eq!(
        read.controller(599, 0),
        simulation.actors()[0].supervisor.active().unwrap()
    );
    assert_eq!(moment.support.is_some(), now.base_of_support.is_some());
    let crate_fell = read.prop(599, 0)[1] < read.prop(0, 0)[1] - 0.2;
    assert!(
        crate_fell,
        "{:?} to {:?}",
        read.prop(0, 0),
        read.prop(599, 0)
    );

    // Any byte that is changed, and any cut, is noticed.
    let bytes = std::fs::read(&path).unwrap();
    let plain = 600 * 4 * 44; // a state, what was sensed, a prop
    assert!(
        bytes.len() < 2 * plain / 3,
        "compact: {} of {plain} bytes",
        bytes.len()
    );
    for at in (0..bytes.len()).step_by(bytes.len() / 50) {
        let mut damaged = bytes.clone();
        damaged[at] ^= 0x10;
        std::fs::write(&path, &damaged).unwrap();
        assert!(Trajectory::read(&path).is_err(), "byte {at}");
        std::fs::write(&path, &bytes[..at]).unwrap();
        assert!(Trajectory::read(&path).is_err(), "cut at {at}");
    }
}

#[test]
fn a_run_is_the_same_every_time() {
    let digest = || {
        let mut simulation = simulation(SCENARIO).unwrap();
        simulation.run(0.3);
        let mut clone = simulation.clone();
        simulation.run(0.3);
        clone.run(0.3);
        assert_eq!(simulation.digest(), clone.digest());
        simulation.digest()
    };
    assert_eq!(digest(), digest());
}
