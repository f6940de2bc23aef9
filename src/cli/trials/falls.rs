//! How a character falls: which way, what touches first, how fast its head is when it touches, how
//! hard head and trunk hit.
//!
//! sensors and events of every step → [`FallRecord`]s, and when it stands again.

use aplomb::framework::character::Model;
use aplomb::framework::events::EventKind;
use aplomb::framework::math::hypot;
use aplomb::framework::sensing::Sensors;
use aplomb::training::exercise::Impact;

use super::rising::RisingRecord;

/// m/s; a slower centre of mass falls the way it was pushed.
const SLOW: f64 = 0.05;

/// Parts of the body that a fall may land on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FallPart {
    Foot,
    Knee,
    Hand,
    Head,
    /// The root link and the thighs.
    Seat,
    Trunk,
    Other,
}

const PARTS: usize = 7;

/// m/s; a slower centre of mass is at rest.
const REST: f64 = 0.15;
/// s of rest that end a fall: what touches after it belongs to getting up.
const RESTED: f64 = 0.1;

/// One fall, from the first touch of anything but feet until the character lies still: a head that
/// touches later, when it rises, was not hit by the fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FallRecord {
    /// Whether it went forward.
    pub(super) forward: bool,
    /// When each part first touched, s.
    touched: [Option<f64>; PARTS],
    /// Speed of the head just before it first touched, m/s.
    head_speed: Option<f64>,
    /// Largest filtered force on the head, N; 0 if it did not touch.
    head_force: f64,
    /// Largest filtered force on trunk and root together, N.
    pub(super) trunk_force: f64,
}

/// How the head was hit in a fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HeadHit {
    /// Speed of the head just before it first touched anything, m/s.
    pub(super) speed: f64,
    /// Largest filtered force on it until the character lies still, N.
    pub(super) force: f64,
}

impl FallRecord {
    /// None if the head touched nothing.
    pub(super) fn head_hit(&self) -> Option<HeadHit> {
        let force = self.head_force;
        self.head_speed.map(|speed| HeadHit { speed, force })
    }

    fn when(&self, part: FallPart) -> f64 {
        self.touched[part as usize].unwrap_or(f64::INFINITY)
    }

    /// Forward: the hands touched before head and trunk, or neither of these did. Backward: hands
    /// or seat touched before the head, or the head did not.
    pub(super) fn broken_well(&self) -> bool {
        let hands = self.when(FallPart::Hand);
        let (good, bad) = if self.forward {
            (
                hands,
                self.when(FallPart::Head).min(self.when(FallPart::Trunk)),
            )
        } else {
            (
                hands.min(self.when(FallPart::Seat)),
                self.when(FallPart::Head),
            )
        };
        bad.is_infinite() || good < bad
    }
}

/// Which part of the body a link is.
fn part(model: &Model, link: usize) -> FallPart {
    if model.is_foot(link) {
        FallPart::Foot
    } else if model.is_shank(link) {
        FallPart::Knee
    } else if model.is_hand(link) {
        FallPart::Hand
    } else if link == model.head {
        FallPart::Head
    } else if model.is_seat(link) {
        FallPart::Seat
    } else if link == model.trunk {
        FallPart::Trunk
    } else {
        FallPart::Other
    }
}

/// Watches one trial.
#[derive(Debug)]
pub(super) struct FallWatch {
    parts: Vec<FallPart>,
    pushed: f64,
    /// Whether a touch of the ground counts as a fall: not before a heap has stood up.
    upright: bool,
    /// m/s, in the step before.
    head_speed: f64,
    impact: Impact,
    falling: Option<FallRecord>,
    /// Since when it has been at rest, s.
    resting: Option<f64>,
    falls: Vec<FallRecord>,
    rising: RisingRecord,
}

impl FallWatch {
    /// Of a character that is pushed with an impulse (N·s) or begins on the floor, in steps of
    /// `dt` s.
    pub(super) fn new(model: &Model, pushed: f64, fallen: bool, dt: f64) -> Self {
        Self {
            parts: (0..model.links.len()).map(|l| part(model, l)).collect(),
            pushed,
            upright: !fallen,
            head_speed: 0.0,
            impact: Impact::new(dt),
            falling: None,
            resting: None,
            falls: Vec::new(),
            rising: RisingRecord::new(fallen),
        }
    }

