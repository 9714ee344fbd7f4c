//! Two populations on a logarithmic axis, and the errors of every threshold between them.

use crate::svg::{COLOURS, Svg};

/// What is drawn.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The heading.
    pub title: String,
    /// The name of the axis.
    pub axis: String,
    /// The populations, each with its name; zeros, and what rounding makes negative, stand at the
    /// left edge.
    pub populations: [(String, Vec<f64>); 2],
    /// Threshold and the share of wrong members of each population.
    pub errors: Vec<(f64, [f64; 2])>,
    /// A threshold to mark.
    pub mark: f64,
}

const LEFT: f64 = 60.0;
const WIDTH: f64 = 640.0;
const TOP: f64 = 70.0;
const HEIGHT: f64 = 160.0;
const SECOND: f64 = TOP + HEIGHT + 60.0;
/// The decades of the axis.
const DECADES: (f64, f64) = (-36.0, 4.0);

fn x(value: f64) -> f64 {
    let (low, high) = DECADES;
    LEFT + WIDTH * ((log(value).clamp(low, high) - low) / (high - low))
}

fn log(value: f64) -> f64 {
    value.max(0.0).log10()
}

/// The lower edge of the upper part, the histograms, and of the lower part, the errors.
const BOTTOMS: [f64; 2] = [TOP + HEIGHT, SECOND + HEIGHT];

/// Draws a histogram of each population, a decade a bar and each to its own total, above
/// the shares of errors by threshold.
pub fn draw(picture: &Picture) -> String {
    let [_, bottom] = BOTTOMS;
    let mut svg = Svg::new((LEFT + WIDTH + 30.0) as u32, (bottom + 50.0) as u32);
    svg.text([LEFT, 22.0], 12, "start", &picture.title);
    legend(&mut svg, picture);
    axes(&mut svg, TOP, "share a decade");
    axes(&mut svg, SECOND, "share misjudged");
    let below = [LEFT + WIDTH / 2.0, bottom + 36.0];
    svg.text(below, 12, "middle", &picture.axis);
    let mark = x(picture.mark);
    svg.line([mark, TOP], [mark, bottom], "stroke:#888888");
    for (k, (_, values)) in picture.populations.iter().enumerate() {
        histogram(&mut svg, k, values);
    }
    errors(&mut svg, picture);
    svg.finish()
}

fn legend(svg: &mut Svg, picture: &Picture) {
    for (k, (name, values)) in picture.populations.iter().enumerate() {
        let place = LEFT + 330.0 * k as f64;
        svg.rectangle([place, 34.0], [10.0, 10.0], COLOURS[k]);
        let text = format!("{name} ({})", values.len());
        svg.text([place + 15.0, 43.0], 12, "start", &text);
    }
}

/// The axes of one part, from 0 to 1 upwards.
fn axes(svg: &mut Svg, top: f64, label: &str) {
    let bottom = top + HEIGHT;
    svg.line([LEFT, top], [LEFT, bottom], "stroke:#000000");
    svg.line([LEFT, bottom], [LEFT + WIDTH, bottom], "stroke:#000000");
    svg.text([LEFT, top - 6.0], 12, "start", label);
    for (y, text) in [(top, "1"), (top + HEIGHT / 2.0, "0.5"), (bottom, "0")] {
        svg.text([LEFT - 6.0, y + 4.0], 12, "end", text);
    }
    for decade in (-36..=4).step_by(4) {
        let at = [x(10f64.powf(f64::from(decade))), bottom + 16.0];
        svg.text(at, 12, "middle", &format!("1e{decade}"));
    }
}

/// The bars of population number `k`.
fn histogram(svg: &mut Svg, k: usize, values: &[f64]) {
    let bar = WIDTH / (DECADES.1 - DECADES.0) / 2.0;
    let total = values.len().max(1) as f64;
    for decade in -36..4 {
        let start = f64::from(decade);
        let inside =
            |value: &&f64| log(**value).clamp(DECADES.0, DECADES.1 - 1e-9).floor() == start;
        let share = values.iter().filter(inside).count() as f64 / total;
        if share > 0.0 {
            let left = x(10f64.powf(start)) + bar * k as f64;
            // One member of many still shows.
            let height = (HEIGHT * share).max(1.5);
            let corner = [left, BOTTOMS[0] - height];
            svg.rectangle(corner, [bar - 0.5, height], COLOURS[k]);
        }
    }
}

fn errors(svg: &mut Svg, picture: &Picture) {
    for (k, colour) in COLOURS.iter().enumerate().take(2) {
        let points: Vec<[f64; 2]> = picture
            .errors
            .iter()
            .map(|(threshold, shares)| [x(*threshold), BOTTOMS[1] - HEIGHT * shares[k]])
            .collect();
        let style = format!("fill:none;stroke-width:2;stroke:{colour}");
        svg.polyline(&points, &style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn histograms_and_curves() {
        let svg = draw(&Picture {
            title: "T".into(),
            axis: "A".into(),
            populations: [("a".into(), vec![-1e-15, 5.0]), ("b".into(), vec![1e-30])],
            errors: vec![(1e-36, [0.0, 1.0]), (1e4, [1.0, 0.0])],
            mark: 1e-10,
        });
        // What is below zero stands in the leftmost decade, 5 in that of 1; each is half of two.
        assert!(svg.contains("<rect x=\"60.0\" y=\"150.0\" width=\"7.5\" height=\"80.0\""));
        assert!(svg.contains("<rect x=\"636.0\" y=\"150.0\" width=\"7.5\" height=\"80.0\""));
        assert!(svg.contains("points=\"60.0,450.0 700.0,290.0\""));
    }
}
