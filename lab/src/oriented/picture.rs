//! A picture of two scenes with the same images: what was photographed, and another solution in front of
//! its cameras (lab/docs/oriented.md, Theorem 10.19).
//!
//! In: a scene and one of its oriented solutions, exact. Out: centres and one point for each pair in both,
//! in floating point, drawn side by side. That the solution is one, and oriented, was shown before, over
//! the integers; a picture proves nothing.

use super::{Oriented, Scene, Standing};
use crate::svg::{COLOURS, Svg};
use viewcert::geometry::camera::Camera;
use viewcert::linalg::integer::{Integer, Signed};
use viewcert_formats::NamedGraph;

type Vector = [f64; 3];

/// A scene: the cameras by their centres, and for each pair a point that both see.
struct Shape {
    centres: Vec<Vector>,
    points: Vec<Vector>,
}

/// How the points of a pair are tried: so many places about the middle of their base line.
const TRIED: u32 = 400;

const SIZE: f64 = 360.0;
const MARGIN: f64 = 30.0;

/// A scene and one of its solutions that is oriented.
pub struct SecondScene<'a> {
    /// The scene with all its solutions.
    pub scene: &'a Scene,
    /// Which of its real roots it is.
    pub root: usize,
    /// Its plane at infinity.
    pub plane: [i64; 4],
    members: &'a [Vec<u32>],
}

impl<'a> SecondScene<'a> {
    /// The first one that was found.
    pub fn of(oriented: &'a Oriented) -> Option<Self> {
        oriented.places.iter().find_map(|scene| {
            let mut roots = scene.roots.iter().enumerate();
            roots.find_map(|(root, found)| match found.standing {
                Standing::Oriented(plane) => Some(Self {
                    scene,
                    root,
                    plane,
                    members: &oriented.members,
                }),
                _ => None,
            })
        })
    }
}

/// The picture; `None` if the scenes are so different that no points near both are found.
pub fn picture(input: &NamedGraph, second: &SecondScene<'_>) -> Option<String> {
    let (scene, labels) = (second.scene, &labels(input)[..]);
    let (edges, plane) = (input.graph.edges(), second.plane);
    let cameras = scene.near(second.members, second.root)?;
    let cameras: Vec<[[f64; 4]; 3]> = cameras.iter().map(rounded).collect();
    let centres: Vec<Vector> = scene.centres.iter().map(|c| c.map(|x| x as f64)).collect();
    let (first, second) = shapes(&centres, &cameras, plane.map(|x| x as f64), edges)?;
    let mut svg = Svg::new(
        (2.0 * SIZE + 3.0 * MARGIN) as u32,
        (SIZE + 3.0 * MARGIN) as u32,
    )
    .titled("Two scenes with the same images of points on all pairs of the graph");
    for (k, (shape, title)) in [(&first, "the scene"), (&second, "another one, same images")]
        .into_iter()
        .enumerate()
    {
        let left = MARGIN + k as f64 * (SIZE + MARGIN);
        draw(&mut svg, shape, (labels, edges), (left, title));
    }
    Some(svg.finish())
}

/// The name of each node.
fn labels(input: &NamedGraph) -> Vec<String> {
    let nodes = 0..input.graph.nodes() as u32;
    nodes.map(|v| input.labels.label(v).into_owned()).collect()
}

/// Leading digits, all entries of a camera divided by one power of ten.
fn rounded(camera: &Camera<Integer>) -> [[f64; 4]; 3] {
    let digits = |x: &Integer| x.abs().to_string().len() as i32;
    let longest = camera.iter().flatten().map(digits).max().unwrap_or(0);
    camera.each_ref().map(|row| {
        row.each_ref().map(|x| {
            let text = x.to_string();
            let (sign, text) = text
                .strip_prefix('-')
                .map_or(("", &text[..]), |rest| ("-", rest));
            let decimal = format!("{sign}0.{text}e{}", text.len() as i32 - longest);
            decimal.parse().unwrap_or(0.0)
        })
    })
}

