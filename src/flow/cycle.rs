//! A multigrid cycle on groups of cells, which preconditions the conjugate gradients.

use super::laplacian::Laplacian;
use crate::chunks::{self, dot};

/// Of the strongest conductance of a cell, the part that another one needs for a pair.
const STRONG: f64 = 0.25;
/// Where pairing leaves more than this part of the cells, there are no coarser levels.
const WORTHWHILE: f64 = 0.9;
/// Steps of conjugate gradients on a coarse level.
const COARSE_STEPS: usize = 2;

/// How cells are grouped: into pairs of pairs on the finest levels, and into pairs on all coarser ones.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum GroupSize {
    /// Pairs of pairs on four levels. A step costs a third of one with small groups, and as few are needed where channels are wide.
    Large,
    /// Pairs of pairs on one level. Where the contact nearly seals, 14 steps are needed instead of 170.
    Small,
}

impl GroupSize {
    /// The number of levels of pairs of pairs.
    fn levels(self) -> usize {
        match self {
            Self::Large => 4,
            Self::Small => 1,
        }
    }
}

/// A preconditioner for the matrix of a network: cells are grouped along their strongest conductances, first into pairs of pairs and then
/// into pairs again and again. Each level is solved by a sweep of Gauss and Seidel, two steps of conjugate gradients on the next level,
/// and a sweep in the opposite order.
///
/// A pressure that is constant on each group is interpolated by its value. So the matrix of a level is that of a network
/// too, with the conductances between groups added up. It depends on conductances alone, which may differ by many orders
/// of magnitude, and not on the geometry, so that channels of any form are seen.
///
/// # Source
/// Notay, Electron. Trans. Numer. Anal. 37, 123 (2010): aggregation by pairwise matching, and the K-cycle. Deviations: the size of the groups, and
/// that cells without a free partner join a group.
pub(super) struct GroupCycle {
    /// From fine to coarse.
    levels: Vec<CycleLevel>,
}

/// A level of the cycle, with room for what is computed on it: new room in each cycle would cost more than a sweep.
struct CycleLevel {
    matrix: Laplacian,
    /// The groups of its cells on the next level; none on the last one.
    groups: Vec<u32>,
    /// The approximate solution.
    z: Vec<f64>,
    /// The conjugate gradients; on the finest level they are those of the caller.
    gradients: Gradients,
}

impl CycleLevel {
    fn new(matrix: Laplacian, is_coarse: bool) -> Self {
        let (z, cells) = (vec![0.0; matrix.cells()], if is_coarse { matrix.cells() } else { 0 });
        let gradients = Gradients::new(vec![0.0; cells], vec![0.0; cells]);
        Self { matrix, groups: Vec::new(), z, gradients }
    }
}

impl GroupCycle {
    /// The levels below a matrix.
    pub fn new(matrix: Laplacian, size: GroupSize) -> Self {
        Self { levels: vec![CycleLevel::new(matrix, false)] }.with_groups(size)
    }

    /// The cycle of the same equations with groups of another size. The finest groups are the same.
    pub fn with_groups(mut self, size: GroupSize) -> Self {
        let levels = &mut self.levels;
        levels.truncate(1 + GroupSize::Small.levels());
        for level in levels.len() - 1.. {
            let fine = &levels[level].matrix;
            let coarser = if level < size.levels() { pairs_of_pairs(fine) } else { paired(fine) };
            let Some((coarse, of)) = coarser else {
                levels[level].groups.clear();
                break;
            };
            levels[level].groups = of;
            levels.push(CycleLevel::new(coarse, true));
        }
        self
    }

    /// A step of conjugate gradients on the finest level, preconditioned by the cycle, see [`Gradients::step`].
    pub fn step(&mut self, gradients: &mut Gradients) -> Option<f64> {
        relax(&mut self.levels, &gradients.residual);
        gradients.step(&self.levels[0].matrix, &self.levels[0].z)
    }
}

