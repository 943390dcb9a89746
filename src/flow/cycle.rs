//! A multigrid cycle on groups of cells, which preconditions the conjugate gradients.

use super::balance::Balance;
use super::laplacian::Laplacian;
use super::network::Network;
use crate::chunks::{self, dot};

/// Of the strongest conductance of a cell, the part that another one needs for a pair.
const STRONG: f64 = 0.25;
/// Where pairing leaves more than this part of the cells, there are no coarser levels.
const WORTHWHILE: f64 = 0.9;
/// Steps of conjugate gradients on a coarse level.
const COARSE_STEPS: usize = 2;

/// How cells are grouped: on the finest levels into pairs of pairs or into pairs of those, and into pairs on all coarser ones.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum GroupSize {
    /// Groups of 4, 8 and 4 on three levels. A step costs less than one with small groups, and about as few are needed where channels are wide.
    Large,
    /// Groups of 4 on one level. Where the contact nearly seals, far fewer steps are needed than with large groups.
    Small,
}

impl GroupSize {
    /// How many times cells are paired from a level to the next one.
    fn pairings(self, level: usize) -> usize {
        let of_finest: &[usize] = match self {
            Self::Large => &[2, 3, 2],
            Self::Small => &[2],
        };
        of_finest.get(level).copied().unwrap_or(1)
    }
}

/// A preconditioner for the matrix of a network: cells are grouped along their strongest conductances, into pairs and these into pairs
/// again and again. Each level is solved by a sweep of Gauss and Seidel, two steps of conjugate gradients on the next level,
/// and a sweep in the opposite order.
///
/// A pressure that is constant on each group is interpolated by its value. So the matrix of a level is that of a network
/// too, with the conductances between groups added up. It depends on conductances alone, which may differ by many orders
/// of magnitude, and not on the geometry, so that channels of any form are seen.
///
/// # Source
/// Notay, Electron. Trans. Numer. Anal. 37, 123 (2010): aggregation by pairwise matching, and the K-cycle. Deviations: the size of the groups, and
/// that cells without a free partner join a group.
pub(super) struct GroupCycle<'a> {
    network: &'a Network,
    room: CycleRoom,
    /// The groups, from fine to coarse.
    levels: Vec<CycleLevel>,
}

/// A level of groups.
struct CycleLevel {
    matrix: Laplacian,
    /// The conjugate gradients on this level.
    gradients: Gradients,
    room: CycleRoom,
}

/// Room for what is computed on a level: new room in each cycle would cost more than a sweep.
struct CycleRoom {
    /// The groups of its cells on the next level; none on the last one.
    groups: Vec<u32>,
    /// The approximate solution.
    z: Vec<f64>,
}

impl CycleRoom {
    fn new(cells: usize) -> Self {
        Self { groups: Vec::new(), z: vec![0.0; cells] }
    }
}

impl CycleLevel {
    fn new(matrix: Laplacian) -> Self {
        let cells = matrix.cells();
        Self { matrix, gradients: Gradients::new(vec![0.0; cells], vec![0.0; cells]), room: CycleRoom::new(cells) }
    }
}

impl<'a> GroupCycle<'a> {
    /// The groups of a network.
    pub(crate) fn new(network: &'a Network, size: GroupSize) -> Self {
        Self { network, room: CycleRoom::new(network.cells()), levels: Vec::new() }.with_groups(size)
    }

    /// The cycle of the same equations with groups of another size. The finest groups are the same.
    pub(crate) fn with_groups(mut self, size: GroupSize) -> Self {
        self.levels.truncate(1);
        loop {
            let pairings = size.pairings(self.levels.len());
            let (coarser, room) = match self.levels.last_mut() {
                None => (grouped(self.network, pairings), &mut self.room),
                Some(level) => (grouped(&level.matrix, pairings), &mut level.room),
            };
            let Some((coarse, of)) = coarser else { return self };
            room.groups = of;
            self.levels.push(CycleLevel::new(coarse));
        }
    }

