//! The plot of a random experiment: share of finite-solvable graphs, and numbers of
//! components, against density.

use crate::svg::Svg;

/// The results at one density.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// The density, in 0..=1.
    pub density: f64,
    /// Share of finite-solvable graphs, in 0..=1.
    pub share: f64,
    /// Least, mean and largest number of components.
    pub components: [f64; 3],
}

const WIDTH: f64 = 360.0;
const HEIGHT: f64 = 240.0;
const LEFT: f64 = 60.0;
const TOP: f64 = 40.0;
const GAP: f64 = 90.0;

/// The plot, with points by rising density.
pub fn plot(points: &[Point]) -> String {
    let mut svg = Svg::new(
        (2.0 * LEFT + 2.0 * WIDTH + GAP) as u32,
        (TOP + HEIGHT + 60.0) as u32,
    );
    panel(&mut svg, LEFT, "share of finite-solvable graphs (%)", 100.0);
    let most = points.iter().map(|p| p.components[2]).fold(5.0, f64::max);
    let top = (most / 5.0).ceil() * 5.0;
    let right = LEFT + WIDTH + GAP;
    panel(&mut svg, right, "components: least, mean, most", top);
    let at = |left: f64, point: &Point, value: f64| {
        [left + WIDTH * point.density, TOP + HEIGHT * (1.0 - value)]
    };
    let shares: Vec<_> = points.iter().map(|p| at(LEFT, p, p.share)).collect();
    svg.polyline(&shares, "fill:none;stroke:#1b6ca8;stroke-width:2");
    for &share in &shares {
        svg.circle(share, 3.5, "fill:#1b6ca8");
    }
    for point in points {
        let [least, _, most] = point.components.map(|c| at(right, point, c / top));
        svg.line(least, most, "stroke:#b5651d;stroke-width:1.5");
        for [x, y] in [least, most] {
            svg.line(
                [x - 5.0, y],
                [x + 5.0, y],
                "stroke:#b5651d;stroke-width:1.5",
            );
        }
    }
    let means: Vec<_> = points
        .iter()
        .map(|p| at(right, p, p.components[1] / top))
        .collect();
    svg.polyline(&means, "fill:none;stroke:#b5651d;stroke-width:2");
    for &mean in &means {
        svg.circle(mean, 3.5, "fill:#b5651d");
    }
    svg.finish()
}

/// Axes with five marks each.
fn panel(svg: &mut Svg, left: f64, title: &str, top: f64) {
    let bottom = TOP + HEIGHT;
    let axis = "stroke:#444;stroke-width:1";
    svg.text([left + WIDTH / 2.0, TOP - 16.0], 14, "middle", title);
    svg.line([left, TOP], [left, bottom], axis);
    svg.line([left, bottom], [left + WIDTH, bottom], axis);
    for mark in 0..=5 {
        let share = f64::from(mark) / 5.0;
        let (x, y) = (left + WIDTH * share, bottom - HEIGHT * share);
        svg.line([left - 4.0, y], [left, y], axis);
        svg.line([x, bottom], [x, bottom + 4.0], axis);
        svg.text(
            [left - 8.0, y + 4.0],
            11,
            "end",
            &format!("{:.0}", top * share),
        );
        svg.text(
            [x, bottom + 18.0],
            11,
            "middle",
            &format!("{:.0}", 100.0 * share),
        );
    }
    svg.text(
        [left + WIDTH / 2.0, bottom + 38.0],
        12,
        "middle",
        "density (%)",
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_is_drawn() {
        let point = |density, share| Point {
            density,
            share,
            components: [1.0, 2.0, 7.0],
        };
        let text = plot(&[point(0.1, 0.0), point(0.5, 1.0)]);
        assert_eq!(text.matches("<circle").count(), 4);
        // 7 components need an axis up to 10.
        assert!(text.contains(">10</text>"), "{text}");
    }
}
