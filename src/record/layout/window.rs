//! The sizes of panes in a window, so that pictures can be drawn in the proportions of theirs.

use crate::record::draw::{ContainerKind, GRID_COLUMNS, Pane};
use crate::record::options::{Options, WINDOW};
use std::collections::BTreeMap;

/// Height of the title of a view, or of a row of tabs.
const TITLE: f64 = 24.0;
/// Points that the viewer leaves free around a picture in its pane: left and right together, or above and below together.
const MARGIN: f64 = 6.0;
/// The size of a point in the smallest windows, over that in the usual one.
const LEAST_SCALE: f64 = 0.7;
/// Distance of neighbours.
const GAP: f64 = 1.0;

/// Width and height of the panes of pictures in points, by the roots of the pictures. A picture that is shown more than once has the size of
/// its smallest pane. In a small window points are smaller, so that words leave room for the curves.
pub(crate) struct Sizes(BTreeMap<String, [f64; 2]>);

impl Sizes {
    /// The sizes of the pictures of a layout in a window, width and height in points.
    pub(crate) fn new(panes: &[Pane], [width, height]: [f64; 2]) -> Self {
        let mut sizes = Self(BTreeMap::new());
        let scale = (width / WINDOW[0]).min(height / WINDOW[1]).clamp(LEAST_SCALE, 1.0);
        let height = height - Options::BARS;
        match panes {
            [only] => sizes.add(only, [width, height]),
            _ => panes.iter().for_each(|pane| sizes.add_tab(pane, [width, height])),
        }
        sizes.0.values_mut().for_each(|size| *size = size.map(|length| length / scale));
        sizes
    }

    /// The size of the pane of a picture.
    pub(crate) fn get(&self, root: &str) -> Option<[f64; 2]> {
        self.0.get(root).copied()
    }

    fn add(&mut self, pane: &Pane, [width, height]: [f64; 2]) {
        match pane {
            Pane::View(view) => self.enter(view.picture.as_deref(), [width - MARGIN, height - TITLE - MARGIN]),
            Pane::Container(ContainerKind::Tabs, _, panes) => {
                panes.iter().for_each(|(pane, _)| self.add_tab(pane, [width, height]));
            }
            Pane::Container(ContainerKind::Grid, _, panes) => {
                let columns = panes.len().min(GRID_COLUMNS);
                let rows = panes.len().div_ceil(columns.max(1));
                let size = [part(width, 1.0, columns as f64, columns), part(height, 1.0, rows as f64, rows)];
                panes.iter().for_each(|(pane, _)| self.add(pane, size));
            }
            Pane::Container(kind, _, panes) => {
                let all: f32 = panes.iter().map(|(_, share)| share).sum();
                let along = |length, share: f32| part(length, f64::from(share), f64::from(all), panes.len());
                for (pane, share) in panes {
                    let is_row = *kind == ContainerKind::Horizontal;
                    let size = if is_row { [along(width, *share), height] } else { [width, along(height, *share)] };
                    self.add(pane, size);
                }
            }
        }
    }

    /// Adds a pane below a row of tabs, which shows the title of the view.
    fn add_tab(&mut self, pane: &Pane, [width, height]: [f64; 2]) {
        let is_view = matches!(pane, Pane::View(_));
        self.add(pane, [width, if is_view { height } else { height - TITLE }]);
    }

    fn enter(&mut self, picture: Option<&str>, [width, height]: [f64; 2]) {
        let Some(root) = picture else { return };
        let known = self.0.entry(root.into()).or_insert([width, height]);
        if width * height < known[0] * known[1] {
            *known = [width, height];
        }
    }
}

/// The length of a pane with a share of `length` among a number of panes.
fn part(length: f64, share: f64, all: f64, panes: usize) -> f64 {
    (length - GAP * panes.saturating_sub(1) as f64) * share / all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::draw::Palette;
    use crate::record::draw::PaneView;
    use crate::setup::Theme;

    fn picture(root: &str) -> Pane {
        PaneView::plane(root, "/", Vec::new(), (root.into(), [0.0; 4]), Palette::new(Theme::Dark))
    }

    #[test]
    fn panes_share_the_window_and_titles_take_their_part() {
        let [a, b, c] = ["a", "b", "c"].map(picture);
        let tabs = Pane::container(ContainerKind::Tabs, "", vec![(b, 1.0), (c, 1.0)]);
        let column = Pane::container(ContainerKind::Vertical, "", vec![(a, 1.0), (tabs, 3.0)]);
        let text = PaneView::text("", "/".into());
        let whole = Pane::container(ContainerKind::Horizontal, "", vec![(column, 3.0), (text, 1.0)]);
        let sizes = Sizes::new(&[whole], [1601.0, 1058.0]);
        assert_eq!(sizes.get("a"), Some([1194.0, 220.0]));
        assert_eq!((sizes.get("b"), sizes.get("c")), (Some([1194.0, 720.0]), Some([1194.0, 720.0])));
        assert_eq!(sizes.get("d"), None);
    }

    #[test]
    fn a_picture_in_two_panes_has_the_size_of_the_smaller_one() {
        let grid = Pane::even(ContainerKind::Grid, "", vec![picture("a"), picture("b"), picture("c")]);
        let sizes = Sizes::new(&[grid, picture("a")], [1601.0, 1058.0]);
        assert_eq!((sizes.get("a"), sizes.get("c")), (Some([794.0, 458.0]), Some([794.0, 458.0])));
    }

    #[test]
    fn words_are_smaller_in_small_windows_but_never_by_more_than_a_third() {
        let width = |window: [f64; 2]| Sizes::new(&[picture("a")], window).get("a").unwrap()[0];
        assert_eq!(width([1600.0, 1000.0]), 1594.0);
        assert_eq!(width([1280.0, 800.0]), 1274.0 / 0.8);
        assert_eq!(width([640.0, 400.0]), 634.0 / LEAST_SCALE);
        assert_eq!(width([1920.0, 1080.0]), 1914.0);
    }
}
