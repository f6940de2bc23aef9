//! The small table of figures between two marks in README.
//!
//! text, figures → text with the rows of these figures new and all others as they were.

use super::page::Highlight;

const BEGIN: &str = "<!-- results -->";
const END: &str = "<!-- /results -->";
const HEAD: &str = "| what | figure |\n|---|---|\n";

/// The text with figures of a study in its table, and a link to the study's page; none without both
/// marks.
pub(super) fn updated(text: &str, link: &str, highlights: &[Highlight]) -> Option<String> {
    let begin = text.find(BEGIN)? + BEGIN.len();
    let end = begin + text[begin..].find(END)?;
    let rows = text[begin..end]
        .lines()
        .skip_while(|l| !l.starts_with("|---"));
    let mut rows: Vec<String> = rows
        .skip(1)
        .filter(|l| l.starts_with('|'))
        .map(str::to_owned)
        .collect();
    for Highlight { what, figure } in highlights {
        let row = format!("| [{what}]({link}) | {figure} |");
        let same = format!("| [{what}](");
        match rows.iter_mut().find(|r| r.starts_with(&same)) {
            Some(old) => *old = row,
            None => rows.push(row),
        }
    }
    let table = format!("\n{HEAD}{}\n", rows.join("\n"));
    Some(format!("{}{table}{}", &text[..begin], &text[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn highlight(what: &str, figure: &str) -> Highlight {
        Highlight {
            what: what.to_owned(),
            figure: figure.to_owned(),
        }
    }

    #[test]
    fn rows_are_renewed_and_the_others_stay() {
        let empty = "a\n<!-- results -->\n<!-- /results -->\nb\n";
        let one = updated(empty, "p.md", &[highlight("pushes", "40")]).unwrap();
        let two = updated(&one, "t.md", &[highlight("trials", "9 of 10")]).unwrap();
        let again = updated(&two, "p.md", &[highlight("pushes", "41")]).unwrap();
        let rows = "| [pushes](p.md) | 41 |\n| [trials](t.md) | 9 of 10 |\n";
        let expected = format!("a\n{BEGIN}\n{HEAD}{rows}{END}\nb\n");
        assert_eq!(again, expected);
    }

    #[test]
    fn a_text_without_both_marks_is_left_alone() {
        for text in ["", "<!-- results -->", "<!-- /results --> <!-- results -->"] {
            assert_eq!(updated(text, "p.md", &[]), None);
        }
    }
}
