//! The guide: one page for each task or concept.
//!
//! Start with [`first_contact`]. The pages are files in `assets/guide`; their examples in Rust and their commands are run as tests.

/// Declares the pages. Links between pages are references, whose targets here come before those in the files. Only the documentation reads the
/// files, so that a change of a page does not build the crate again.
macro_rules! pages {
    ($($name:ident $path:literal)*) => {
        $(
            #[doc = "[adhesion]: crate::guide::adhesion"]
            #[doc = "[boundaries-and-solids]: crate::guide::boundaries_and_solids"]
            #[doc = "[explorer]: crate::guide::explorer"]
            #[doc = "[first-contact]: crate::guide::first_contact"]
            #[doc = "[flow]: crate::guide::flow"]
            #[doc = "[from-contact-mechanics]: crate::guide::from_contact_mechanics"]
            #[doc = "[from-tamaas]: crate::guide::from_tamaas"]
            #[doc = "[gallery]: crate::guide::gallery"]
            #[doc = "[hardness]: crate::guide::hardness"]
            #[doc = "[history]: crate::guide::history"]
            #[doc = "[how-it-works]: crate::guide::how_it_works"]
            #[doc = "[measured-surfaces]: crate::guide::measured_surfaces"]
            #[doc = "[other-solvers]: crate::guide::other_solvers"]
            #[doc = "[python]: crate::guide::python"]
            #[doc = "[recordings]: crate::guide::recordings"]
            #[doc = "[slow-solvers]: crate::guide::slow_solvers"]
            #[doc = "[studies]: crate::guide::studies"]
            #[doc = "[time-and-friction]: crate::guide::time_and_friction"]
            #[doc = "[trust]: crate::guide::trust"]
            #[doc = "[words]: crate::guide::words"]
            #[doc = "[yielding]: crate::guide::yielding"]
            #[doc = ""]
            #[cfg_attr(doc, doc = include_str!(concat!("../", $path)))]
            pub mod $name {}
        )*
    };
}

pages! {
    first_contact "assets/guide/first-contact.md"
    measured_surfaces "assets/guide/measured-surfaces.md"
    boundaries_and_solids "assets/guide/boundaries-and-solids.md"
    hardness "assets/guide/hardness.md"
    yielding "assets/guide/yielding.md"
    history "assets/guide/history.md"
    time_and_friction "assets/guide/time-and-friction.md"
    adhesion "assets/guide/adhesion.md"
    roughness "assets/guide/roughness.md"
    flow "assets/guide/flow.md"
    recordings "assets/guide/recordings.md"
    studies "assets/guide/studies.md"
    explorer "assets/guide/explorer.md"
    other_solvers "assets/guide/other-solvers.md"
    slow_solvers "assets/guide/slow-solvers.md"
    python "assets/guide/python.md"
    gallery "assets/guide/gallery.md"
    from_tamaas "assets/guide/from-tamaas.md"
    from_contact_mechanics "assets/guide/from-contact-mechanics.md"
    how_it_works "assets/guide/how-it-works.md"
    trust "assets/guide/trust.md"
    words "assets/guide/words.md"
}
