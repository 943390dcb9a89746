//! The tree of contact patches over the loads: which one lives when and merges into which, and above it how many are born, die, merge and split.

use crate::contact::{PatchEvent, PatchEventKind, PatchHistory, PatchLife, PatchTree};
use crate::plot::{Align, AxesFrame, Axis, Colour, Sheet};
use crate::record::draw::chart::load_axis::LoadAxis;
use crate::record::draw::ink::canvas::{self, PANE, strips};
use crate::record::draw::ink::palette::{Palette, SERIES, colour};
use crate::record::draw::ink::pane::{Pane, PaneView};
use rerun::components::{Scalar, Text};
use rerun::{AnyValues, Points2D, Radius, RecordingStream, RecordingStreamResult, Scalars, SeriesLines};

/// The most patches that are drawn.
const MOST: usize = 60;
/// The most patches that are named at their ends.
const NAMED: usize = 8;
/// Room for the names to the right, over the size of words: enough for `in all: 1234`.
const ASIDE: f64 = 5.4;
/// Rows of the lane of events above the tree, with their names.
const ROWS: [(PatchEventKind, &str); 4] = [
    (PatchEventKind::Born, "born"),
    (PatchEventKind::Died, "died"),
    (PatchEventKind::Merged, "merged"),
    (PatchEventKind::Split, "split"),
];
/// Height of a row of the lane, over the size of words, and that of the largest numbers in it.
const ROW: f64 = 1.05;
const NUMBER: f64 = 0.85;
/// Half the height of a tick of an event above or below a life, in lanes.
const DOT: f32 = 2.6;
/// Radii of the lives of patches that carry nothing, and of one that carries everything.
const RADII: [f64; 2] = [0.6, 4.5];

/// The picture of the tree.
pub(crate) struct PatchTreePicture {
    root: String,
    palette: &'static Palette,
    frame: AxesFrame,
    loads: LoadAxis,
}

impl PatchTreePicture {
    /// The tree of the patches of a scene under some loads. Loads that turn back are drawn by their numbers.
    pub(crate) fn new(scene: &str, palette: &'static Palette, loads: &LoadAxis) -> Self {
        let values = &loads.values;
        let turns = !(values.is_sorted_by(|a, b| a < b) || values.is_sorted_by(|a, b| a > b));
        let numbers = || LoadAxis::linear("load number", (1..=values.len()).map(|load| load as f64).collect());
        let loads = if turns { numbers() } else { loads.clone() };
        let axes = [loads.whole(), Axis::linear("", [0.0, 1.0])];
        Self { root: format!("{scene}/patch_tree"), palette, frame: canvas::frame(PANE, axes, ASIDE), loads }
    }

    /// The root of its entities.
    pub(crate) fn root(&self) -> &str {
        &self.root
    }

    /// Takes the proportions of its pane, width and height in points.
    pub(crate) fn fit(&mut self, pane: [f64; 2]) {
        canvas::fit(&mut self.frame, pane, ASIDE);
    }

    /// The view of the tree.
    pub(crate) fn pane(&self) -> Pane {
        let bounds = canvas::bounds(&self.frame, ASIDE);
        let contents = vec![format!("{}/**", self.root), format!("- {}/counts", self.root)];
        let title = "Contact patches: births, deaths, mergers and splits";
        PaneView::plane(title, &self.root, contents, (self.root.clone(), bounds), self.palette)
    }

    /// Records the axis, and the names of the rows of the lane of events.
    pub(crate) fn log_static(&self, to: &RecordingStream) -> RecordingStreamResult<()> {
        canvas::log_floor(to, self.palette, &format!("{}/axes", self.root), &self.frame)?;
        let mut names = Sheet::default();
        for (row, (_, name)) in ROWS.iter().enumerate() {
            let size = NUMBER * self.frame.text;
            names.words(name, [-0.4 * self.frame.text, self.height(row)], size, Align::Right);
        }
        to.log_static(format!("{}/events/names", self.root), &canvas::written(self.palette, &names))?;
        let names = ROWS.map(|(_, name)| name);
        to.log_static(format!("{}/counts", self.root), &SeriesLines::new().with_names(names))
    }

