//! Contact point: a point of the body that may touch the wall, and its way to the nodes.

/// A point that may touch the wall.
#[derive(Debug, Clone, Copy)]
pub struct ContactPoint<const N: usize> {
    /// First node.
    pub node: usize,
    /// Values of its nodes' functions.
    pub values: [f64; N],
    /// Undeformed height above the wall.
    pub height: f64,
    /// Undeformed distance from the axis.
    pub radius: f64,
}

impl<const N: usize> ContactPoint<N> {
    /// Component `axis` of a nodal field here.
    #[inline(always)]
    pub fn at<V: AsRef<[f64]>>(&self, offsets: &[usize; N], field: &[V], axis: usize) -> f64 {
        let mut sum = 0.0;
        for (value, offset) in self.values.iter().zip(offsets) {
            sum += value * field[self.node + offset].as_ref()[axis];
        }
        sum
    }

    /// Give an impulse along `axis` to the nodes.
    #[inline(always)]
    pub fn press<V: AsRef<[f64]> + AsMut<[f64]>>(
        &self,
        offsets: &[usize; N],
        impulse: f64,
        v: &mut [V],
        recip_mass: &[V],
        axis: usize,
    ) {
        for (value, offset) in self.values.iter().zip(offsets) {
            let n = self.node + offset;
            v[n].as_mut()[axis] += value * impulse * recip_mass[n].as_ref()[axis];
        }
    }

    /// Coupling with another point: the speed that a unit impulse there gives to this one.
    pub fn coupling(
        &self,
        other: &Self,
        offsets: &[usize; N],
        recip_mass: impl Fn(usize) -> f64,
    ) -> f64 {
        let mut sum = 0.0;
        for (value, offset) in self.values.iter().zip(offsets) {
            let n = self.node + offset;
            for (theirs, offset) in other.values.iter().zip(offsets) {
                if other.node + offset == n {
                    sum += value * theirs * recip_mass(n);
                }
            }
        }
        sum
    }
}
