//! Text of a controller file, laid out to be read: no line is longer than it has to be.

/// Longest line, characters.
const WIDTH: usize = 120;
/// What a bracket is indented by.
const STEP: usize = 4;

/// The same RON with long lines folded at their outermost brackets.
pub(super) fn folded(text: &str) -> String {
    let mut all = String::new();
    for line in text.lines() {
        let rest = line.trim_start();
        fold(rest, line.len() - rest.len(), &mut all);
    }
    all
}

/// Writes a line, folded if it is too long and has a bracket to fold at.
fn fold(line: &str, indent: usize, out: &mut String) {
    let group = (indent + line.chars().count() > WIDTH).then(|| longest_group(line));
    let Some((open, close)) = group.flatten() else {
        return put(line, indent, out);
    };
    put(&line[..=open], indent, out);
    let mut row = String::new();
    for item in items(&line[open + 1..close]) {
        let wide = indent + STEP + row.chars().count() + 1 + item.chars().count() + 1 > WIDTH;
        if wide && !row.is_empty() {
            fold(&row, indent + STEP, out);
            row.clear();
        }
        if !row.is_empty() {
            row.push(' ');
        }
        row.push_str(item);
        row.push(',');
    }
    if !row.is_empty() {
        fold(&row, indent + STEP, out);
    }
    put(&line[close..], indent, out);
}

fn put(line: &str, indent: usize, out: &mut String) {
    out.extend(std::iter::repeat_n(' ', indent));
    out.push_str(line);
    out.push('\n');
}

/// Bytes outside of strings, each with its place and the depth of brackets that it stands at: those of
/// a bracket are the depth outside of it.
fn structure(line: &str) -> impl Iterator<Item = (usize, u8, usize)> + '_ {
    let (mut quoted, mut escaped, mut depth) = (false, false, 0_usize);
    line.bytes().enumerate().filter_map(move |(at, byte)| {
        if quoted {
            quoted = escaped || byte != b'"';
            escaped = !escaped && byte == b'\\';
            return None;
        }
        match byte {
            b'"' => quoted = true,
            b'(' | b'[' | b'{' => {
                depth += 1;
                return Some((at, byte, depth - 1));
            }
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        Some((at, byte, depth))
    })
}

/// The longest of the outermost pairs of brackets.
fn longest_group(line: &str) -> Option<(usize, usize)> {
    let (mut open, mut longest) = (None, None::<(usize, usize)>);
    for (at, byte, _) in structure(line).filter(|(.., depth)| *depth == 0) {
        match byte {
            b'(' | b'[' | b'{' => open = Some(at),
            b')' | b']' | b'}' => {
                if let Some(open) = open.take()
                    && longest.is_none_or(|(from, to)| at - open > to - from)
                {
                    longest = Some((open, at));
                }
            }
            _ => {}
        }
    }
    longest
}

/// What stands between the commas outside of brackets.
fn items(inside: &str) -> Vec<&str> {
    let mut all = Vec::new();
    let mut from = 0;
    let commas = structure(inside).filter(|(_, byte, depth)| *byte == b',' && *depth == 0);
    for (at, ..) in commas {
        all.push(inside[from..at].trim());
        from = at + 1;
    }
    all.push(inside[from..].trim());
    all.retain(|item| !item.is_empty());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_lines_stay_and_long_ones_are_folded_at_the_outermost_brackets() {
        let short = "(\n    a: [1, 2],\n)\n";
        assert_eq!(folded(short), short);
        let numbers = (0..12)
            .map(|i| format!("\"joint, {i}\": -0.{i}2345"))
            .collect::<Vec<_>>();
        let text = format!(
            "    (name: \"x\", pose: {{{}}}, duration: 1),\n",
            numbers.join(", ")
        );
        let folded = folded(&text);
        assert!(
            folded.lines().all(|l| l.chars().count() <= WIDTH),
            "{folded}"
        );
        assert!(folded.starts_with("    (\n        name: \"x\",\n        pose: {\n            \""));
        assert!(
            folded.ends_with("        },\n        duration: 1,\n    ),\n"),
            "{folded}"
        );
        let bare = |text: &str| {
            text.replace([' ', '\n'], "")
                .replace(",}", "}")
                .replace(",)", ")")
        };
        assert_eq!(bare(&folded), bare(&text));
    }
}
