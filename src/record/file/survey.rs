//! Recordings of surveys of heights.

use super::recording::{Name, write_whole};
use crate::error::FileError;
use crate::record::draw::{FigurePicture, Palette, SurfaceRelief, survey_figure};
use crate::record::layout::{fit_survey, send_survey};
use crate::record::options::WINDOW;
use crate::setup::Theme;
use crate::surface::{Surface, Survey};
use rerun::{RecordingStream, RecordingStreamResult, TextDocument};
use std::path::Path;

/// Entity of the text.
const TEXT: &str = "/description";
/// Entity of the relief.
const RELIEF: &str = "/surface";

/// Writes a recording of a surface: a relief, of a line its heights; the power spectrum with its power law; the rms gradient over the
/// distance; and a text in Markdown. Lengths are in `unit`, such as `m`.
///
/// # Errors
/// [`FileError::Target`] if no file can be made at `out`, [`FileError::Write`] if writing fails.
pub fn record_survey(
    out: &Path,
    title: &str,
    surface: &Surface,
    survey: &Survey,
    unit: &str,
    text: &str,
) -> Result<(), FileError> {
    let palette = Palette::new(Theme::Dark);
    let mut relief = (!surface.grid().is_line()).then(|| SurfaceRelief::new(surface, palette, RELIEF, unit));
    let mut figure = FigurePicture::new(&survey_figure(surface, survey, unit), Vec::new(), palette);
    fit_survey(relief.as_mut(), &mut figure, TEXT, WINDOW);
    let name = Name::made_of(title.into(), &[title.to_owned(), text.to_owned()]);
    write_whole(out, &name, |stream| log(stream, relief.as_ref(), &figure, text))
}

fn log(
    to: &RecordingStream,
    relief: Option<&SurfaceRelief>,
    figure: &FigurePicture,
    text: &str,
) -> RecordingStreamResult<()> {
    send_survey(relief.map(SurfaceRelief::view), figure, TEXT, to)?;
    to.log_static(TEXT, &TextDocument::from_markdown(text))?;
    figure.log_static(to)?;
    relief.map_or(Ok(()), |relief| relief.log(to))
}
