//! The elastic solid.

use super::{YieldLaw, one_or_more};
use crate::elastic::{self, Base, HalfSpace, StiffnessTable};
use crate::error::SolidError;
use crate::quantity;
use serde::{Deserialize, Deserializer, Serialize};
use std::sync::Arc;

/// The elastic solid: a half-space by its contact modulus, or by the elastic constants that make one, or a layer on a rigid base.
///
/// ```
/// use asperity::setup::{Body, Solid};
/// let (steel, glass) = (Body { young: 210e9, poisson: 0.3 }, Body { young: 70e9, poisson: 0.22 });
/// // 1/E* = sum (1 - nu^2)/E over both bodies
/// assert!((Solid::Bodies(steel, None).contact_modulus()? / (210e9 / 0.91) - 1.0).abs() < 1e-15);
/// assert!(Solid::Bodies(steel, Some(glass)).contact_modulus()? < 70e9);
/// assert_eq!(Solid::ContactModulus(1e9).contact_modulus()?, 1e9);
/// # Ok::<(), asperity::error::SolidError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SolidKeys", into = "SolidKeys")]
pub enum Solid {
    /// The contact modulus `E*`, a pressure.
    ContactModulus(f64),
    /// One elastic body against a rigid one, or two elastic bodies.
    Bodies(Body, Option<Body>),
    /// A layer on a rigid base.
    Layer {
        /// Its stiffness.
        modulus: LayerModulus,
        /// Poisson's ratio.
        poisson: f64,
        /// Thickness, a length.
        thickness: f64,
        /// How it is held on its base.
        base: Base,
    },
    /// A solid with a given stiffness of its waves.
    Stiffness(StiffnessTable),
    /// An elastic solid that yields below its surface.
    Yielding(Box<Solid>, YieldLaw),
}

/// The stiffness of a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LayerModulus {
    /// None: pressures are over its contact modulus.
    Unit,
    /// The contact modulus `E*`, a pressure.
    Contact(f64),
    /// Young's modulus, a pressure.
    Young(f64),
}

/// The elastic constants of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Young's modulus `E`, a pressure.
    pub young: f64,
    /// Poisson's ratio `nu`, above -1 and at most 1/2.
    pub poisson: f64,
}

impl Solid {
    /// The contact modulus `E*`, of bodies by `1/E* = sum (1 - nu^2)/E`.
    ///
    /// # Errors
    /// For elastic constants that no body has. The contact modulus itself is checked where the problem is posed.
    pub fn contact_modulus(&self) -> Result<f64, SolidError> {
        match *self {
            Self::ContactModulus(modulus) => Ok(modulus),
            Self::Bodies(first, None) => Ok(first.compliance()?.recip()),
            Self::Bodies(first, Some(second)) => Ok((first.compliance()? + second.compliance()?).recip()),
            Self::Layer { modulus, poisson, .. } => {
                let body = |young| Body { young, poisson }.compliance().map(f64::recip);
                match modulus {
                    LayerModulus::Unit => body(1.0).map(|_| 1.0),
                    LayerModulus::Contact(modulus) => body(1.0).map(|_| modulus),
                    LayerModulus::Young(young) => body(young),
                }
            }
            Self::Stiffness(ref table) => Ok(elastic::ElasticSolid::contact_modulus(table)),
            Self::Yielding(ref elastic, _) => elastic.contact_modulus(),
        }
    }

    /// The shares of two elastic bodies in their compliance, `(1 - nu^2)/E` over its sum.
    pub fn compliance_shares(&self) -> Option<[f64; 2]> {
        let Self::Bodies(first, Some(second)) = self.as_elastic() else { return None };
        let [first, second] = [first.compliance().ok()?, second.compliance().ok()?];
        Some([first, second].map(|it| it / (first + second)))
    }

    /// Whether pressures have a unit: a layer without a modulus has none.
    pub fn has_modulus(&self) -> bool {
        !matches!(self.as_elastic(), Self::Layer { modulus: LayerModulus::Unit, .. })
    }

