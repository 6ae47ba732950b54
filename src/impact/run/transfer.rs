//! Remap: velocity carried by the material points and mapped to the nodes every step, as most material point methods do.
//!
//! The crate's own scheme is `()`: velocity stays on the nodes. The others exist to show what transfers cost and lose.
//! Nodal displacements grow by the mapped velocity, as in the thesis (equations 3-6 to 3-11).

use crate::impact::kernel::{Point, folded, loaded, spread, store};
use crate::lanes::{Lanes, WIDTH};
use crate::space::Flat;
use crate::tape::{Keep, Tape, keep_fields};

/// A step that has ended, before velocities are mapped; nodal fields.
#[derive(Debug, Clone, Copy)]
pub struct StepEnd<'a, V> {
    /// Length of the step.
    pub dt: f64,
    /// Velocity before it.
    pub old: &'a [V],
    /// Internal force in it.
    pub force: &'a [V],
    /// Lumped mass.
    pub mass: &'a [f64],
    /// Reciprocal mass by component; 0 where the component is fixed.
    pub recip_mass: &'a [V],
}

/// What happens to the nodal velocity between two steps.
pub trait Remap<V>: Clone + Keep {
    /// Map the velocity `v` through the points; returns the energy that the body gains by it (negative: a loss).
    fn remap(&mut self, step: StepEnd<V>, v: &mut [V]) -> f64;
    /// Displacement of the points as a nodal field, from which contact takes its gaps: that of the nodes, unless points
    /// move with the velocity before it is mapped.
    #[inline(always)]
    fn travel<'a>(&'a self, u: &'a [V]) -> &'a [V] {
        u
    }
    /// Memory, bytes.
    fn bytes(&self) -> usize;
}

/// Velocity stays on the nodes.
impl<V> Remap<V> for () {
    #[inline(always)]
    fn remap(&mut self, _: StepEnd<V>, _: &mut [V]) -> f64 {
        0.0
    }
    fn bytes(&self) -> usize {
        0
    }
}

/// A point that carries velocity.
#[derive(Debug, Clone, Copy)]
struct Carrier {
    node: usize,
    mass: f64,
    velocity: [f64; 3],
}

keep_fields!(Carrier: velocity; rebuilt node, mass);

/// The points of a run and their way to the nodes.
#[derive(Debug, Clone)]
pub struct Carriers<V, const N: usize> {
    carriers: Vec<Carrier>,
    /// Values of the functions of its nodes, of each.
    values: Vec<[f64; N]>,
    offsets: [usize; N],
    mapped: Vec<V>,
    travel: Vec<V>,
}

impl<V: Copy + Default + AsRef<[f64]> + AsMut<[f64]>, const N: usize> Carriers<V, N> {
    /// Carriers for `points` (first node, point) on `nodes` nodes, all at `velocity`.
    #[must_use]
    pub fn new(points: &[(u32, Point<N>)], offsets: [usize; N], nodes: usize, velocity: V) -> Self {
        let mut start = [0.0; 3];
        for (a, b) in start.iter_mut().zip(velocity.as_ref()) {
            *a = *b;
        }
        let carry = |(node, p): &(u32, Point<N>)| Carrier {
            node: *node as usize,
            mass: p.volume,
            velocity: start,
        };
        Carriers {
            carriers: points.iter().map(carry).collect(),
            values: points.iter().map(|(_, p)| p.values).collect(),
            offsets,
            mapped: vec![V::default(); nodes],
            travel: vec![V::default(); nodes],
        }
    }

    /// Move on with `v`, then replace it by the momentum of the carriers over the nodal mass; returns the energy gained.
    fn deposit(&mut self, step: &StepEnd<V>, v: &mut [V]) -> f64 {
        let mut gain = 0.0;
        for (n, v) in v.iter_mut().enumerate() {
            // of a node by itself, so that additions of different nodes do not wait for each other
            let mut own = 0.0;
            for (k, v) in v.as_mut().iter_mut().enumerate() {
                let new = self.mapped[n].as_ref()[k] * step.recip_mass[n].as_ref()[k];
                own += 0.5 * step.mass[n] * (new * new - *v * *v)
                    + 0.5 * step.dt * step.force[n].as_ref()[k] * (*v - new);
                self.travel[n].as_mut()[k] += step.dt * *v;
                *v = new;
            }
            gain += own;
        }
        gain
    }

