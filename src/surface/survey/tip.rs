//! What a ball-shaped tip has reached of the heights that it measured.

use crate::error::SurfaceError;
use crate::formats::Scan;
use ndarray::Array2;

/// The least that the place of the tip moves for each node along the surface, in all directions, where it touches alone: by `(rho - R) / rho` in a valley of
/// radius `rho`, so that valleys of less than twice its own radius count as not reached. Between two contacts the place does not move. Of rough maps
/// below a tip, 95 % of the nodes with a larger move were within 0.1 rms heights of the truth, where a tenth of all nodes was more than 0.7 rms
/// heights above it.
const LEAST_MOVE: f64 = 0.5;
/// The nodes to each side over which the move is found. With 2 it is that of nodes beside the contact, too.
const REACH: usize = 1;

/// Heights as an instrument with a ball-shaped tip measures them, and which of them the tip has reached.
///
/// A tip of radius `R` measures the dilation of the surface `s`, `i(y) = max over u of s(y + u) - t(u)` with `t(u) = R - sqrt(R^2 - u^2)`: peaks of
/// radius `r` come out with `r + R`, and valleys with less than `R` with the cusps of the tip between both flanks. The highest surface with this
/// image is the erosion `r(x) = min over y of i(y) + t(x - y)`. A node of it is certain where the tip at the place `y` of the minimum touches
/// there alone: the surface is at `r(x)`. Where the tip touches at several nodes at once, it may not have reached what lies between them, and the
/// surface may be anywhere below `r(x)`. On a grid these are the nodes between which the place of the tip hardly moves.
///
/// The heights are to be free of noise: a tip with noise seems to touch on the lowest values of the noise alone.
///
/// # Source
/// J. S. Villarrubia, J. Res. Natl. Inst. Stand. Technol. 102 (1997) 425, "certified reconstruction".
///
/// ```
/// use asperity::formats::Scan;
/// use asperity::surface::TipReach;
/// // the image of a ball of radius 20 on a plane by a tip of radius 30 is a ball of radius 50
/// let square = |i: usize| (i as f64 - 64.0).powi(2);
/// let image = |(y, x): (usize, usize)| ((2500.0 - square(y) - square(x)).max(0.0).sqrt() - 30.0).max(0.0);
/// let scan = Scan { height: ndarray::Array2::from_shape_fn((129, 129), image), spacing: [1.0; 2] };
/// let found = TipReach::new(&scan, 30.0)?;
/// let ball = |i: usize| (400.0 - square(i)).sqrt();
/// assert!((found.height.height[[64, 74]] - ball(74)).abs() < 0.05);
/// assert!(found.is_certain[[64, 64]] && found.is_certain[[10, 10]] && !found.is_certain[[64, 90]]);
/// # Ok::<(), asperity::error::SurfaceError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TipReach {
    /// The highest heights with this image, NaN where the heights are void.
    pub height: Scan,
    /// The nodes that the tip has touched, and nothing else at the same time.
    pub is_certain: Array2<bool>,
    /// The radius of the tip.
    pub radius: f64,
}

impl TipReach {
    /// The heights below an image by a tip of some radius.
    ///
    /// # Errors
    /// [`SurfaceError::NotPositive`] for a radius that is not positive and finite.
    pub fn new(image: &Scan, radius: f64) -> Result<Self, SurfaceError> {
        crate::surface::check_positive(&[("tip radius", radius)])?;
        let (tip, lowest) = (TipShape::new(image, radius), image.height.iter().copied().fold(f64::INFINITY, f64::min));
        let mut height = image.clone();
        let mut places = Array2::from_elem(image.height.dim(), None);
        for (node, eroded) in height.height.indexed_iter_mut() {
            if eroded.is_nan() {
                continue;
            }
            let (place, least) = tip.lowest_above(image, node, lowest);
            *eroded = least;
            places[node] = Some(place);
        }
        let is_certain = Array2::from_shape_fn(image.height.dim(), |node| {
            places[node].is_some() && least_move(&places, node) > LEAST_MOVE
        });
        Ok(Self { height, is_certain, radius })
    }

    /// The part of the measured nodes that the tip has not reached for certain.
    pub fn unreached_share(&self) -> f64 {
        let measured = self.height.height.len() - self.height.voids();
        let certain = self.is_certain.iter().filter(|it| **it).count();
        1.0 - certain as f64 / measured.max(1) as f64
    }

    /// The part of the highest measured nodes, a share `share` of all, that the tip has not reached for certain. A contact begins at the highest nodes.
    pub fn unreached_share_of_highest(&self, share: f64) -> f64 {
        let mut nodes: Vec<(f64, bool)> = self
            .height
            .height
            .iter()
            .copied()
            .zip(self.is_certain.iter().copied())
            .filter(|it| !it.0.is_nan())
            .collect();
        nodes.sort_unstable_by(|one, other| other.0.total_cmp(&one.0));
        nodes.truncate(((share * nodes.len() as f64).ceil() as usize).max(1));
        nodes.iter().filter(|it| !it.1).count() as f64 / nodes.len().max(1) as f64
    }

