//! The adjacency matrix as pixels, rows and columns ordered by component.
//!
//! A component is a block on the diagonal, in its colour; what joins components stands outside
//! the blocks. Of a camera-point graph the rows are cameras and the columns points.

use crate::graph_picture::{Mark, Picture};
use serde::Serialize;
use std::io;

/// Most pixels along a side.
const MOST_PIXELS: usize = 640;

/// The picture: which edges fall into which pixel.
#[derive(Serialize)]
pub(super) struct Adjacency {
    /// Width and height in pixels.
    size: [usize; 2],
    /// How many columns, and how many rows, of the matrix a pixel stands for.
    cell: [usize; 2],
    /// The nodes of the rows, from the top.
    rows: Vec<u32>,
    #[serde(skip)]
    pixels: Vec<Pixel>,
}

/// The edges in a pixel, and the component that most of them are in, if most are in one.
#[derive(Clone, Copy, Default)]
struct Pixel {
    edges: u32,
    component: u32,
    lead: u32,
}

impl Pixel {
    /// Counts an edge, and lets it vote (Boyer and Moore).
    fn add(&mut self, component: u32) {
        self.edges += 1;
        if self.component == component {
            self.lead += 1;
        } else if self.lead == 0 {
            (self.component, self.lead) = (component, 1);
        } else {
            self.lead -= 1;
        }
    }
}

impl Adjacency {
    /// Sorts every edge into its pixel. O(n log n + m).
    pub(super) fn new(picture: &Picture) -> Self {
        let graph = &picture.input.graph;
        let (nodes, cameras) = (graph.nodes() as u32, picture.cameras() as u32);
        let bipartite = cameras < nodes;
        // A node of several components stands where the largest is, one of none last.
        let place = |v: &u32| picture.components_of(*v).first().map_or(u32::MAX, |&k| k);
        let mut rows: Vec<u32> = (0..cameras).collect();
        rows.sort_by_key(place);
        let mut columns: Vec<u32> = (cameras..nodes).collect();
        columns.sort_by_key(place);
        let mut at = vec![0; nodes as usize];
        for list in [&rows, &columns] {
            for (k, &v) in list.iter().enumerate() {
                at[v as usize] = k;
            }
        }
        let across = if bipartite { columns.len() } else { rows.len() };
        let cell = [across, rows.len()].map(|count| count.div_ceil(MOST_PIXELS).max(1));
        let size = [across.div_ceil(cell[0]), rows.len().div_ceil(cell[1])];
        let mut pixels = vec![Pixel::default(); size[0] * size[1]];
        for (k, &(i, j)) in graph.edges().iter().enumerate() {
            let component = picture.of_edge(k) as u32;
            let mut add = |row: u32, column: u32| {
                let [x, y] = [at[column as usize] / cell[0], at[row as usize] / cell[1]];
                pixels[y * size[0] + x].add(component);
            };
            add(i, j);
            if !bipartite {
                add(j, i);
            }
        }
        Self {
            size,
            cell,
            rows,
            pixels,
        }
    }

    /// The pixels as a PNG; where no edges are it is transparent, so that it stands on any ground.
    ///
    /// # Errors
    /// Those of the encoder.
    pub(super) fn png(&self, picture: &Picture) -> io::Result<Vec<u8>> {
        let capacity = (self.cell[0] * self.cell[1]) as f64;
        let colours = self.pixels.iter().flat_map(|pixel| {
            let [_, r, g, b] = rgb(picture.mark(pixel.component as usize)).to_be_bytes();
            // Few edges of many are still to be seen.
            let share = (f64::from(pixel.edges) / capacity).min(1.0).sqrt();
            let alpha = match pixel.edges {
                0 => 0,
                _ => 90 + (165.0 * share) as u8,
            };
            [r, g, b, alpha]
        });
        let bytes: Vec<u8> = colours.collect();
        let [width, height] = self.size.map(|side| side as u32);
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&bytes)?;
        writer.finish()?;
        Ok(png)
    }
}

/// A colour as a number, 0xrrggbb.
fn rgb(mark: Mark) -> u32 {
    let digits = mark.colour().trim_start_matches('#');
    u32::from_str_radix(digits, 16).expect("colours are written in six digits")
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::decide::{Options, decide};
    use viewcert::graph::{Graph, Labels};
    use viewcert_formats::NamedGraph;

    fn picture_of(input: &NamedGraph, look: impl FnOnce(&Picture)) {
        let verdict = decide(&input.graph, &Options::default()).unwrap();
        look(&Picture::new(input, &verdict));
    }

    fn named(nodes: u32, pairs: Vec<(u32, u32)>) -> NamedGraph {
        let graph = Graph::new(nodes, pairs).unwrap();
        NamedGraph::new("g", graph, Labels::Numbers { first: 0 })
    }

    fn decoded(png: &[u8]) -> (usize, Vec<[u8; 4]>) {
        let decoder = png::Decoder::new(io::Cursor::new(png));
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        let pixels = bytes.chunks_exact(4).map(|p| p.try_into().unwrap());
        (info.width as usize, pixels.collect())
    }

    /// A pair 0, 1, a triangle 2, 3, 4 that 1 hangs on by the pair 1, 4: the triangle is the
    /// first component, its block is first.
    #[test]
    fn blocks_are_components() {
        let input = named(5, vec![(0, 1), (2, 3), (2, 4), (3, 4), (1, 4)]);
        picture_of(&input, |picture| {
            let found = Adjacency::new(picture);
            assert_eq!(found.rows[..3], [2, 3, 4]);
            let (width, pixels) = decoded(&found.png(picture).unwrap());
            assert_eq!((width, pixels.len()), (5, 25));
            let is = |row: usize, column: usize| pixels[5 * row + column][3] == 255;
            let mut found_edges = Vec::new();
            for row in 0..5 {
                for column in 0..row {
                    assert_eq!(is(row, column), is(column, row));
                    if is(row, column) {
                        let (a, b) = (found.rows[row], found.rows[column]);
                        found_edges.push((a.min(b), a.max(b)));
                    }
                }
            }
            found_edges.sort_unstable();
            assert_eq!(found_edges, input.graph.edges());
            // The colour of the largest component in its block, of single pairs outside.
            assert_eq!(pixels[1][..3], [0x44, 0x77, 0xaa]);
            let pair = pixels
                .iter()
                .filter(|p| p[3] > 0 && p[..3] != [0x44, 0x77, 0xaa]);
            assert_eq!(pair.count(), 4);
        });
    }

    /// A pixel of a large graph stands for several nodes.
    #[test]
    fn large_graphs_fit() {
        let input = named(1300, (0..1299).map(|v| (v, v + 1)).collect());
        picture_of(&input, |picture| {
            let found = Adjacency::new(picture);
            assert_eq!((found.size, found.cell), ([434, 434], [3, 3]));
            let edges: u32 = found.pixels.iter().map(|pixel| pixel.edges).sum();
            assert_eq!(edges, 2 * 1299);
        });
    }
}
