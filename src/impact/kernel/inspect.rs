//! What is done with points outside the hot loop: looked at, kept, swept cell by cell, weakened.

use super::part::Level;
use crate::impact::kernel::{Cell, Part, Point, Points, Purpose, Sweep};
use crate::lanes::{Lanes, WIDTH};
use crate::material::stress::Kinematics;
use crate::space::{Space, Symmetric};
use crate::tape::{Keep, Tape};

/// A material point as a person would look at it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointView {
    /// Deformed position.
    pub position: [f64; 3],
    /// Reference position.
    pub reference: [f64; 3],
    /// Reference volume.
    pub volume: f64,
    /// Accumulated equivalent plastic strain.
    pub plastic_strain: f64,
    /// Von Mises (Cauchy) stress.
    pub von_mises: f64,
    /// Pressure, minus the mean (Cauchy) stress; of viscous stresses nothing.
    pub pressure: f64,
    /// Temperature, K, of matter that knows one.
    pub temperature: Option<f64>,
}

/// How warm points are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Warmth {
    /// Share of the plastic work that became heat.
    pub share: f64,
    /// Highest temperature, K.
    pub hottest: f64,
    /// Volume mean, K.
    pub mean: f64,
}

impl<S: Space, const N: usize> Keep for Points<S, N> {
    fn save(&self, tape: &mut Tape) {
        let Self {
            matter,
            shock,
            cells,
            levels,
            clock,
            offsets: _,
            factors: _,
            scattered: _,
            volumes: _,
            scratch: _,
            partial: _,
            cold: _,
            moduli: _,
            own_volume: _,
        } = self;
        matter.save(tape);
        shock.save(tape);
        clock.save(tape);
        let left = cells.iter().map(|c| (c.first, (c.strength, c.moved)));
        left.collect::<Vec<_>>().save(tape);
        let ends: Vec<usize> = levels.iter().map(|l| l.end).collect();
        ends.save(tape);
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        self.matter.load(tape)?;
        self.shock.load(tape)?;
        self.clock.load(tape)?;
        let mut left: Vec<(u32, (f64, f64))> = Vec::new();
        left.load(tape)?;
        let kept = |(first, (strength, moved)): &(u32, (f64, f64))| {
            let place = self.cells.binary_search_by_key(first, |c| c.first).ok()?;
            let cell = self.cells[place];
            Some(Cell {
                strength: *strength,
                moved: *moved,
                ..cell
            })
        };
        // a resumed run has its cells in the order in which they were laid
        self.cells = left.iter().map(kept).collect::<Option<_>>()?;
        let mut ends: Vec<usize> = Vec::new();
        ends.load(tape)?;
        if !ends.is_sorted() || ends.last() != Some(&self.cells.len()) {
            return None;
        }
        let level = |end| Level {
            end,
            ..Level::default()
        };
        self.levels = ends.into_iter().map(level).collect();
        (0..self.levels.len()).for_each(|level| self.list_nodes(level));
        Some(())
    }
}

impl<S: Space, const N: usize> Points<S, N> {
    /// Sum over the points of reference volume times accumulated plastic strain.
    pub fn plastic_strain_volume(&self) -> f64 {
        let of_block =
            |(block, volume): (usize, &Lanes)| (self.matter.plastic_strain(block) * *volume).sum();
        self.volumes.iter().enumerate().map(of_block).sum()
    }

    /// Temperatures of matter that knows them, and the share of its plastic work that became heat.
    pub fn warmth(&self) -> Option<Warmth> {
        let (mut hottest, mut sum) = (0.0f64, 0.0);
        for (block, volume) in self.volumes.iter().enumerate() {
            let temperature = self.matter.temperature(block)?;
            // padding is as hot as the point it copies
            hottest = temperature.array().into_iter().fold(hottest, f64::max);
            sum += (temperature * *volume).sum();
        }
        Some(Warmth {
            share: self.matter.heat_share(),
            hottest,
            mean: sum / self.volume(),
        })
    }