    /// Records what happened up to the last state of a history, at the current time: its events and the tree so far.
    pub(crate) fn log(&self, to: &RecordingStream, history: &PatchHistory) -> RecordingStreamResult<()> {
        let load = history.states.len() - 1;
        let events: Vec<&PatchEvent> = history.events.iter().filter(|it| it.state == load + 1).collect();
        let counts = ROWS.map(|(kind, _)| events.iter().filter(|it| it.event == kind).count());
        to.log(format!("{}/counts", self.root), &Scalars::new(counts.map(|count| count as f64)))?;
        let numbers = AnyValues::default()
            .with_component::<Scalar>("event_patch", events.iter().map(|it| it.patch as f64))
            .with_component::<Text>("event_kind", events.iter().map(|it| <&str>::from(it.event)))
            .with_component::<Scalar>("event_other", events.iter().map(|it| it.other.map_or(f64::NAN, |it| it as f64)));
        to.log(format!("{}/events", self.root), &numbers)?;
        self.log_counts(to, load, &counts)?;
        self.log_tree(to, &PatchTree::new(history, MOST), history, load)
    }

    /// Records the trees of all states anew, in the order of the lanes of the last one, at the times to which `turn` goes.
    pub(crate) fn settle(
        &self,
        to: &RecordingStream,
        turn: &dyn Fn(&RecordingStream, usize),
        history: &PatchHistory,
    ) -> RecordingStreamResult<()> {
        let tree = PatchTree::new(history, MOST);
        (0..history.states.len()).try_for_each(|load| {
            turn(to, load);
            self.log_tree(to, &tree, history, load)
        })
    }

    /// The height of the middle of a row of the lane of events.
    fn height(&self, row: usize) -> f64 {
        (row as f64 + 0.6) * ROW * self.frame.text
    }

    /// The place of a load along the axis.
    fn place(&self, load: usize) -> Option<f64> {
        let place = self.frame.x.place(self.loads.number(load)?);
        place.is_finite().then(|| self.frame.position([place, 0.0])[0])
    }

    /// Records the numbers of events of a load in a column of the lane, which stays.
    fn log_counts(&self, to: &RecordingStream, load: usize, counts: &[usize; ROWS.len()]) -> RecordingStreamResult<()> {
        let Some(x) = self.place(load) else { return Ok(()) };
        let width = self.frame.size[0] / self.loads.values.len() as f64;
        let size = (NUMBER * self.frame.text).min(0.5 * width);
        let mut sheet = Sheet::default();
        for (row, count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
            sheet.words(&count.to_string(), [x, self.height(row)], size, Align::Middle);
        }
        to.log(format!("{}/events/{}", self.root, load + 1), &canvas::written(self.palette, &sheet))
    }

    /// Records the tree up to a load at the current time.
    fn log_tree(
        &self,
        to: &RecordingStream,
        tree: &PatchTree,
        history: &PatchHistory,
        load: usize,
    ) -> RecordingStreamResult<()> {
        let state = load + 1;
        let lives = || tree.lives.iter().enumerate().filter(|(_, life)| life.first <= state);
        let colours: Vec<Colour> = tree.lives.iter().map(|life| self.colour(tree, life)).collect();
        let radius = |life: &PatchLife| {
            Radius::new_ui_points((RADII[0] + (RADII[1] - RADII[0]) * life.most.clamp(0.0, 1.0).sqrt()) as f32)
        };
        let lines = lives().flat_map(|(lane, life)| {
            let style = (colour(colours[lane]), radius(life));
            self.lines(tree, lane, state).into_iter().map(move |line| (line, style.0, style.1))
        });
        to.log(format!("{}/lives", self.root), &strips(lines).with_draw_order(30.0))?;
        let dots = lives().flat_map(|(lane, life)| self.dots(tree, lane, life, state));
        let dots = Points2D::new(dots).with_colors([colour(self.palette.ink)]).with_radii([Radius::new_ui_points(DOT)]);
        to.log(format!("{}/dots", self.root), &dots.with_draw_order(36.0))?;
        to.log(format!("{}/strongest", self.root), &canvas::written(self.palette, &self.names(tree, history, load)))
    }

