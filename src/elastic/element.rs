//! The displacement by a uniform pressure on one element of a half-space, without images.

use std::f64::consts::PI;

/// Distance, in widths, from which the influence of a strip is computed by a series: there the closed form loses digits
/// by cancellation.
const FAR: f64 = 16.0;

/// The same for a rectangle, in longer sides. The first term that the series leaves out is below 4e-14 of the sum there.
const FAR_RECTANGLE: f64 = 64.0;

/// Points and weights of Gauss-Legendre quadrature between -1/2 and 1/2. The terms that it leaves out are below rounding at the
/// distance of [`FAR_RECTANGLE`].
const GAUSS: [[f64; 2]; 4] = [
    [-0.430_568_155_797_026_3, 0.173_927_422_568_726_93],
    [-0.169_990_521_792_428_13, 0.326_072_577_431_273_07],
    [0.169_990_521_792_428_13, 0.326_072_577_431_273_07],
    [0.430_568_155_797_026_3, 0.173_927_422_568_726_93],
];

/// Step and end of the trapezium rule for waves. It errs by `exp(-pi^2 / STEP)`, and the integrand has fallen by `exp(-END)`.
const STEP: f64 = 0.25;
const END: f64 = 40.0;

/// Displacement at the distance `x` from the middle of a strip of some `width` that runs across a line, per unit of pressure:
/// `-(2 / (pi E*)) int ln(|s| / D) ds` over the strip, with the datum `D`.
///
/// # Source
/// Flamant; Johnson, *Contact Mechanics* (1985), sections 2.2 and 2.5.
pub(super) fn strip(x: f64, width: f64, datum: f64, contact_modulus: f64) -> f64 {
    let (x, half) = (x.abs(), 0.5 * width);
    let integral = if x > FAR * width {
        let square = (half / x).powi(2);
        width
            * ((x / datum).ln() - square * (1.0 / 6.0 + square * (1.0 / 20.0 + square * (1.0 / 42.0 + square / 72.0))))
    } else {
        let of = |s: f64| if s == 0.0 { 0.0 } else { s * ((s.abs() / datum).ln() - 1.0) };
        of(x + half) - of(x - half)
    };
    -2.0 / (PI * contact_modulus) * integral
}

/// Displacement at the distance `[y, x]` from the middle of a rectangle of sides `[dy, dx]`, per unit of pressure:
/// `(1 / (pi E*)) int 1/r` over the rectangle.
///
/// # Source
/// Love, Phil. Trans. R. Soc. A 228, 377 (1929); Johnson, *Contact Mechanics* (1985), Eq. 3.25.
pub(crate) fn rectangle(at: [f64; 2], sides: [f64; 2], contact_modulus: f64) -> f64 {
    let [[y, x], [dy, dx]] = [at, sides];
    let far = FAR_RECTANGLE * dx.max(dy);
    let integral = if x * x + y * y > far * far { dx * dy * mean_far(at, sides) } else { integral_near(at, sides) };
    integral / (PI * contact_modulus)
}

/// Displacement along `x` at the distance `[y, x]` from the middle of a rectangle of sides `[dy, dx]`, per unit of traction along `x`:
/// `(1 / (pi E*)) int (1/r + m x^2/r^3)` over the rectangle, with `m = sum (nu/G) / sum ((1 - nu)/G)` over the bodies.
///
/// # Source
/// Cerruti; Johnson, *Contact Mechanics* (1985), Eq. 3.75. The mixed derivative of `y asinh(x/|y|)` is `x^2/r^3`.
pub(crate) fn sheared_rectangle(at: [f64; 2], sides: [f64; 2], contact_modulus: f64, m: f64) -> f64 {
    let [[y, x], [dy, dx]] = [at, sides];
    let far = FAR_RECTANGLE * dx.max(dy);
    let along = if x * x + y * y > far * far {
        let value = |y: f64, x: f64| x * x / (x * x + y * y).powf(1.5);
        dx * dy * mean(at, sides, value)
    } else {
        let [[below, above], [left, right]] = [[y, dy], [x, dx]].map(|[at, side]| [at - 0.5 * side, at + 0.5 * side]);
        let edge = |s: f64| s * ((right / s.abs()).asinh() - (left / s.abs()).asinh());
        let edge = |s: f64| if s == 0.0 { 0.0 } else { edge(s) };
        edge(above) - edge(below)
    };
    rectangle(at, sides, contact_modulus) + m * along / (PI * contact_modulus)
}

