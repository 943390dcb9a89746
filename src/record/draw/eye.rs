//! The eye that looks at a relief.

use glam::Vec3;

/// From what is looked at towards the eye: from the front, the right and above.
const TOWARDS: Vec3 = Vec3::new(4.6, -9.6, 8.8);
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
    /// The nearest eye that sees all `corners` in a pane that is `aspect` times as wide as it is high.
    pub fn around(corners: &[Vec3], aspect: f32) -> Self {
        let towards = TOWARDS.normalize();
        let right = Vec3::Z.cross(towards).normalize();
        let up = towards.cross(right);
        let mut target = corners.iter().sum::<Vec3>() / corners.len() as f32;
        let [mut near, mut far] = [0.0, FARTHEST];
        for _ in 0..ROUNDS {
            let distance = 0.5 * (near + far);
            let seen = |axis: Vec3, room: f32| {
                let places = corners.iter().map(|corner| {
                    let from = *corner - target;
                    let depth = distance - from.dot(towards);
                    if depth > 0.0 { from.dot(axis) / depth / room } else { f32::INFINITY }
                });
                places.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
            };
            let room = FILLED * HALF_VIEW.tan();
            let [across, upwards] = [(right, room * aspect), (up, room)].map(|(axis, room)| seen(axis, room));
            let is_seen = [across, upwards].iter().all(|[low, high]| high - low <= 2.0);
            if is_seen {
                far = distance;
                let shift = |[low, high]: [f32; 2], room: f32| 0.5 * (low + high) * room * distance;
                target += right * shift(across, room * aspect) + up * shift(upwards, room);
            } else {
                near = distance;
            }
        }
        Self { position: (target + far * towards).to_array(), target: target.to_array() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where the corners are in a pane, from -1 to 1 across and upwards.
    fn places(eye: Eye, corners: &[Vec3], aspect: f32) -> Vec<[f32; 2]> {
        let to_view = glam::Mat4::look_at_rh(eye.position.into(), eye.target.into(), Vec3::Z);
        let to_pane = glam::Mat4::perspective_rh(2.0 * HALF_VIEW, aspect, 0.1, 1e4) * to_view;
        corners.iter().map(|corner| to_pane.project_point3(*corner).truncate().to_array()).collect()
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
