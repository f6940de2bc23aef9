//! Tables as aligned text.

use super::table::Table;

/// Between two columns.
const GAP: &str = "  ";

/// All tables, an empty line between them.
pub(super) fn told(tables: &[Table]) -> String {
    let each: Vec<String> = tables.iter().map(one).collect();
    each.join("\n")
}

fn one(table: &Table) -> String {
    let length = |text: &str| text.chars().count();
    let widths: Vec<usize> = (0..table.headings.len())
        .map(|k| {
            let cells = table.rows.iter().map(|row| length(&row[k]));
            cells.max().unwrap_or(0).max(length(table.headings[k]))
        })
        .collect();
    let line = |cells: &[&str]| {
        let each = cells.iter().enumerate().map(|(k, cell)| {
            let width = widths[k];
            if k < table.words {
                format!("{cell:width$}")
            } else {
                format!("{cell:>width$}")
            }
        });
        let line = each.collect::<Vec<_>>().join(GAP);
        format!("{}\n", line.trim_end())
    };
    let mut text = format!("{}\n\n{}", table.title, line(&table.headings));
    for row in &table.rows {
        let cells: Vec<&str> = row.iter().map(String::as_str).collect();
        text.push_str(&line(&cells));
    }
    text
}
