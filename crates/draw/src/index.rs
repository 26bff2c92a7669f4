//! Indices below the line: `s_SN` is written as s with SN as its index.

use kuva::render::render::{Primitive, TextAnchor, TextSpan};

/// How far below the line an index stands, in units of the letters.
const DROP: f64 = 0.22;
/// Size of an index, in units of the letters.
const SMALL: f64 = 0.75;
/// Mean width of a letter in units of its size, of the letters in use, and of those of indices.
const LETTER: f64 = 0.61;
const INDEX: f64 = 0.72 * SMALL;

/// The pieces of a text, and whether each is an index: up to three letters or digits behind the underscore of a single
/// letter.
pub fn pieces(text: &str) -> Vec<(String, bool)> {
    let mut pieces = Vec::new();
    let (mut line, mut rest) = (String::new(), text);
    while let Some((head, tail)) = rest.split_once('_') {
        let mut before = head.chars().rev();
        let is_letter = before.next().is_some_and(char::is_alphabetic)
            && !before.next().is_some_and(char::is_alphanumeric);
        let end = tail
            .find(|letter: char| !letter.is_alphanumeric())
            .unwrap_or(tail.len());
        line += head;
        let is_index = is_letter && (1..=3).contains(&end);
        if is_index {
            pieces.push((std::mem::take(&mut line), false));
            pieces.push((tail[..end].to_owned(), true));
        } else {
            line.push('_');
        }
        rest = if is_index { &tail[end..] } else { tail };
    }
    line += rest;
    if !line.is_empty() || pieces.is_empty() {
        pieces.push((line, false));
    }
    pieces
}

/// About how wide a text of this size is.
pub fn width(size: u32, text: &str) -> f64 {
    pieces(text).iter().map(|piece| wide(size, piece)).sum()
}

fn wide(size: u32, (text, is_index): &(String, bool)) -> f64 {
    let letter = if *is_index { INDEX } else { LETTER };
    letter * f64::from(size) * text.chars().count() as f64
}

/// An SVG document, one element in each line, whose texts are written anew and have their indices below the line.
pub(crate) fn document(document: &str, anew: impl Fn(&str) -> String) -> String {
    let lines = document.lines().map(|line| lowered(line, &anew) + "\n");
    lines.collect()
}

fn lowered(line: &str, anew: impl Fn(&str) -> String) -> String {
    let text = line.trim_start().starts_with("<text");
    let Some((tag, text)) = line.split_once('>').filter(|_| text) else {
        return line.to_owned();
    };
    let Some(text) = text.strip_suffix("</text>") else {
        return line.to_owned();
    };
    let size = tag
        .split_once("font-size=\"")
        .and_then(|(_, rest)| rest.split_once('"')?.0.parse().ok());
    let size: f64 = size.unwrap_or(1.0);
    let (drop, small) = (DROP * size, SMALL * size);
    let mut written = format!("{tag}>");
    for (index, (piece, is_index)) in pieces(&anew(text)).into_iter().enumerate() {
        written += &match (index, is_index) {
            (_, true) => {
                format!("<tspan dy=\"{drop:.1}\" font-size=\"{small:.1}\">{piece}</tspan>")
            }
            (0, false) => piece,
            (_, false) => format!("<tspan dy=\"{:.1}\">{piece}</tspan>", -drop),
        };
    }
    written + "</text>"
}

/// The same of an element for a picture of pixels, which has no texts of several sizes: a piece each, side by side.
pub(crate) fn placed(element: &Primitive) -> Vec<Primitive> {
    let Primitive::Text {
        x,
        y,
        content,
        size,
        anchor,
        rotate,
        bold,
        color,
    } = element
    else {
        return vec![element.clone()];
    };
    let pieces = pieces(content);
    if let ([_], None, true) = (&pieces[..], rotate, bold) {
        // What is bold is so in a rich text only.
        let mut span = TextSpan::plain(content.as_str());
        span.bold = true;
        return vec![Primitive::RichText {
            x: *x,
            y: *y,
            spans: vec![span],
            size: *size,
            anchor: *anchor,
            color: color.clone(),
        }];
    }
    let letters = f64::from(*size);
    let small = (SMALL * letters).round() as u32;
    let whole = width(*size, content);
    let mut along = match (pieces.len(), anchor) {
        (1, _) | (_, TextAnchor::Start) => 0.0,
        (_, TextAnchor::Middle) => -0.5 * whole,
        (_, TextAnchor::End) => -whole,
    };
    let anchor = match pieces.len() {
        1 => *anchor,
        _ => TextAnchor::Start,
    };
    let (sin, cos) = rotate.unwrap_or(0.0).to_radians().sin_cos();
    let mut elements = Vec::new();
    for piece in pieces {
        let (below, step) = (
            if piece.1 { DROP * letters } else { 0.0 },
            wide(*size, &piece),
        );
        elements.push(Primitive::Text {
            x: x + along * cos - below * sin,
            y: y + along * sin + below * cos,
            size: if piece.1 { small } else { *size },
            content: piece.0,
            anchor,
            rotate: *rotate,
            bold: *bold,
            color: color.clone(),
        });
        along += step;
    }
    elements
}

#[cfg(test)]
mod tests {
    use super::{lowered, pieces};

    #[test]
    fn an_index_follows_the_underscore_of_a_single_letter() {
        let whole = |text: &str| vec![(text.to_owned(), false)];
        assert_eq!(pieces("missing_strips"), whole("missing_strips"));
        assert_eq!(pieces(""), whole(""));
        let index = |text: &str| (text.to_owned(), true);
        let line = |text: &str| (text.to_owned(), false);
        assert_eq!(pieces("up to s_SN"), [line("up to s"), index("SN")]);
        assert_eq!(
            pieces("X_m, a_b_c"),
            [line("X"), index("m"), line(", a"), index("b"), line("_c")]
        );
    }

    #[test]
    fn texts_of_a_document_come_back_to_the_line() {
        let line = "  <text x=\"1\" font-size=\"10\">s_SN, up</text>";
        let below = "  <text x=\"1\" font-size=\"10\">s<tspan dy=\"2.2\" font-size=\"7.5\">SN</tspan>\
                     <tspan dy=\"-2.2\">, up</tspan></text>";
        assert_eq!(lowered(line, str::to_owned), below);
        let other = "<path d=\"M0 0\" id=\"s_SN\"/>";
        assert_eq!(lowered(other, str::to_owned), other);
    }
}
