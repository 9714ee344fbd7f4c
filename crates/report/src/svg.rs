//! Scalable vector graphics, written by hand.

use std::fmt::{Display, Write};

/// Colours that are told apart by people who do not tell red from green (P. Tol's bright
/// scheme).
pub const COLOURS: [&str; 6] = [
    "#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377",
];

/// Text as it stands between tags, and in attributes with double quotes. XML has no way to write
/// control characters; they are shown as unknown ones.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            c if c.is_control() => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

/// A picture: elements on a white ground.
pub struct Svg {
    body: String,
    title: Option<String>,
    width: u32,
    height: u32,
}

impl Svg {
    /// An empty picture of this size in pixels.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            body: String::new(),
            title: None,
            width,
            height,
        }
    }

    /// Says in words what the picture shows.
    #[must_use]
    pub fn titled(mut self, title: &str) -> Self {
        self.title = Some(escaped(title));
        self
    }

    /// An element of any kind, as it is written; names in it go through [`escaped`].
    pub fn element(&mut self, element: impl Display) {
        // Writing to a string does not fail.
        let _ = writeln!(self.body, "{element}");
    }

    /// A line of the given style.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], style: &str) {
        let ([a, b], [c, d]) = (from, to);
        self.element(format_args!(
            r#"<line x1="{a:.1}" y1="{b:.1}" x2="{c:.1}" y2="{d:.1}" style="{style}"/>"#
        ));
    }

    /// Line segments from point to point.
    pub fn polyline(&mut self, points: &[[f64; 2]], style: &str) {
        let text: Vec<String> = points
            .iter()
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        self.element(format_args!(
            r#"<polyline points="{}" style="{style}"/>"#,
            text.join(" ")
        ));
    }

    /// A filled rectangle: its upper left corner, width and height.
    pub fn rectangle(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], fill: &str) {
        self.element(format_args!(
            r#"<rect x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}" fill="{fill}"/>"#
        ));
    }

    /// A disc.
    pub fn circle(&mut self, [x, y]: [f64; 2], radius: f64, style: &str) {
        self.element(format_args!(
            r#"<circle cx="{x:.1}" cy="{y:.1}" r="{radius:.1}" style="{style}"/>"#
        ));
    }

    /// Text whose anchor is `"start"`, `"middle"` or `"end"`.
    pub fn text(&mut self, [x, y]: [f64; 2], size: u32, anchor: &str, text: &str) {
        let text = escaped(text);
        self.element(format_args!(
            r#"<text x="{x:.1}" y="{y:.1}" font-size="{size}" text-anchor="{anchor}">{text}</text>"#
        ));
    }

    /// The document.
    pub fn finish(self) -> String {
        let Self {
            body,
            title,
            width,
            height,
        } = self;
        let title = title.map_or_else(String::new, |title| format!("<title>{title}</title>\n"));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" fill=\"#222\">\n\
             {title}<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{body}</svg>\n"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped() {
        let mut svg = Svg::new(10, 20);
        svg.text([1.0, 2.0], 12, "end", "a<b&c");
        let text = svg.finish();
        assert!(text.contains(">a&lt;b&amp;c</text>"), "{text}");
        assert!(text.contains("viewBox=\"0 0 10 20\""));
        assert_eq!(escaped("\"\u{1}'\u{7f}\""), "&quot;\u{fffd}'\u{fffd}&quot;");
        let titled = Svg::new(1, 1).titled("x & y").finish();
        assert!(
            titled.contains("<title>x &amp; y</title>\n<rect"),
            "{titled}"
        );
    }
}