    /// Every material point at displacements `u`, in a fixed order.
    pub fn view(&self, u: &[S::Vector]) -> Vec<PointView> {
        let mut all = Vec::with_capacity(self.cold.len());
        let own_bulk = 0.5 * self.moduli.bulk * self.own_volume;
        for cell in &self.cells {
            let mut cold = self.cold[cell.cold as usize..].iter();
            let blocks = cell.first as usize..cell.last as usize;
            let volume =
                |block| S::determinant(&self.gradient_of(cell, block, u)) * self.volumes[block];
            let volume: f64 = blocks.clone().map(|block| volume(block).sum()).sum();
            let mean =
                self.moduli.volumetric_stress(volume / cell.volume) * (1.0 - self.own_volume);
            for block in blocks {
                let f = self.gradient_of(cell, block, u);
                let j = S::determinant(&f);
                let kinematics = Kinematics {
                    gradient: f,
                    recip_j: j.recip(),
                    recip_cbrt_j: j.recip_cbrt(),
                };
                let trial = self.matter.trial(&kinematics, block);
                let mises = (trial.deviator.squared_norm() * 1.5).sqrt() * j.recip();
                let own = (j * j - Lanes::splat(1.0)) * j.recip() * own_bulk;
                let pressure = (Lanes::splat(mean) + own) * -cell.strength;
                let temperature = self.matter.temperature(block).map(|t| t.array());
                let strain = self.matter.plastic_strain(block);
                for lane in 0..WIDTH {
                    if self.volumes[block].array()[lane] > 0.0
                        && let Some((node, point)) = cold.next()
                    {
                        all.push(PointView {
                            position: self.displaced(*node as usize, point, u),
                            reference: point.position,
                            volume: point.volume,
                            plastic_strain: strain.array()[lane],
                            von_mises: mises.array()[lane],
                            pressure: pressure.array()[lane],
                            temperature: temperature.map(|t| t[lane]),
                        });
                    }
                }
            }
        }
        all
    }

    /// Whether the cell whose first node is `node` has not been taken out.
    pub fn carries(&self, node: usize) -> bool {
        self.cells.iter().any(|cell| cell.node as usize == node)
    }

    /// Least height of a material point at displacements `u`; NaN as soon as one point's is.
    pub fn lowest(&self, u: &[S::Vector]) -> f64 {
        let mut lowest = f64::INFINITY;
        for cell in &self.cells {
            let mut cold = self.cold[cell.cold as usize..].iter();
            for volumes in &self.volumes[cell.first as usize..cell.last as usize] {
                let filled = volumes.array().into_iter().filter(|v| *v > 0.0);
                for (_, (node, point)) in filled.zip(&mut cold) {
                    let mut height = point.position[S::NORMAL];
                    for (value, offset) in point.values.iter().zip(self.offsets) {
                        height += value * u[*node as usize + offset].as_ref()[S::NORMAL];
                    }
                    lowest = if height >= lowest { lowest } else { height };
                }
            }
        }
        lowest
    }

    /// Deformed position of a point whose nodes start at `node`.
    fn displaced(&self, node: usize, point: &Point<N>, u: &[S::Vector]) -> [f64; 3] {
        let mut x = point.position;
        for (a, value) in point.values.iter().enumerate() {
            for (x, u) in x.iter_mut().zip(u[node + self.offsets[a]].as_ref()) {
                *x += value * u;
            }
        }
        x
    }

    /// What `seen` makes of a sweep over each cell of a part alone and of the forces on its nodes, in the order of the cells.
    pub fn one_by_one<T>(
        &mut self,
        part: Part,
        purpose: Purpose,
        u: &[S::Vector],
        mut seen: impl FnMut(&Sweep, &[(usize, S::Vector)]) -> T,
    ) -> Vec<T> {
        self.partial.clear();
        self.partial
            .resize(u.len() * S::DIRECTIONS, Lanes::default());
        let mut answers = Vec::with_capacity(self.cells.len());
        for index in self.range(part) {
            let sweep = self.pass(index..index + 1, purpose, u);
            let first = self.cells[index].node as usize;
            let forces = self.offsets.map(|offset| {
                let node = first + offset;
                let mut force = S::Vector::default();
                let lanes = &mut self.partial[node * S::DIRECTIONS..][..S::DIRECTIONS];
                for (x, lanes) in force.as_mut().iter_mut().zip(lanes) {
                    *x = 0.0 - std::mem::take(lanes).sum();
                }
                (node, force)
            });
            answers.push(seen(&sweep, &forces));
        }
        answers
    }

    /// Let each cell of a part carry the share `left` of what it carries now; a cell with less than `least` of its strength
    /// is taken out (its mass stays on the nodes). Returns the volume that lost its strength in this.
    pub fn weaken(&mut self, part: Part, left: &[f64], least: f64) -> f64 {
        let mut lost = 0.0;
        let mut index = 0;
        let range = self.range(part);
        let mut gone = Vec::new();
        self.cells.retain_mut(|cell| {
            let before = cell.strength;
            if range.contains(&index) {
                cell.strength *= left[index - range.start];
            }
            let stays = cell.strength >= least;
            lost += cell.volume * (before - if stays { cell.strength } else { 0.0 });
            if !stays {
                gone.push(index);
            }
            index += 1;
            stays
        });
        for level in &mut self.levels {
            level.end -= gone.partition_point(|index| *index < level.end);
        }
        lost
    }

    /// Reference volume of all points.
    pub fn volume(&self) -> f64 {
        self.volumes.iter().map(|v| v.sum()).sum()
    }
}