    fn size(&self) -> usize {
        std::mem::size_of_val(&self.carriers[..])
            + std::mem::size_of_val(&self.values[..])
            + 2 * std::mem::size_of_val(&self.mapped[..])
    }
}

impl<V: Keep, const N: usize> Keep for Carriers<V, N> {
    fn save(&self, tape: &mut Tape) {
        let Self {
            carriers,
            travel,
            values: _,
            offsets: _,
            mapped: _,
        } = self;
        carriers.as_slice().save(tape);
        travel.as_slice().save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        let Self {
            carriers,
            travel,
            values: _,
            offsets: _,
            mapped: _,
        } = self;
        carriers.as_mut_slice().load(tape)?;
        travel.as_mut_slice().load(tape)
    }
}

keep_fields!(impl [V: Keep, const N: usize] Blend<V, N>: carriers; rebuilt flip, rows);
keep_fields!(impl [V: Keep, const N: usize] Apic<V, N>: carriers; rebuilt arms);

/// The transfer a plan asks for, chosen once a step: the loops over points are those of the variants, and the solver
/// around them is compiled once for all.
#[derive(Debug, Clone)]
pub enum Exchange<V, const N: usize> {
    /// Velocity stays on the nodes.
    Persistent,
    /// FLIP, PIC, or between them.
    Blend(Box<Blend<V, N>>),
    /// Affine particle-in-cell.
    Apic(Box<Apic<V, N>>),
}

impl<V: Keep, const N: usize> Keep for Exchange<V, N> {
    fn save(&self, tape: &mut Tape) {
        match self {
            Exchange::Persistent => {}
            Exchange::Blend(blend) => blend.save(tape),
            Exchange::Apic(apic) => apic.save(tape),
        }
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        match self {
            Exchange::Persistent => Some(()),
            Exchange::Blend(blend) => blend.load(tape),
            Exchange::Apic(apic) => apic.load(tape),
        }
    }
}

impl<V, const N: usize> Remap<V> for Exchange<V, N>
where
    V: Copy + Default + Keep + Flat + AsRef<[f64]> + AsMut<[f64]>,
{
    fn remap(&mut self, step: StepEnd<V>, v: &mut [V]) -> f64 {
        match self {
            Exchange::Persistent => 0.0,
            Exchange::Blend(blend) => blend.remap(step, v),
            Exchange::Apic(apic) => apic.remap(step, v),
        }
    }

    fn travel<'a>(&'a self, u: &'a [V]) -> &'a [V] {
        match self {
            Exchange::Persistent => u,
            Exchange::Blend(blend) => blend.travel(u),
            Exchange::Apic(apic) => apic.travel(u),
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Exchange::Persistent => 0,
            Exchange::Blend(blend) => blend.bytes(),
            Exchange::Apic(apic) => apic.bytes(),
        }
    }
}

/// FLIP, PIC, or between them: $v_p \leftarrow \alpha (v_p + \sum_i N_{ip} \Delta v_i) + (1 - \alpha) \sum_i N_{ip} v_i$.
#[derive(Debug, Clone)]
pub struct Blend<V, const N: usize> {
    /// The points.
    carriers: Carriers<V, N>,
    /// Share $\alpha$ of FLIP.
    flip: f64,
    /// Functions of cubic splines by rows of four nodes, in place of the values: those of the first direction, then what each row has in
    /// common, of each point.
    rows: Vec<f64>,
}

impl<V: Copy + Default + Keep + Flat + AsRef<[f64]> + AsMut<[f64]>, const N: usize> Blend<V, N> {
    /// Functions of a row, then rows of a point.
    const STRIDE: usize = WIDTH + N / WIDTH;

    /// For `points`, with the share `flip` of FLIP.
    #[must_use]
    pub fn new(mut carriers: Carriers<V, N>, points: &[(u32, Point<N>)], flip: f64) -> Self {
        let mut rows = Vec::new();
        if N == WIDTH.pow(V::COMPONENTS as u32) {
            carriers.values = Vec::new();
            for (_, point) in points {
                let [first, second, third] = point.factors.map(|[values, _]| values);
                rows.extend(first);
                rows.extend((0..N / WIDTH).map(|row| match V::COMPONENTS {
                    2 => second[row],
                    _ => second[row % WIDTH] * third[row / WIDTH],
                }));
            }
        }
        Blend {
            carriers,
            flip,
            rows,
        }
    }

