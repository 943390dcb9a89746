//! What a history with friction carries from one step to the next.

use super::discs::{Pair, add, length, scaled};
use super::slip_round::values;
use crate::contact::Contact;

/// What a history carries from one step to the next.
#[derive(Clone)]
pub(super) struct SlipMemory {
    /// The contact of the last step, with the displacement `A_t p` along `x` by tractions `p` along `x`.
    pub pressed: Option<(Contact, Vec<f64>)>,
    /// The traction along `x` and `y`; the second one is empty in steps along `x` alone.
    pub traction: [Vec<f64>; 2],
    /// Its mean along `x` and `y`, a pressure, and the tangential loads that were given for it.
    pub tangential: Pair,
    pub loads: Pair,
    /// The displacement along `x` and `y` by the traction and, with coupling, by the pressure.
    pub displaced: [Vec<f64>; 2],
    /// With coupling, what the traction displaces into the solid.
    pub raised: Vec<f64>,
}

impl SlipMemory {
    /// `c = dQ/dP` of a step, at most `mu`, times the ratio of the tangential to the normal compliance; zero where the normal load stays.
    ///
    /// A normal load that changes by `dP` with a tangential one that changes by `c dP` lets all nodes stick where the traction changes by
    /// `c` times the pressure (Mindlin and Deresiewicz 1953; Jäger 1993). A node that does not touch then moves by `c` times the change of its gap
    /// relative to the rigid surface, less the shift. Without coupling and with `m = 0` this is exact. Otherwise it is not, and steps find
    /// the rest.
    pub(crate) fn rate(&self, contact: &Contact, target: Pair, (coefficient, ratio): (f64, f64)) -> Option<Pair> {
        let (earlier, _) = self.pressed.as_ref()?;
        let risen = contact.mean_pressure() - earlier.mean_pressure();
        let change = add(target, -1.0, self.tangential);
        if risen == 0.0 || length(change) == 0.0 {
            return Some([0.0; 2]);
        }
        let carried = (coefficient * risen.abs() / length(change)).min(1.0);
        Some(scaled(change, ratio * carried / risen))
    }

    /// How far nodes that come into contact in this step have moved along `x` and `y` relative to the rigid surface before they
    /// touched, less the shift, by the rate `c`: a step counts the slip of a node from where it touches.
    pub(crate) fn moved_before_touch(&self, contact: &Contact, rate: Pair) -> [Vec<f64>; 2] {
        let mut moved = self.displaced.each_ref().map(|it| vec![0.0; it.len()]);
        let Some((earlier, _)) = &self.pressed else { return moved };
        let (now, before) = (values(&contact.pressure), values(&earlier.pressure));
        for (moved, rate) in moved.iter_mut().zip(rate) {
            let gaps = values(&earlier.gap).iter().enumerate().zip(moved);
            for ((_, gap), moved) in gaps.filter(|((i, _), _)| now[*i] > 0.0 && before[*i] == 0.0) {
                *moved = -rate * gap.max(0.0);
            }
        }
        moved
    }
}
