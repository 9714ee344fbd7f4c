//! Cameras: 3 x 4 matrices, their centres, and the normal form [ I | -c ]
//! (docs/theory.md, section 2).

use crate::linalg::Ring;

/// A 3 x 4 camera, row by row.
pub type Camera<E> = [[E; 4]; 3];

/// The camera [ I | -c ] with centre c (docs/theory.md, section 2).
pub fn normal_form<R: Ring>(ring: &R, centre: &[R::Elem; 3]) -> Camera<R::Elem> {
    std::array::from_fn(|row| {
        std::array::from_fn(|col| match col {
            3 => ring.neg(&centre[row]),
            _ if row == col => ring.one(),
            _ => ring.zero(),
        })
    })
}

/// The centre of a camera in homogeneous coordinates: the four maximal minors with
/// alternating signs. They are all zero exactly when the rank is below 3.
pub fn centre<R: Ring>(ring: &R, camera: &Camera<R::Elem>) -> [R::Elem; 4] {
    std::array::from_fn(|omitted| {
        let [a, b, c]: [usize; 3] = match omitted {
            0 => [1, 2, 3],
            1 => [0, 2, 3],
            2 => [0, 1, 3],
            _ => [0, 1, 2],
        };
        let minor = |k: usize, l: usize| {
            let [_, p, q] = camera;
            ring.sub(&ring.mul(&p[k], &q[l]), &ring.mul(&p[l], &q[k]))
        };
        let top = &camera[0];
        let even = ring.add(
            &ring.mul(&top[a], &minor(b, c)),
            &ring.mul(&top[c], &minor(a, b)),
        );
        let determinant = ring.sub(&even, &ring.mul(&top[b], &minor(a, c)));
        if omitted % 2 == 0 {
            determinant
        } else {
            ring.neg(&determinant)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::draw::{DrawKey, cameras_rational};
    use crate::linalg::integer::{Integer, Integers, Zero};

    #[test]
    fn centres_of_cameras() {
        let n = |x: i64| Integer::from(x);
        let camera = normal_form(&Integers, &[n(2), n(-3), n(5)]);
        let c = centre(&Integers, &camera);
        // The centre is (2, -3, 5, 1) up to scale.
        assert_eq!(c, [n(-2), n(3), n(-5), n(-1)]);
        let key = DrawKey {
            graph_sha256: [0; 32],
            core_sha256: None,
            seed: 0,
            draw: 0,
        };
        let drawn = cameras_rational(5, 50, 10, &key).unwrap();
        for camera in drawn.values {
            let c = centre(&Integers, &camera);
            for row in &camera {
                let terms = row.iter().zip(&c).map(|(a, b)| a * b);
                assert!(
                    terms
                        .fold(Integer::zero(), |sum, term| sum + term)
                        .is_zero()
                );
            }
        }
    }
}
