//! Pages: documents with all that they need in them.

use softstop_draw::style;

/// A template with its parts, each in place of its name in double braces; all pages have version, colours and controls.
pub(crate) fn fill(template: &str, parts: &[(&str, &str)]) -> String {
    let shared = [
        ("version", env!("CARGO_PKG_VERSION")),
        ("style", style::PAGE),
        ("controls.css", include_str!("../assets/controls.css")),
    ];
    let parts = shared.iter().chain(parts);
    parts.fold(template.to_owned(), |page, (name, part)| {
        page.replacen(&["{{", name, "}}"].concat(), part, 1)
    })
}

/// JSON that can stand in a script, which ends at the first `</script`, whatever it holds.
pub(crate) fn in_script(json: &str) -> String {
    json.replace('<', "\\u003c")
}
