//! A recording as a table for other programs: named columns, a row a step.
//!
//! [`Trajectory`] → [`Export`] → names of the columns, [`Datum`]s of each row. What file they go into
//! is the caller's.

use std::collections::BTreeSet;

use crate::character::{Kinematics, Model, State};
use crate::run::trajectory::Trajectory;

/// Columns of a character behind its positions and velocities, in this order.
const MEASURES: [&str; 10] = [
    "com_x",
    "com_y",
    "com_vx",
    "com_vy",
    "grf_x",
    "grf_y",
    "cop_x",
    "support_rear",
    "support_front",
    "reference_x",
];

/// What stands in one column of one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Datum<'a> {
    /// s, in whole nanoseconds.
    Time(f64),
    /// SI units and radians, world frame, of the recording's precision.
    Number(f32),
    /// Name of a controller.
    Name(&'a str),
    /// There is no such thing in this step.
    Nothing,
}

impl From<Option<f32>> for Datum<'_> {
    fn from(number: Option<f32>) -> Self {
        number
            .filter(|x| !x.is_nan())
            .map_or(Self::Nothing, Self::Number)
    }
}

/// A recording that is read row by row.
#[derive(Debug)]
pub struct Export<'a> {
    trajectory: &'a Trajectory,
    /// One a character, for the frames of its links.
    poses: Vec<(State, Kinematics)>,
}

impl<'a> Export<'a> {
    /// Of a recording.
    #[must_use]
    pub fn new(trajectory: &'a Trajectory) -> Self {
        let pose = |model: &Model| (State::standing(model), Kinematics::new(model));
        Self {
            trajectory,
            poses: trajectory.models.iter().map(|m| pose(m)).collect(),
        }
    }

    /// Names of the columns: `time`; of each character `NAME.active`, root and joints, their
    /// velocities, what was measured, the frame of every link; of each prop its frame. A second one
    /// of a name is `NAME_2`.
    #[must_use]
    pub fn columns(&self) -> Vec<String> {
        let mut names = BTreeSet::new();
        let mut columns = vec!["time".to_owned()];
        for model in &self.trajectory.models {
            let name = distinct(&model.name, &mut names);
            columns.push(format!("{name}.active"));
            for prefix in ["", "v."] {
                let joints = model.joints().map(|j| j.name.as_str());
                let all = ["x", "y", "pitch"].into_iter().chain(joints);
                columns.extend(all.map(|coordinate| format!("{name}.{prefix}{coordinate}")));
            }
            columns.extend(MEASURES.map(|measure| format!("{name}.{measure}")));
            for link in &model.links {
                columns.extend(frame(&format!("{name}.{}", link.name)));
            }
        }
        for prop in &self.trajectory.header.props {
            columns.extend(frame(&distinct(&prop.name, &mut names)));
        }
        columns
    }

    /// The steps nearest to 0, `every`, 2 `every` … s; each step once.
    pub fn steps(&self, every: f64) -> impl Iterator<Item = usize> + use<> {
        let stride = (every / self.trajectory.header.dt).max(1.0);
        let len = self.trajectory.len();
        let nearest = (0_usize..).map(move |n| (n as f64 * stride).round() as usize);
        nearest.take_while(move |step| *step < len)
    }

    /// Puts the data of a step, one a column, into `row`, which is emptied before.
    pub fn row(&mut self, step: usize, row: &mut Vec<Datum<'a>>) {
        let trajectory = self.trajectory;
        row.clear();
        let time = step as f64 * trajectory.header.dt;
        row.push(Datum::Time((1e9 * time).round() / 1e9));
        for (character, (state, kinematics)) in self.poses.iter_mut().enumerate() {
            let model = &trajectory.models[character];
            let moment = trajectory.moment(step, character);
            row.push(match trajectory.controller(step, character) {
                "" => Datum::Nothing,
                name => Datum::Name(name),
            });
            let mut add = |number: Option<f32>| row.push(number.into());
            for number in moment.q.iter().chain(moment.qdot) {
                add(Some(*number));
            }
            for number in [moment.com, moment.com_velocity, moment.force].as_flattened() {
                add(Some(*number));
            }
            add(moment.cop);
            add(moment.support.map(|[rear, _]| rear));
            add(moment.support.map(|[_, front]| front));
            add(moment.reference);
            for (to, from) in state.q.iter_mut().zip(moment.q) {
                *to = f64::from(*from);
            }
            kinematics.update(model, state);
            for link in &kinematics.links {
                for number in [link.origin[0], link.origin[1], link.angle] {
                    add(Some(number as f32));
                }
            }
        }
        for prop in 0..trajectory.header.props.len() {
            let pose = trajectory.prop(step, prop);
            row.extend(pose.map(|number| Datum::from(Some(number))));
        }
    }
}

