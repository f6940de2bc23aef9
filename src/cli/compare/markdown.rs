//! Tables in Markdown.

use super::table::Table;

/// All tables, each under its title.
pub(super) fn told(tables: &[Table]) -> String {
    let each: Vec<String> = tables.iter().map(one).collect();
    each.join("\n")
}

fn one(table: &Table) -> String {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rules = (0..table.headings.len()).map(|k| match k < table.words {
        true => "---".to_owned(),
        false => "---:".to_owned(),
    });
    let mut text = format!("**{}**\n\n", table.title);
    text.push_str(&line(table.headings.iter().map(|h| escaped(h)).collect()));
    text.push_str(&line(rules.collect()));
    for row in &table.rows {
        text.push_str(&line(row.iter().map(|c| escaped(c)).collect()));
    }
    text
}

/// What would otherwise be markup.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if matches!(c, '\\' | '|' | '*' | '_' | '`' | '<' | '>' | '[' | ']') {
            escaped.push('\\');
        }
        escaped.push(c);
    }
    escaped
}
