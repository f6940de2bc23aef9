//! Numbers of the program's JSON lie where physics and counting allow them.

use serde_json::{Value, json as value};

/// What is wrong with the numbers of a value. A bound is a field's path, its parts divided by dots,
/// and the least and the most that its number may be.
fn outside(value: &Value, bounds: &[(&str, f64, f64)]) -> Vec<String> {
    let complaint = |(path, least, most): &(&str, f64, f64)| {
        let pointer = format!("/{}", path.replace('.', "/"));
        let found = value.pointer(&pointer).unwrap_or(&Value::Null);
        let number = found.as_f64();
        let fits = number.is_some_and(|n| (*least..=*most).contains(&n));
        (!fits).then(|| format!("{path} is {found}, not {least} to {most}"))
    };
    bounds.iter().filter_map(complaint).collect()
}

/// Asserts that the numbers of a value lie within bounds, as [`outside`] has them.
#[track_caller]
pub(crate) fn assert_within(value: &Value, bounds: &[(&str, f64, f64)]) {
    let complaints = outside(value, bounds);
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn numbers_outside_of_their_bounds_are_found() {
    let run = value!({"end": {"com": [0.1, 2.0]}, "unmet": null, "digest": "7"});
    assert_within(&run, &[("end.com.0", 0.0, 0.1), ("end.com.1", 2.0, 2.0)]);
    let of = |path, least, most| outside(&run, &[(path, least, most)]);
    assert_eq!(
        of("end.com.1", 0.0, 1.9),
        ["end.com.1 is 2.0, not 0 to 1.9"]
    );
    for path in ["end.com.2", "end", "unmet", "digest", "no.such"] {
        assert_eq!(of(path, f64::MIN, f64::MAX).len(), 1, "{path}");
    }
}
