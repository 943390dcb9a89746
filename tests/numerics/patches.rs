//! Contact patches, against those that filling finds.

use asperity::contact::{ContactModulus, Load, Multilevel, Patch, PatchHistory, Patches, Problem, Solver, Stop};
use asperity::setup::{Cell, Recipe, Setup};
use asperity::surface::Spectrum;
use asperity::{Grid, Surface};
use ndarray::Array2;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

fn grid(shape: [usize; 2]) -> Grid {
    if shape[0] == 1 { Grid::line(shape[1], 1.0) } else { Grid::surface(shape, [1.0, 1.0]) }.unwrap()
}

fn patches(rows: &[&str]) -> Vec<usize> {
    let field: Vec<f64> = rows.iter().flat_map(|r| r.chars()).map(|c| if c == '#' { 1.0 } else { 0.0 }).collect();
    Patches::new(&field, &grid([rows.len(), rows[0].len()])).sizes().to_vec()
}

#[test]
fn patches_join_across_rows_columns_and_periods() {
    assert_eq!(patches(&["##..#..#"]), [3, 1]);
    assert!(patches(&["........"]).is_empty());
    assert_eq!(patches(&["########"]), [8]);
    assert_eq!(patches(&["#..#", ".##.", "....", "#..#"]), [4, 2]);
    assert_eq!(patches(&["#.#.", "###.", "#.#.", "...."]), [7]);
    assert_eq!(patches(&["#...", ".#..", "..#.", "...#"]), [1, 1, 1, 1]);
}

/// The sizes by filling: each node takes the lowest number of its neighbours until nothing changes.
fn filled(pressure: &[f64], grid: &Grid) -> Vec<usize> {
    let ([ny, nx], [round_y, round_x]) = (grid.shape(), grid.periodic());
    let mut lowest: Vec<usize> = (0..ny * nx).collect();
    loop {
        let before = lowest.clone();
        for i in (0..ny * nx).filter(|&i| pressure[i] > 0.0) {
            let (y, x) = (i / nx, i % nx);
            let around = [
                ((y + 1) % ny * nx + x, round_y || y + 1 < ny),
                ((y + ny - 1) % ny * nx + x, round_y || y > 0),
                (y * nx + (x + 1) % nx, round_x || x + 1 < nx),
                (y * nx + (x + nx - 1) % nx, round_x || x > 0),
            ];
            for (j, is_there) in around {
                if is_there && pressure[j] > 0.0 {
                    lowest[i] = lowest[i].min(lowest[j])
                }
            }
        }
        if lowest == before {
            break;
        }
    }
    let mut sizes = vec![0; ny * nx];
    (0..ny * nx).filter(|&i| pressure[i] > 0.0).for_each(|i| sizes[lowest[i]] += 1);
    sizes.retain(|&nodes| nodes > 0);
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes
}

#[test]
fn patches_are_those_of_filling() {
    for shape in [[1, 40], [7, 5], [31, 32], [64, 48]] {
        for level in [-0.8, -0.3, 0.0, 0.3, 0.8] {
            let value = |i: usize| ((i * i) as f64 * 0.7).sin() + level;
            let pressure: Vec<f64> = (0..shape[0] * shape[1]).map(value).collect();
            for periodic in [[true; 2], [true, false], [false, true], [false; 2]] {
                let grid = grid(shape).with_periodic(periodic);
                assert_eq!(Patches::new(&pressure, &grid).sizes(), filled(&pressure, &grid), "{grid:?} {level}");
            }
        }
    }
}

/// The patches by filling from node to node: for each node the number of its patch from 0 on in the order of their first nodes, if it is in one.
fn labelled(pressure: &[f64], [ny, nx]: [usize; 2], is_periodic: bool) -> Vec<Option<usize>> {
    let mut labels = vec![None; ny * nx];
    let mut count = 0;
    for first in 0..ny * nx {
        if pressure[first] <= 0.0 || labels[first].is_some() {
            continue;
        }
        let mut waiting = vec![first];
        while let Some(node) = waiting.pop() {
            if pressure[node] <= 0.0 || labels[node].is_some() {
                continue;
            }
            labels[node] = Some(count);
            let (y, x) = (node / nx, node % nx);
            let mut visit = |is_inside: bool, y: usize, x: usize| {
                if is_inside || is_periodic {
                    waiting.push(y % ny * nx + x % nx);
                }
            };
            visit(y + 1 < ny, y + 1, x);
            visit(y > 0, y + ny - 1, x);
            visit(x + 1 < nx, y, x + 1);
            visit(x > 0, y, x + nx - 1);
        }
        count += 1;
    }
    labels
}