    /// The colour of a life: that of the patch at the root of its branch.
    fn colour(&self, tree: &PatchTree, life: &PatchLife) -> Colour {
        let roots: Vec<usize> = tree.lives.iter().map(|it| it.patch).filter(|it| tree.root(*it) == *it).collect();
        let place = roots.iter().position(|root| *root == tree.root(life.patch)).unwrap_or_default();
        self.palette.on_ground(SERIES[place % SERIES.len()])
    }

    /// The height of a lane.
    fn level(&self, tree: &PatchTree, lane: usize) -> f64 {
        let top = self.height(ROWS.len());
        top + (self.frame.size[1] - top) * (lane as f64 + 0.5) / tree.lives.len().max(1) as f64
    }

    /// The lines of a life up to a state: along its lane, to the patch that it merged into, and from the one that it was split from.
    fn lines(&self, tree: &PatchTree, lane: usize, state: usize) -> Vec<Vec<[f32; 2]>> {
        let life = &tree.lives[lane];
        let at = |state: usize, lane: usize| {
            Some([self.place(state.checked_sub(1)?)?, self.level(tree, lane)].map(|place| place as f32))
        };
        let own = [life.first, life.last.min(state)].map(|state| at(state, lane));
        let own = own.into_iter().flatten().collect::<Vec<_>>();
        let merged = life.merged_into().filter(|_| life.last < state).and_then(|other| tree.lane(other));
        let merged = merged.and_then(|other| Some(vec![at(life.last, lane)?, at(life.last + 1, other)?]));
        let split = life.begin.and_then(|(_, other)| tree.lane(other?));
        let split = split.and_then(|other| Some(vec![at(life.first - 1, other)?, at(life.first, lane)?]));
        [Some(own), merged, split].into_iter().flatten().filter(|line| line.len() > 1).collect()
    }

    /// Dots where a life begins without another one, and where it ends without one.
    fn dots(&self, tree: &PatchTree, lane: usize, life: &PatchLife, state: usize) -> Vec<[f32; 2]> {
        let born = life.begin.is_some_and(|(event, _)| event == PatchEventKind::Born).then_some(life.first);
        let died = life.end.is_some_and(|(event, _)| event == PatchEventKind::Died && life.last < state);
        let ends = [born, died.then_some(life.last)].into_iter().flatten();
        ends.filter_map(|state| Some([self.place(state - 1)?, self.level(tree, lane)].map(|it| it as f32))).collect()
    }

    /// The names of the strongest patches under a load with their shares of it, right of the tree.
    fn names(&self, tree: &PatchTree, history: &PatchHistory, load: usize) -> Sheet {
        let (state, text) = (&history.states[load], self.frame.text);
        let mut patches: Vec<_> = state.patches.iter().collect();
        patches.sort_by(|a, b| b.its.load.total_cmp(&a.its.load));
        let mut names = Sheet::default();
        let mut taken: Vec<f64> = Vec::new();
        for patch in patches.into_iter().take(NAMED) {
            let Some(lane) = tree.lane(patch.number) else { continue };
            let y = self.level(tree, lane);
            if taken.iter().all(|other| (other - y).abs() > text) {
                let words = format!("{}: {:.0} %", patch.number, 1e2 * patch.its.load / state.load());
                names.words(&words, [self.frame.size[0] + 0.5 * text, y], NUMBER * text, Align::Left);
                taken.push(y);
            }
        }
        // The tree has the patches of all loads, of which most are not there under this one: the first number is that of the contact that is shown beside it.
        let mut counts =
            vec![format!("now: {}", state.patches.len()), format!("in all: {}", tree.lives.len() + tree.left_out)];
        if tree.left_out > 0 {
            counts.push(format!("drawn: {}", tree.lives.len()));
        }
        for (row, words) in counts.iter().enumerate() {
            names.words(words, [self.frame.size[0] + 0.5 * text, self.height(row)], NUMBER * text, Align::Left);
        }
        names
    }
}