    /// Velocities of the points and momenta of the nodes, row by row, with whatever vector instructions the machine has.
    fn by_rows(&mut self, old: &[V], new: &[V]) {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma")
        {
            // SAFETY: the features were detected on the lines above.
            return unsafe { self.by_rows_avx2(old, new) };
        }
        self.by_rows_any(old, new);
    }

    /// [`Self::by_rows`] compiled for 256-bit registers.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    fn by_rows_avx2(&mut self, old: &[V], new: &[V]) {
        self.by_rows_any(old, new);
    }

    #[allow(clippy::needless_range_loop)] // iterators are not always inlined
    #[inline(always)]
    fn by_rows_any(&mut self, old: &[V], new: &[V]) {
        let components = V::COMPONENTS;
        let Carriers {
            carriers,
            offsets,
            mapped,
            ..
        } = &mut self.carriers;
        let (old, new, mapped) = (V::flat(old), V::flat(new), V::flat_mut(mapped));
        for index in 0..carriers.len() {
            let p = &mut carriers[index];
            let f = &self.rows[index * Self::STRIDE..][..Self::STRIDE];
            let (mut change, mut here) = ([Lanes::default(); 3], [Lanes::default(); 3]);
            for row in 0..N / WIDTH {
                let at = (p.node + offsets[row * WIDTH]) * components;
                let old = &old[at..][..WIDTH * components];
                let new = &new[at..][..WIDTH * components];
                let weight = Lanes::splat(f[WIDTH + row]);
                for k in 0..components {
                    let now = loaded(new, k);
                    change[k] = (now - loaded(old, k)).mul_add(weight, change[k]);
                    here[k] = now.mul_add(weight, here[k]);
                }
            }
            let values = spread(&f[..WIDTH], components);
            let change = folded(&change, &values, components);
            let here = folded(&here, &values, components);
            for k in 0..components {
                p.velocity[k] =
                    self.flip * (p.velocity[k] + change[k]) + (1.0 - self.flip) * here[k];
            }
            let mut terms = [Lanes::default(); 3];
            for k in 0..components {
                let of = |lane: usize| p.mass * p.velocity[(WIDTH * k + lane) % components];
                terms[k] = values[k] * Lanes::each(of);
            }
            for row in 0..N / WIDTH {
                let at = (p.node + offsets[row * WIDTH]) * components;
                let to = &mut mapped[at..][..WIDTH * components];
                let weight = Lanes::splat(f[WIDTH + row]);
                for k in 0..components {
                    let sum = terms[k].mul_add(weight, loaded(to, k));
                    store(to, k, sum);
                }
            }
        }
    }

    /// The same node by node.
    #[allow(
        clippy::needless_range_loop,
        reason = "zipped iterators are not inlined here, and took as long as the forces"
    )]
    fn by_nodes(&mut self, old: &[V], new: &[V]) {
        let Carriers {
            carriers,
            values,
            offsets,
            mapped,
            ..
        } = &mut self.carriers;
        for index in 0..carriers.len() {
            let (p, values) = (&mut carriers[index], &values[index]);
            let (mut change, mut here) = ([0.0; 3], [0.0; 3]);
            for n in 0..N {
                let (value, node) = (values[n], p.node + offsets[n]);
                let (new, old) = (new[node].as_ref(), old[node].as_ref());
                for k in 0..new.len() {
                    change[k] += value * (new[k] - old[k]);
                    here[k] += value * new[k];
                }
            }
            for k in 0..3 {
                p.velocity[k] =
                    self.flip * (p.velocity[k] + change[k]) + (1.0 - self.flip) * here[k];
            }
            for n in 0..N {
                let share = p.mass * values[n];
                let to = mapped[p.node + offsets[n]].as_mut();
                for k in 0..to.len() {
                    to[k] += share * p.velocity[k];
                }
            }
        }
    }
}

impl<V: Copy + Default + Keep + Flat + AsRef<[f64]> + AsMut<[f64]>, const N: usize> Remap<V>
    for Blend<V, N>
{
    fn remap(&mut self, step: StepEnd<V>, v: &mut [V]) -> f64 {
        self.carriers.mapped.fill(V::default());
        match self.rows.is_empty() {
            true => self.by_nodes(step.old, v),
            false => self.by_rows(step.old, v),
        }
        self.carriers.deposit(&step, v)
    }

    fn travel<'a>(&'a self, _: &'a [V]) -> &'a [V] {
        &self.carriers.travel
    }

    fn bytes(&self) -> usize {
        self.carriers.size() + std::mem::size_of_val(&self.rows[..])
    }
}

