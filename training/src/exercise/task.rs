//! What a controller is measured by, as its file declares it in `exercise`: its goal, and where it
//! begins.
//!
//! `exercise` of a controller file (RON) → [`Task`] (validated).
//!
//! ```text
//! exercise: Rise(goal: Stand, heaps: 0.5, impulse: (70, 260), disturbance: "rise_supine")
//! exercise: Rise(goal: Reach(posture: prone), heaps: 0.5, impulse: (70, 260))
//! exercise: Step(search: (impulse: (40, 90), sites: [trunk, root]), measure: (impulse: (40, 75), sites: [trunk]))
//! exercise: Fall(impulse: (60, 300), sites: [trunk, root, head])
//! exercise: Stand(forward: (38, 50), backward: (34, 42))
//! ```

use aplomb_framework::control::{Condition, Contract};
use aplomb_framework::input::{Error, Result, check};
use serde::{Deserialize, Serialize};

use crate::exercise::rising::Goal;
use crate::exercise::skill::Skill;
use crate::situations::disturbance;
use crate::situations::pushes::Site;

/// N·s; no push is stronger.
const STRONGEST: f64 = 1000.0;
/// At most this many sites.
const MOST_SITES: usize = 16;
/// What to write in a file without it.
const EXAMPLE: &str = "Rise(…), Step(…), Fall(…) or Stand(…), for example \
                       exercise: Rise(goal: Stand, heaps: 0.5, impulse: (70, 260))";

/// Pushes of a character that stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Blows {
    /// Weakest and strongest, N·s.
    pub impulse: [f64; 2],
    /// Where they act, in turn.
    pub sites: Vec<Site>,
}

/// What a controller has to do, and from where.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Task {
    /// Bring a character to a goal, from where the repertoire hands over to the controller in heaps
    /// on the floor and in falls.
    Rise {
        /// What is to be brought about.
        goal: Goal,
        /// Part of the situations that begin as heaps, 0 to 1; the others begin as falls.
        heaps: f64,
        /// Weakest and strongest push of the falls, N·s.
        impulse: [f64; 2],
        /// The shipped disturbance that further starts begin with where heaps and falls seldom lead
        /// to the controller.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        disturbance: Option<String>,
    },
    /// Stand again after a push.
    Step {
        /// The pushes of a search.
        search: Blows,
        /// The pushes of a measurement in one world.
        measure: Blows,
    },
    /// Come down well after a push.
    Fall {
        /// Weakest and strongest push, N·s.
        impulse: [f64; 2],
        /// Where they act, in turn.
        sites: Vec<Site>,
    },
    /// Withstand pushes of the trunk in place, alone.
    Stand {
        /// Weakest and strongest push forward, N·s.
        forward: [f64; 2],
        /// Weakest and strongest push backward, N·s.
        backward: [f64; 2],
    },
}

impl Task {
    /// What a skill's file declares.
    ///
    /// # Errors
    /// [`Error::Invalid`] if it declares nothing, or what its contract rules out: a controller that
    /// never ends or has always succeeded, and one that is to act unasked but acts only on command;
    /// [`Error::Syntax`]; numbers out of bounds.
    pub fn of(skill: &Skill) -> Result<Self> {
        let source = &skill.file.source;
        let Some(raw) = &skill.file.exercise else {
            let missing = Error::refused("exercise", "missing", EXAMPLE);
            return Err(source.locate(missing));
        };
        let task: Self = source.parse_part("exercise", raw)?;
        let checked = task.check().map_err(|e| e.inside("exercise"));
        let fits = checked.and_then(|()| task.check_contract(&skill.contract));
        fits.map_err(|e| source.locate(e))?;
        Ok(task)
    }