/// An approximate solution of `A z = r` on the first of some levels.
fn relax(levels: &mut [CycleLevel], r: &[f64]) {
    let Some((CycleLevel { matrix, groups, z, .. }, coarser)) = levels.split_first_mut() else { return };
    matrix.sweep_from_zero(r, z);
    if !groups.is_empty() {
        let mut gradients = std::mem::take(&mut coarser[0].gradients);
        gradients.start_from_zero();
        (0..r.len()).for_each(|cell| gradients.residual[groups[cell] as usize] += matrix.rest_of_sweep(cell, z));
        for _ in 0..COARSE_STEPS {
            relax(coarser, &gradients.residual);
            if gradients.step(&coarser[0].matrix, &coarser[0].z).is_none() {
                break;
            }
        }
        chunks::update(z, |range, z| {
            z.iter_mut().zip(&groups[range]).for_each(|(z, group)| *z += gradients.x[*group as usize]);
        });
        coarser[0].gradients = gradients;
    }
    matrix.sweep_back(r, z);
}

/// Flexible conjugate gradients, for a preconditioner that is not quite linear.
#[derive(Default)]
pub(super) struct Gradients {
    /// The solution so far.
    pub x: Vec<f64>,
    /// `b - A x`.
    pub residual: Vec<f64>,
    direction: Vec<f64>,
    product: Vec<f64>,
    /// `<d A d>` of the last direction.
    curvature: f64,
}

impl Gradients {
    /// Starts at `x`, whose residual is given.
    pub fn new(x: Vec<f64>, residual: Vec<f64>) -> Self {
        let [direction, product] = [(); 2].map(|()| vec![0.0; x.len()]);
        Self { x, residual, direction, product, curvature: 0.0 }
    }

    /// Begins again at zero. The residual is zero until the right side is added to it.
    fn start_from_zero(&mut self) {
        self.x.fill(0.0);
        self.residual.fill(0.0);
        self.curvature = 0.0;
    }

    /// A step along the preconditioned residual `z`, made conjugate to the last direction. Returns by how much the power
    /// `<x A x> - 2 <b x>` falls, or none where no step lowers it.
    fn step(&mut self, matrix: &Laplacian, z: &[f64]) -> Option<f64> {
        let overlap = if self.curvature > 0.0 { dot(z, &self.product) / self.curvature } else { 0.0 };
        chunks::update(&mut self.direction, |range, d| {
            d.iter_mut().zip(range).for_each(|(d, i)| *d = z[i] - overlap * *d);
        });
        matrix.apply(&self.direction, &mut self.product);
        self.curvature = dot(&self.direction, &self.product);
        let slope = dot(&self.direction, &self.residual);
        if !(self.curvature > 0.0 && slope > 0.0) {
            return None;
        }
        let length = slope / self.curvature;
        let Self { x, residual, direction, product, .. } = self;
        chunks::update_both(x, residual, |range, x, r| {
            for ((x, r), i) in x.iter_mut().zip(r).zip(range) {
                *x += length * direction[i];
                *r -= length * product[i];
            }
        });
        Some(slope * length)
    }
}

/// The level of pairs of pairs, if there are many, and the group of each cell.
fn pairs_of_pairs(fine: &Laplacian) -> Option<(Laplacian, Vec<u32>)> {
    let (pairs, mut of) = paired(fine)?;
    let Some((coarse, of_pair)) = paired(&pairs) else { return Some((pairs, of)) };
    of.iter_mut().for_each(|group| *group = of_pair[*group as usize]);
    Some((coarse, of))
}

/// The level of pairs, if there are many, and the group of each cell.
fn paired(fine: &Laplacian) -> Option<(Laplacian, Vec<u32>)> {
    let (of, groups) = pairs(fine);
    ((groups as f64) < WORTHWHILE * fine.cells() as f64).then(|| (fine.grouped(&of, groups), of))
}

/// Each cell is paired with the one that is free and whose conductance is largest, if that is strong. If there is none, it joins the
/// group of the cell to which its conductance is largest. The groups of cells, and their number.
fn pairs(matrix: &Laplacian) -> (Vec<u32>, usize) {
    let mut of = vec![u32::MAX; matrix.cells()];
    let mut groups = 0;
    for cell in 0..matrix.cells() {
        if of[cell] != u32::MAX {
            continue;
        }
        let links = matrix.links(cell);
        let Some((nearest, strongest)) = links.clone().max_by(|a, b| a.1.total_cmp(&b.1)) else {
            of[cell] = groups;
            groups += 1;
            continue;
        };
        let free = links.filter(|&(other, conductance)| of[other] == u32::MAX && conductance >= STRONG * strongest);
        match free.max_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((partner, _)) => {
                (of[cell], of[partner]) = (groups, groups);
                groups += 1;
            }
            None => of[cell] = of[nearest],
        }
    }
    (of, groups as usize)
}
