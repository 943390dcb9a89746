//! Figures as PDF, with letters as outlines.

use super::colour::Colour;
use super::font::width;
use super::letters::letters;
use super::sheet::{Align, Element, PixelImage, Sheet};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// The objects that every page has.
const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
/// The first of the other objects.
const FIRST: i32 = 5;

/// A PDF of one page with a sheet, whose units have some points.
pub(crate) fn pdf(sheet: &Sheet, points: f64) -> io::Result<Vec<u8>> {
    let size = sheet.size.map(|length| (f64::from(length) * points) as f32);
    let mut drawn = PdfDrawing { content: Content::new(), opacities: BTreeMap::new(), images: Vec::new() };
    drawn.content.save_state();
    // a sheet goes down from its top, a page up from its bottom
    drawn.content.transform([points as f32, 0.0, 0.0, -points as f32, 0.0, size[1]]);
    sheet.elements.iter().for_each(|element| drawn.element(element));
    drawn.content.restore_state();
    drawn.written(size)
}

/// What is drawn on a page, and what it refers to.
struct PdfDrawing<'a> {
    content: Content,
    /// Opacities in per cent.
    opacities: BTreeMap<u32, Vec<u8>>,
    images: Vec<&'a PixelImage>,
}

impl<'a> PdfDrawing<'a> {
    fn element(&mut self, element: &'a Element) {
        match element {
            Element::Line { points, colour, width } => {
                let [red, green, blue] = parts(*colour);
                self.content.set_stroke_rgb(red, green, blue).set_line_width(*width as f32);
                self.path(points);
                self.content.stroke();
            }
            Element::Shape { corners, colour, opacity } => {
                self.fill(*colour, *opacity);
                self.path(corners);
                self.content.close_path().fill_nonzero();
            }
            Element::Words { words, at, size, align, upwards } => self.words(words, *at, *size, *align, *upwards),
            Element::PixelImage(image) => self.image(image),
        }
    }

    /// Chooses how the next shapes are filled.
    fn fill(&mut self, colour: Colour, opacity: f64) {
        let percent = (100.0 * opacity).round() as u32;
        let name = self.opacities.entry(percent).or_insert_with(|| format!("O{percent}").into_bytes());
        let [red, green, blue] = parts(colour);
        self.content.set_parameters(Name(name)).set_fill_rgb(red, green, blue);
    }

    fn path(&mut self, points: &[[f64; 2]]) {
        for (i, [x, y]) in points.iter().map(|point| point.map(|it| it as f32)).enumerate() {
            let _ = if i == 0 { self.content.move_to(x, y) } else { self.content.line_to(x, y) };
        }
    }

    fn words(&mut self, words: &str, [x, y]: [f64; 2], size: f64, align: Align, upwards: bool) {
        let back = match align {
            Align::Left => 0.0,
            Align::Middle => 0.5,
            Align::Right => 1.0,
        } * width(words, size);
        let place = |[right, down]: [f64; 2]| match upwards {
            true => [x + down, y - (right - back)],
            false => [x + right - back, y + down],
        };
        self.fill(Colour::BLACK, 1.0);
        let outlines = letters(words, size).concat();
        for outline in &outlines {
            self.path(&outline.iter().map(|point| place(*point)).collect::<Vec<_>>());
            self.content.close_path();
        }
        if !outlines.is_empty() {
            self.content.fill_nonzero();
        }
    }

    fn image(&mut self, image: &'a PixelImage) {
        let ([x, y], [width, height]) = (image.corner.map(|it| it as f32), image.size.map(|it| it as f32));
        let name = format!("I{}", self.images.len());
        self.images.push(image);
        self.content.save_state();
        self.content.transform([width, 0.0, 0.0, -height, x, y + height]).x_object(Name(name.as_bytes()));
        self.content.restore_state();
    }

    /// The bytes of the file.
    fn written(self, [width, height]: [f32; 2]) -> io::Result<Vec<u8>> {
        let mut pdf = Pdf::new();
        let others: Vec<Ref> = (FIRST..).take(self.opacities.len() + self.images.len()).map(Ref::new).collect();
        let (of_opacities, of_images) = others.split_at(self.opacities.len());
        let names: Vec<String> = (0..self.images.len()).map(|i| format!("I{i}")).collect();
        pdf.catalog(CATALOG).pages(PAGES);
        pdf.pages(PAGES).kids([PAGE]).count(1);
        let mut page = pdf.page(PAGE);
        page.media_box(Rect::new(0.0, 0.0, width, height)).parent(PAGES).contents(CONTENT);
        let mut resources = page.resources();
        let states = self.opacities.values().map(|name| Name(name)).zip(of_opacities.iter().copied());
        resources.ext_g_states().pairs(states);
        resources.x_objects().pairs(names.iter().map(|name| Name(name.as_bytes())).zip(of_images.iter().copied()));
        resources.finish();
        page.finish();
        for (percent, at) in self.opacities.keys().zip(of_opacities) {
            pdf.ext_graphics(*at).non_stroking_alpha(*percent as f32 / 100.0);
        }
        for (image, at) in self.images.iter().zip(of_images) {
            let bytes = packed(&image.pixels.iter().flat_map(|Colour(parts)| *parts).collect::<Vec<u8>>())?;
            let mut object = pdf.image_xobject(*at, &bytes);
            object.filter(Filter::FlateDecode);
            object.width(image.shape[1] as i32).height(image.shape[0] as i32);
            object.color_space().device_rgb();
            object.bits_per_component(8);
        }
        let content = packed(&self.content.finish())?;
        pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
        Ok(pdf.finish())
    }
}

fn packed(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
    packed.write_all(bytes)?;
    packed.finish()
}

fn parts(Colour(parts): Colour) -> [f32; 3] {
    parts.map(|part| f32::from(part) / 255.0)
}