/// Both scenes. The second one is mapped so that its plane at infinity is there, and then by the affine map
/// that brings its centres nearest to the first ones.
fn shapes(
    centres: &[Vector],
    cameras: &[[[f64; 4]; 3]],
    plane: [f64; 4],
    edges: &[(u32, u32)],
) -> Option<(Shape, Shape)> {
    // Homogeneous centres with plane . C = 1.
    let second = cameras.iter().map(|camera| {
        let centre = kernel(camera);
        let scale = dot4(&plane, &centre);
        (scale != 0.0).then(|| centre.map(|x| x / scale))
    });
    let second: Vec<[f64; 4]> = second.collect::<Option<_>>()?;
    // The rows of the map: least squares, and the plane last.
    let mut normal = [[0.0; 7]; 4];
    for (c, target) in second.iter().zip(centres) {
        for (k, row) in normal.iter_mut().enumerate() {
            for (entry, x) in row.iter_mut().zip(c.iter().chain(target)) {
                *entry += c[k] * x;
            }
        }
    }
    let solved = solve(normal)?;
    let row = |r: usize| solved.map(|row| row[4 + r]);
    let map = [row(0), row(1), row(2), plane];
    // Cameras have blocks of positive determinant, that of [Q; plane] divided by that of the map; a reflection
    // of the scene changes its sign, and no more.
    let map = if determinant(&map) > 0.0 {
        [map[0].map(|x| -x), map[1], map[2], map[3]]
    } else {
        map
    };
    let moved: Vec<Vector> = second
        .iter()
        .map(|c| [0, 1, 2].map(|r| dot4(&map[r], c)))
        .collect();
    let inverse = inverse(&map)?;
    let mut shape = (
        Shape {
            centres: centres.to_vec(),
            points: Vec::new(),
        },
        Shape {
            centres: moved,
            points: Vec::new(),
        },
    );
    for &(i, j) in edges {
        let (i, j) = (i as usize, j as usize);
        let (x, y) = (0..TRIED).find_map(|k| {
            let x = candidate(&centres[i], &centres[j], k);
            let y = seen_alike([i, j], centres, &x, cameras, (&shape.1.centres, &inverse))?;
            Some((x, y))
        })?;
        shape.0.points.push(x);
        shape.1.points.push(y);
    }
    Some(shape)
}

/// A point about the middle of two centres, further away the more were tried.
fn candidate(c: &Vector, d: &Vector, k: u32) -> Vector {
    let length = (0..3).map(|r| (c[r] - d[r]).powi(2)).sum::<f64>().sqrt();
    let (turn, reach) = (f64::from(k) * 2.399_963, 0.4 + f64::from(k) / 60.0);
    let height = (f64::from(k) * 0.618_034).fract() * 2.0 - 1.0;
    let flat = (1.0 - height * height).sqrt();
    let direction = [flat * turn.cos(), flat * turn.sin(), height];
    [0, 1, 2].map(|r| (c[r] + d[r]) / 2.0 + reach * length * direction[r])
}

