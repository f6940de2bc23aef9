use super::*;

/// A recording without steps of so many humanoids, and what one of them senses.
pub(crate) fn of_humanoids(count: usize) -> (Trajectory, Sensors) {
    let model = Model::load("humanoid").unwrap();
    let cast = Cast {
        model: model.source.clone(),
        controllers: vec!["rest".into()],
    };
    let header = Header {
        scenario: "x".into(),
        seed: 3,
        dt: 1e-3,
        cast: vec![cast; count],
        props: vec![],
    };
    let now = Sensors::new(&model, 9.81);
    (Trajectory::new(header, vec![model; count]), now)
}
