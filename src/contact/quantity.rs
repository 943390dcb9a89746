//! The quantities: all numbers that can be read of a state, in one table.
//!
//! A new quantity needs one row of the table. Results, tables of studies, the page, Python and the curves of recordings follow from it.
//!
//! A plain name such as `relative_area` or `kappa_r` is the most accurate value, with contact edges interpolated between the nodes. The errors
//! `relative_area_error` and `kappa_r_error` belong to it. Names that end in `_counted` are from counting nodes. Names that end in `_corrected` are
//! from counting nodes, minus the mean excess.

use super::quantity_row::Curve;
use super::readings::{in_contact, known, positive};
use crate::contact::{PageTable, QuantityKind, QuantityRow, Readings, Unit, Validity};
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumString, IntoEnumIterator, IntoStaticStr};

/// Makes of the rows the enum [`Quantity`], its table, and the struct [`Observables`]. Rows of `known` are numbers that only a process knows. Rows of
/// `found` can be computed of any contact.
///
/// The parts of a row: `symbol` and `title` in charts, `short` where a column of text needs another heading than the title, `unit`, `kind` of its values
/// (numbers, unless the type or the row says otherwise), which `curve` it has in recordings, on which part of the `page` it stands, for which states it is `valid`, the `errors` that are estimated of
/// it, whether `solve` prints it in a row of its own (`printed`), how it is computed `of` a reading, and one `sentence`.
macro_rules! quantities {
    (
        known { $($known:ident $known_name:ident {
            symbol: $known_symbol:literal, title: $known_title:literal, $(short: $known_short:literal,)? unit: $known_unit:ident, kind: $known_kind:ident,
            curve: $known_curve:ident, $(page: $known_page:ident,)? $(errors: [$($known_error:ident),+],)? sentence: $known_sentence:literal
        })+ }
        found { $($found:ident $field:ident: $type:ty {
            symbol: $symbol:literal, title: $title:literal, $(short: $short:literal,)? unit: $unit:ident, $(kind: $kind:ident,)? curve: $curve:ident,
            $(page: $page:ident,)? valid: $validity:ident, $(errors: [$($error:ident),+],)? $(printed: $is_printed:literal,)? of: $of:expr, sentence: $sentence:literal
        })+ }
    ) => {
        /// A number that can be read of a state.
        ///
        /// ```
        /// use asperity::contact::{Quantity, Unit};
        /// assert_eq!((Quantity::MeanGap.name(), Quantity::MeanGap.row().unit), ("mean_gap", Unit::Length));
        /// assert_eq!(Quantity::find("kappa_r"), Some(Quantity::KappaR));
        /// ```
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, EnumIter, EnumString, IntoStaticStr)]
        #[strum(serialize_all = "snake_case")]
        pub enum Quantity {
            $(#[doc = $known_sentence] $known,)+
            $(#[doc = $sentence] $found,)+
        }

        /// The table of all quantities, in the order of [`Quantity`].
        const TABLE: &[QuantityRow] = &[
            $(QuantityRow {
                name: stringify!($known_name),
                symbol: $known_symbol,
                title: $known_title,
                short: [$($known_short,)? $known_title][0],
                unit: Unit::$known_unit,
                kind: QuantityKind::$known_kind,
                is_traced: matches!(Curve::$known_curve, Curve::Steps | Curve::Both),
                has_curve: matches!(Curve::$known_curve, Curve::States | Curve::Both),
                validity: Validity::Always,
                is_printed: false,
                page: [$(Some(PageTable::$known_page),)? None][0],
                is_known_by_process: true,
                errors: &[$($(stringify!($known_error)),+)?],
                sentence: $known_sentence,
                read: None,
            },)+
            $(QuantityRow {
                name: stringify!($field),
                symbol: $symbol,
                title: $title,
                short: [$($short,)? $title][0],
                unit: Unit::$unit,
                kind: [$(QuantityKind::$kind,)? kind_of(stringify!($type))][0],
                is_traced: matches!(Curve::$curve, Curve::Steps | Curve::Both),
                has_curve: matches!(Curve::$curve, Curve::States | Curve::Both),
                validity: Validity::$validity,
                is_printed: [$($is_printed,)? false][0],
                page: QuantityRow::page([$(Some(PageTable::$page),)? None][0], Curve::$curve),
                is_known_by_process: false,
                errors: &[$($(stringify!($error)),+)?],
                sentence: $sentence,
                read: Some(|reading| {
                    let of: fn(&dyn Readings) -> $type = $of;
                    of(reading) as f64
                }),
            },)+
        ];

        /// All quantities that can be computed of a contact; those that are not known are NaN or 0.
        ///
        /// ```
        /// use asperity::contact::Observables;
        /// use asperity::setup::Setup;
        /// let setup = Setup::from_toml("
        ///     surface = { indenter = { shape = 'sine', amplitude = 0.01 } }
        ///     grid = { points = 256, size = 1.0 }
        ///     load = { reduced-pressure = 0.1 }
        /// ")?;
        /// let contact = setup.solver.solver().solve(&setup.problem()?, &setup.stop, &mut ())?;
        /// let found = Observables::new(&contact);
        /// assert_eq!((found.patches, found.kappa_r), (1, contact.resolved().kappa_r));
        /// # Ok::<(), Box<dyn std::error::Error>>(())
        /// ```
        #[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
        #[serde(default)]
        pub struct Observables {
            $(#[doc = $sentence] pub $field: $type,)+
        }

        impl Observables {
            /// All of them by what gives the value of each.
            pub(super) fn by(value: impl Fn(Quantity) -> f64) -> Self {
                Self { $($field: value(Quantity::$found) as $type,)+ }
            }

            /// The numbers, in the order of [`Quantity::found`].
            pub fn numbers(&self) -> Vec<f64> {
                vec![$(self.$field as f64,)+]
            }
        }
    };
}

// The rows.
#[rustfmt::skip]
quantities! {
    known {
        Time time { symbol: "t", title: "time", unit: Time, kind: Number, curve: States,
            sentence: "Time since the beginning." }
        Speed speed { symbol: "V", title: "speed", unit: Speed, kind: Number, curve: States,
            sentence: "Speed at which the surface slides over the solid." }
        Creepage creepage { symbol: "xi", title: "creepage", unit: One, kind: Number, curve: States,
            sentence: "Creepage of rolling: the relative difference of the speeds of both surfaces." }
        ContactPressure contact_pressure { symbol: "<p_c>", title: "mean contact pressure", unit: Pressure, kind: Number, curve: States,
            sentence: "Mean pressure where the surfaces touch, beside the attraction." }
        MeanAttraction mean_attraction { symbol: "<sigma>", title: "mean attraction", short: "attraction", unit: Pressure, kind: Number, curve: States,
            sentence: "Mean attraction between the surfaces." }
        MeanTraction mean_traction { symbol: "<tau>", title: "mean traction", unit: Pressure, kind: Number, curve: States,
            sentence: "Mean traction along x on the solid." }
        LateralFriction lateral_friction { symbol: "mu_y", title: "lateral coefficient", unit: One, kind: Number, curve: States,
            sentence: "Force on the solid perpendicular to the motion, divided by the normal force." }
        FrictionFullContact friction_full_contact { symbol: "mu, full", title: "friction in full contact", short: "in full contact", unit: One, kind: Number, curve: States,
            sentence: "Friction coefficient in full contact under the same load, exact where all nodes touch." }
        FrictionPersson friction_persson { symbol: "mu, Persson", title: "friction by Persson", short: "Persson", unit: One, kind: Number, curve: States,
            sentence: "Friction coefficient of Persson's theory, an estimate for partial contact." }
        FrictionError friction_error { symbol: "|dmu| / mu", title: "error of the friction", short: "relative error", unit: One, kind: Bound, curve: None,
            sentence: "Estimated relative error of the hysteretic friction coefficient on this grid: the difference from half as many points along each axis, and the error of the area." }
        EffectivePressure effective_pressure { symbol: "<p_eff>", title: "effective pressure", short: "eff. pressure", unit: Pressure, kind: Number, curve: States,
            sentence: "Mean effective pressure: the pressure that would displace the glassy solid as far as the solid is displaced." }
        Shift shift { symbol: "s", title: "shift", unit: Length, kind: Number, curve: States,
            sentence: "Shift of the rigid surface along x since the beginning." }
        StickShare stick_share { symbol: "n_s / n_c", title: "share that sticks", short: "sticks", unit: One, kind: Number, curve: States,
            sentence: "Share of the nodes in contact that stick." }
        ShiftPathError shift_path_error { symbol: "|ds|, path", title: "error of the shift by the steps", short: "error of shift", unit: Length, kind: Number, curve: States,
            sentence: "Estimated error of the shift that the length of the steps of the path causes; 0 where steps are exact." }
        StickSharePathError stick_share_path_error { symbol: "|dn_s| / n_c, path", title: "error of the share that sticks by the steps", unit: One, kind: Number, curve: None,
            sentence: "Estimated error of the share of the nodes in contact that stick, that the length of the steps of the path causes; at least the share of those at the edge of what sticks." }
        Dissipated dissipated { symbol: "W_lost", title: "dissipated energy", short: "energy lost", unit: EnergyPerArea, kind: Number, curve: States,
            sentence: "Energy dissipated since the beginning, per area of the cell." }
        DissipatedError dissipated_error { symbol: "|dW_lost|", title: "error of the loss", unit: EnergyPerArea, kind: Number, curve: States,
            sentence: "Estimated error of the energy that jumps have lost with adhesion, per area of the cell; not known on a free boundary." }
        Stored stored { symbol: "W_stored", title: "stored energy", unit: EnergyPerArea, kind: Number, curve: States,
            sentence: "Stored elastic energy, per area of the cell; with friction, that of the traction alone, and with adhesion with the energy of the attraction." }
        WorkDone work_done { symbol: "W", title: "work of the load", unit: EnergyPerArea, kind: Number, curve: States,
            sentence: "Work of the load since the beginning, per area of the cell." }
        TimeError time_error { symbol: "|dp| / |p|, t", title: "error in time", unit: One, kind: Bound, curve: States,
            sentence: "Estimated relative error of the contact pressure, root mean square, that the length of the steps in time causes." }
        MeanPressureTimeError mean_pressure_time_error { symbol: "|d<p>|, t", title: "error in time of the mean pressure", unit: Pressure, kind: Number, curve: States,
            sentence: "Estimated error of the mean pressure that the length of the steps in time causes; 0 where the load prescribes it." }
        MeanGapTimeError mean_gap_time_error { symbol: "|d<g>|, t", title: "error in time of the mean gap", unit: Length, kind: Number, curve: States,
            sentence: "Estimated error of the mean gap that the length of the steps in time causes; 0 where it is prescribed." }
        RelativeAreaTimeError relative_area_time_error { symbol: "|da|, t", title: "error in time of the area", unit: One, kind: Number, curve: States,
            sentence: "Estimated error of the relative area that the length of the steps in time causes." }
        DissipatedTimeError dissipated_time_error { symbol: "|dW_lost|, t", title: "error in time of the loss", short: "error of loss", unit: EnergyPerArea, kind: Number, curve: States,
            sentence: "Estimated error of the dissipated energy that the length of the steps in time causes, per area of the cell." }
        DissipatedPathError dissipated_path_error { symbol: "|dW_lost|, path", title: "error of the loss by the steps", short: "error of loss", unit: EnergyPerArea, kind: Number, curve: States,
            sentence: "Estimated error of the energy dissipated by friction that the length of the steps of the path causes, per area of the cell; 0 where steps are exact." }
        WorkTimeError work_time_error { symbol: "|dW|, t", title: "error in time of the work", unit: EnergyPerArea, kind: Number, curve: States,
            sentence: "Estimated error of the work of the load, and of its balance with the stored and dissipated energy, that the length of the steps in time causes, per area of the cell." }
        HistoryBound history_bound { symbol: "|dp_eff| / |p_eff|", title: "bound through time", unit: One, kind: Number, curve: States,
            sentence: "Bound of the relative error of the effective pressure that the solver caused in all steps so far." }
        Jump jump { symbol: "dW", title: "energy of the jump", short: "lost in jump", unit: EnergyPerArea, kind: Number, curve: None,
            sentence: "Energy lost in the jump that ends with this state, per area of the cell." }
        Residual residual { symbol: "r", title: "residual", unit: One, kind: Bound, curve: None,
            sentence: "Largest violation of equilibrium at a node: a pressure over the strength of the attraction, or the displacement by it over the range." }
        LeastCurvature least_curvature { symbol: "lambda", title: "least curvature", unit: One, kind: Number, curve: States,
            sentence: "Least curvature of the energy over that of the softest wave; positive where the state is stable." }
        CurvatureError curvature_error { symbol: "|dlambda|", title: "error of the curvature", unit: One, kind: Number, curve: States,
            sentence: "Error of the least curvature: there is an eigenvalue that is at most so far away." }
        PressureInContact pressure_in_contact { symbol: "p_m", title: "mean pressure in contact", unit: Pressure, kind: Number, curve: States,
            sentence: "Mean pressure over the area in contact of a solid that yields below its surface; under a ball it rises to about 2.8 times the yield stress." }
        PressureInContactError pressure_in_contact_error { symbol: "|dp_m| / p_m", title: "error of the mean pressure in contact", unit: One, kind: Number, curve: States,
            sentence: "Estimated relative error of the mean pressure in contact on this grid: that of the area, by which the load is divided." }
        ContactPressureOverYield contact_pressure_over_yield { symbol: "p_m / Y", title: "contact pressure over yield stress", short: "p_m / Y", unit: One, kind: Number, curve: States,
            sentence: "Mean pressure over the area in contact divided by the yield stress: 1.1 where a ball begins to dent, about 2.8 where it is fully plastic." }
        MaxPlasticStrain max_plastic_strain { symbol: "alpha_max", title: "largest plastic strain", short: "largest alpha", unit: One, kind: Number, curve: States,
            sentence: "Largest accumulated plastic strain." }
        DeepestYield deepest_yield { symbol: "z_pl", title: "deepest yield", unit: Length, kind: Number, curve: States,
            sentence: "Depth at which the deepest layer ends that has yielded, with a plastic strain above a thousandth of the elastic strain at yield; 0 where none has." }
        PlasticVolume plastic_volume { symbol: "V_pl / A", title: "plastic volume", unit: Length, kind: Number, curve: States,
            sentence: "Volume that has yielded, per area of the cell." }
        ImprintDepth imprint_depth { symbol: "d_imp", title: "depth of the imprint", short: "imprint", unit: Length, kind: Number, curve: States,
            errors: [imprint_step_error, imprint_layer_error, imprint_grid_error],
            sentence: "Difference of the largest and the smallest displacement of the surface by the plastic strain: the depth of the imprint that stays without load." }
        PlasticWork plastic_work { symbol: "W_pl", title: "plastic work", unit: EnergyPerArea, kind: Number, curve: States,
            sentence: "Energy that flow has taken up since the beginning, per area of the cell." }
        StepCertificate step_certificate { symbol: "eta_s", title: "certificate of the load step", short: "eta of step", unit: One, kind: Bound, curve: None, page: Solving,
            sentence: "Bound of the distance of the load step from its least energy, over the energy that flow took up in the step plus a thousandth of the elastic energy." }
        ImprintStepError imprint_step_error { symbol: "|d_imp|, s", title: "error of the imprint by the steps", unit: Length, kind: Number, curve: None,
            sentence: "Estimated error of the depth of the imprint by the load steps: three times the difference from steps of half the length, and at least 0.4 % of the depth." }
        ImprintLayerError imprint_layer_error { symbol: "|d_imp|, z", title: "error of the imprint by the layers", unit: Length, kind: Number, curve: None,
            sentence: "Estimated error of the depth of the imprint by the layers: twice the difference from layers of twice the thickness, and at least half the difference between these and layers of four times the thickness." }
        ImprintGridError imprint_grid_error { symbol: "|d_imp|, dx", title: "error of the imprint by the grid", unit: Length, kind: Number, curve: None,
            sentence: "Estimated error of the depth of the imprint by the grid: the difference from half as many points along each axis." }
        RelativeAreaStepError relative_area_step_error { symbol: "|da|, s", title: "error of the area by the steps", unit: One, kind: Number, curve: None,
            sentence: "Estimated error of the relative area by the load steps: three times the difference from steps of half the length, and at least 0.2 % of the area." }
        RelativeAreaLayerError relative_area_layer_error { symbol: "|da|, z", title: "error of the area by the layers", unit: One, kind: Number, curve: None,
            sentence: "Estimated error of the relative area by the layers: twice the difference from layers of twice the thickness, and at least half the difference between these and layers of four times the thickness." }
        RelativeAreaGridError relative_area_grid_error { symbol: "|da|, dx", title: "error of the area by the grid", unit: One, kind: Number, curve: None,
            sentence: "Estimated error of the relative area by the grid: the difference from half as many points along each axis." }
        TractionCertificate traction_certificate { symbol: "eta_t", title: "certificate of the traction", short: "eta of traction", unit: One, kind: Bound, curve: None, page: Solving,
            sentence: "Certificate eta of the traction." }
        OpenPercolatesX open_percolates_x { symbol: "open?", title: "open area percolates along x", unit: One, kind: Flag, curve: None,
            sentence: "Whether the open area connects both sides along x." }
        OpenPercolatesY open_percolates_y { symbol: "open?", title: "open area percolates along y", unit: One, kind: Flag, curve: None,
            sentence: "Whether the open area connects both sides along y." }
        ContactPercolatesX contact_percolates_x { symbol: "joined?", title: "contact percolates along x", unit: One, kind: Flag, curve: None,
            sentence: "Whether the contact connects both sides along x." }
        ContactPercolatesY contact_percolates_y { symbol: "joined?", title: "contact percolates along y", unit: One, kind: Flag, curve: None,
            sentence: "Whether the contact connects both sides along y." }
        LeakageLowerX leakage_lower_x { symbol: "sigma_-", title: "least leakage along x", unit: Volume, kind: Number, curve: None,
            sentence: "Lower bound of the leakage along x: the cube of the gap of parallel plates that leak as much." }
        LeakageUpperX leakage_upper_x { symbol: "sigma_+", title: "largest leakage along x", unit: Volume, kind: Number, curve: None,
            sentence: "Upper bound of the leakage along x." }
        LeakageLowerY leakage_lower_y { symbol: "sigma_-", title: "least leakage along y", unit: Volume, kind: Number, curve: None,
            sentence: "Lower bound of the leakage along y: the cube of the gap of parallel plates that leak as much." }
        LeakageUpperY leakage_upper_y { symbol: "sigma_+", title: "largest leakage along y", unit: Volume, kind: Number, curve: None,
            sentence: "Upper bound of the leakage along y." }
        HydraulicGapX hydraulic_gap_x { symbol: "u_h", title: "hydraulic gap along x", short: "leaks along x", unit: Length, kind: Number, curve: None,
            sentence: "The gap of parallel plates that leak as much along x." }
        HydraulicGapY hydraulic_gap_y { symbol: "u_h", title: "hydraulic gap along y", short: "leaks along y", unit: Length, kind: Number, curve: None,
            sentence: "The gap of parallel plates that leak as much along y." }
        ConductancePerArea conductance_per_area { symbol: "G / A", title: "conductance per area", short: "conductance", unit: Conductance, kind: Number, curve: None,
            sentence: "The conductance per area of the cell; infinite where all nodes touch." }
        ConductanceTimesResistivity conductance_times_resistivity { symbol: "G rho / A", title: "conductance times resistivity", unit: PerLength, kind: Number, curve: None,
            sentence: "The conductance per area times the sum of both resistivities: twice the contact stiffness over the contact modulus." }
        LowestPressure lowest_pressure { symbol: "<p>_min", title: "lowest mean pressure", unit: Pressure, kind: Number, curve: None,
            sentence: "The lowest mean pressure since the beginning, also between the states that are shown; negative if the surfaces stick, and the pull-off pressure if they parted." }
        Separated separated { symbol: "apart?", title: "separated", unit: One, kind: Flag, curve: None,
            sentence: "Whether the surfaces parted under the load." }
        LargestArea largest_area { symbol: "a_max", title: "largest relative area", unit: One, kind: Number, curve: None,
            sentence: "The largest share of nodes that touched in any state: by counting nodes." }
        Jumps jumps { symbol: "n_j", title: "jumps", unit: One, kind: Whole, curve: None,
            sentence: "The number of jumps." }
        LostInJumps lost_in_jumps { symbol: "W_j", title: "energy lost in jumps", unit: EnergyPerArea, kind: Number, curve: None,
            sentence: "Energy lost in all jumps but parting under the load, per area of the cell." }
        LostError lost_error { symbol: "|dW_j|", title: "error of the energy lost in jumps", unit: EnergyPerArea, kind: Number, curve: None,
            sentence: "Estimated error of the energy lost in jumps, per area of the cell; not known on a free boundary." }
        Stable stable { symbol: "stable?", title: "stable", unit: One, kind: Flag, curve: None,
            sentence: "Whether each state with contact was stable, or the solution." }
        States states { symbol: "n", title: "states", unit: One, kind: Whole, curve: None,
            sentence: "The number of states, without the frames of motions." }
        HistoryTransforms history_transforms { symbol: "transforms", title: "transforms of the history", unit: One, kind: Whole, curve: None,
            sentence: "Fourier transforms of all states." }
    }
    found {
        MeanPressure mean_pressure: f64 { symbol: "<p>", title: "mean pressure", unit: Pressure, curve: States, valid: Always,
            of: |it| it.mean_pressure(),
            sentence: "Mean pressure." }
        ReducedPressure reduced_pressure: f64 { symbol: "p*", title: "reduced pressure", short: "p*", unit: One, curve: None, valid: Always,
            of: |it| it.reduced_pressure(),
            sentence: "Reduced pressure: mean pressure divided by rms gradient and contact modulus, of a contact that slides by its effective modulus." }
        ReducedPressureContact reduced_pressure_contact: f64 { symbol: "p_r*", title: "reduced pressure in contact", unit: One, curve: None, valid: Elastic,
            of: |it| known(it.resolved().reduced_pressure_contact),
            sentence: "Reduced pressure with the rms gradient of the contact." }
        ReducedPressureContactCounted reduced_pressure_contact_counted: f64 { symbol: "p_r*, counted", title: "reduced pressure in contact, nodes counted", unit: One, curve: None, valid: Elastic,
            of: |it| known(it.counted().reduced_pressure_contact),
            sentence: "Reduced pressure with the rms gradient of the nodes in contact." }
        RelativeArea relative_area: f64 { symbol: "a_rel", title: "relative area", unit: One, curve: Both, valid: Always,
            errors: [relative_area_error, relative_area_step_error, relative_area_layer_error, relative_area_grid_error],
            of: |it| it.resolved().relative_area,
            sentence: "Relative contact area, with contact edges interpolated between grid nodes; with adhesion the fraction of nodes in contact." }
        RelativeAreaCounted relative_area_counted: f64 { symbol: "a_rel, counted", title: "relative area, nodes counted", short: "counted", unit: One, curve: Steps, valid: Always,
            of: |it| it.counted().relative_area,
            sentence: "Relative contact area as the fraction of nodes in contact." }
        RelativeAreaCorrected relative_area_corrected: f64 { symbol: "a_rel, corrected", title: "relative area, corrected", unit: One, curve: None, valid: Elastic,
            of: |it| it.counted().relative_area_corrected,
            sentence: "Fraction of nodes in contact, minus the mean excess of counted nodes at the edges." }
        RmsHeight rms_height: f64 { symbol: "h_rms", title: "rms height", unit: Length, curve: None, valid: Always, printed: true,
            of: |it| it.rms_height(),
            sentence: "Root mean square of the heights about their mean." }
        RmsGradient rms_gradient: f64 { symbol: "g_rms", title: "rms gradient", unit: One, curve: None, valid: Always,
            of: |it| it.rms_gradient(),
            sentence: "Root-mean-square gradient of the surface." }
        RmsGradientContact rms_gradient_contact: f64 { symbol: "g_r", title: "rms gradient in contact", unit: One, curve: None, valid: Elastic,
            of: |it| in_contact(it, it.resolved().rms_gradient_contact),
            sentence: "Root-mean-square gradient over the contact, with contact edges interpolated between grid nodes." }
        RmsGradientContactCounted rms_gradient_contact_counted: f64 { symbol: "g_r, counted", title: "rms gradient in contact, nodes counted", unit: One, curve: None, valid: Always,
            of: |it| in_contact(it, it.counted().rms_gradient_contact),
            sentence: "Root-mean-square gradient of the nodes in contact." }
        RmsGradientContactCorrected rms_gradient_contact_corrected: f64 { symbol: "g_r, corrected", title: "rms gradient in contact, corrected", unit: One, curve: None, valid: Elastic,
            of: |it| in_contact(it, it.counted().rms_gradient_contact_corrected),
            sentence: "Root-mean-square gradient of the nodes in contact, minus the mean excess of counted nodes at the edges." }
        Kappa kappa: f64 { symbol: "kappa", title: "kappa", unit: One, curve: Steps, valid: Elastic, errors: [relative_area_error],
            of: |it| positive(it.resolved().relative_area / it.counted().reduced_pressure),
            sentence: "Relative contact area divided by reduced pressure, with contact edges interpolated between grid nodes." }
        KappaCounted kappa_counted: f64 { symbol: "kappa, counted", title: "kappa, nodes counted", unit: One, curve: None, valid: Elastic,
            of: |it| positive(it.counted().kappa),
            sentence: "Fraction of nodes in contact divided by reduced pressure." }
        KappaCorrected kappa_corrected: f64 { symbol: "kappa, corrected", title: "kappa, corrected", unit: One, curve: None, valid: Elastic,
            of: |it| positive(it.counted().relative_area_corrected / it.counted().reduced_pressure),
            sentence: "Corrected relative contact area divided by reduced pressure." }
        KappaR kappa_r: f64 { symbol: "kappa_r", title: "kappa_r", unit: One, curve: Both, valid: NoAdhesion, errors: [kappa_r_error],
            of: |it| it.kappa_r(),
            sentence: "Relative contact area divided by the reduced pressure with the rms gradient of the contact, with contact edges interpolated between grid nodes." }
        KappaRCounted kappa_r_counted: f64 { symbol: "kappa_r, counted", title: "kappa_r, nodes counted", unit: One, curve: Steps, valid: Elastic,
            of: |it| positive(it.counted().kappa_r),
            sentence: "Fraction of nodes in contact, divided by the reduced pressure with the rms gradient of these nodes." }
        KappaRCorrected kappa_r_corrected: f64 { symbol: "kappa_r, corrected", title: "kappa_r, corrected", unit: One, curve: None, valid: Elastic,
            of: |it| positive(it.counted().kappa_r_corrected),
            sentence: "Corrected relative contact area divided by the reduced pressure with the corrected rms gradient of the contact." }
        MeanGap mean_gap: f64 { symbol: "<g>", title: "mean gap", unit: Length, curve: States, valid: Always,
            of: |it| it.mean_gap(),
            sentence: "Mean gap between the surfaces." }
        MeanGapOverRmsHeight mean_gap_over_rms_height: f64 { symbol: "<g> / h_rms", title: "mean gap over rms height", unit: One, curve: Steps, valid: Always,
            of: |it| it.mean_gap() / it.rms_height(),
            sentence: "Mean gap divided by the rms height." }
        ElasticEnergy elastic_energy: f64 { symbol: "U", title: "elastic energy", unit: EnergyPerArea, curve: None, valid: Elastic,
            of: |it| it.elastic_energy(),
            sentence: "Elastic energy per area: half the mean of pressure times displacement." }
        Approach approach: f64 { symbol: "d", title: "approach", unit: Length, curve: States, valid: Always,
            of: |it| it.approach(),
            sentence: "Approach: distance that the surface has moved since its highest peak touched the undeformed solid. Not defined on a periodic half-space." }
        PlasticArea plastic_area: f64 { symbol: "a_pl", title: "plastic area", unit: One, curve: None, valid: Elastic,
            of: |it| it.plastic_area(),
            sentence: "Relative plastic area: the fraction of nodes at the hardness, where the solid yields." }
        PlasticLoadShare plastic_load_share: f64 { symbol: "F_pl / F", title: "plastic share of the load", unit: One, curve: None, valid: Yielding,
            of: |it| it.plastic_load_share(),
            sentence: "Fraction of the load that is carried by nodes at the hardness, where the solid yields." }
        PlasticOverlap plastic_overlap: f64 { symbol: "<o>", title: "plastic overlap", unit: Length, curve: States, valid: Yielding,
            of: |it| it.plastic_overlap(),
            sentence: "Mean overlap of the surfaces where they yield or have yielded, not part of the mean gap: the plastically displaced volume per area of the cell." }
        MaxPressure max_pressure: f64 { symbol: "p_max", title: "largest pressure", short: "max. pressure", unit: Pressure, curve: States, valid: Always,
            of: |it| it.max_pressure(),
            sentence: "Largest pressure." }
        MaxPressureOverModulus max_pressure_over_modulus: f64 { symbol: "p_max / E*", title: "largest pressure over modulus", unit: One, curve: None, valid: Always, printed: true,
            of: |it| it.max_pressure() / it.contact_modulus(),
            sentence: "Largest pressure divided by the contact modulus." }
        EffectiveModulus effective_modulus: f64 { symbol: "E*_eff", title: "effective modulus", unit: Pressure, curve: States, valid: Sliding,
            of: |it| it.effective_modulus(),
            sentence: "Contact modulus that reduced pressures, kappa and kappa_r use: E*, or between the relaxed and the glassy one for a contact that slides over a viscoelastic solid." }
        Patches patches: usize { symbol: "n", title: "contact patches", short: "patches", unit: One, curve: Steps, valid: Always,
            of: |it| it.patches(),
            sentence: "Number of contact patches." }
        NodesPerPatch nodes_per_patch: f64 { symbol: "n_c / n", title: "nodes per patch", unit: One, curve: None, valid: Always,
            of: |it| in_contact(it, it.resolution().nodes_per_patch),
            sentence: "Nodes in contact per contact patch." }
        UnresolvedShare unresolved_share: f64 { symbol: "n_c < few / n_c", title: "share that is not resolved", unit: One, curve: None, valid: Always,
            of: |it| in_contact(it, it.resolution().unresolved_share),
            sentence: "Fraction of the nodes in contact that are in patches too small to trust: fewer than 4 nodes on lines, 12 on surfaces." }
        FilledAreaShare filled_area_share: f64 { symbol: "n_f / n_c", title: "share of contact on filled heights", unit: One, curve: None, valid: Always,
            of: |it| in_contact(it, it.counted().filled_area_share),
            sentence: "Fraction of the nodes in contact whose heights were not measured but filled in." }
        FilledLoadShare filled_load_share: f64 { symbol: "F_f / F", title: "share of load on filled heights", unit: One, curve: None, valid: Always,
            of: |it| in_contact(it, it.counted().filled_load_share),
            sentence: "Fraction of the load that is on heights that were not measured but filled in." }
        EdgesOfShape edges_of_shape: f64 { symbol: "n_e / n", title: "share of edges by the shape", unit: One, curve: None, valid: Elastic,
            of: |it| in_contact(it, it.resolved().edges_of_shape as f64 / (it.resolved().edges.max(1)) as f64),
            sentence: "Fraction of the contact edges that are given by the shape of the surface, such as the rim of a punch." }
        RelativeAreaError relative_area_error: f64 { symbol: "|da| / a_rel", title: "error of the relative area", unit: One, curve: None, valid: NoAdhesion,
            of: |it| it.resolution().relative_area_error,
            sentence: "Estimated relative error of the relative contact area on this grid." }
        KappaRError kappa_r_error: f64 { symbol: "|dkappa_r| / kappa_r", title: "error of kappa_r", unit: One, curve: None, page: Contact, valid: NoAdhesion,
            of: |it| it.resolution().kappa_r_error,
            sentence: "Estimated relative error of kappa_r on this grid." }
        Certificate certificate: f64 { symbol: "eta", title: "certificate", short: "eta", unit: One, kind: Bound, curve: Steps, page: Solving, valid: NoAdhesion,
            of: |it| it.certificate().eta,
            sentence: "Certificate: a bound of the energy error, divided by load times rms height." }
        PressureErrorBound pressure_error_bound: f64 { symbol: "|dp| / |p|", title: "bound of the pressure error", unit: One, curve: None, valid: Elastic,
            of: |it| it.certificate().pressure_error_bound,
            sentence: "Bound of the relative error of the pressure in the energy norm." }
        CertificateGap certificate_gap: f64 { symbol: "eta_D", title: "certificate over the remaining gap", unit: One, curve: None, valid: Elastic,
            of: |it| it.certificate().eta_gap,
            sentence: "Certificate at a given mean gap, divided by the remaining gap: the order of magnitude of the relative error of the load." }
        MeanGapErrorBound mean_gap_error_bound: f64 { symbol: "|d<g>| / h_rms", title: "bound of the mean gap error", unit: One, curve: None, valid: Elastic,
            of: |it| it.certificate().mean_gap_error_bound,
            sentence: "Bound of the error of the mean gap, divided by the rms height." }
        Penetration penetration: f64 { symbol: "-min g / h_rms", title: "penetration", unit: One, curve: None, valid: Elastic, printed: true,
            of: |it| it.certificate().penetration,
            sentence: "Largest penetration divided by the rms height." }
        LoadError load_error: f64 { symbol: "|dl| / l", title: "error of the load", unit: One, curve: None, valid: Elastic, printed: true,
            of: |it| it.certificate().load_error,
            sentence: "Error of the load, relative to the given load; at a given mean gap, relative to the rms height." }
        Stiffness stiffness: f64 { symbol: "k", title: "contact stiffness", unit: Stiffness, curve: None, valid: Elastic,
            of: |it| it.stiffness(),
            sentence: "Contact stiffness: increase of the mean pressure per decrease of the mean gap. Computed on request." }
        MeanPressureError mean_pressure_error: f64 { symbol: "|d<p>| / <p>", title: "error of the mean pressure", unit: One, curve: None, valid: Elastic,
            of: |it| it.mean_pressure_error(),
            sentence: "Relative error of the mean pressure at a given mean gap, to first order, from the contact stiffness; 0 if the pressure is given." }
        Friction friction: f64 { symbol: "mu", title: "friction coefficient", short: "friction", unit: One, curve: States, page: Contact, valid: Elastic,
            of: |it| it.friction(),
            sentence: "Hysteretic friction coefficient of a contact that slides over a viscoelastic solid: the force along x by the loss in the solid over the load. Not defined at rest." }
        Iterations iterations: usize { symbol: "iterations", title: "iterations", unit: One, curve: None, page: Solving, valid: Always,
            of: |it| it.iterations(),
            sentence: "Iterations of the solver." }
        Transforms transforms: u64 { symbol: "transforms", title: "transforms", unit: One, curve: None, page: Solving, valid: Always,
            of: |it| it.transforms(),
            sentence: "Fourier transforms, forward and inverse." }
    }
}

impl Quantity {
    /// The row of the table of quantities for this quantity.
    pub fn row(self) -> &'static QuantityRow {
        &TABLE[self as usize]
    }

    /// Its name in files and tables.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The quantity of a name, if there is one.
    pub fn find(name: &str) -> Option<Self> {
        name.parse().ok()
    }

    /// All quantities, in the order of the table.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::iter()
    }

    /// The quantities that can be computed of any contact, in the order of the table.
    pub fn found() -> impl Iterator<Item = Self> {
        Self::iter().filter(|it| it.row().read.is_some())
    }

    /// The quantities that are recorded at each step of a solve.
    pub fn traced() -> impl Iterator<Item = Self> {
        Self::iter().filter(|it| it.row().is_traced)
    }
}

/// The kind of a quantity whose row does not say it: that of the type of its value.
const fn kind_of(type_name: &str) -> QuantityKind {
    if matches!(type_name.as_bytes(), b"f64") { QuantityKind::Number } else { QuantityKind::Whole }
}