/// Displacement along `y` at the distance `[y, x]` from the middle of a rectangle of sides `[dy, dx]`, per unit of traction along `x`, for
/// `m = 1`: `(1 / (pi E*)) int x y/r^3` over the rectangle. It is odd in `x` and in `y`.
///
/// # Source
/// Cerruti; Johnson, *Contact Mechanics* (1985), Eq. 3.75. The mixed derivative of `-r` is `x y/r^3`.
pub(crate) fn crossed_rectangle(at: [f64; 2], sides: [f64; 2], contact_modulus: f64) -> f64 {
    let [[y, x], [dy, dx]] = [at, sides];
    let far = FAR_RECTANGLE * dx.max(dy);
    let integral = if x * x + y * y > far * far {
        let value = |y: f64, x: f64| x * y / (x * x + y * y).powf(1.5);
        dx * dy * mean(at, sides, value)
    } else {
        let [[below, above], [left, right]] = [[y, dy], [x, dx]].map(|[at, side]| [at - 0.5 * side, at + 0.5 * side]);
        right.hypot(below) + left.hypot(above) - right.hypot(above) - left.hypot(below)
    };
    integral / (PI * contact_modulus)
}

/// Displacement into the solid at the distance `[y, x]` from the middle of a rectangle of sides `[dy, dx]`, per unit of traction along
/// `x`, for Dundurs' `beta = 1`: `(1 / (pi E*)) int x/r^2` over the rectangle. It is odd in `x`.
///
/// # Source
/// Cerruti; Johnson, *Contact Mechanics* (1985), Eq. 3.77. The mixed derivative of `(y/2) ln r^2 + x atan(y/x)` is `x/r^2`.
pub(crate) fn coupled_rectangle(at: [f64; 2], sides: [f64; 2], contact_modulus: f64) -> f64 {
    let [[y, x], [dy, dx]] = [at, sides];
    let far = FAR_RECTANGLE * dx.max(dy);
    let integral = if x * x + y * y > far * far {
        let value = |y: f64, x: f64| x / (x * x + y * y);
        dx * dy * mean(at, sides, value)
    } else {
        let [[below, above], [left, right]] = [[y, dy], [x, dx]].map(|[at, side]| [at - 0.5 * side, at + 0.5 * side]);
        let of = |y: f64, x: f64| {
            let angle = if x == 0.0 { 0.0 } else { x * (y / x).atan() };
            let log = if y == 0.0 { 0.0 } else { y * x.hypot(y).ln() };
            log + angle
        };
        of(above, right) - of(above, left) - of(below, right) + of(below, left)
    };
    integral / (PI * contact_modulus)
}

/// The mean of `value(y, x)`, which is smooth, over a rectangle of sides `[dy, dx]` around `[y, x]`, by quadrature.
pub(super) fn mean([y, x]: [f64; 2], [dy, dx]: [f64; 2], value: impl Fn(f64, f64) -> f64) -> f64 {
    let along_y = |x: f64| GAUSS.map(|[s, v]| v * value(y + dy * s, x)).iter().sum::<f64>();
    GAUSS.map(|[t, w]| w * along_y(x + dx * t)).iter().sum()
}

/// The integral of `1/r` over a rectangle in closed form. It loses digits as the square of the distance, by cancellation.
fn integral_near([y, x]: [f64; 2], [dy, dx]: [f64; 2]) -> f64 {
    let [[below, above], [left, right]] = [[y, dy], [x, dx]].map(|[at, side]| [at - 0.5 * side, at + 0.5 * side]);
    // x asinh(y/|x|) + y asinh(x/|y|) has the mixed derivative 1/r
    let edge = |s: f64, from: f64, to: f64| s * ((to / s.abs()).asinh() - (from / s.abs()).asinh());
    edge(right, below, above) - edge(left, below, above) + edge(above, left, right) - edge(below, left, right)
}

/// The mean of `1/r` over a distant rectangle: the Taylor series about its middle up to fourth order, integrated term by term.
fn mean_far([y, x]: [f64; 2], [dy, dx]: [f64; 2]) -> f64 {
    let square = (x * x + y * y).recip();
    // squares of the cosine and the sine of the direction; second moments of the sides over the square of the distance
    let [[c, a], [s, b]] = [[x, dx], [y, dy]].map(|[at, side]| [at * at * square, side * side * square / 24.0]);
    let fourth = |c: f64, a: f64| 0.3 * a * a * (9.0 - 90.0 * c + 105.0 * c * c);
    let second = a * (3.0 * c - 1.0) + b * (3.0 * s - 1.0);
    square.sqrt() * (1.0 + second + fourth(c, a) + fourth(s, b) + a * b * (105.0 * c * s - 12.0))
}