/// Affine particle-in-cell: $v_p = \sum_i N_{ip} v_i$, $C_p = \sum_i N_{ip} v_i (x_i - x_p)^T D_p^{-1}$, and nodes get
/// $v_p + C_p (x_i - x_p)$ (Jiang, Schroeder, Selle, Teran and Stomakhin 2015).
#[derive(Debug, Clone)]
pub struct Apic<V, const N: usize> {
    carriers: Carriers<V, N>,
    /// $D_p^{-1} (x_i - x_p)$ and $x_i - x_p$ of every node of every point.
    arms: Vec<[[[f64; 3]; 2]; N]>,
}

impl<V: Copy + Default + AsRef<[f64]> + AsMut<[f64]>, const N: usize> Apic<V, N> {
    /// For `points`, whose nodes lie at `places` (Greville points, so that affine fields are exact).
    #[must_use]
    pub fn new(carriers: Carriers<V, N>, points: &[(u32, Point<N>)], places: &[V]) -> Self {
        let dimensions = V::default().as_ref().len();
        let arms = points
            .iter()
            .map(|(node, p)| {
                let mut reach = [[0.0; 3]; N];
                for (reach, offset) in reach.iter_mut().zip(&carriers.offsets) {
                    for (k, x) in places[*node as usize + offset].as_ref().iter().enumerate() {
                        reach[k] = x - p.position[k];
                    }
                }
                affine(&reach, &p.values, dimensions)
            })
            .collect();
        Apic { carriers, arms }
    }
}

/// $D^{-1} x$ and $x$ for the arms `reach` weighted by `values`; unused dimensions get a unit diagonal.
fn affine<const N: usize>(
    reach: &[[f64; 3]; N],
    values: &[f64; N],
    dimensions: usize,
) -> [[[f64; 3]; 2]; N] {
    let mut d = nalgebra::Matrix3::<f64>::zeros();
    for (x, value) in reach.iter().zip(values) {
        for i in 0..dimensions {
            for j in 0..dimensions {
                d[(i, j)] += value * x[i] * x[j];
            }
        }
    }
    for k in dimensions..3 {
        d[(k, k)] = 1.0;
    }
    // a point on a node of linear splines has no spread along a direction: no slope there
    let inverse = d.try_inverse().unwrap_or_else(nalgebra::Matrix3::zeros);
    std::array::from_fn(|a| {
        let x = nalgebra::Vector3::from(reach[a]);
        [(inverse * x).into(), reach[a]]
    })
}

impl<V: Copy + Default + Keep + AsRef<[f64]> + AsMut<[f64]>, const N: usize> Remap<V>
    for Apic<V, N>
{
    fn remap(&mut self, step: StepEnd<V>, v: &mut [V]) -> f64 {
        let Carriers {
            carriers,
            values,
            offsets,
            mapped,
            ..
        } = &mut self.carriers;
        mapped.fill(V::default());
        for ((p, values), arms) in carriers.iter_mut().zip(values).zip(&self.arms) {
            let (mut mean, mut slope) = ([0.0; 3], [[0.0; 3]; 3]);
            for ((value, offset), [dual, _]) in values.iter().zip(offsets.iter()).zip(arms) {
                for (k, x) in v[p.node + *offset].as_ref().iter().enumerate() {
                    mean[k] += value * x;
                    for (s, d) in slope[k].iter_mut().zip(dual) {
                        *s += value * x * d;
                    }
                }
            }
            p.velocity = mean;
            for ((value, offset), [_, arm]) in values.iter().zip(offsets.iter()).zip(arms) {
                let share = p.mass * value;
                for (k, m) in mapped[p.node + *offset].as_mut().iter_mut().enumerate() {
                    let turn: f64 = slope[k].iter().zip(arm).map(|(s, x)| s * x).sum();
                    *m += share * (mean[k] + turn);
                }
            }
        }
        self.carriers.deposit(&step, v)
    }

    fn travel<'a>(&'a self, _: &'a [V]) -> &'a [V] {
        &self.carriers.travel
    }

    fn bytes(&self) -> usize {
        self.carriers.size() + std::mem::size_of_val(&self.arms[..])
    }
}
