//! Figures as SVG and PNG. The font comes with the program, so that bare machines draw the same.

use anyhow::Result;
use asperity::surface::write_beside;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;
use std::io::{self, Write};
use std::path::Path;

/// The name that the font goes by; in an SVG it is what the viewer has.
pub const FONT: &str = "sans-serif";
/// Pixels of a PNG per unit of the figure.
const SCALE: u32 = 2;

/// Something to be drawn.
pub trait Drawing {
    /// Width and height in units of about a pixel.
    const SIZE: [u32; 2];

    /// Draws on `area`, `scale` pixels per unit.
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, scale: u32) -> Result<()>
    where
        B::ErrorType: 'static;
}

/// Writes a scalable figure.
pub fn write_svg<D: Drawing>(path: &Path, drawing: &D) -> Result<()> {
    let mut text = String::new();
    paint(SVGBackend::with_string(&mut text, D::SIZE.into()), drawing, 1)?;
    Ok(write_beside(path, |file| file.write_all(text.as_bytes()))?)
}

/// Writes a figure of pixels.
pub fn write_png<D: Drawing>(path: &Path, drawing: &D) -> Result<()> {
    let [width, height] = D::SIZE.map(|length| SCALE * length);
    let mut pixels = vec![0; (3 * width * height) as usize];
    paint(BitMapBackend::with_buffer(&mut pixels, (width, height)), drawing, SCALE)?;
    Ok(write_beside(path, |file| encode(file, [width, height], &pixels))?)
}

fn paint<B: DrawingBackend>(backend: B, drawing: &impl Drawing, scale: u32) -> Result<()>
where
    B::ErrorType: 'static,
{
    register_font(FONT, FontStyle::Normal, dejavu::sans::regular()).ok();
    let area = backend.into_drawing_area();
    area.fill(&WHITE)?;
    drawing.draw(&area, scale)?;
    Ok(area.present()?)
}

fn encode(file: impl Write, [width, height]: [u32; 2], pixels: &[u8]) -> io::Result<()> {
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    Ok(writer.finish()?)
}

/// A power of ten, or nothing for what is none.
pub fn power_of_ten(value: f64) -> String {
    let exponent = value.log10().round() as i32;
    if (value / 10f64.powi(exponent) - 1.0).abs() > 1e-6 {
        return String::new();
    }
    const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |c: char| c.to_digit(10).map_or('⁻', |digit| SUPERSCRIPTS[digit as usize]);
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten_are_written_as_such() {
        assert_eq!([1e-12, 1.0 - 1e-15, 1e3, 2e-3].map(power_of_ten), ["10⁻¹²", "10⁰", "10³", ""]);
    }
}
