//! The knobs of a file of heights, and its surface.

use super::refusal::{Refusal, RefusalRule};
use super::schema::MOST_POINTS;
use crate::formats::{HeightFile, Layout};
use crate::grid::Grid;
use crate::quantity::some_length;
use crate::sentence::{Sentence, sentence};
use crate::setup::{Boundary, Cell, Recipe};
use crate::surface::{Crop, Preparation, PreparationChoice};
use serde::{Deserialize, Serialize};

/// How often the steps are chosen anew for a smaller part of a file: mirror images make more points of it, and a smaller part
/// may need them where a larger one did not.
const MOST_CHOICES: usize = 3;

/// How the heights of a file are read and prepared. Lengths are in metres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct HeightKnobs {
    /// The hash of the file that they are for, as in a description; any file if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The channel, by name or number from 1 on; the first one of heights if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub channel: Option<String>,
    /// The unit of a file that states none.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_length")]
    pub unit: Option<f64>,
    /// The length of the whole file along x. The spacing along y is the same.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_length")]
    pub width: Option<f64>,
    /// The boundary of the heights.
    pub boundary: Boundary,
    /// Whether a description chooses the steps automatically.
    pub auto: bool,
    /// The preparation of the heights.
    pub prepare: Preparation,
}

impl Default for HeightKnobs {
    fn default() -> Self {
        let (file, channel, unit, width, prepare) = Default::default();
        Self { file, channel, unit, width, boundary: Boundary::Periodic, auto: true, prepare }
    }
}

impl HeightKnobs {
    /// Refuses lengths that no file has.
    ///
    /// # Errors
    /// A sentence for a length that is not above 0.
    pub(super) fn check(&self) -> Result<(), Refusal> {
        let lengths = [self.unit, self.width, self.prepare.low_pass];
        match lengths.into_iter().flatten().find(|length| !(*length > 0.0 && length.is_finite())) {
            Some(_) => Err(RefusalRule::NotALength.into()),
            None => Ok(()),
        }
    }

    /// The recipe and the cell of a file, bounded like all surfaces of the page.
    ///
    /// # Errors
    /// For a file that cannot be read, and for one of too many points.
    pub fn surface(&self, file: &HeightFile) -> Result<(Recipe, Cell), Refusal> {
        let (recipe, cell) = self.unbounded(file)?;
        let grid = recipe.grid(&cell)?;
        let (most, [ny, nx]) = (most(grid.is_line()), grid.shape());
        if grid.len() > most {
            let given = [("ny", ny.to_string()), ("nx", nx.to_string()), ("most", most.to_string())];
            return Err(RefusalRule::HeightPoints.with(given));
        }
        Ok((recipe, cell))
    }

    /// The knobs with the steps that the heights of a file need, and why they need them.
    ///
    /// # Errors
    /// For a file that cannot be read, and one without known lengths.
    pub fn chosen(&self, file: &HeightFile) -> Result<(Self, Vec<Sentence>), Refusal> {
        let layout = file.layout(self.channel.as_deref())?;
        let most = most(layout.is_profile);
        let part = |points: usize| (points > most).then(|| middle(&layout, most as f64 / points as f64));
        let [rows, columns] = layout.shape;
        let mut choice = self.choice(file, part(rows * columns))?;
        for _ in 0..MOST_CHOICES {
            let mirrored = choice.preparation.mirror.map_or([rows, columns], |mirror| mirror.shape([rows, columns]));
            let crop = part(mirrored[0] * mirrored[1]);
            if crop == choice.preparation.crop {
                break;
            }
            choice = self.choice(file, crop)?;
        }
        if choice.preparation.crop.is_some() {
            let reason = sentence!(
                "{rows} x {columns} points (with mirror images, if any) are too many for this page: only the middle \
                 part is kept",
                rows,
                columns
            );
            choice.reasons.insert(0, reason);
        }
        Ok((Self { prepare: choice.preparation, ..self.clone() }, choice.reasons))
    }

    /// The steps that a part of a file needs.
    fn choice(&self, file: &HeightFile, crop: Option<Crop>) -> Result<PreparationChoice, Refusal> {
        let prepare = Preparation { crop, ..Preparation::default() };
        let (recipe, cell) = Self { prepare, ..self.clone() }.unbounded(file)?;
        let PreparationChoice { preparation, reasons } = recipe.choice(&cell)?;
        let crop = preparation.crop.clone().or(recipe.prepare.crop);
        Ok(PreparationChoice { preparation: Preparation { crop, ..preparation }, reasons })
    }

    /// The recipe and the cell of a file of any length.
    fn unbounded(&self, file: &HeightFile) -> Result<(Recipe, Cell), Refusal> {
        let Self { channel, unit, prepare, .. } = self.clone();
        let recipe = Recipe { height: Some(file.clone()), channel, file_unit: unit, prepare, ..Recipe::default() };
        let size = match self.width {
            Some(width) => size(width, &file.layout(self.channel.as_deref())?),
            None => Vec::new(),
        };
        Ok((recipe, Cell { points: Vec::new(), size, refine: None, boundary: vec![self.boundary], datum: None }))
    }
}

/// The most points of a line or a surface.
fn most(is_line: bool) -> usize {
    MOST_POINTS[usize::from(!is_line)]
}

/// The lengths along the axes of a file of some width.
fn size(width: f64, layout: &Layout) -> Vec<f64> {
    let [ny, nx] = layout.shape.map(|n| n as f64);
    if layout.is_profile { vec![width] } else { vec![width * ny / nx, width] }
}

/// The middle of a map or a profile, a share of its points.
fn middle(layout: &Layout, share: f64) -> Crop {
    let side = if layout.is_profile { share } else { share.sqrt() };
    let range = |n: usize| {
        let kept = ((n as f64 * side) as usize).max(Grid::MIN_POINTS).min(n);
        [(n - kept) / 2, (n - kept) / 2 + kept]
    };
    let [y, x] = layout.shape.map(range);
    Crop(if layout.is_profile { x.into() } else { [y, x].concat() })
}