/// The rows of a table of patches, by its own means: names of patches for each node, and what happened, as (state, word, patch, other).
#[derive(Default)]
struct OwnTracker {
    names: Vec<Option<usize>>,
    given: usize,
    states: usize,
    events: BTreeSet<(usize, &'static str, usize, Option<usize>)>,
}

impl OwnTracker {
    fn follow(&mut self, labels: &[Option<usize>]) {
        self.states += 1;
        let mut shared: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for (name, label) in self.names.iter().zip(labels) {
            if let (Some(name), Some(label)) = (name, label) {
                *shared.entry((*name, *label)).or_default() += 1;
            }
        }
        // the pairs with the largest overlap, one after the other, and among equals those whose nodes come first; labels are in that order
        let first = |name: usize| self.names.iter().position(|it| *it == Some(name));
        let rank = |name: usize, label: usize, nodes: usize| (nodes, Reverse(first(name)), Reverse(label));
        let (mut free, mut partners) = (shared.clone(), BTreeMap::new());
        while let Some((&(name, label), _)) =
            free.iter().max_by_key(|((name, label), nodes)| rank(*name, *label, **nodes))
        {
            partners.insert(label, name);
            free.retain(|(other, its), _| *other != name && *its != label);
        }
        let before: BTreeSet<usize> = self.names.iter().copied().flatten().collect();
        let now: BTreeSet<usize> = labels.iter().copied().flatten().collect();
        let closest = |is_it: &dyn Fn(usize, usize) -> bool| {
            let pairs = shared.iter().filter(|((name, label), _)| is_it(*name, *label));
            pairs
                .max_by_key(|((name, label), nodes)| rank(*name, *label, **nodes))
                .map(|((name, label), _)| (*name, *label))
        };
        let named: BTreeSet<usize> = partners.values().copied().collect();
        let known: BTreeSet<usize> = partners.keys().copied().collect();
        for &label in now.difference(&known) {
            self.given += 1;
            partners.insert(label, self.given);
            if self.states > 1 {
                let other = closest(&|_, its| its == label).map(|(name, _)| name);
                let word = if other.is_some() { "split" } else { "born" };
                self.events.insert((self.states, word, self.given, other));
            }
        }
        for &name in before.difference(&named) {
            let other = closest(&|its, _| its == name).map(|(_, label)| partners[&label]);
            let word = if other.is_some() { "merged" } else { "died" };
            self.events.insert((self.states, word, name, other));
        }
        self.names = labels.iter().map(|label| label.map(|it| partners[&it])).collect();
    }
}

/// Patches of a rough surface under growing load are those of filling, and keep their numbers as another tracker finds them.
#[test]
fn patches_of_a_rough_surface_keep_their_numbers_over_25_loads() {
    let shape = [96, 128];
    let recipe = Recipe {
        spectrum: Some(Spectrum { hurst: 0.8, rolloff_wavelength: 0.25, short_cutoff: 0.05, rms_gradient: 0.1 }.into()),
        seed: Some(5),
        ..Recipe::default()
    };
    let setup = Setup::new(recipe, Cell::surface(shape, [0.75, 1.0]), Load::ReducedPressure(0.5));
    let problem = setup.problem().unwrap();
    let (mut history, mut own) = (PatchHistory::new(shape), OwnTracker::default());
    // names by its own means for each of the numbers that were given
    let mut names: BTreeMap<usize, usize> = BTreeMap::new();
    // up, and down again
    let loads = (0..25).map(|i: i32| 0.5 * 0.75f64.powi((18 - i).abs()));
    for load in loads {
        let problem = problem.clone().with_load(Load::ReducedPressure(load)).unwrap();
        let contact = Multilevel.solve(&problem, &Stop::default(), &mut ()).unwrap();
        assert!(contact.is_converged());
        let pressure = contact.pressure.as_slice().unwrap();
        history.add(&contact);
        own.follow(&labelled(pressure, shape, true));
        let state = history.states.last().unwrap();
        let mut nodes: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        own.names.iter().enumerate().for_each(|(i, name)| {
            name.iter().for_each(|name| nodes.entry(*name).or_default().push(i));
        });
        assert_eq!(state.patches.len(), nodes.len());
        let cell = 0.75 / 96.0 / 128.0;
        for patch in &state.patches {
            let name = own.names[patch.its.peak].unwrap();
            assert_eq!(*names.entry(patch.number).or_insert(name), name, "patch {} at {load}", patch.number);
            let its = &nodes[&name];
            let force = cell * its.iter().map(|i| pressure[*i]).sum::<f64>();
            assert!(patch.its.nodes == its.len() && (patch.its.load / force - 1.0).abs() < 1e-12);
        }
        let force = |nodes: &Vec<usize>| nodes.iter().map(|i| pressure[*i]).sum::<f64>();
        let most = nodes.iter().max_by(|a, b| force(a.1).total_cmp(&force(b.1))).unwrap();
        assert_eq!(names[&state.strongest().unwrap().number], *most.0, "the patch that carries most");
        for size in state.sizes() {
            let is_in = |it: &&Vec<usize>| (size.nodes..2 * size.nodes).contains(&it.len());
            let (count, area) = (nodes.values().filter(is_in).count(), nodes.values().filter(is_in).map(Vec::len));
            let all = nodes.values().map(Vec::len).sum::<usize>();
            assert_eq!(size.patches, count);
            assert!((size.area_share - area.sum::<usize>() as f64 / all as f64).abs() < 1e-12);
        }
        assert_eq!(state.sizes().iter().map(|it| it.patches).sum::<usize>(), nodes.len());
    }
    assert_eq!(names.values().collect::<BTreeSet<_>>().len(), names.len(), "two numbers for one patch");
    let told: BTreeSet<_> = history
        .events
        .iter()
        .map(|it| (it.state, <&str>::from(it.event), names[&it.patch], it.other.map(|other| names[&other])))
        .collect();
    assert_eq!(told, own.events);
    let count = |word: &str| told.iter().filter(|it| it.1 == word).count();
    assert!(["born", "died", "merged", "split"].iter().all(|word| count(word) >= 5), "{told:?}");
    // the table has each event once, and each patch in each state
    let rows = history.rows();
    assert_eq!(rows.len(), history.states.iter().map(|it| it.patches.len()).sum::<usize>());
    assert_eq!(rows.iter().filter(|it| it.begin.is_some()).count(), count("born") + count("split"));
    assert_eq!(rows.iter().filter(|it| it.end.is_some()).count(), count("died") + count("merged"));
}

#[test]
fn a_patch_across_the_period_has_its_centre_there() {
    let grid = Grid::surface([8, 8], [1.0, 1.0]).unwrap();
    let problem = Problem::new(
        Surface::new(grid, Array2::from_shape_fn((8, 8), |(y, _)| y as f64)).unwrap(),
        ContactModulus(1.0),
        Load::MeanPressure(1.0),
    )
    .unwrap();
    let pressure: Vec<f64> = (0..64).map(|i| if [7, 0].contains(&(i % 8)) && i / 8 == 3 { 1.0 } else { 0.0 }).collect();
    let [patch] = Patch::all(&problem, &pressure)[..] else { panic!("one patch") };
    assert_eq!((patch.nodes, patch.centre), (2, [3.0 / 8.0, 7.5 / 8.0]));
}

/// Of a map that was mirrored, each patch counts once, as far as it is in the map.
#[test]
fn mirror_images_are_no_patches() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("heights.txt");
    let height = |y: usize, x: usize| format!("{:.6}", 0.01 * ((x * x + 3 * y * y) as f64 * 0.11).sin());
    let rows = (0..24).map(|y| (0..32).map(|x| height(y, x)).collect::<Vec<_>>().join(" ") + "\n");
    std::fs::write(&file, rows.collect::<String>()).unwrap();
    let scene = format!(
        "[surface]\nheight = {:?}\n[surface.prepare]\nmirror = \"both\"\n[grid]\nsize = [24.0, 32.0]\n[load]\nreduced-pressure = 0.05\n",
        file.display().to_string()
    );
    let setup = Setup::from_toml(&scene).unwrap();
    let contact = Multilevel.solve(&setup.problem().unwrap(), &Stop::default(), &mut ()).unwrap();
    let shape = contact.problem.surface().grid().shape();
    let own = setup.surface.own_shape(shape);
    assert_eq!((shape, own), ([46, 62], [24, 32]));
    let mut history = PatchHistory::new(own);
    history.add(&contact);
    let map: Vec<f64> = (0..24 * 32).map(|i| contact.pressure[[i / 32, i % 32]]).collect();
    let labels = labelled(&map, own, false);
    let count = labels.iter().flatten().max().unwrap() + 1;
    let state = &history.states[0];
    assert_eq!(state.patches.len(), count);
    let mut sizes = vec![0; count];
    labels.iter().flatten().for_each(|label| sizes[*label] += 1);
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    assert_eq!(state.patches.iter().map(|it| it.its.nodes).collect::<Vec<_>>(), sizes);
    let all = contact.patches().count();
    assert!(count > 4 && all > 2 * count && all < 4 * count, "{count} of {all}");
}