    /// The solid that responds, a half-space with a datum of line loads.
    ///
    /// # Errors
    /// The errors of [`Solid::contact_modulus`], and for a thickness that is not positive and finite.
    pub fn elastic(&self, datum: Option<f64>) -> Result<Arc<dyn elastic::ElasticSolid>, SolidError> {
        let contact_modulus = self.contact_modulus()?;
        match *self {
            Self::Layer { thickness, .. } if !(thickness.is_finite() && thickness > 0.0) => {
                Err(SolidError::Thickness { thickness })
            }
            Self::Layer { poisson, thickness, base, .. } => {
                Ok(elastic::Layer { contact_modulus, poisson, thickness, base }.into())
            }
            Self::Stiffness(ref table) => Ok(table.clone().into()),
            Self::Yielding(ref elastic, _) => elastic.elastic(datum),
            _ => Ok(HalfSpace { contact_modulus, datum }.into()),
        }
    }

    /// Poisson's ratio of the elastic body, or of the first of two; none if only the contact modulus is known.
    pub fn poisson(&self) -> Option<f64> {
        match self {
            Self::ContactModulus(_) | Self::Stiffness(_) => None,
            Self::Bodies(Body { poisson, .. }, _) | Self::Layer { poisson, .. } => Some(*poisson),
            Self::Yielding(elastic, _) => elastic.poisson(),
        }
    }

    /// Dundurs' second constant, by which normal and tangential loads couple, with `G = E / (2 (1 + nu))`:
    ///
    /// `beta = 1/2 [(1 - 2 nu_1)/G_1 - (1 - 2 nu_2)/G_2] / [(1 - nu_1)/G_1 + (1 - nu_2)/G_2]`,
    ///
    /// where a rigid body has no terms. It is not known of a contact modulus alone, nor meant for a layer.
    ///
    /// # Source
    /// Johnson, Contact Mechanics (1985), eq. 5.3.
    pub fn dundurs_beta(&self) -> Option<f64> {
        let Self::Bodies(first, second) = self.as_elastic() else { return None };
        let terms = |Body { young, poisson }: Body| {
            let shear = young / (2.0 * (1.0 + poisson));
            [(1.0 - 2.0 * poisson) / shear, (1.0 - poisson) / shear]
        };
        let ([a, b], [c, d]) = (terms(*first), second.map_or([0.0; 2], terms));
        Some(0.5 * (a - c) / (b + d))
    }

    /// The ratio `m = sum (nu/G) / sum ((1 - nu)/G)` over the elastic bodies, by which a surface gives way more to a traction along a
    /// wave front than across it. It is not known of a contact modulus alone, nor meant for a layer.
    ///
    /// # Source
    /// Johnson, Contact Mechanics (1985), Eq. 3.75.
    pub fn shear_ratio(&self) -> Option<f64> {
        let Self::Bodies(first, second) = self.as_elastic() else { return None };
        let bodies = || [Some(*first), *second].into_iter().flatten();
        let sum = |of: fn(f64) -> f64| -> f64 {
            bodies().map(|Body { young, poisson }| of(poisson) * 2.0 * (1.0 + poisson) / young).sum()
        };
        Some(sum(|nu| nu) / sum(|nu| 1.0 - nu))
    }

    /// How the solid yields below its surface, if it does.
    pub fn yield_law(&self) -> Option<&YieldLaw> {
        let Self::Yielding(_, law) = self else { return None };
        Some(law)
    }

    /// The solid without what yields.
    pub fn as_elastic(&self) -> &Self {
        let Self::Yielding(elastic, _) = self else { return self };
        elastic
    }

    /// The body that yields against a rigid one, if it is a single one.
    pub(super) fn yielding_body(&self) -> Option<Body> {
        let Self::Bodies(body, None) = self.as_elastic() else { return None };
        Some(*body)
    }

    /// The solid in words.
    pub fn description(&self) -> String {
        self.described(&|pressure| format!("{pressure:e}"))
    }

