//! The quantities: all numbers that can be read of a state, in one table.
//!
//! A new quantity needs one row of the table. Results, tables of studies, the page, Python and the curves of recordings follow from it.
//!
//! A plain name such as `relative_area` or `kappa_r` is the most accurate value, with contact edges interpolated between the nodes. The errors
//! `relative_area_error` and `kappa_r_error` belong to it. Names that end in `_counted` are from counting nodes. Names that end in `_corrected` are
//! from counting nodes, minus the mean excess.

use super::quantity_row::Curve;
use crate::contact::{QuantityKind, QuantityRow, Readings, Unit, Validity};
use serde::{Deserialize, Serialize};
use strum::{EnumIter, EnumString, IntoEnumIterator, IntoStaticStr};

/// Makes of the rows the enum [`Quantity`], its table, and the struct [`Observables`]. Rows of `known` are numbers that only a process knows. Rows of
/// `found` can be computed of any contact.
macro_rules! quantities {
    (
        known { $($known:ident $known_name:ident, $known_symbol:literal, $known_title:literal, $known_unit:ident, $known_kind:ident, $known_curve:ident, $known_sentence:literal;)+ }
        found { $($found:ident $field:ident: $type:ty, $validity:ident, $symbol:literal, $title:literal, $unit:ident, $curve:ident, $of:expr, $sentence:literal;)+ }
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
                unit: Unit::$known_unit,
                kind: QuantityKind::$known_kind,
                is_traced: matches!(Curve::$known_curve, Curve::Steps | Curve::Both),
                has_curve: matches!(Curve::$known_curve, Curve::States | Curve::Both),
                validity: Validity::Always,
                sentence: $known_sentence,
                read: None,
            },)+
            $(QuantityRow {
                name: stringify!($field),
                symbol: $symbol,
                title: $title,
                unit: Unit::$unit,
                kind: if matches!(stringify!($type).as_bytes(), b"f64") { QuantityKind::Number } else { QuantityKind::Whole },
                is_traced: matches!(Curve::$curve, Curve::Steps | Curve::Both),
                has_curve: matches!(Curve::$curve, Curve::States | Curve::Both),
                validity: Validity::$validity,
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

// The rows. Of those that are found: the validity is the first word behind the type.
#[rustfmt::skip]
quantities! {
    // name, symbol, title, unit, kind, curves, one sentence
    known {
        Time time, "t", "time", Time, Number, States,
            "Time since the beginning.";
        Speed speed, "V", "speed", Speed, Number, States,
            "Speed at which the surface slides over the solid.";
        Creepage creepage, "xi", "creepage", One, Number, States,
            "Creepage of rolling: the relative difference of the speeds of both surfaces.";
        ContactPressure contact_pressure, "<p_c>", "mean contact pressure", Pressure, Number, States,
            "Mean pressure where the surfaces touch, beside the attraction.";
        MeanAttraction mean_attraction, "<sigma>", "mean attraction", Pressure, Number, States,
            "Mean attraction between the surfaces.";
        MeanTraction mean_traction, "<tau>", "mean traction", Pressure, Number, States,
            "Mean traction along x on the solid.";
        LateralFriction lateral_friction, "mu_y", "lateral coefficient", One, Number, States,
            "Force on the solid perpendicular to the motion, divided by the normal force.";
        FrictionFullContact friction_full_contact, "mu, full", "friction in full contact", One, Number, States,
            "Friction coefficient in full contact under the same load, exact where all nodes touch.";
        FrictionPersson friction_persson, "mu, Persson", "friction by Persson", One, Number, States,
            "Friction coefficient of Persson's theory, an estimate for partial contact.";
        FrictionError friction_error, "|dmu| / mu", "error of the friction", One, Number, None,
            "Estimated relative error of the hysteretic friction coefficient on this grid: the difference from half as many points along each axis, and the error of the area.";
        EffectivePressure effective_pressure, "<p_eff>", "effective pressure", Pressure, Number, States,
            "Mean effective pressure: the pressure that would displace the glassy solid as far as the solid is displaced.";
        Shift shift, "s", "shift", Length, Number, States,
            "Shift of the rigid surface along x since the beginning.";
        StickShare stick_share, "n_s / n_c", "share that sticks", One, Number, States,
            "Share of the nodes in contact that stick.";
        ShiftPathError shift_path_error, "|ds|, path", "error of the shift by the steps", Length, Number, States,
            "Estimated error of the shift that the length of the steps of the path causes; 0 where steps are exact.";
        StickSharePathError stick_share_path_error, "|dn_s| / n_c, path", "error of the share that sticks by the steps", One, Number, None,
            "Estimated error of the share of the nodes in contact that stick, that the length of the steps of the path causes; at least the share of those at the edge of what sticks.";
        Dissipated dissipated, "W_lost", "dissipated energy", EnergyPerArea, Number, States,
            "Energy dissipated since the beginning, per area of the cell.";
        DissipatedError dissipated_error, "|dW_lost|", "error of the loss", EnergyPerArea, Number, States,
            "Estimated error of the energy that jumps have lost with adhesion, per area of the cell; not known on a free boundary.";
        Stored stored, "W_stored", "stored energy", EnergyPerArea, Number, States,
            "Stored elastic energy, per area of the cell; with friction, that of the traction alone, and with adhesion with the energy of the attraction.";
        WorkDone work_done, "W", "work of the load", EnergyPerArea, Number, States,
            "Work of the load since the beginning, per area of the cell.";
        TimeError time_error, "|dp| / |p|, t", "error in time", One, Number, States,
            "Estimated relative error of the contact pressure, root mean square, that the length of the steps in time causes.";
        MeanPressureTimeError mean_pressure_time_error, "|d<p>|, t", "error in time of the mean pressure", Pressure, Number, States,
            "Estimated error of the mean pressure that the length of the steps in time causes; 0 where the load prescribes it.";
        MeanGapTimeError mean_gap_time_error, "|d<g>|, t", "error in time of the mean gap", Length, Number, States,
            "Estimated error of the mean gap that the length of the steps in time causes; 0 where it is prescribed.";
        RelativeAreaTimeError relative_area_time_error, "|da|, t", "error in time of the area", One, Number, States,
            "Estimated error of the relative area that the length of the steps in time causes.";
        DissipatedTimeError dissipated_time_error, "|dW_lost|, t", "error in time of the loss", EnergyPerArea, Number, States,
            "Estimated error of the dissipated energy that the length of the steps in time causes, per area of the cell.";
        DissipatedPathError dissipated_path_error, "|dW_lost|, path", "error of the loss by the steps", EnergyPerArea, Number, States,
            "Estimated error of the energy dissipated by friction that the length of the steps of the path causes, per area of the cell; 0 where steps are exact.";
        WorkTimeError work_time_error, "|dW|, t", "error in time of the work", EnergyPerArea, Number, States,
            "Estimated error of the work of the load, and of its balance with the stored and dissipated energy, that the length of the steps in time causes, per area of the cell.";
        HistoryBound history_bound, "|dp_eff| / |p_eff|", "bound through time", One, Number, States,
            "Bound of the relative error of the effective pressure that the solver caused in all steps so far.";
        Jump jump, "dW", "energy of the jump", EnergyPerArea, Number, None,
            "Energy lost in the jump that ends with this state, per area of the cell.";
        Residual residual, "r", "residual", One, Number, None,
            "Largest violation of equilibrium at a node: a pressure over the strength of the attraction, or the displacement by it over the range.";
        LeastCurvature least_curvature, "lambda", "least curvature", One, Number, States,
            "Least curvature of the energy over that of the softest wave; positive where the state is stable.";
        CurvatureError curvature_error, "|dlambda|", "error of the curvature", One, Number, States,
            "Error of the least curvature: there is an eigenvalue that is at most so far away.";
        PressureInContact pressure_in_contact, "p_m", "mean pressure in contact", Pressure, Number, States,
            "Mean pressure over the area in contact of a solid that yields below its surface; under a ball it rises to about 2.8 times the yield stress.";
        PressureInContactError pressure_in_contact_error, "|dp_m| / p_m", "error of the mean pressure in contact", One, Number, States,
            "Estimated relative error of the mean pressure in contact on this grid: that of the area, by which the load is divided.";
        ContactPressureOverYield contact_pressure_over_yield, "p_m / Y", "contact pressure over yield stress", One, Number, States,
            "Mean pressure over the area in contact divided by the yield stress: 1.1 where a ball begins to dent, about 2.8 where it is fully plastic.";
        MaxPlasticStrain max_plastic_strain, "alpha_max", "largest plastic strain", One, Number, States,
            "Largest accumulated plastic strain.";
        DeepestYield deepest_yield, "z_pl", "deepest yield", Length, Number, States,
            "Depth at which the deepest layer ends that has yielded, with a plastic strain above a thousandth of the elastic strain at yield; 0 where none has.";
        PlasticVolume plastic_volume, "V_pl / A", "plastic volume", Length, Number, States,
            "Volume that has yielded, per area of the cell.";
        ImprintDepth imprint_depth, "d_imp", "depth of the imprint", Length, Number, States,
            "Difference of the largest and the smallest displacement of the surface by the plastic strain: the depth of the imprint that stays without load.";
        PlasticWork plastic_work, "W_pl", "plastic work", EnergyPerArea, Number, States,
            "Energy that flow has taken up since the beginning, per area of the cell.";
        StepCertificate step_certificate, "eta_s", "certificate of the load step", One, Number, None,
            "Bound of the distance of the load step from its least energy, over the energy that flow took up in the step plus a thousandth of the elastic energy.";
        ImprintStepError imprint_step_error, "|d_imp|, s", "error of the imprint by the steps", Length, Number, None,
            "Estimated error of the depth of the imprint by the load steps: three times the difference from steps of half the length, and at least 0.4 % of the depth.";
        ImprintLayerError imprint_layer_error, "|d_imp|, z", "error of the imprint by the layers", Length, Number, None,
            "Estimated error of the depth of the imprint by the layers: twice the difference from layers of twice the thickness, and at least half the difference between these and layers of four times the thickness.";
        ImprintGridError imprint_grid_error, "|d_imp|, dx", "error of the imprint by the grid", Length, Number, None,
            "Estimated error of the depth of the imprint by the grid: the difference from half as many points along each axis.";
        RelativeAreaStepError relative_area_step_error, "|da|, s", "error of the area by the steps", One, Number, None,
            "Estimated error of the relative area by the load steps: three times the difference from steps of half the length, and at least 0.2 % of the area.";
        RelativeAreaLayerError relative_area_layer_error, "|da|, z", "error of the area by the layers", One, Number, None,
            "Estimated error of the relative area by the layers: twice the difference from layers of twice the thickness, and at least half the difference between these and layers of four times the thickness.";
        RelativeAreaGridError relative_area_grid_error, "|da|, dx", "error of the area by the grid", One, Number, None,
            "Estimated error of the relative area by the grid: the difference from half as many points along each axis.";
        TractionCertificate traction_certificate, "eta_t", "certificate of the traction", One, Number, None,
            "Certificate eta of the traction.";
        OpenPercolatesX open_percolates_x, "open?", "open area percolates along x", One, Flag, None,
            "Whether the open area connects both sides along x.";
        OpenPercolatesY open_percolates_y, "open?", "open area percolates along y", One, Flag, None,
            "Whether the open area connects both sides along y.";
        ContactPercolatesX contact_percolates_x, "joined?", "contact percolates along x", One, Flag, None,
            "Whether the contact connects both sides along x.";
        ContactPercolatesY contact_percolates_y, "joined?", "contact percolates along y", One, Flag, None,
            "Whether the contact connects both sides along y.";
        LeakageLowerX leakage_lower_x, "sigma_-", "least leakage along x", Volume, Number, None,
            "Lower bound of the leakage along x: the cube of the gap of parallel plates that leak as much.";
        LeakageUpperX leakage_upper_x, "sigma_+", "largest leakage along x", Volume, Number, None,
            "Upper bound of the leakage along x.";
        LeakageLowerY leakage_lower_y, "sigma_-", "least leakage along y", Volume, Number, None,
            "Lower bound of the leakage along y: the cube of the gap of parallel plates that leak as much.";
        LeakageUpperY leakage_upper_y, "sigma_+", "largest leakage along y", Volume, Number, None,
            "Upper bound of the leakage along y.";
        HydraulicGapX hydraulic_gap_x, "u_h", "hydraulic gap along x", Length, Number, None,
            "The gap of parallel plates that leak as much along x.";
        HydraulicGapY hydraulic_gap_y, "u_h", "hydraulic gap along y", Length, Number, None,
            "The gap of parallel plates that leak as much along y.";
        ConductancePerArea conductance_per_area, "G / A", "conductance per area", Conductance, Number, None,
            "The conductance per area of the cell; infinite where all nodes touch.";
        ConductanceTimesResistivity conductance_times_resistivity, "G rho / A", "conductance times resistivity", PerLength, Number, None,
            "The conductance per area times the sum of both resistivities: twice the contact stiffness over the contact modulus.";
        LowestPressure lowest_pressure, "<p>_min", "lowest mean pressure", Pressure, Number, None,
            "The lowest mean pressure since the beginning, also between the states that are shown; negative if the surfaces stick, and the pull-off pressure if they parted.";
        Separated separated, "apart?", "separated", One, Flag, None,
            "Whether the surfaces parted under the load.";
        LargestArea largest_area, "a_max", "largest relative area", One, Number, None,
            "The largest share of nodes that touched in any state: by counting nodes.";
        Jumps jumps, "n_j", "jumps", One, Whole, None,
            "The number of jumps.";
        LostInJumps lost_in_jumps, "W_j", "energy lost in jumps", EnergyPerArea, Number, None,
            "Energy lost in all jumps but parting under the load, per area of the cell.";
        LostError lost_error, "|dW_j|", "error of the energy lost in jumps", EnergyPerArea, Number, None,
            "Estimated error of the energy lost in jumps, per area of the cell; not known on a free boundary.";
        Stable stable, "stable?", "stable", One, Flag, None,
            "Whether each state with contact was stable, or the solution.";
        States states, "n", "states", One, Whole, None,
            "The number of states, without the frames of motions.";
        HistoryTransforms history_transforms, "transforms", "transforms of the history", One, Whole, None,
            "Fourier transforms of all states.";
    }
    // name, type, validity, symbol, title, unit, curves, how it is computed, one sentence
    found {
        MeanPressure mean_pressure: f64, Always, "<p>", "mean pressure", Pressure, States, |it| it.mean_pressure(),
            "Mean pressure.";
        ReducedPressure reduced_pressure: f64, Always, "p*", "reduced pressure", One, None, |it| it.reduced_pressure(),
            "Reduced pressure: mean pressure divided by rms gradient and contact modulus, of a contact that slides by its effective modulus.";
        ReducedPressureContact reduced_pressure_contact: f64, Elastic, "p_r*", "reduced pressure in contact", One, None, |it| known(it.resolved().reduced_pressure_contact),
            "Reduced pressure with the rms gradient of the contact.";
        ReducedPressureContactCounted reduced_pressure_contact_counted: f64, Elastic, "p_r*, counted", "reduced pressure in contact, nodes counted", One, None, |it| known(it.counted().reduced_pressure_contact),
            "Reduced pressure with the rms gradient of the nodes in contact.";
        RelativeArea relative_area: f64, Always, "a_rel", "relative area", One, Both, |it| it.resolved().relative_area,
            "Relative contact area, with contact edges interpolated between grid nodes; with adhesion the fraction of nodes in contact.";
        RelativeAreaCounted relative_area_counted: f64, Always, "a_rel, counted", "relative area, nodes counted", One, Steps, |it| it.counted().relative_area,
            "Relative contact area as the fraction of nodes in contact.";
        RelativeAreaCorrected relative_area_corrected: f64, Elastic, "a_rel, corrected", "relative area, corrected", One, None, |it| it.counted().relative_area_corrected,
            "Fraction of nodes in contact, minus the mean excess of counted nodes at the edges.";
        RmsHeight rms_height: f64, Always, "h_rms", "rms height", Length, None, |it| it.rms_height(),
            "Root mean square of the heights about their mean.";
        RmsGradient rms_gradient: f64, Always, "g_rms", "rms gradient", One, None, |it| it.rms_gradient(),
            "Root-mean-square gradient of the surface.";
        RmsGradientContact rms_gradient_contact: f64, Elastic, "g_r", "rms gradient in contact", One, None, |it| in_contact(it, it.resolved().rms_gradient_contact),
            "Root-mean-square gradient over the contact, with contact edges interpolated between grid nodes.";
        RmsGradientContactCounted rms_gradient_contact_counted: f64, Always, "g_r, counted", "rms gradient in contact, nodes counted", One, None, |it| in_contact(it, it.counted().rms_gradient_contact),
            "Root-mean-square gradient of the nodes in contact.";
        RmsGradientContactCorrected rms_gradient_contact_corrected: f64, Elastic, "g_r, corrected", "rms gradient in contact, corrected", One, None, |it| in_contact(it, it.counted().rms_gradient_contact_corrected),
            "Root-mean-square gradient of the nodes in contact, minus the mean excess of counted nodes at the edges.";
        Kappa kappa: f64, Elastic, "kappa", "kappa", One, Steps, |it| positive(it.resolved().relative_area / it.counted().reduced_pressure),
            "Relative contact area divided by reduced pressure, with contact edges interpolated between grid nodes.";
        KappaCounted kappa_counted: f64, Elastic, "kappa, counted", "kappa, nodes counted", One, None, |it| positive(it.counted().kappa),
            "Fraction of nodes in contact divided by reduced pressure.";
        KappaCorrected kappa_corrected: f64, Elastic, "kappa, corrected", "kappa, corrected", One, None, |it| positive(it.counted().relative_area_corrected / it.counted().reduced_pressure),
            "Corrected relative contact area divided by reduced pressure.";
        KappaR kappa_r: f64, NoAdhesion, "kappa_r", "kappa_r", One, Both, |it| it.kappa_r(),
            "Relative contact area divided by the reduced pressure with the rms gradient of the contact, with contact edges interpolated between grid nodes.";
        KappaRCounted kappa_r_counted: f64, Elastic, "kappa_r, counted", "kappa_r, nodes counted", One, Steps, |it| positive(it.counted().kappa_r),
            "Fraction of nodes in contact, divided by the reduced pressure with the rms gradient of these nodes.";
        KappaRCorrected kappa_r_corrected: f64, Elastic, "kappa_r, corrected", "kappa_r, corrected", One, None, |it| positive(it.counted().kappa_r_corrected),
            "Corrected relative contact area divided by the reduced pressure with the corrected rms gradient of the contact.";
        MeanGap mean_gap: f64, Always, "<g>", "mean gap", Length, States, |it| it.mean_gap(),
            "Mean gap between the surfaces.";
        MeanGapOverRmsHeight mean_gap_over_rms_height: f64, Always, "<g> / h_rms", "mean gap over rms height", One, Steps, |it| it.mean_gap() / it.rms_height(),
            "Mean gap divided by the rms height.";
        ElasticEnergy elastic_energy: f64, Elastic, "U", "elastic energy", EnergyPerArea, None, |it| it.elastic_energy(),
            "Elastic energy per area: half the mean of pressure times displacement.";
        Approach approach: f64, Always, "d", "approach", Length, States, |it| it.approach(),
            "Approach: distance that the surface has moved since its highest peak touched the undeformed solid. Not defined on a periodic half-space.";
        PlasticArea plastic_area: f64, Elastic, "a_pl", "plastic area", One, None, |it| it.plastic_area(),
            "Relative plastic area: the fraction of nodes at the hardness, where the solid yields.";
        PlasticOverlap plastic_overlap: f64, Yielding, "<o>", "plastic overlap", Length, States, |it| it.plastic_overlap(),
            "Mean overlap of the surfaces where they yield or have yielded, not part of the mean gap: the plastically displaced volume per area of the cell.";
        MaxPressure max_pressure: f64, Always, "p_max", "largest pressure", Pressure, States, |it| it.max_pressure(),
            "Largest pressure.";
        MaxPressureOverModulus max_pressure_over_modulus: f64, Always, "p_max / E*", "largest pressure over modulus", One, None, |it| it.max_pressure() / it.contact_modulus(),
            "Largest pressure divided by the contact modulus.";
        EffectiveModulus effective_modulus: f64, Sliding, "E*_eff", "effective modulus", Pressure, States, |it| it.effective_modulus(),
            "Contact modulus that reduced pressures, kappa and kappa_r use: E*, or between the relaxed and the glassy one for a contact that slides over a viscoelastic solid.";
        Patches patches: usize, Always, "n", "contact patches", One, Steps, |it| it.patches(),
            "Number of contact patches.";
        NodesPerPatch nodes_per_patch: f64, Always, "n_c / n", "nodes per patch", One, None, |it| in_contact(it, it.resolution().nodes_per_patch),
            "Nodes in contact per contact patch.";
        UnresolvedShare unresolved_share: f64, Always, "n_c < few / n_c", "share that is not resolved", One, None, |it| in_contact(it, it.resolution().unresolved_share),
            "Fraction of the nodes in contact that are in patches too small to trust: fewer than 4 nodes on lines, 12 on surfaces.";
        FilledAreaShare filled_area_share: f64, Always, "n_f / n_c", "share of contact on filled heights", One, None, |it| in_contact(it, it.counted().filled_area_share),
            "Fraction of the nodes in contact whose heights were not measured but filled in.";
        FilledLoadShare filled_load_share: f64, Always, "F_f / F", "share of load on filled heights", One, None, |it| in_contact(it, it.counted().filled_load_share),
            "Fraction of the load that is on heights that were not measured but filled in.";
        EdgesOfShape edges_of_shape: f64, Elastic, "n_e / n", "share of edges by the shape", One, None, |it| in_contact(it, it.resolved().edges_of_shape as f64 / (it.resolved().edges.max(1)) as f64),
            "Fraction of the contact edges that are given by the shape of the surface, such as the rim of a punch.";
        RelativeAreaError relative_area_error: f64, NoAdhesion, "|da| / a_rel", "error of the relative area", One, None, |it| it.resolution().relative_area_error,
            "Estimated relative error of the relative contact area on this grid.";
        KappaRError kappa_r_error: f64, NoAdhesion, "|dkappa_r| / kappa_r", "error of kappa_r", One, None, |it| it.resolution().kappa_r_error,
            "Estimated relative error of kappa_r on this grid.";
        Certificate certificate: f64, NoAdhesion, "eta", "certificate", One, Steps, |it| it.certificate().eta,
            "Certificate: a bound of the energy error, divided by load times rms height.";
        PressureErrorBound pressure_error_bound: f64, Elastic, "|dp| / |p|", "bound of the pressure error", One, None, |it| it.certificate().pressure_error_bound,
            "Bound of the relative error of the pressure in the energy norm.";
        CertificateGap certificate_gap: f64, Elastic, "eta_D", "certificate over the remaining gap", One, None, |it| it.certificate().eta_gap,
            "Certificate at a given mean gap, divided by the remaining gap: the order of magnitude of the relative error of the load.";
        MeanGapErrorBound mean_gap_error_bound: f64, Elastic, "|d<g>| / h_rms", "bound of the mean gap error", One, None, |it| it.certificate().mean_gap_error_bound,
            "Bound of the error of the mean gap, divided by the rms height.";
        Penetration penetration: f64, Elastic, "-min g / h_rms", "penetration", One, None, |it| it.certificate().penetration,
            "Largest penetration divided by the rms height.";
        LoadError load_error: f64, Elastic, "|dl| / l", "error of the load", One, None, |it| it.certificate().load_error,
            "Error of the load, relative to the given load; at a given mean gap, relative to the rms height.";
        Stiffness stiffness: f64, Elastic, "k", "contact stiffness", Stiffness, None, |it| it.stiffness(),
            "Contact stiffness: increase of the mean pressure per decrease of the mean gap. Computed on request.";
        MeanPressureError mean_pressure_error: f64, Elastic, "|d<p>| / <p>", "error of the mean pressure", One, None, |it| it.mean_pressure_error(),
            "Relative error of the mean pressure at a given mean gap, to first order, from the contact stiffness; 0 if the pressure is given.";
        Friction friction: f64, Elastic, "mu", "friction coefficient", One, States, |it| it.friction(),
            "Hysteretic friction coefficient of a contact that slides over a viscoelastic solid: the force along x by the loss in the solid over the load. Not defined at rest.";
        Iterations iterations: usize, Always, "iterations", "iterations", One, None, |it| it.iterations(),
            "Iterations of the solver.";
        Transforms transforms: u64, Always, "transforms", "transforms", One, None, |it| it.transforms(),
            "Fourier transforms, forward and inverse.";
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

/// A reduced pressure with the gradient of a contact; NaN where there is no gradient, as in a contact of one node or below a punch.
fn known(reduced_pressure: f64) -> f64 {
    if reduced_pressure.is_finite() { reduced_pressure } else { f64::NAN }
}

/// A number of the nodes in contact; NaN where nothing touches.
fn in_contact(it: &dyn Readings, value: f64) -> f64 {
    if it.counted().contact_nodes > 0 { value } else { f64::NAN }
}

/// A ratio of an area to a load; NaN where it is zero or no number: without contact, and where single nodes have neither an area nor a gradient.
pub(super) fn positive(ratio: f64) -> f64 {
    if ratio > 0.0 { ratio } else { f64::NAN }
}

impl Observables {
    /// The relative area, where the grid resolves it.
    pub fn resolved_area(&self) -> Option<f64> {
        resolved(self.relative_area, self.relative_area_error)
    }

    /// `kappa`, where the grid resolves the relative area.
    pub fn resolved_kappa(&self) -> Option<f64> {
        resolved(self.kappa, self.relative_area_error)
    }

    /// `kappa_r`, where the grid resolves it.
    pub fn resolved_kappa_r(&self) -> Option<f64> {
        resolved(self.kappa_r, self.kappa_r_error)
    }
}

/// A value whose error is smaller than the value. If patches have too few nodes, the value is 0 or NaN, or its error is
/// unknown or infinite.
fn resolved(value: f64, error: f64) -> Option<f64> {
    (value.is_finite() && value > 0.0 && error < 1.0).then_some(value)
}