/// Where the rays that see a point in the first scene meet in the second one, if they do in front of the
/// cameras and nearby.
fn seen_alike(
    pair: [usize; 2],
    first: &[Vector],
    x: &Vector,
    cameras: &[[[f64; 4]; 3]],
    (second, inverse): (&[Vector], &[[f64; 4]; 4]),
) -> Option<Vector> {
    let rays = pair.map(|v| {
        let ray = [0, 1, 2].map(|r| x[r] - first[v][r]);
        let block: [[f64; 3]; 3] = std::array::from_fn(|r| {
            std::array::from_fn(|c| (0..4).map(|k| cameras[v][r][k] * inverse[k][c]).sum())
        });
        let solved = solve([0, 1, 2].map(|r| [block[r][0], block[r][1], block[r][2], ray[r]]))?;
        Some((second[v], solved.map(|row| row[3])))
    });
    let [Some((c, g)), Some((d, h))] = rays else {
        return None;
    };
    // c + a g = d + b h, by least squares.
    let difference = [0, 1, 2].map(|r| d[r] - c[r]);
    let (gg, gh, hh) = (dot(&g, &g), dot(&g, &h), dot(&h, &h));
    let (gd, hd) = (dot(&g, &difference), dot(&h, &difference));
    let below = gg * hh - gh * gh;
    let (a, b) = ((gd * hh - hd * gh) / below, (gd * gh - hd * gg) / below);
    let far = 4.0 * dot(&difference, &difference).sqrt();
    let near = a * gg.sqrt() < far && b * hh.sqrt() < far;
    (a > 0.0 && b > 0.0 && near).then(|| [0, 1, 2].map(|r| c[r] + a * g[r]))
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn dot4(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The minors with alternating signs.
fn kernel(camera: &[[f64; 4]; 3]) -> [f64; 4] {
    [0, 1, 2, 3].map(|omitted| {
        let [a, b, c] = match omitted {
            0 => [1, 2, 3],
            1 => [0, 3, 2],
            2 => [0, 1, 3],
            _ => [0, 2, 1],
        };
        let [x, y, z] = camera;
        x[a] * (y[b] * z[c] - y[c] * z[b])
            + x[b] * (y[c] * z[a] - y[a] * z[c])
            + x[c] * (y[a] * z[b] - y[b] * z[a])
    })
}

fn determinant(rows: &[[f64; 4]; 4]) -> f64 {
    -dot4(&rows[3], &kernel(&[rows[0], rows[1], rows[2]]))
}

fn inverse(rows: &[[f64; 4]; 4]) -> Option<[[f64; 4]; 4]> {
    let unit = |r: usize, c: usize| f64::from(u8::from(r == c));
    let wide = std::array::from_fn(|r| {
        std::array::from_fn(|c| if c < 4 { rows[r][c] } else { unit(r, c - 4) })
    });
    let solved: [[f64; 8]; 4] = solve(wide)?;
    Some(solved.map(|row| [row[4], row[5], row[6], row[7]]))
}

/// Gauss and Jordan on the first N columns.
fn solve<const N: usize, const M: usize>(mut rows: [[f64; M]; N]) -> Option<[[f64; M]; N]> {
    for k in 0..N {
        let size = |row: &usize| rows[*row][k].abs();
        let pivot = (k..N).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        rows.swap(k, pivot);
        let top = rows[k][k];
        if top == 0.0 {
            return None;
        }
        rows[k] = rows[k].map(|x| x / top);
        let above = rows[k];
        for row in (0..N).filter(|&row| row != k) {
            let factor = rows[row][k];
            for (x, y) in rows[row].iter_mut().zip(above) {
                *x -= factor * y;
            }
        }
    }
    Some(rows)
}

/// Seen from a corner, in a square.
fn draw(
    svg: &mut Svg,
    shape: &Shape,
    (labels, edges): (&[String], &[(u32, u32)]),
    (left, title): (f64, &str),
) {
    let flat = |x: &Vector| {
        let across = 0.8 * x[0] - 0.6 * x[1];
        [across, 0.36 * x[0] + 0.48 * x[1] - 0.8 * x[2]]
    };
    let all = || shape.centres.iter().chain(&shape.points).map(flat);
    let least = [0, 1].map(|k| all().map(|x| x[k]).fold(f64::MAX, f64::min));
    let most = [0, 1].map(|k| all().map(|x| x[k]).fold(f64::MIN, f64::max));
    let extent = (most[0] - least[0])
        .max(most[1] - least[1])
        .max(f64::MIN_POSITIVE);
    let place = |x: &Vector| {
        let [x, y] = flat(x);
        let x = left + (x - least[0]) / extent * SIZE;
        [x, 2.0 * MARGIN + (y - least[1]) / extent * SIZE]
    };
    svg.text([left, MARGIN], 14, "start", title);
    for (&(i, j), point) in edges.iter().zip(&shape.points) {
        for v in [i, j] {
            svg.line(
                place(&shape.centres[v as usize]),
                place(point),
                "stroke:#bbbbbb",
            );
        }
        svg.circle(place(point), 2.5, &format!("fill:{}", COLOURS[1]));
    }
    for (centre, label) in shape.centres.iter().zip(labels) {
        let [x, y] = place(centre);
        svg.circle([x, y], 5.0, &format!("fill:{}", COLOURS[0]));
        svg.text([x + 7.0, y - 6.0], 13, "start", label);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::linalg::integer::decimal;

    #[test]
    fn linear_algebra_by_hand() {
        let rows = [
            [1.0, 0.0, 0.0, -2.0],
            [0.0, 1.0, 0.0, 3.0],
            [0.0, 0.0, 1.0, -5.0],
        ];
        // The centre of [ I | -c ], up to a factor, is (c; 1).
        assert_eq!(kernel(&rows), [-2.0, 3.0, -5.0, -1.0]);
        let square = [rows[0], rows[1], rows[2], [0.0, 0.0, 0.0, 2.0]];
        assert_eq!(determinant(&square), 2.0);
        let inverse = inverse(&square).unwrap();
        assert_eq!(inverse[0], [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(inverse[3], [0.0, 0.0, 0.0, 0.5]);
        assert!(solve([[1.0, 1.0, 0.0], [1.0, 1.0, 1.0]]).is_none());
    }

    #[test]
    fn long_numbers() {
        let integer = |text: &str| decimal(text).unwrap();
        let long = integer("-123456789012345678901234567890");
        let row = [long.clone(), -long, integer("0"), integer("1")];
        let [a, b, c, d] = rounded(&[row.clone(), row.clone(), row])[0];
        assert!((a + 0.123_456_789_012_345_68).abs() < 1e-15 && a == -b);
        assert!(c == 0.0 && (0.0..1e-28).contains(&d));
    }
}