    /// The solid in words, with its pressures as `in_words` writes them.
    pub fn described(&self, in_words: &dyn Fn(f64) -> String) -> String {
        let words = |Body { young, poisson }: Body| format!("E {}, nu {poisson}", in_words(young));
        match *self {
            Self::ContactModulus(_) => "given".into(),
            Self::Bodies(one, None) => format!("of one elastic body, {}", words(one)),
            Self::Bodies(one, Some(other)) => format!("of two elastic bodies, {} and {}", words(one), words(other)),
            Self::Layer { modulus: LayerModulus::Young(young), poisson, .. } => {
                format!("of a layer, {}", words(Body { young, poisson }))
            }
            Self::Layer { poisson, .. } => format!("of a layer, nu {poisson}"),
            Self::Stiffness(_) => "of the shortest wave with a given stiffness".into(),
            Self::Yielding(ref elastic, ref law) => match law.yield_stress {
                Some(yield_stress) => {
                    format!("{}, yield stress {}", elastic.described(in_words), in_words(yield_stress))
                }
                None => elastic.described(in_words),
            },
        }
    }
}

impl Body {
    /// `(1 - nu^2)/E`.
    fn compliance(&self) -> Result<f64, SolidError> {
        let Self { young, poisson } = *self;
        if !(young.is_finite() && young > 0.0) {
            return Err(SolidError::Young { young });
        }
        if !(poisson > -1.0 && poisson <= 0.5) {
            return Err(SolidError::Poisson { poisson });
        }
        Ok((1.0 - poisson * poisson) / young)
    }
}

/// The keys of the section `solid`.
#[derive(Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case", expecting = "a section for the Solid")]
struct SolidKeys {
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_pressure")]
    contact_modulus: Option<f64>,
    #[serde(
        skip_serializing_if = "Vec::is_empty",
        serialize_with = "one_or_more::serialize",
        deserialize_with = "one_or_more::pressures"
    )]
    young: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty", with = "one_or_more")]
    poisson: Vec<f64>,
    /// Thickness of a layer.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "quantity::some_length")]
    layer: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    base: Option<Base>,
    /// Wavenumbers at which the stiffness is given.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    wavenumber: Vec<f64>,
    /// Stiffness of the wave of each wavenumber, a pressure per length.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    stiffness: Vec<f64>,
    /// Stiffness under a uniform pressure.
    #[serde(skip_serializing_if = "Option::is_none")]
    uniform_stiffness: Option<f64>,
    /// Those of a solid that yields below its surface.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_pressure")]
    yield_stress: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_pressure")]
    hardening_modulus: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_pressure")]
    kinematic_hardening: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "quantity::some_length")]
    yield_depth: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    yield_layers: Option<usize>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    yield_errors: bool,
}

impl SolidKeys {
    /// The solid whose stiffness the keys give, if they give any.
    fn stiffness(&self) -> Option<Result<Solid, SolidError>> {
        let Self { contact_modulus, young, poisson, layer, base, wavenumber, stiffness, uniform_stiffness, .. } = self;
        if wavenumber.is_empty() && stiffness.is_empty() && uniform_stiffness.is_none() {
            return None;
        }
        let has_constants =
            contact_modulus.is_some() || layer.is_some() || base.is_some() || !young.is_empty() || !poisson.is_empty();
        let [wavenumbers, stiffnesses] = [wavenumber.len(), stiffness.len()];
        Some(match wavenumbers == stiffnesses {
            _ if has_constants => Err(SolidError::StiffnessAndConstants),
            false => Err(SolidError::StiffnessColumns { wavenumbers, stiffnesses }),
            true => {
                let rows = wavenumber.iter().zip(stiffness).map(|(&q, &k)| [q, k]);
                StiffnessTable::new(rows, *uniform_stiffness).map(Solid::Stiffness)
            }
        })
    }
}

impl SolidKeys {
    /// How the solid yields.
    fn yield_law(&self) -> YieldLaw {
        YieldLaw {
            yield_stress: self.yield_stress,
            hardening_modulus: self.hardening_modulus,
            kinematic_hardening: self.kinematic_hardening,
            depth: self.yield_depth,
            layers: self.yield_layers,
            errors: self.yield_errors,
        }
    }

