//! What a controller sees: computed once a step from the body, shared by all controllers.
//!
//! body → [`Sensors`] → conditions, features, controllers.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::character::{Kinematics, Model, Point, State, wrapped};
use crate::math::hypot;
use crate::sensing::sensed_prop::SensedProp;

/// How the character holds itself: from what supports it (a ball against the chest does not) and
/// the trunk's pitch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Posture {
    /// Only feet support it; the centre of mass is above 0.8 of its standing height.
    Standing,
    /// Only feet support it; the centre of mass is lower.
    Crouching,
    /// Hands support it, and nothing but hands and feet.
    HandsAndFeet,
    /// Shanks or knees support it, and nothing but these, hands and feet.
    Kneeling,
    /// Something else supports it and the trunk is within 0.9 rad of upright.
    Sitting,
    /// Something else supports it and the trunk leans back further: face up.
    Supine,
    /// Something else supports it and the trunk leans forward further: face down.
    Prone,
    /// Nothing supports it.
    Airborne,
}

impl Posture {
    /// As in files, JSON and messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Standing => "standing",
            Self::Crouching => "crouching",
            Self::HandsAndFeet => "hands_and_feet",
            Self::Kneeling => "kneeling",
            Self::Sitting => "sitting",
            Self::Supine => "supine",
            Self::Prone => "prone",
            Self::Airborne => "airborne",
        }
    }
}

/// Contact of one link with anything but its own character.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LinkContact {
    /// Whether it touches (a gap below 3 mm, or any force).
    pub touching: bool,
    /// Whether something touches it from below: the ground, a step, a crate it lies on.
    pub supported: bool,
    /// Whether that is only at its knee, the hinge of a shank.
    pub knee: bool,
    /// Force on the link over the last step by all that touches it, N, world frame.
    pub force: Point,
    /// Where it acts: the middle of what touches by its force, world, m; none without load.
    pub at: Option<Point>,
}

/// Contact of one foot.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FootContact {
    /// Whether the rear end of the sole is supported.
    pub heel: bool,
    /// Whether the front end of the sole is supported.
    pub toe: bool,
    /// Ground reaction force: of all that supports the foot, N.
    pub force: Point,
    /// Centre of pressure, world x, m; none without load.
    pub cop: Option<f64>,
    /// Rear and front end of what touches, world x, m.
    pub support: Option<[f64; 2]>,
}

impl FootContact {
    /// Whether any part of the foot is supported.
    #[must_use]
    pub fn touching(&self) -> bool {
        self.support.is_some()
    }
}

/// The character and its contacts at one instant. SI units, world frame (x forward, y up).
///
/// ```
/// # use aplomb_framework::prelude::*;
/// let model = Model::load("humanoid")?;
/// let now = Sensors::new(&model, 9.81); // a controller is given them
/// assert_eq!((now.posture, now.cop), (Posture::Airborne, None));
/// assert_eq!(now.contacts.len(), model.links.len());
/// assert!(now.trunk_pitch().abs() < 1e-9 && !now.stands());
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sensors {
    /// The character.
    pub model: Arc<Model>,
    /// s, since the world began.
    pub time: f64,
    /// m/s², downwards positive.
    pub gravity: f64,
    /// q, q̇.
    pub state: State,
    /// Poses and velocities of all links.
    pub kinematics: Kinematics,
    /// Centre of mass c, m.
    pub com: Point,
    /// ċ, m/s.
    pub com_velocity: Point,
    /// About the centre of mass, kg·m²/s, counter-clockwise.
    pub angular_momentum: f64,
    /// One a link.
    pub contacts: Vec<LinkContact>,
    /// One a foot, in the model's order.
    pub feet: Vec<FootContact>,
    /// Force of the ground on all feet, N.
    pub ground_reaction_force: Point,
    /// Centre of pressure under all feet, world x, m; none without load.
    pub cop: Option<f64>,
    /// Rear and front end of the soles of the feet that touch, flat or tilted, world x, m; none in
    /// the air. (The 2001 paper's support polygon surrounds the feet in contact.)
    pub base_of_support: Option<[f64; 2]>,
    /// Height of the surface last touched, m.
    pub ground: f64,
    /// c_x + ċ_x / ω₀ with ω₀ = √(g / height): where the centre of pressure would have to be at
    /// once to stop the fall (Pratt et al. 2006), world x, m.
    pub capture_point: f64,
    /// See [`Posture`].
    pub posture: Posture,
    /// The world's props, in its order.
    pub props: Vec<SensedProp>,
}

