//! Gauss-Legendre quadrature of a fixed order.

use gauss_quad::GaussLegendre;
use std::num::NonZeroUsize;
use std::sync::LazyLock;

/// Nodes per integral. Integrands are made smooth by substitution first; 64 nodes then reach rounding for scales down
/// to a twentieth of the interval.
const NODES: NonZeroUsize = NonZeroUsize::new(64).unwrap();

static RULE: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(NODES));

/// `int_from^to f(x) dx` for a smooth `f`.
pub(super) fn integral(from: f64, to: f64, f: impl FnMut(f64) -> f64) -> f64 {
    RULE.integrate(from, to, f)
}
