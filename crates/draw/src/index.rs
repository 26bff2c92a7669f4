//! Indices below the line: `s_SN` is written as s with SN as its index.

use kuva::render::render::{Primitive, TextAnchor, TextSpan};

/// How far below the line an index stands, in units of the letters.
const DROP: f64 = 0.22;
/// Size of an index, in units of the letters.
const SMALL: f64 = 0.75;

/// The pieces of a text, and whether each is an index: up to three letters or digits behind the underscore of a single
/// letter.
pub fn split_indices(text: &str) -> Vec<(String, bool)> {
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

/// About how wide a text of this size is; bold ones are a tenth wider.
pub(crate) fn width(size: u32, text: &str) -> f64 {
    split_indices(text)
        .iter()
        .map(|piece| wide(size, piece))
        .sum()
}

fn wide(size: u32, (text, is_index): &(String, bool)) -> f64 {
    let size = if *is_index { SMALL } else { 1.0 } * f64::from(size);
    text.chars().map(|letter| size * letter_width(letter)).sum()
}

/// Width of a letter of DejaVu Sans in units of its size, to a tenth.
fn letter_width(letter: char) -> f64 {
    match letter {
        'i' | 'j' | 'l' | 'I' | ' ' | '.' | ',' | ':' | ';' | '|' | '\'' | '′' => 0.31,
        'f' | 'r' | 't' | '(' | ')' | '[' | ']' | '-' | '/' | '⁰'..='₎' | '²' | '³' | '¹' => {
            0.4
        }
        '+' | '−' | '±' | '×' | '=' | '<' | '>' | '≤' | '≥' | '→' | '←' | '↔' => 0.84,
        'm' | 'w' | 'M' | 'W' | '%' | '—' => 0.93,
        letter if letter.is_uppercase() => 0.69,
        _ => 0.62,
    }
}

/// An SVG document, one element in each line, whose texts are written anew and have their indices below the line.
pub(crate) fn document(document: &str, anew: impl Fn(&str) -> String) -> String {
    let lines = document.lines().map(|line| lowered(line, &anew) + "\n");
    lines.collect()
}

fn lowered(line: &str, anew: impl Fn(&str) -> String) -> String {
    let is_text = line.trim_start().starts_with("<text");
    let text = line.strip_suffix("</text>").filter(|_| is_text);
    let Some((tag, text)) = text.and_then(|text| text.split_once('>')) else {
        return line.to_owned();
    };
    let size = tag
        .split_once("font-size=\"")
        .and_then(|(_, rest)| rest.split_once('"')?.0.parse().ok());
    let size: f64 = size.unwrap_or(1.0);
    let (drop, small) = (DROP * size, SMALL * size);
    let mut written = format!("{tag}>");
    for (index, (piece, is_index)) in split_indices(&anew(text)).into_iter().enumerate() {
        written += &match (index, is_index) {
            (_, true) => {
                format!("<tspan dy=\"{drop:.1}\" font-size=\"{small:.1}\">{piece}</tspan>")
            }
            (0, false) => piece,
            (_, false) => {
                // librsvg leaves out spaces with which an element begins or ends.
                let rest = piece.trim_start();
                let space = &piece[..piece.len() - rest.len()];
                format!("{space}<tspan dy=\"{:.1}\">{rest}</tspan>", -drop)
            }
        };
    }
    written + "</text>"
}

/// An element for a picture of pixels, which has no texts of several sizes: a piece each, side by side.
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
    let pieces = split_indices(content);
    let is_whole = pieces.len() == 1;
    let (sin, cos) = rotate.unwrap_or(0.0).to_radians().sin_cos();
    let mut along = match anchor {
        TextAnchor::Middle if !is_whole => -0.5 * width(*size, content),
        TextAnchor::End if !is_whole => -width(*size, content),
        _ => 0.0,
    };
    let place = |piece: (String, bool)| {
        let letters = f64::from(*size);
        let step = wide(*size, &piece);
        let (below, size) = match piece.1 {
            true => (DROP * letters, (SMALL * letters).round() as u32),
            false => (0.0, *size),
        };
        let (x, y) = (x + along * cos - below * sin, y + along * sin + below * cos);
        along += step;
        let anchor = if is_whole { *anchor } else { TextAnchor::Start };
        let mut span = TextSpan::plain(piece.0.as_str());
        span.bold = *bold;
        let (color, rotate) = (color.clone(), *rotate);
        match rotate {
            // Letters of a rich text alone are bold.
            None => Primitive::RichText {
                x,
                y,
                spans: vec![span],
                size,
                anchor,
                color,
            },
            Some(_) => Primitive::Text {
                x,
                y,
                content: piece.0,
                size,
                anchor,
                rotate,
                bold: false,
                color,
            },
        }
    };
    pieces.into_iter().map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::{lowered, split_indices as pieces};

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
        let space = "<text font-size=\"10\">s_SN back</text>";
        assert!(lowered(space, str::to_owned).contains("SN</tspan> <tspan dy=\"-2.2\">back<"));
        let line = "  <text x=\"1\" font-size=\"10\">s_SN, up</text>";
        let below = "  <text x=\"1\" font-size=\"10\">s<tspan dy=\"2.2\" font-size=\"7.5\">SN</tspan>\
                     <tspan dy=\"-2.2\">, up</tspan></text>";
        assert_eq!(lowered(line, str::to_owned), below);
        let other = "<path d=\"M0 0\" id=\"s_SN\"/>";
        assert_eq!(lowered(other, str::to_owned), other);
    }
}
