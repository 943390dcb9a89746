//! The eye that looks at a relief.

use glam::Vec3;

/// From what is looked at towards the eye, seen from above: from the front and the right.
const TOWARDS: [f32; 2] = [0.43, -0.9];
/// Heights of the eye that are tried, in radians above the horizon.
const ELEVATIONS: [f32; 6] = [0.5, 0.6, 0.7, 0.8, 0.9, 1.0];
/// Half of the angle of view of the viewer from below to above, in radians.
const HALF_VIEW: f32 = 27.5 * std::f32::consts::PI / 180.0;
/// Share of the pane that is filled.
const FILLED: f32 = 0.96;
/// The farthest distance that is tried, and how often the distance is halved and the middle moved.
const FARTHEST: f32 = 1e3;
const ROUNDS: usize = 40;

/// Where the eye stands, and what it looks at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eye {
    pub position: [f32; 3],
    pub target: [f32; 3],
}

impl Eye {
    /// The eye that sees all `corners` as large as possible in a pane that is `aspect` times as wide as it is high.
    pub fn around(corners: &[Vec3], aspect: f32) -> Self {
        let eyes = ELEVATIONS.map(|elevation| Self::nearest(corners, aspect, elevation));
        let [(first, _), ..] = eyes;
        eyes.into_iter().fold((first, 0.0), |best, other| if other.1 > best.1 { other } else { best }).0
    }

    /// The nearest eye at a height that sees all corners, and the share of the pane that they fill.
    fn nearest(corners: &[Vec3], aspect: f32, elevation: f32) -> (Self, f32) {
        let (across, upwards) = (elevation.cos(), elevation.sin());
        let towards = Vec3::new(across * TOWARDS[0], across * TOWARDS[1], upwards).normalize();
        let right = Vec3::Z.cross(towards).normalize();
        let up = towards.cross(right);
        let room = [aspect, 1.0].map(|width| FILLED * HALF_VIEW.tan() * width);
        let mut target = corners.iter().sum::<Vec3>() / corners.len() as f32;
        let ([mut near, mut far], mut filled) = ([0.0, FARTHEST], 0.0);
        for _ in 0..ROUNDS {
            let distance = 0.5 * (near + far);
            let [x, y] = [(right, room[0]), (up, room[1])].map(|(axis, room)| {
                let places = corners.iter().map(|corner| {
                    let from = *corner - target;
                    let depth = distance - from.dot(towards);
                    if depth > 0.0 { from.dot(axis) / depth / room } else { f32::INFINITY }
                });
                places.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
            });
            let reach = [x, y].map(|[low, high]| 0.5 * (high - low));
            if reach.iter().all(|reach| *reach <= 1.0) {
                far = distance;
                filled = reach[0] * reach[1];
                target += distance * (right * x[0].midpoint(x[1]) * room[0] + up * y[0].midpoint(y[1]) * room[1]);
            } else {
                near = distance;
            }
        }
        (Self { position: (target + far * towards).to_array(), target: target.to_array() }, filled)
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
            let places = places(Eye::around(&corners, aspect), &corners, aspect);
            assert!(places.iter().flatten().all(|place| place.abs() < 1.0), "{aspect}: {places:?}");
            let reach = |axis: usize| {
                places.iter().fold([1.0f32, -1.0], |[low, high], at| [low.min(at[axis]), high.max(at[axis])])
            };
            let filled = [0, 1].map(|axis| 0.5 * (reach(axis)[1] - reach(axis)[0]));
            assert!(filled[0].max(filled[1]) > 0.9, "{aspect}: {filled:?}");
        }
    }
}
