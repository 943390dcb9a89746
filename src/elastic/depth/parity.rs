//! Which components of a tensor a wave couples.

/// Components of a tensor below a surface, in the order `xx`, `yy`, `zz`, `xy`, `xz`, `yz`, that are coupled with each other.
pub(super) type Coupled = [bool; 6];

const ALL: &[Coupled] = &[[true; 6]];
const EVEN_AND_ODD: &[Coupled] = &[[true, true, true, false, true, false], [false, false, false, true, false, true]];

/// The sets of components that a wave of a surface couples, the one with `zz` first, to which displacement and pressure belong.
///
/// A wave at the Nyquist wavenumber along `y` is its own mirror image: the grid does not tell apart `+q_y` and `-q_y`. The mean of the operators of both
/// does not couple components that are odd when `y` is reversed (`xy` and `yz`) with those that are even. Else a mirrored strain would not cause the mirrored
/// stress. Along `x` the inverse transform takes this mean by itself, since it drops the imaginary part at the Nyquist wavenumber.
pub(super) fn coupled(is_nyquist: bool) -> &'static [Coupled] {
    if is_nyquist { EVEN_AND_ODD } else { ALL }
}