    /// Takes in a step: what was sensed, and what happened to the character.
    pub(super) fn observe<'a>(
        &mut self,
        now: &Sensors,
        mut events: impl Iterator<Item = &'a EventKind>,
    ) {
        if self.upright && events.any(|e| matches!(e, EventKind::Fell)) {
            let v = now.com_velocity[0];
            let way = if v.abs() < SLOW { self.pushed } else { v };
            self.upright = false;
            self.rising.fell(now);
            self.falling = Some(FallRecord {
                forward: way > 0.0,
                touched: [None; PARTS],
                head_speed: None,
                head_force: 0.0,
                trunk_force: 0.0,
            });
        }
        if self.rising.observe(now) {
            self.upright = true;
            self.falls.extend(self.falling.take());
        }
        if hypot(now.com_velocity[0], now.com_velocity[1]) > REST {
            self.resting = None;
        } else if now.time - *self.resting.get_or_insert(now.time) > RESTED {
            self.falls.extend(self.falling.take());
        }
        self.impact.observe(now);
        if let Some(fall) = &mut self.falling {
            for (part, contact) in self.parts.iter().zip(&now.contacts) {
                if contact.touching {
                    fall.touched[*part as usize].get_or_insert(now.time);
                    if *part == FallPart::Head {
                        fall.head_speed.get_or_insert(self.head_speed);
                    }
                }
            }
            fall.head_force = fall.head_force.max(self.impact.head);
            fall.trunk_force = fall.trunk_force.max(self.impact.trunk);
        }
        let v = now.kinematics.links[now.model.head].com_velocity;
        self.head_speed = hypot(v[0], v[1]);
    }

    /// All falls, the last one possibly not over, and the time to standing of [`RisingRecord`].
    pub(super) fn finish(mut self) -> (Vec<FallRecord>, Option<f64>) {
        self.falls.extend(self.falling);
        (self.falls, self.rising.took())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use aplomb::framework::run::Simulation;
    use aplomb::framework::scenario::Scenario;

    /// Steps with what touches in each.
    fn fall(forward: bool, touches: &[&[&str]]) -> FallRecord {
        let model = Model::load("humanoid").unwrap();
        let mut watch = FallWatch::new(&model, if forward { 1.0 } else { -1.0 }, false, 1e-3);
        let mut now = Sensors::new(&model, 9.81);
        for (i, links) in touches.iter().enumerate() {
            now.time = i as f64;
            now.com_velocity = [if forward { 1.0 } else { -1.0 }, 0.0];
            now.kinematics.links[model.head].com_velocity = [0.0, -1.0 - i as f64];
            for (link, contact) in model.links.iter().zip(&mut now.contacts) {
                contact.touching = links.contains(&link.name.as_str());
                contact.force = [0.0, if contact.touching { 1000.0 } else { 0.0 }];
            }
            let fell = (i == 0).then_some(&EventKind::Fell);
            watch.observe(&now, fell.into_iter());
        }
        watch.finish().0[0]
    }

    #[test]
    fn hands_before_head_and_trunk_break_a_forward_fall() {
        assert!(fall(true, &[&["forearm_l"], &["torso"], &["head"]]).broken_well());
        assert!(fall(true, &[&["shank_r"], &["thigh_r"]]).broken_well());
        assert!(!fall(true, &[&["torso"], &["forearm_l"]]).broken_well());
        assert!(!fall(true, &[&["head"], &["forearm_l"]]).broken_well());
    }

    #[test]
    fn hands_or_seat_before_the_head_break_a_backward_fall() {
        assert!(fall(false, &[&["pelvis"], &["torso"], &["head"]]).broken_well());
        assert!(fall(false, &[&["torso"], &["upper_arm_l"]]).broken_well());
        assert!(!fall(false, &[&["torso"], &["head"], &["pelvis"]]).broken_well());
    }

    #[test]
    fn the_head_is_as_fast_as_just_before_it_touches() {
        let hit = fall(false, &[&["pelvis"], &[], &["head"], &["head"]]).head_hit();
        assert_eq!(hit.map(|h| h.speed), Some(2.0));
        assert_eq!(fall(false, &[&["pelvis"], &["torso"]]).head_hit(), None);
    }

    #[test]
    fn head_and_trunk_are_hit_as_hard_as_the_filter_lets_through() {
        let fall = fall(false, &[&["pelvis", "torso"], &[], &["head"], &["head"]]);
        assert!((fall.trunk_force - 200.0).abs() < 1e-9);
        assert!((fall.head_force - 190.0).abs() < 1e-9);
    }

    #[test]
    fn a_heap_has_not_fallen_before_it_has_stood_up() {
        let scenario = Scenario::standing("humanoid", 2.0);
        let mut run = Simulation::new(&scenario, &aplomb::controllers::registry()).unwrap();
        let mut watch = FallWatch::new(run.sensors(0).model.as_ref(), 0.0, true, 1e-3);
        watch.observe(run.sensors(0), [EventKind::Fell].iter());
        assert!(watch.falling.is_none());
        for _ in 0..1500 {
            run.step();
            watch.observe(run.sensors(0), [].iter());
        }
        watch.observe(run.sensors(0), [EventKind::Fell].iter());
        let (falls, took) = watch.finish();
        assert_eq!(falls.len(), 1);
        assert!(took.is_some_and(|s| s < 0.5), "{took:?}");
    }
}
