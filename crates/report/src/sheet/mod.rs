//! A page of words, tables and a picture of the images, which needs no network, no script and no
//! other file.
//!
//! In: what a command prints for people, and what it is about ([`Scene`]). Out: sections of one page.
//! The words are those of the screen, line by line, so that page and screen cannot differ.
//! Names come from files of others and are escaped; the page's policy lets no script run.

mod cameras;
mod scene;
mod tables;
mod words;

pub use scene::Scene;

use crate::svg::escaped;
use viewcert_advice::Advice;

/// The style of the pages of graphs, and what these have besides.
const STYLE: &str = concat!(include_str!("../page/style.css"), include_str!("style.css"));

/// What a page says.
pub struct Sheet<'a> {
    /// What kind of page it is.
    pub kind: &'a str,
    /// What it is about: the title.
    pub name: &'a str,
    /// The answer in a sentence, and whether it is good.
    pub answer: (String, bool),
    /// What the command prints for people.
    pub text: &'a str,
    /// The images, and what is between them.
    pub scene: Scene<'a>,
    /// Joints and suggestions.
    pub advice: &'a Advice,
}

impl Sheet<'_> {
    /// The page. O(n log n) for n cameras and links that are drawn.
    pub fn html(&self) -> String {
        let (answer, is_good) = &self.answer;
        let class = if *is_good { "good" } else { "bad" };
        let name = escaped(self.name);
        let sections = [
            section("summary", "What is determined", &words::entries(self.text)),
            section("cameras", "The images", &self.scene.html()),
            section("parts", "Parts", &tables::parts(&self.scene)),
            section("joints", "Joints", &tables::joints(self.advice)),
            section(
                "suggestions",
                "Images to match",
                &tables::suggestions(self.advice),
            ),
        ];
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
             style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n<title>{name}</title>\n\
             <style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n<p class=\"kind\">{}</p>\n\
             <h1>{name}</h1>\n<div id=\"verdict\" class=\"{class}\"><p class=\"answer\">{}</p></div>\n\
             </header>\n<main>\n{}</main>\n<footer><p>Made by verify {} of viewcert. Parts are components, with the \
             numbers that they have everywhere else.</p></footer>\n</body>\n</html>\n",
            escaped(self.kind),
            escaped(answer),
            sections.concat(),
            env!("CARGO_PKG_VERSION"),
        )
    }
}

/// A section, unless it is empty.
fn section(id: &str, title: &str, content: &str) -> String {
    if content.is_empty() {
        return String::new();
    }
    format!("<section id=\"{id}\">\n<h2>{title}</h2>\n{content}</section>\n")
}

#[cfg(test)]
mod tests;
