//! The numbers of the states of a history: the one table of them.

use super::HistoryState;
use crate::contact::Validity;

/// The unit of a number of a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HistoryUnit {
    /// Dimensionless.
    One,
    /// A time.
    Time,
    /// A length.
    Length,
    /// A length per time.
    Speed,
    /// A pressure.
    Pressure,
    /// An energy per area.
    EnergyPerArea,
}

/// A number of the states of a history.
pub struct HistoryQuantity {
    /// Its name in tables and files.
    pub name: &'static str,
    /// Its title in charts.
    pub title: &'static str,
    /// Its unit.
    pub unit: HistoryUnit,
    /// What it is, in one sentence.
    pub help: &'static str,
    /// Its value; none where the process has no such number.
    pub value: fn(&HistoryState) -> Option<f64>,
}

/// All numbers of the states of a history, in the order of a table.
#[rustfmt::skip]
pub const HISTORY_QUANTITIES: &[HistoryQuantity] = &[
    quantity("time", "time", HistoryUnit::Time, "Time since the beginning.", |it| it.numbers.time),
    quantity("speed", "speed", HistoryUnit::Speed, "Speed at which the surface slides over the solid.", |it| it.numbers.speed),
    quantity("creepage", "creepage", HistoryUnit::One, "Creepage of rolling: the relative difference of the speeds of both surfaces.", |it| it.numbers.creepage),
    quantity("mean_pressure", "mean pressure", HistoryUnit::Pressure, "Mean pressure; with adhesion less the attraction, and negative where the surfaces are pulled apart.", |it| it.numbers.net_pressure.or_else(|| Some(it.contact.mean_pressure()))),
    quantity("contact_pressure", "mean contact pressure", HistoryUnit::Pressure, "Mean pressure where the surfaces touch, beside the attraction.", |it| it.numbers.net_pressure.map(|_| it.contact.mean_pressure())),
    quantity("mean_attraction", "mean attraction", HistoryUnit::Pressure, "Mean attraction between the surfaces.", |it| it.numbers.attraction),
    quantity("mean_traction", "mean traction", HistoryUnit::Pressure, "Mean traction along x on the solid.", |it| it.numbers.mean_traction),
    quantity("friction", "friction coefficient", HistoryUnit::One, "Tangential force divided by normal force.", |it| it.numbers.friction),
    quantity("lateral_friction", "lateral coefficient", HistoryUnit::One, "Force on the solid perpendicular to the motion, divided by the normal force.", |it| it.numbers.lateral_friction),
    quantity("friction_full_contact", "friction in full contact", HistoryUnit::One, "Friction coefficient in full contact under the same load, exact where all nodes touch.", |it| it.numbers.friction_full_contact),
    quantity("friction_persson", "friction by Persson", HistoryUnit::One, "Friction coefficient of Persson's theory, an estimate for partial contact.", |it| it.numbers.friction_persson),
    quantity("relative_area", "relative area", HistoryUnit::One, "Relative contact area, with edges interpolated between the nodes.", |it| Some(it.relative_area())),
    quantity("kappa_r", "kappa_r", HistoryUnit::One, "Area-load factor with the rms gradient in contact; of a solid that creeps, with its effective modulus.", |it| it.is_known(Validity::NoAdhesion).then(|| it.kappa_r())),
    quantity("effective_modulus", "effective modulus", HistoryUnit::Pressure, "Contact modulus in kappa_r of a contact that slides over a viscoelastic solid.", |it| it.numbers.effective_modulus),
    quantity("mean_gap", "mean gap", HistoryUnit::Length, "Mean gap.", |it| Some(it.contact.mean_gap())),
    quantity("plastic_overlap", "plastic overlap", HistoryUnit::Length, "Mean overlap of the surfaces where they yield, not part of the mean gap.", |it| it.contact.problem.law().hardness().map(|_| it.contact.plasticity().overlap)),
    quantity("approach", "approach", HistoryUnit::Length, "Approach of the bodies since the highest peak touched; not defined on a periodic half-space.", |it| it.contact.approach()),
    quantity("max_pressure", "largest pressure", HistoryUnit::Pressure, "Largest pressure.", |it| Some(it.contact.max_pressure())),
    quantity("effective_pressure", "effective pressure", HistoryUnit::Pressure, "Mean effective pressure: the pressure that would displace the glassy solid as far as the solid is displaced.", |it| it.numbers.effective_pressure),
    quantity("shift", "shift", HistoryUnit::Length, "Shift of the rigid surface along x since the beginning.", |it| it.numbers.shift),
    quantity("stick_share", "share that sticks", HistoryUnit::One, "Share of the nodes in contact that stick.", |it| it.numbers.stick_share),
    quantity("dissipated", "dissipated energy", HistoryUnit::EnergyPerArea, "Energy dissipated since the beginning, per area of the cell.", |it| it.numbers.dissipated),
    quantity("dissipated_error", "error of the loss", HistoryUnit::EnergyPerArea, "Estimated error of the energy that jumps have lost with adhesion, per area of the cell; not known on a free boundary.", |it| it.numbers.dissipated_error),
    quantity("stored", "stored energy", HistoryUnit::EnergyPerArea, "Stored elastic energy, per area of the cell; with friction, that of the traction alone, and with adhesion with the energy of the attraction.", |it| it.numbers.stored),
    quantity("work_done", "work of the load", HistoryUnit::EnergyPerArea, "Work of the load since the beginning, per area of the cell.", |it| it.numbers.work_done),
    quantity("time_error", "error in time", HistoryUnit::One, "Estimated relative error of the contact pressure, root mean square, that the length of the steps in time causes.", |it| it.numbers.time_error),
    quantity("mean_pressure_time_error", "error in time of the mean pressure", HistoryUnit::Pressure, "Estimated error of the mean pressure that the length of the steps in time causes; 0 where the load prescribes it.", |it| it.numbers.mean_pressure_time_error),
    quantity("mean_gap_time_error", "error in time of the mean gap", HistoryUnit::Length, "Estimated error of the mean gap that the length of the steps in time causes; 0 where it is prescribed.", |it| it.numbers.mean_gap_time_error),
    quantity("relative_area_time_error", "error in time of the area", HistoryUnit::One, "Estimated error of the relative area that the length of the steps in time causes.", |it| it.numbers.relative_area_time_error),
    quantity("dissipated_time_error", "error in time of the loss", HistoryUnit::EnergyPerArea, "Estimated error of the dissipated energy that the length of the steps in time causes, per area of the cell.", |it| it.numbers.dissipated_time_error),
    quantity("work_time_error", "error in time of the work", HistoryUnit::EnergyPerArea, "Estimated error of the work of the load, and of its balance with the stored and dissipated energy, that the length of the steps in time causes, per area of the cell.", |it| it.numbers.work_time_error),
    quantity("history_bound", "bound through time", HistoryUnit::One, "Bound of the relative error of the effective pressure that the solver caused in all steps so far.", |it| it.numbers.history_bound),
    quantity("jump", "energy of the jump", HistoryUnit::EnergyPerArea, "Energy lost in the jump that ends with this state, per area of the cell.", |it| it.numbers.jump),
    quantity("residual", "residual", HistoryUnit::One, "Largest violation of equilibrium at a node: a pressure over the strength of the attraction, or the displacement by it over the range.", |it| it.numbers.residual),
    quantity("least_curvature", "least curvature", HistoryUnit::One, "Least curvature of the energy over that of the softest wave; positive where the state is stable.", |it| it.numbers.least_curvature),
    quantity("curvature_error", "error of the curvature", HistoryUnit::One, "Error of the least curvature: there is an eigenvalue that is at most so far away.", |it| it.numbers.curvature_error),
    quantity("certificate", "certificate", HistoryUnit::One, "Certificate eta of the pressure.", |it| it.is_known(Validity::NoAdhesion).then_some(it.contact.certificate.eta)),
    quantity("traction_certificate", "certificate of the traction", HistoryUnit::One, "Certificate eta of the traction.", |it| it.numbers.traction_certificate),
    quantity("transforms", "transforms", HistoryUnit::One, "Fourier transforms since the state before.", |it| Some(it.work.transforms as f64)),
];

const fn quantity(
    name: &'static str,
    title: &'static str,
    unit: HistoryUnit,
    help: &'static str,
    value: fn(&HistoryState) -> Option<f64>,
) -> HistoryQuantity {
    HistoryQuantity { name, title, unit, help, value }
}

impl HistoryState {
    /// Whether a number of a validity has a meaning for the state.
    fn is_known(&self, validity: Validity) -> bool {
        validity.holds(self.contact.values().kind)
    }

    /// Relative contact area, with edges interpolated between the nodes: of a solid that creeps, by its effective pressure.
    pub fn relative_area(&self) -> f64 {
        self.numbers.relative_area.unwrap_or_else(|| self.contact.resolved().relative_area)
    }

    /// `kappa_r`: of a solid that creeps, and of a contact that slides, with the effective modulus.
    pub fn kappa_r(&self) -> f64 {
        self.numbers.kappa_r.unwrap_or_else(|| self.contact.resolved().kappa_r)
    }
}
