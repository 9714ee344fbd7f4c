//! Grouped bars on a logarithmic scale.

use crate::svg::{COLOURS, Svg};

/// What is drawn.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The heading.
    pub title: String,
    /// The names of the bars within a group.
    pub series: Vec<String>,
    /// The groups, from top to bottom.
    pub groups: Vec<Group>,
}

/// A group of bars, one a series.
#[derive(Clone, Debug)]
pub struct Group {
    /// Its name.
    pub name: String,
    /// The lengths of its bars.
    pub values: Vec<u64>,
}

const LEFT: f64 = 150.0;
const WIDTH: f64 = 480.0;
const TOP: f64 = 60.0;
const BAR: f64 = 14.0;
const GAP: f64 = 12.0;

/// Draws horizontal bars with their values; one decade has the same width everywhere.
pub fn draw(chart: &Chart) -> String {
    let largest = chart
        .groups
        .iter()
        .flat_map(|group| &group.values)
        .copied()
        .max()
        .unwrap_or(1)
        .max(1);
    let decades = largest.ilog10() + 1;
    let step = GAP + BAR * chart.series.len() as f64;
    let bottom = TOP + step * chart.groups.len() as f64;
    let place = |value: u64| LEFT + WIDTH * (value.max(1) as f64).log10() / f64::from(decades);
    let mut svg = Svg::new((LEFT + WIDTH + 90.0) as u32, (bottom + 40.0) as u32);
    svg.text([LEFT, 22.0], 12, "start", &chart.title);
    for (k, name) in chart.series.iter().enumerate() {
        let x = LEFT + 90.0 * k as f64;
        svg.rectangle([x, 34.0], [10.0, 10.0], COLOURS[k % COLOURS.len()]);
        svg.text([x + 15.0, 43.0], 12, "start", name);
    }
    for decade in 0..=decades {
        let x = place(10u64.saturating_pow(decade));
        svg.line([x, TOP], [x, bottom], "stroke:#dddddd");
        svg.text([x, bottom + 16.0], 12, "middle", &format!("1e{decade}"));
    }
    for (g, group) in chart.groups.iter().enumerate() {
        let y = TOP + step * g as f64 + GAP / 2.0;
        let middle = y + (step - GAP) / 2.0 + 4.0;
        svg.text([LEFT - 8.0, middle], 12, "end", &group.name);
        for (k, &value) in group.values.iter().enumerate() {
            let (y, end) = (y + BAR * k as f64, place(value));
            svg.rectangle(
                [LEFT, y],
                [end - LEFT, BAR - 2.0],
                COLOURS[k % COLOURS.len()],
            );
            svg.text([end + 4.0, y + BAR - 4.0], 12, "start", &value.to_string());
        }
    }
    svg.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_proportional_to_logarithms() {
        // Largest value 1000: four decades of 120 each, so that 10 ends at 120 and 1000 at
        // 360.
        let chart = Chart {
            title: "T".into(),
            series: vec!["rows".into(), "columns".into()],
            groups: vec![Group {
                name: "g".into(),
                values: vec![1000, 10],
            }],
        };
        let svg = draw(&chart);
        assert!(svg.contains("<rect x=\"150.0\" y=\"66.0\" width=\"360.0\" height=\"12.0\""));
        assert!(svg.contains("<rect x=\"150.0\" y=\"80.0\" width=\"120.0\" height=\"12.0\""));
    }
}