    fn check(&self) -> Result<()> {
        let range = |field: &'static str, [low, high]: [f64; 2]| {
            check::within((field, 0), low, 0.0..=STRONGEST)?;
            check::above((field, 1), high, low, STRONGEST)
        };
        let sites = |sites: &[Site]| check::count("sites", sites.len(), 1..=MOST_SITES, "sites");
        match self {
            Self::Rise {
                goal,
                heaps,
                impulse,
                disturbance,
            } => {
                check::within("heaps", *heaps, 0.0..=1.0)?;
                if let Goal::Reach {
                    barred: Some(barred),
                    ..
                } = goal
                {
                    let checked = check::within("barred", *barred, -7.0..=7.0);
                    checked.map_err(|e| e.inside("goal"))?;
                }
                if let Some(name) = disturbance {
                    disturbance::shipped(name).map_err(|e| e.inside("disturbance"))?;
                }
                range("impulse", *impulse)
            }
            Self::Step { search, measure } => {
                let blows = [("search", search), ("measure", measure)];
                blows.into_iter().try_for_each(|(field, blows)| {
                    let checked = range("impulse", blows.impulse).and(sites(&blows.sites));
                    checked.map_err(|e| e.inside(field))
                })
            }
            Self::Fall { impulse, sites: at } => range("impulse", *impulse).and(sites(at)),
            Self::Stand { forward, backward } => {
                range("forward", *forward).and(range("backward", *backward))
            }
        }
    }

    fn check_contract(&self, contract: &Contract) -> Result<()> {
        let invalid = |field: &str, problem: String, accepted: &str| {
            Err(Error::refused(field, problem, accepted).inside("contract"))
        };
        let post = &contract.postcondition;
        match self {
            Self::Rise { .. } if matches!(post, Condition::Never | Condition::Always) => {
                let accepted = "a condition that the controller brings about";
                invalid("postcondition", post.to_string(), accepted)
            }
            Self::Step { .. } | Self::Stand { .. } if contract.weight == 0 => {
                let accepted = "above 0 for one that takes over from a standing character";
                invalid("weight", "0, only on command".to_owned(), accepted)
            }
            _ => Ok(()),
        }
    }

    /// So many starts in words.
    pub(crate) fn starts_in_words(&self, count: usize) -> String {
        match self {
            Self::Stand {
                forward: [low, high],
                backward: [low2, high2],
            } => format!(
                "{count} pushes of {low} to {high} N·s forward and {low2} to {high2} backward"
            ),
            _ => format!("{count} starts in varied worlds"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercise::skill::tests::{TUCK, shipped, skills};
    use aplomb_framework::input::Source;
    use aplomb_framework::sensing::Posture;

    /// What is said of TUCK with another exercise.
    fn told(exercise: &str) -> std::result::Result<Task, String> {
        let before = r#"Rise(goal: Reach(posture: supine), heaps: 0.5, impulse: (70.0, 260.0))"#;
        assert!(TUCK.contains(before));
        let (folder, skills) = skills(&TUCK.replace(before, exercise));
        let beside = |e: String| e.replace(&format!("{}/", folder.path().display()), "");
        Task::of(Skill::find(&skills, "tuck").unwrap()).map_err(|e| beside(e.to_string()))
    }

    #[test]
    fn the_task_is_what_the_file_declares() {
        let goal = Goal::Reach {
            posture: Posture::Supine,
            barred: None,
        };
        let Ok(Task::Rise { goal: found, .. }) =
            told("Rise(goal: Reach(posture: supine), heaps: 0, impulse: (1, 2))")
        else {
            panic!("no task to rise");
        };
        assert_eq!(found, goal);
        let kinds = [
            ("balance", "Stand"),
            ("stance", "Stand"),
            ("protective_step", "Step"),
            ("fall", "Fall"),
            ("stand_up", "Rise"),
            ("roll_backward", "Rise"),
        ];
        for (name, kind) in kinds {
            let task = format!("{:?}", Task::of(&shipped(name)).unwrap());
            assert!(task.starts_with(kind), "{name}: {task}");
        }
    }

    #[test]
    fn who_declares_nothing_reads_what_to_write() {
        let told = Task::of(&shipped("bow")).unwrap_err().to_string();
        assert!(
            told.starts_with("built-in skills/bow.ron:2:1: exercise is missing; "),
            "{told}"
        );
        assert!(told.contains("exercise: Rise(goal: Stand"), "{told}");
    }

    #[test]
    fn what_is_out_of_bounds_is_refused() {
        let rise = |rest: &str| format!("Rise(goal: Stand, {rest})");
        let refusals = [
            (rise("heaps: 2, impulse: (70, 260)"), "heaps is 2"),
            (
                rise("heaps: 0.5, impulse: (70, 7)"),
                "impulse[1] is 7; accepted: above 70, at most 1000",
            ),
            (
                rise("heaps: 0.5, impulse: (-1, 7)"),
                "impulse[0] is -1; accepted: 0 to 1000",
            ),
            (rise("heaps: 0.5, impulse: (7, 2000)"), "impulse[1] is 2000"),
            (
                rise("heaps: 0.5, impulse: (7, 8), disturbance: \"rol\""),
                "'roll'",
            ),
            ("Fall(impulse: (1, 2), sites: [])".into(), "a list of 0"),
            ("Jump(height: 1)".into(), "Jump"),
            (
                "Stand(forward: (1, 2), backward: (3, 3))".into(),
                "backward[1] is 3; accepted: above 3",
            ),
        ];
        for (exercise, why) in refusals {
            let told = told(&exercise).unwrap_err();
            assert!(told.contains(why), "{exercise}: {told}");
            assert!(told.starts_with("repertoire.ron:14:"), "{told}");
        }
        let told = told("Stand(forward: (1, 2), backward: (3, 3))").unwrap_err();
        let place = "repertoire.ron:14:52: controllers[0].exercise.backward[1] is 3; ";
        assert!(told.starts_with(place), "{told}");
    }

    #[test]
    fn what_is_within_bounds_is_taken() {
        assert!(told("Stand(forward: (1, 2), backward: (1, 2))").is_ok());
    }

    #[test]
    fn a_task_survives_its_file() {
        for name in ["balance", "protective_step", "fall", "roll_backward"] {
            let task = Task::of(&shipped(name)).unwrap();
            let text = aplomb_framework::input::options().to_string(&task).unwrap();
            let again: Task = Source::new("x", text).parse().unwrap();
            assert_eq!(again, task);
        }
    }
}