    /// The part of the measured nodes that stand above what the tip measures of the reconstructed heights: they are sharper than the tip, by noise or
    /// since the tip is smaller. Differences below the height of the tip one spacing from its lowest point are those of the grid.
    pub fn sharper_share(&self, image: &Scan) -> f64 {
        let tip = TipShape::new(image, self.radius);
        let spacing = image.axes().map(|axis| image.spacing[axis]).fold(0.0, f64::max);
        let grid = self.radius - (self.radius * self.radius - spacing * spacing).max(0.0).sqrt();
        let highest = self.height.height.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let is_sharper =
            |(node, height): &((usize, usize), &f64)| **height > tip.highest_below(&self.height, *node, highest) + grid;
        let sharper = image.height.indexed_iter().filter(|(_, height)| !height.is_nan()).filter(is_sharper).count();
        sharper as f64 / (image.height.len() - image.voids()).max(1) as f64
    }

    /// How much larger areas of the image are than those of the reconstructed heights, by their rms gradients, as a part of the former. The surface
    /// may be steeper yet where the tip has not reached.
    pub fn area_error(&self, image: &Scan) -> f64 {
        let [image, below] = [image, &self.height].map(Scan::rms_gradient);
        if below > 0.0 { (1.0 - image / below).abs() } else { 0.0 }
    }
}

/// The places of the tip at which it is lowest above each node; none above voids.
type TipPlaces = Array2<Option<(usize, usize)>>;

/// The least move of the place of the tip about a node, in nodes for each node along the surface, of all directions: the smaller singular value of the
/// derivatives of the place along rows and columns.
fn least_move(places: &TipPlaces, (y, x): (usize, usize)) -> f64 {
    let (ny, nx) = places.dim();
    let nodes = |i: usize, n: usize| [i.saturating_sub(REACH), (i + REACH).min(n - 1)];
    let along = |[first, last]: [(usize, usize); 2], nodes: usize| {
        let (Some(from), Some(to)) = (places[first], places[last]) else { return [1.0, 0.0] };
        let step = |a: usize, b: usize| (b as f64 - a as f64) / nodes.max(1) as f64;
        [step(from.0, to.0), step(from.1, to.1)]
    };
    let ([top, bottom], [left, right]) = (nodes(y, ny), nodes(x, nx));
    let [xy, xx] = along([(y, left), (y, right)], right - left);
    if ny == 1 {
        return xx.abs();
    }
    let [yy, yx] = along([(top, x), (bottom, x)], bottom - top);
    let (square, determinant) = (xx * xx + xy * xy + yx * yx + yy * yy, xx * yy - xy * yx);
    (0.5 * (square - (square * square - 4.0 * determinant * determinant).max(0.0).sqrt())).max(0.0).sqrt()
}

/// The tip on the grid.
struct TipShape {
    /// Steps to nodes below the tip, and its height there above its lowest point; the lowest ones first.
    steps: Vec<([isize; 2], f64)>,
}

impl TipShape {
    /// The tip as far as it is no higher than the whole range of the heights: beyond, it cannot touch.
    fn new(image: &Scan, radius: f64) -> Self {
        let range = image.reach().min(radius);
        let far = (range * (2.0 * radius - range)).max(0.0).sqrt();
        let reach = [0, 1].map(|axis| match image.shape()[axis] {
            1 => 0,
            n => ((far / image.spacing[axis]).ceil() as isize).min(n as isize),
        });
        let mut steps = Vec::new();
        for y in -reach[0]..=reach[0] {
            for x in -reach[1]..=reach[1] {
                let square = (y as f64 * image.spacing[0]).powi(2) + (x as f64 * image.spacing[1]).powi(2);
                let under = radius * radius - square;
                if under >= 0.0 {
                    // R - sqrt(R^2 - u^2) without the loss of digits of the difference
                    steps.push(([y, x], square / (radius + under.sqrt())));
                }
            }
        }
        steps.sort_by(|one, other| one.1.total_cmp(&other.1));
        Self { steps }
    }

    /// The height of the lowest point of the tip over a node, where it rests on some heights.
    fn highest_below(&self, heights: &Scan, (y, x): (usize, usize), highest: f64) -> f64 {
        let mut most = f64::NEG_INFINITY;
        for ([dy, dx], above) in &self.steps {
            if highest - above <= most {
                break;
            }
            let (Some(row), Some(column)) = (y.checked_add_signed(*dy), x.checked_add_signed(*dx)) else { continue };
            most = most.max(heights.height.get((row, column)).copied().unwrap_or(f64::NAN) - above);
        }
        most
    }

    /// The place of the tip that is lowest above a node, and the height of its surface there.
    fn lowest_above(&self, image: &Scan, (y, x): (usize, usize), lowest: f64) -> ((usize, usize), f64) {
        let (mut place, mut least) = ((y, x), f64::INFINITY);
        for ([dy, dx], above) in &self.steps {
            // steps are in ascending order, so that no further one can be lower
            if above + lowest >= least {
                break;
            }
            let (Some(row), Some(column)) = (y.checked_add_signed(*dy), x.checked_add_signed(*dx)) else { continue };
            let height = image.height.get((row, column)).copied().unwrap_or(f64::NAN) + above;
            if height < least {
                (place, least) = ((row, column), height);
            }
        }
        (place, least)
    }
}
