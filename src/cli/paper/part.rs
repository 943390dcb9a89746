//! The parts of the paper.

use super::study::Study;
use super::{Made, beyond, fig1, fig2, fig3, fig4, fig5, gw, table1};
use anyhow::Result;
use clap::ValueEnum;

/// A table, a figure or a section of the paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Part {
    /// Contact parameters of cylinder and sphere
    Table1,
    /// kappa_r of cylinder and sphere against p_r*
    Fig1,
    /// Rough lines: a_rel, kappa and kappa_r
    Fig2,
    /// Fits of Eq. 11 to the points of fig2
    Fig3,
    /// Rough surfaces: a_rel, kappa and kappa_r
    Fig4,
    /// Lines over surfaces, from the points of fig2 and fig4
    Fig5,
    /// Section 6: Greenwood and Williamson with the gradient over the contact
    Gw,
    /// What the paper leaves out: power-law indenters, and a sine to full contact
    Beyond,
    /// All of these
    All,
}

impl Part {
    /// Those that make something.
    pub const EACH: [Self; 8] =
        [Self::Table1, Self::Fig1, Self::Fig2, Self::Fig3, Self::Fig4, Self::Fig5, Self::Gw, Self::Beyond];

    /// The parts asked for, each once.
    pub fn expand(asked: &[Self]) -> Vec<Self> {
        let mut parts: Vec<Self> = Vec::new();
        for &part in asked {
            let new = if part == Self::All { Self::EACH.to_vec() } else { vec![part] };
            new.into_iter().for_each(|part| parts.extend((!parts.contains(&part)).then_some(part)));
        }
        parts
    }

    /// Its name, as on the command line and in file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Table1 => "table1",
            Self::Fig1 => "fig1",
            Self::Fig2 => "fig2",
            Self::Fig3 => "fig3",
            Self::Fig4 => "fig4",
            Self::Fig5 => "fig5",
            Self::Gw => "gw",
            Self::Beyond => "beyond",
            Self::All => "all",
        }
    }

    /// The parts whose points it needs.
    pub fn tables(self) -> &'static [Self] {
        match self {
            Self::Table1 => &[Self::Table1],
            Self::Fig1 => &[Self::Fig1],
            Self::Fig2 | Self::Fig3 => &[Self::Fig2],
            Self::Fig4 => &[Self::Fig4],
            Self::Fig5 => &[Self::Fig2, Self::Fig4],
            Self::Beyond => &[Self::Beyond],
            Self::Gw | Self::All => &[],
        }
    }

    /// Refuses what cannot be, before anything is solved.
    pub fn check(self, study: &Study) -> Result<()> {
        self.tables().iter().try_for_each(|&table| study.check(table))
    }

    /// The surfaces and loads behind its points.
    pub fn realisations(self, study: &Study) -> Result<Vec<asperity::study::Realisation>> {
        match self {
            Self::Table1 => table1::realisations(study),
            Self::Fig1 => fig1::realisations(study),
            Self::Fig2 => fig2::realisations(study),
            Self::Fig4 => fig4::realisations(study),
            Self::Beyond => beyond::realisations(study),
            Self::Fig3 | Self::Fig5 | Self::Gw | Self::All => Ok(Vec::new()),
        }
    }

    /// Makes it.
    pub fn make(self, study: &Study) -> Result<Made> {
        match self {
            Self::Table1 => table1::make(study),
            Self::Fig1 => fig1::make(study),
            Self::Fig2 => fig2::make(study),
            Self::Fig3 => fig3::make(study),
            Self::Fig4 => fig4::make(study),
            Self::Fig5 => fig5::make(study),
            Self::Gw => gw::make(study),
            Self::Beyond => beyond::make(study),
            Self::All => Ok(Made { figure: None, findings: Vec::new() }),
        }
    }
}