    /// A step of conjugate gradients on the finest level, preconditioned by the cycle, see [`Gradients::step`].
    pub(crate) fn step(&mut self, gradients: &mut Gradients) -> Option<f64> {
        relax(self.network, &mut self.room, &mut self.levels, &gradients.residual);
        gradients.step(self.network, &self.room.z)
    }
}

/// An approximate solution of `A z = r` on a level, by all coarser ones.
fn relax(matrix: &impl Balance, room: &mut CycleRoom, coarser: &mut [CycleLevel], r: &[f64]) {
    let CycleRoom { groups, z } = room;
    matrix.sweep_from_zero(r, z);
    if let Some((CycleLevel { matrix: coarse, gradients, room }, coarser)) = coarser.split_first_mut() {
        gradients.start_from_zero();
        matrix.add_rest_of_sweep(z, groups, &mut gradients.residual);
        for _ in 0..COARSE_STEPS {
            relax(coarse, room, coarser, &gradients.residual);
            if gradients.step(coarse, &room.z).is_none() {
                break;
            }
        }
        chunks::update(z, |range, z| {
            z.iter_mut().zip(&groups[range]).for_each(|(z, group)| *z += gradients.x[*group as usize]);
        });
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
    pub(crate) fn new(x: Vec<f64>, residual: Vec<f64>) -> Self {
        let [direction, product] = [(); 2].map(|()| chunks::touched(x.len()));
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
    fn step(&mut self, matrix: &impl Balance, z: &[f64]) -> Option<f64> {
        let overlap = if self.curvature > 0.0 { dot(z, &self.product) / self.curvature } else { 0.0 };
        chunks::update(&mut self.direction, |range, d| {
            if overlap == 0.0 {
                return d.copy_from_slice(&z[range]);
            }
            d.iter_mut().zip(&z[range]).for_each(|(d, z)| *d = z - overlap * *d);
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
            x.iter_mut().zip(&direction[range.clone()]).for_each(|(x, d)| *x += length * d);
            r.iter_mut().zip(&product[range]).for_each(|(r, product)| *r -= length * product);
        });
        Some(slope * length)
    }
}

/// The level of cells that are paired some times, as long as many find a partner, and the group of each cell.
fn grouped(fine: &impl Balance, pairings: usize) -> Option<(Laplacian, Vec<u32>)> {
    let (mut coarse, mut of) = paired(fine)?;
    for _ in 1..pairings {
        let Some((pairs, of_pair)) = paired(&coarse) else { break };
        of.iter_mut().for_each(|group| *group = of_pair[*group as usize]);
        coarse = pairs;
    }
    Some((coarse, of))
}

/// The level of pairs, if there are many, and the group of each cell.
fn paired(fine: &impl Balance) -> Option<(Laplacian, Vec<u32>)> {
    let (of, groups) = pairs(fine);
    ((groups as f64) < WORTHWHILE * fine.cells() as f64).then(|| (Laplacian::new(fine, &of, groups), of))
}

/// Each cell is paired with the one that is free and whose conductance is largest, if that is strong. If there is none, it joins the
/// group of the cell to which its conductance is largest. A cell through which nothing flows joins the first group, which does not change
/// that one. The groups of cells, and their number.
fn pairs(matrix: &impl Balance) -> (Vec<u32>, usize) {
    let mut of = vec![u32::MAX; matrix.cells()];
    let mut groups = 0;
    for cell in 0..matrix.cells() {
        if of[cell] != u32::MAX {
            continue;
        }
        let links = matrix.links(cell);
        let Some((nearest, strongest)) = links.clone().max_by(|a, b| a.1.total_cmp(&b.1)) else {
            let is_joined = matrix.to_sides(cell) > 0.0;
            of[cell] = if is_joined { groups } else { 0 };
            groups += u32::from(is_joined);
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
