//! Scalable vector graphics, written by hand.

use std::fmt::{Display, Write};
pub(crate) use viewcert_report::scene::COLOURS;
use viewcert_report::scene::{document, escaped};

/// A picture: elements on a white ground.
pub(crate) struct Svg {
    body: String,
    title: String,
    size: [f64; 2],
}

impl Svg {
    /// An empty picture of this size in pixels.
    pub(crate) fn new(width: u32, height: u32) -> Self {
        Self {
            body: String::new(),
            title: String::new(),
            size: [f64::from(width), f64::from(height)],
        }
    }

    /// Says in words what the picture shows.
    #[must_use]
    pub(crate) fn titled(mut self, title: &str) -> Self {
        self.title = title.to_owned();
        self
    }

    /// An element of any kind, as it is written; names in it go through [`escaped`].
    pub(crate) fn element(&mut self, element: impl Display) {
        // Writing to a string does not fail.
        let _ = writeln!(self.body, "{element}");
    }

    /// A line of the given style.
    pub(crate) fn line(&mut self, from: [f64; 2], to: [f64; 2], style: &str) {
        let ([a, b], [c, d]) = (from, to);
        self.element(format_args!(
            r#"<line x1="{a:.1}" y1="{b:.1}" x2="{c:.1}" y2="{d:.1}" style="{style}"/>"#
        ));
    }

    /// Line segments from point to point.
    pub(crate) fn polyline(&mut self, points: &[[f64; 2]], style: &str) {
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
    pub(crate) fn rectangle(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], fill: &str) {
        self.element(format_args!(
            r#"<rect x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}" fill="{fill}"/>"#
        ));
    }

    /// A disc.
    pub(crate) fn circle(&mut self, [x, y]: [f64; 2], radius: f64, style: &str) {
        self.element(format_args!(
            r#"<circle cx="{x:.1}" cy="{y:.1}" r="{radius:.1}" style="{style}"/>"#
        ));
    }

    /// Text whose anchor is `"start"`, `"middle"` or `"end"`.
    pub(crate) fn text(&mut self, [x, y]: [f64; 2], size: u32, anchor: &str, text: &str) {
        let text = escaped(text);
        self.element(format_args!(
            r#"<text x="{x:.1}" y="{y:.1}" font-size="{size}" text-anchor="{anchor}">{text}</text>"#
        ));
    }

    /// The document.
    pub(crate) fn finish(self) -> String {
        document(self.size, &self.title, &self.body)
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
        assert_eq!(escaped("\"\u{1}'\u{202e}\""), "&quot;\\u0001'\\u202e&quot;");
        let titled = Svg::new(1, 1).titled("x & y").finish();
        assert!(
            titled.contains("<title>x &amp; y</title>\n<rect"),
            "{titled}"
        );
    }
}
