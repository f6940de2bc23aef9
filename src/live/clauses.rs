//! The clauses of a condition: as a tree for a page, and whether each holds now.
//!
//! [`Condition`], sensors → nodes, numbered from 0 in the order in which they are written.

use aplomb_framework::control::Condition;
use aplomb_framework::sensing::Sensors;
use serde::Serialize;

/// A clause with the clauses in it.
#[derive(Debug, Serialize)]
pub(super) struct Node {
    text: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    all: Option<Vec<Node>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    any: Option<Vec<Node>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    not: Option<Box<Node>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    feature: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    min: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max: Option<f64>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    learned: bool,
}

impl Node {
    pub(super) fn of(condition: &Condition) -> Self {
        let nodes = |list: &[Condition]| Some(list.iter().map(Self::of).collect());
        let mut node = Self {
            text: condition.to_string(),
            all: None,
            any: None,
            not: None,
            feature: None,
            min: None,
            max: None,
            learned: false,
        };
        match condition {
            Condition::All(list) => node.all = nodes(list),
            Condition::Any(list) => node.any = nodes(list),
            Condition::Not(c) => node.not = Some(Box::new(Self::of(c))),
            Condition::Within { feature, min, max } => {
                node.feature = Some(feature.to_string());
                node.min = min.is_finite().then_some(*min);
                node.max = max.is_finite().then_some(*max);
            }
            Condition::Svm(_) => node.learned = true,
            _ => {}
        }
        node
    }
}

fn children(condition: &Condition) -> &[Condition] {
    match condition {
        Condition::All(list) | Condition::Any(list) => list,
        Condition::Not(c) => std::slice::from_ref(&**c),
        _ => &[],
    }
}

fn size(condition: &Condition) -> usize {
    1 + children(condition).iter().map(size).sum::<usize>()
}

/// Whether each clause holds, and the value that it bounds.
pub(super) fn states(condition: &Condition, now: &Sensors) -> Vec<(u8, Option<f64>)> {
    let mut states = vec![(u8::from(condition.holds(now)), condition.value(now))];
    for child in children(condition) {
        states.extend(self::states(child, now));
    }
    states
}

/// The node that refuses, and the value that it refuses; none if the condition holds.
pub(super) fn refusing(condition: &Condition, now: &Sensors) -> Option<(usize, Option<f64>)> {
    if condition.holds(now) {
        return None;
    }
    if let Condition::All(list) = condition {
        let mut place = 1;
        for child in list {
            if let Some((node, value)) = refusing(child, now) {
                return Some((place + node, value));
            }
            place += size(child);
        }
    }
    Some((0, condition.value(now)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use aplomb_framework::Model;

    #[test]
    fn the_clause_that_refuses_is_found_by_its_number() {
        let text = r#"All([Not(Never), Any([Never, Always]), All([
            Within(feature: "com_height", min: 0.5), Within(feature: "com_velocity_x", min: 1)])])"#;
        let condition: Condition = ron::from_str(text).unwrap();
        let now = Sensors::new(&Model::load("humanoid").unwrap(), 9.81);
        assert_eq!(refusing(&condition, &now), Some((8, Some(0.0))));
        let states = states(&condition, &now);
        let holds: Vec<u8> = states.iter().map(|s| s.0).collect();
        assert_eq!(holds, [0, 1, 0, 1, 0, 1, 0, 1, 0]);
        let node = serde_json::to_value(Node::of(&condition)).unwrap();
        assert_eq!(node["all"][2]["all"][1]["min"], 1.0);
    }
}
