//! Homes: which cell's polynomials carry the material of each cell, so that no node hangs on a sliver of the body.
//!
//! A node that only slivers support is light and soft at once: the wall's pressure crushes it long before the body
//! yields. What lies in a cell the body fills too little is therefore carried by the polynomials of a fuller neighbour,
//! continued beyond that cell's edge. Splines of degree p differ from that continuation by $O(h^{p+1})$.
//! Source of the idea: extended B-splines (Hollig, Reif and Wipper 2001); here cell by cell.

/// For each cell (row by row, `columns` a row) its home, from the shares of the cells that the body fills.
///
/// A cell filled by at least `least_fill`, or without a neighbour that is, is its own home.
#[must_use]
pub fn homes(fill: &[f64], columns: usize, least_fill: f64) -> Vec<usize> {
    let rows = fill.len() / columns;
    let fullest = |c: usize, steps: &[(isize, isize)]| -> Option<usize> {
        let mut best: Option<usize> = None;
        for (di, dj) in steps {
            let i = (c % columns) as isize + di;
            let j = (c / columns) as isize + dj;
            if (0..columns as isize).contains(&i) && (0..rows as isize).contains(&j) {
                let n = j as usize * columns + i as usize;
                if fill[n] >= least_fill && best.is_none_or(|b| fill[n] > fill[b]) {
                    best = Some(n);
                }
            }
        }
        best
    };
    let home = |c: usize| {
        if fill[c] >= least_fill {
            return c;
        }
        fullest(c, &[(0, 1), (0, -1), (-1, 0), (1, 0)])
            .or_else(|| fullest(c, &[(-1, 1), (-1, -1), (1, 1), (1, -1)]))
            .unwrap_or(c)
    };
    (0..fill.len()).map(home).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slivers_move_to_the_fullest_neighbour_and_full_cells_stay() {
        // three columns, two rows; the body fills the right and the lower side
        let fill = [1.0, 1.0, 1.0, 0.1, 0.3, 0.9];
        assert_eq!(homes(&fill, 3, 0.4), [0, 1, 2, 0, 1, 5]);
        assert_eq!(homes(&fill, 3, 0.0), [0, 1, 2, 3, 4, 5]);
    }

    #[test]
    fn without_a_full_neighbour_a_cell_keeps_its_own() {
        assert_eq!(homes(&[0.1, 0.2, 0.3, 0.0], 2, 0.5), [0, 1, 2, 3]);
    }
}
