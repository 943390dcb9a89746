//! Which components of a tensor a wave couples.

/// Components of a tensor below a surface, in the order `xx`, `yy`, `zz`, `xy`, `xz`, `yz`, that are coupled with each other.
pub(super) type Coupled = [bool; 6];

const ALL: &[Coupled] = &[[true; 6]];
const ALONG_X: &[Coupled] = &[[true, true, true, false, false, true], [false, false, false, true, true, false]];
const ALONG_Y: &[Coupled] = &[[true, true, true, false, true, false], [false, false, false, true, false, true]];
const ALONG_BOTH: &[Coupled] = &[
    [true, true, true, false, false, false],
    [false, false, false, true, false, false],
    [false, false, false, false, true, false],
    [false, false, false, false, false, true],
];

/// The sets of components that a wave of a surface couples, the one with `zz` first, to which displacement and pressure belong.
///
/// A wave at the Nyquist wavenumber along an axis is its own mirror image: the grid does not tell apart `+q` and `-q`. The mean of the operators of both couples only
/// components that are both even or both odd when the axis is reversed (`xy` and `xz` are odd along `x`). Else a mirrored strain would not
/// cause the mirrored stress.
pub(super) fn coupled([y, x]: [bool; 2]) -> &'static [Coupled] {
    match (y, x) {
        (false, false) => ALL,
        (false, true) => ALONG_X,
        (true, false) => ALONG_Y,
        (true, true) => ALONG_BOTH,
    }
}