impl Sensors {
    /// A character standing in the air, before anything was sensed.
    #[must_use]
    pub fn new(model: &Arc<Model>, gravity: f64) -> Self {
        let state = State::standing(model);
        let mut kinematics = Kinematics::new(model);
        kinematics.update(model, &state);
        let mut sensors = Self {
            model: Arc::clone(model),
            time: 0.0,
            gravity,
            com: kinematics.com,
            com_velocity: kinematics.com_velocity,
            angular_momentum: 0.0,
            contacts: vec![LinkContact::default(); model.links.len()],
            feet: vec![FootContact::default(); model.feet.len()],
            ground_reaction_force: [0.0; 2],
            cop: None,
            base_of_support: None,
            ground: 0.0,
            capture_point: 0.0,
            posture: Posture::Airborne,
            props: Vec::new(),
            state,
            kinematics,
        };
        sensors.derive();
        sensors
    }

    /// Height of the centre of mass above the ground, m.
    #[must_use]
    pub fn com_height(&self) -> f64 {
        self.com[1] - self.ground
    }

    /// ω₀ = √(g / height) of the linear inverted pendulum, 1/s.
    #[must_use]
    pub fn pendulum_rate(&self) -> f64 {
        (self.gravity.max(1e-6) / self.com_height().max(0.05)).sqrt()
    }

    /// Middle of the base of support, world x, m.
    #[must_use]
    pub fn support_centre(&self) -> Option<f64> {
        self.base_of_support
            .map(|[rear, front]| 0.5 * (rear + front))
    }

    /// Rate at which the body as a whole turns, rad/s: its angular momentum about the centre of mass
    /// over the inertia that it has in this pose.
    #[must_use]
    pub fn spin(&self) -> f64 {
        let links = self.model.links.iter().zip(&self.kinematics.links);
        let inertia: f64 = links
            .map(|(link, motion)| {
                let arm = [motion.com[0] - self.com[0], motion.com[1] - self.com[1]];
                link.inertia + link.mass * (arm[0] * arm[0] + arm[1] * arm[1])
            })
            .sum();
        self.angular_momentum / inertia.max(1e-9)
    }

    /// Pitch of the trunk in (−π, π], rad, leaning back positive.
    #[must_use]
    pub fn trunk_pitch(&self) -> f64 {
        wrapped(self.kinematics.links[self.model.trunk].angle)
    }

    /// Whether only feet support it and the centre of mass is above 0.9 of its standing height, over
    /// the base of support and slower than 0.1 m/s: what a run calls standing if it lasts for 1 s.
    #[must_use]
    pub fn stands(&self) -> bool {
        let over = self
            .base_of_support
            .is_some_and(|[rear, front]| self.com[0] >= rear && self.com[0] <= front);
        let speed = hypot(self.com_velocity[0], self.com_velocity[1]);
        over && self.only_feet_support()
            && self.com_height() > 0.9 * self.model.standing_com()[1]
            && speed < 0.1
    }

    /// Whether it is supported, and by nothing but feet.
    #[must_use]
    pub fn only_feet_support(&self) -> bool {
        self.contacts.iter().any(|c| c.supported) && !self.is_down()
    }

    /// Whether anything but feet supports it.
    #[must_use]
    pub fn is_down(&self) -> bool {
        let mut links = self.contacts.iter().enumerate();
        links.any(|(i, c)| c.supported && !self.model.is_foot(i))
    }