/// Columns of a frame in the world.
fn frame(name: &str) -> [String; 3] {
    ["x", "y", "angle"].map(|part| format!("{name}.{part}"))
}

/// The name itself, or with the first number from 2 that makes it another than all before.
fn distinct(name: &str, taken: &mut BTreeSet<String>) -> String {
    let numbered = (2..).map(|n| format!("{name}_{n}"));
    let mut all = std::iter::once(name.to_owned()).chain(numbered);
    let free = all.find(|n| !taken.contains(n)).unwrap_or_default();
    taken.insert(free.clone());
    free
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::trajectory::push_character;
    use crate::run::trajectory::tests::of_humanoids;

    /// Two humanoids, so many steps of 1 ms.
    fn recording(steps: usize) -> Trajectory {
        let (mut trajectory, mut now) = of_humanoids(2);
        for i in 0..steps {
            now.state.q[2] = 0.25;
            let mut row = Vec::new();
            push_character(&mut row, &now, (i > 0).then_some(0.5), 0);
            push_character(&mut row, &now, None, 9);
            trajectory.push_row(&row);
        }
        trajectory
    }

    #[test]
    fn a_row_has_a_datum_a_column_and_what_is_not_there_is_nothing() {
        let trajectory = recording(3);
        let mut export = Export::new(&trajectory);
        let columns = export.columns();
        let mut row = Vec::new();
        export.row(1, &mut row);
        assert_eq!(row.len(), columns.len());
        let at = |name: &str| row[columns.iter().position(|c| c == name).unwrap()];
        assert_eq!(at("time"), Datum::Time(1e-3));
        assert_eq!(at("humanoid.active"), Datum::Name("rest"));
        assert_eq!(at("humanoid_2.active"), Datum::Nothing);
        assert_eq!(at("humanoid.reference_x"), Datum::Number(0.5));
        assert_eq!(at("humanoid_2.reference_x"), Datum::Nothing);
        assert_eq!(at("humanoid.cop_x"), Datum::Nothing);
        assert_eq!(at("humanoid.torso.angle"), Datum::Number(0.25));
        export.row(0, &mut row);
        assert_eq!(row.len(), columns.len());
        let names: BTreeSet<&String> = columns.iter().collect();
        assert_eq!(names.len(), columns.len());
    }

    #[test]
    fn steps_are_thinned_to_the_nearest_and_none_twice() {
        let trajectory = recording(11);
        let export = Export::new(&trajectory);
        let steps = |every: f64| export.steps(every).collect::<Vec<_>>();
        assert_eq!(steps(1e-3), (0..11).collect::<Vec<_>>());
        assert_eq!(steps(1e-9), (0..11).collect::<Vec<_>>());
        assert_eq!(steps(5e-3), [0, 5, 10]);
        assert_eq!(steps(2.5e-3), [0, 3, 5, 8, 10]);
        assert_eq!(steps(1.0), [0]);
    }

    #[test]
    fn a_third_one_of_a_name_gets_the_next_number_that_is_free() {
        let mut taken = BTreeSet::new();
        let names = ["a", "a_2", "a", "a", "b"].map(|n| distinct(n, &mut taken));
        assert_eq!(names, ["a", "a_2", "a_3", "a_4", "b"]);
    }
}
