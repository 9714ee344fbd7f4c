//! Exponents of monomials in a few unknowns, up to a bound for each: the places of coefficients.

/// All exponents up to bounds, in lexicographic order, the last unknown fastest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Exponents {
    pub(super) bounds: Vec<usize>,
}

impl Exponents {
    pub(super) fn len(&self) -> usize {
        self.bounds.iter().map(|bound| bound + 1).product()
    }

    /// Those that are marked.
    pub(super) fn marked(&self, marks: &[bool]) -> Vec<Vec<usize>> {
        let marked = self.all().into_iter().zip(marks).filter(|(_, mark)| **mark);
        marked.map(|(exponent, _)| exponent).collect()
    }

    pub(super) fn all(&self) -> Vec<Vec<usize>> {
        self.bounds.iter().fold(vec![Vec::new()], |all, &bound| {
            let longer = all.into_iter().flat_map(|exponent: Vec<usize>| {
                (0..=bound).map(move |e| exponent.iter().copied().chain([e]).collect())
            });
            longer.collect()
        })
    }

    /// The places here of all exponents up to smaller bounds, in their order. The place of a sum
    /// of two exponents is the sum of their places.
    pub(super) fn places(&self, smaller: &[usize]) -> Vec<usize> {
        let mut places = vec![0];
        for (&bound, &own) in smaller.iter().zip(&self.bounds) {
            let longer = places
                .iter()
                .flat_map(|&place| (0..=bound).map(move |e| place * (own + 1) + e));
            places = longer.collect();
        }
        places
    }

    /// How far the place of `a + e_f` is from that of `a`.
    pub(super) fn stride(&self, f: usize) -> usize {
        self.bounds[f + 1..].iter().map(|bound| bound + 1).product()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_by_hand() {
        let exponents = Exponents { bounds: vec![2, 3] };
        assert_eq!(exponents.len(), 12);
        assert_eq!(exponents.places(&[1, 1]), [0, 1, 4, 5]);
        assert_eq!([exponents.stride(0), exponents.stride(1)], [4, 1]);
        assert_eq!(exponents.all()[6], [1, 2]);
    }
}