    /// Whether something holds it up and it moves so little that an eye takes it for still: its centre of mass by
    /// less than 0.03 m/s, each joint by less than 0.2 rad/s.
    #[must_use]
    pub fn is_still(&self) -> bool {
        let [x, y] = self.com_velocity;
        self.contacts.iter().any(|c| c.supported)
            && x.abs().max(y.abs()) < 0.03
            && self.state.rates().iter().all(|rate| rate.abs() < 0.2)
    }

    /// Distance between the foremost and the rearmost ankle, m.
    #[must_use]
    pub fn feet_apart(&self) -> f64 {
        let feet = self.model.feet.iter();
        let x = feet.map(|f| self.kinematics.links[f.link].origin[0]);
        let most = x.clone().fold(f64::NEG_INFINITY, f64::max);
        most - x.fold(f64::INFINITY, f64::min)
    }

    /// Rear and front end of all soles together, whether they touch or not, world x, m.
    #[must_use]
    pub fn soles(&self) -> [f64; 2] {
        let wider = |[rear, front]: [f64; 2], [x, _]: Point| [rear.min(x), front.max(x)];
        let nothing = [f64::INFINITY, f64::NEG_INFINITY];
        self.sole_ends().fold(nothing, wider)
    }

    /// Height of the lowest end of a sole, world y, m.
    #[must_use]
    pub fn lowest_sole(&self) -> f64 {
        self.sole_ends().map(|p| p[1]).fold(f64::INFINITY, f64::min)
    }

    /// Heels and toes, in the world.
    fn sole_ends(&self) -> impl Iterator<Item = Point> + '_ {
        let feet = self.model.feet.iter();
        feet.flat_map(|f| [f.heel, f.toe].map(|end| self.kinematics.point(f.link, end)))
    }

    /// Recomputes everything that follows from state, links and feet. Called by whoever senses.
    pub fn derive(&mut self) {
        self.kinematics.update(&self.model, &self.state);
        self.com = self.kinematics.com;
        self.com_velocity = self.kinematics.com_velocity;
        self.angular_momentum = self.kinematics.angular_momentum;
        let (mut force, mut moment) = ([0.0; 2], 0.0);
        let mut support: Option<[f64; 2]> = None;
        for (foot, contact) in self.model.feet.iter().zip(&self.feet) {
            force[0] += contact.force[0];
            force[1] += contact.force[1];
            moment += contact.cop.unwrap_or(0.0) * contact.force[1];
            if contact.touching() {
                for end in [foot.heel, foot.toe] {
                    let x = self.kinematics.point(foot.link, end)[0];
                    let [rear, front] = support.unwrap_or([x, x]);
                    support = Some([rear.min(x), front.max(x)]);
                }
            }
        }
        self.ground_reaction_force = force;
        self.base_of_support = support;
        self.cop = (force[1] > 1.0).then(|| moment / force[1]);
        self.capture_point = self.com[0] + self.com_velocity[0] / self.pendulum_rate();
        self.posture = self.judge_posture();
    }

    fn judge_posture(&self) -> Posture {
        let model = &self.model;
        let (mut feet, mut hands, mut shanks, mut rest) = (false, false, false, false);
        for (i, contact) in self
            .contacts
            .iter()
            .enumerate()
            .filter(|(_, c)| c.supported)
        {
            if model.is_foot(i) {
                feet = true;
            } else if model.is_hand(i) {
                hands = true;
            } else if model.is_shank(i) || contact.knee {
                shanks = true;
            } else {
                rest = true;
            }
        }
        if rest {
            let pitch = self.trunk_pitch();
            if pitch.abs() < 0.9 {
                Posture::Sitting
            } else if pitch > 0.0 {
                Posture::Supine
            } else {
                Posture::Prone
            }
        } else if shanks {
            Posture::Kneeling
        } else if hands {
            Posture::HandsAndFeet
        } else if !feet {
            Posture::Airborne
        } else if self.com_height() > 0.8 * model.standing_com()[1] {
            Posture::Standing
        } else {
            Posture::Crouching
        }
    }
}