    /// The keys of the same solid that yields in another way.
    fn with_yield_law(self, law: YieldLaw) -> Self {
        Self {
            yield_stress: law.yield_stress,
            hardening_modulus: law.hardening_modulus,
            kinematic_hardening: law.kinematic_hardening,
            yield_depth: law.depth,
            yield_layers: law.layers,
            yield_errors: law.errors,
            ..self
        }
    }
}

fn some_pressure<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    quantity::pressure(from).map(Some)
}

impl TryFrom<SolidKeys> for Solid {
    type Error = SolidError;

    fn try_from(keys: SolidKeys) -> Result<Self, SolidError> {
        let law = keys.yield_law();
        if law.is_given() {
            let elastic = Self::try_from(keys.with_yield_law(YieldLaw::default()))?;
            return Ok(Self::Yielding(elastic.into(), law));
        }
        if let Some(solid) = keys.stiffness() {
            return solid;
        }
        let SolidKeys { contact_modulus, young, poisson, layer, base, .. } = keys;
        if let Some(thickness) = layer {
            return Self::layer(contact_modulus, &young, &poisson, thickness, base.unwrap_or_default());
        }
        if base.is_some() {
            return Err(SolidError::BaseWithoutLayer);
        }
        let body = |i: usize| Body { young: young[i], poisson: poisson[i] };
        match (contact_modulus, young.len(), poisson.len()) {
            (Some(modulus), 0, 0) => Ok(Self::ContactModulus(modulus)),
            (Some(_), ..) => Err(SolidError::Both),
            (None, 0, 0) => Err(SolidError::Nothing),
            (None, 1, 1) => Ok(Self::Bodies(body(0), None)),
            (None, 2, 2) => Ok(Self::Bodies(body(0), Some(body(1)))),
            (None, young, poisson) => Err(SolidError::Bodies { young, poisson }),
        }
    }
}

impl Solid {
    /// The layer of some keys.
    fn layer(
        contact_modulus: Option<f64>,
        young: &[f64],
        poisson: &[f64],
        thickness: f64,
        base: Base,
    ) -> Result<Self, SolidError> {
        let modulus = match (contact_modulus, young) {
            (None, []) => LayerModulus::Unit,
            (Some(modulus), []) => LayerModulus::Contact(modulus),
            (None, &[young]) => LayerModulus::Young(young),
            (Some(_), _) => return Err(SolidError::Both),
            (None, _) => return Err(SolidError::BodiesOfLayer { bodies: young.len() }),
        };
        match *poisson {
            [poisson] => Ok(Self::Layer { modulus, poisson, thickness, base }),
            _ => Err(SolidError::PoissonOfLayer { count: poisson.len() }),
        }
    }
}

impl From<Solid> for SolidKeys {
    fn from(solid: Solid) -> Self {
        match solid {
            Solid::ContactModulus(modulus) => Self { contact_modulus: Some(modulus), ..Self::default() },
            Solid::Bodies(first, second) => {
                let bodies = || [Some(first), second].into_iter().flatten();
                let [young, poisson] = [bodies().map(|it| it.young).collect(), bodies().map(|it| it.poisson).collect()];
                Self { young, poisson, ..Self::default() }
            }
            Solid::Layer { modulus, poisson, thickness, base } => {
                let (contact_modulus, young) = match modulus {
                    LayerModulus::Unit => (None, Vec::new()),
                    LayerModulus::Contact(modulus) => (Some(modulus), Vec::new()),
                    LayerModulus::Young(young) => (None, vec![young]),
                };
                let (poisson, layer, base) = (vec![poisson], Some(thickness), Some(base));
                Self { contact_modulus, young, poisson, layer, base, ..Self::default() }
            }
            Solid::Stiffness(table) => {
                let column = |i: usize| table.rows().iter().map(|row| row[i]).collect();
                let uniform_stiffness = table.uniform();
                Self { wavenumber: column(0), stiffness: column(1), uniform_stiffness, ..Self::default() }
            }
            Solid::Yielding(elastic, law) => Self::from(*elastic).with_yield_law(law),
        }
    }
}