/// Displacement at the distance `x` from the middle of a strip of some `width` under a pressure that is a wave of wavenumber `q` along
/// the strip, over the height of the wave: `(2 / (pi E*)) int K0(q |s|) ds` across the strip, with the Bessel function
/// `K0(z) = int_0^inf exp(-z cosh t) dt`.
pub(super) fn wave(x: f64, width: f64, q: f64, contact_modulus: f64) -> f64 {
    let (x, half) = (x.abs(), 0.5 * width);
    let term = |cosh: f64| {
        let fraction = if x < half {
            -2.0 * (-q * half * cosh).exp_m1()
        } else {
            -(-q * (x - half) * cosh).exp() * (-q * width * cosh).exp_m1()
        };
        fraction / (q * cosh)
    };
    let steps = (END / STEP) as usize;
    let sum: f64 = (1..=steps).map(|i| term((STEP * i as f64).cosh())).take_while(|&term| term > 0.0).sum();
    2.0 / (PI * contact_modulus) * STEP * (0.5 * term(1.0) + sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gauss-Legendre quadrature of `1/r` with four points along each side, which is exact to rounding at these distances.
    fn by_quadrature([y, x]: [f64; 2], [dy, dx]: [f64; 2]) -> f64 {
        let (inner, outer) = ((6.0f64 / 5.0).sqrt(), 18.0 + 30f64.sqrt());
        let node = |sign: f64| (3.0 / 7.0 + sign * 2.0 / 7.0 * inner).sqrt();
        let weights = [outer / 36.0, 1.0 - outer / 36.0];
        let points = [-1.0, 1.0].map(|side| [(side * node(-1.0), weights[0]), (side * node(1.0), weights[1])]).concat();
        let term = |(s, v): (f64, f64), (t, w): (f64, f64)| v * w / (y + 0.5 * dy * s).hypot(x + 0.5 * dx * t);
        let sum: f64 = points.iter().flat_map(|a| points.iter().map(|b| term(*a, *b))).sum();
        0.25 * dx * dy * sum / PI
    }

    #[test]
    fn distant_rectangles_displace_as_by_quadrature() {
        for sides in [[1.0f64, 1.0], [1.0, 3.0], [2.0, 0.1]] {
            for distance in [64.1, 100.0, 1e3, 1e5] {
                for angle in [0.0, 0.3, 0.8, 1.2, PI / 2.0] {
                    let reach = distance * sides[0].max(sides[1]);
                    let at = [reach * f64::sin(angle), reach * f64::cos(angle)];
                    let (found, exact) = (rectangle(at, sides, 1.0), by_quadrature(at, sides));
                    assert!((found / exact - 1.0).abs() < 5e-14, "{sides:?} {at:?}: {found:e}, {exact:e}");
                }
            }
        }
    }

    /// Along `x` and along `y` together the two kernels of shear are those of `2/r + m/r`; and one of them is symmetric under an
    /// exchange of the axes.
    #[test]
    fn both_directions_of_shear_add_up() {
        for at in [[0.0, 0.0], [0.0, 1.0], [3.0, 0.5], [40.0, 30.0], [70.0, 10.0], [1e4, 2e4]] {
            let (sides, m) = ([1.0, 1.5], 0.7);
            let turned = |[y, x]: [f64; 2]| [x, y];
            let both = sheared_rectangle(at, sides, 1.0, m) + sheared_rectangle(turned(at), turned(sides), 1.0, m);
            let exact = (2.0 + m) * rectangle(at, sides, 1.0);
            assert!((both / exact - 1.0).abs() < 1e-11, "{at:?}: {both:e}, {exact:e}");
        }
    }

    /// The closed form of the crossed term is the sum of those of four quarters, is odd, and meets the quadrature of distant elements.
    #[test]
    fn the_crossed_term_is_odd_and_additive() {
        for at in [[0.3, 0.2], [0.0, 1.0], [3.0, 0.5], [40.0, -30.0], [70.0, 67.0], [70.0, 80.0]] {
            let (sides, [y, x]) = ([1.0, 1.5], at);
            let whole = crossed_rectangle(at, sides, 1.0);
            let quarters = [[-0.25, -0.375], [-0.25, 0.375], [0.25, -0.375], [0.25, 0.375]];
            let sum: f64 = quarters.iter().map(|[b, a]| crossed_rectangle([y + b, x + a], [0.5, 0.75], 1.0)).sum();
            assert!((whole - sum).abs() < 1e-13, "{at:?}: {whole:e}, {sum:e}");
            assert!((whole + crossed_rectangle([-y, x], sides, 1.0)).abs() < 1e-14);
            let middle = 1.5 * x * y / (PI * x.hypot(y).powi(3));
            assert!(x.hypot(y) < 30.0 || (whole / middle - 1.0).abs() < 1e-2, "{whole:e}, {middle:e}");
        }
    }

    #[test]
    fn the_closed_form_and_the_series_agree_where_they_meet() {
        let sides = [1.0, 1.5];
        for angle in [0.1, 0.7, 1.5] {
            let at = [64.0 * 1.5 * f64::sin(angle), 64.0 * 1.5 * f64::cos(angle)];
            let ratio = integral_near(at, sides) / (1.5 * mean_far(at, sides));
            assert!((ratio - 1.0).abs() < 3e-12, "{ratio}");
        }
    }
}
