//! The camera that looks at a relief.

use glam::Vec3;

/// From what is looked at towards the eye, seen from above: from the front and the right.
const TOWARDS: [f32; 2] = [0.43, -0.9];
/// Half of the angle of view of the viewer from below to above, in radians.
const HALF_VIEW: f32 = 27.5 * std::f32::consts::PI / 180.0;
/// Share of the pane that is filled.
const FILLED: f32 = 0.96;
/// The farthest distance that is tried, how often the distance is halved, and how often the middle is moved for each distance.
const FARTHEST: f32 = 1e3;
const ROUNDS: usize = 30;
const SHIFTS: usize = 24;

/// Where the eye stands, and what it looks at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Eye {
    pub position: [f32; 3],
    pub target: [f32; 3],
}

impl Eye {
    /// The eye that sees all `corners` as large as possible in a pane that is `aspect` times as wide as it is high, at one of some
    /// elevations in radians above the horizon.
    pub(crate) fn around<const N: usize>(corners: &[Vec3], aspect: f32, elevations: [f32; N]) -> Self {
        let nowhere = Self { position: [0.0; 3], target: [0.0; 3] };
        let eyes = elevations.map(|elevation| Self::nearest(corners, aspect, elevation));
        eyes.into_iter().fold((nowhere, f32::NEG_INFINITY), |best, other| if other.1 > best.1 { other } else { best }).0
    }

    /// The nearest eye at a height that sees all corners, and the share of the pane that they fill.
    fn nearest(corners: &[Vec3], aspect: f32, elevation: f32) -> (Self, f32) {
        let (flat, upright) = (elevation.cos(), elevation.sin());
        let towards = Vec3::new(flat * TOWARDS[0], flat * TOWARDS[1], upright).normalize();
        let right = Vec3::Z.cross(towards).normalize();
        let axes = [(right, FILLED * HALF_VIEW.tan() * aspect), (towards.cross(right), FILLED * HALF_VIEW.tan())];
        // places of the corners over the room along an axis: the lowest and the highest
        let seen = |target: Vec3, distance: f32, (axis, room): (Vec3, f32)| {
            let places = corners.iter().map(|corner| {
                let from = *corner - target;
                let depth = distance - from.dot(towards);
                if depth > 0.0 { from.dot(axis) / depth / room } else { f32::INFINITY }
            });
            places.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
        };
        let middle = corners.iter().sum::<Vec3>() / corners.len() as f32;
        let ([mut near, mut far], mut target) = ([0.0, FARTHEST], middle);
        for _ in 0..ROUNDS {
            let distance = 0.5 * (near + far);
            let mut centred = middle;
            for _ in 0..SHIFTS {
                let shift = axes.map(|(axis, room)| {
                    let [low, high] = seen(centred, distance, (axis, room));
                    axis * low.midpoint(high) * room * distance
                });
                centred += shift[0] + shift[1];
            }
            let is_seen = axes.iter().all(|axis| seen(centred, distance, *axis).iter().all(|place| place.abs() <= 1.0));
            if is_seen {
                (far, target) = (distance, centred);
            } else {
                near = distance;
            }
        }
        let [across, upwards] = axes.map(|axis| seen(target, far, axis)).map(|[low, high]| 0.5 * (high - low));
        (Self { position: (target + far * towards).to_array(), target: target.to_array() }, across * upwards)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where the corners are in a pane, from -1 to 1 across and upwards.
    fn places(eye: Eye, corners: &[Vec3], aspect: f32) -> Vec<[f32; 2]> {
        let position = Vec3::from_array(eye.position);
        let ahead = (Vec3::from_array(eye.target) - position).normalize();
        let right = ahead.cross(Vec3::Z).normalize();
        let place = |corner: &Vec3| {
            let from = *corner - position;
            let edge = from.dot(ahead) * HALF_VIEW.tan();
            assert!(edge > 0.0, "{corner} is behind the eye");
            [from.dot(right) / (edge * aspect), from.dot(right.cross(ahead)) / edge]
        };
        corners.iter().map(place).collect()
    }

    #[test]
    fn all_corners_are_seen_and_one_side_of_the_pane_is_filled() {
        let corners: Vec<Vec3> =
            (0..8).map(|i| Vec3::new([-5.0, 6.0][i & 1], [-6.0, 5.0][i >> 1 & 1], [-1.6, 0.0][i >> 2 & 1])).collect();
        for aspect in [0.5, 1.2, 2.6, 5.0] {
            let places = places(Eye::around(&corners, aspect, [0.5, 0.6, 0.7, 0.8, 0.9, 1.0]), &corners, aspect);
            assert!(places.iter().flatten().all(|place| place.abs() < 1.0), "{aspect}: {places:?}");
            let reach = |axis: usize| {
                places.iter().fold([1.0f32, -1.0], |[low, high], at| [low.min(at[axis]), high.max(at[axis])])
            };
            let filled = [0, 1].map(|axis| 0.5 * (reach(axis)[1] - reach(axis)[0]));
            assert!(filled[0].max(filled[1]) > 0.9, "{aspect}: {filled:?}");
        }
    }
}
