//! At most 255 colours for a GIF, from the pictures themselves.

use resvg::tiny_skia::Pixmap;

/// Bits kept of each channel when colours are counted.
const BITS: u32 = 5;
const BINS: usize = 1 << (3 * BITS);
/// The place of the colour that means "as before".
pub(super) const UNCHANGED: u8 = 255;

/// A palette and the way from any colour to its nearest.
pub(super) struct Palette {
    colours: Vec<[u8; 3]>,
    nearest: Vec<u8>,
}

fn bin(r: u8, g: u8, b: u8) -> usize {
    let cut = |c: u8| usize::from(c >> (8 - BITS));
    (cut(r) << (2 * BITS)) | (cut(g) << BITS) | cut(b)
}

impl Palette {
    /// The most frequent colours of the pictures.
    pub(super) fn of(pictures: &[Pixmap]) -> Self {
        let mut counts = vec![0_u64; BINS];
        // The colour that most of a bin's pixels have, by majority vote: flat areas keep theirs.
        let mut favourites = vec![([0_u8; 3], 0_u64); BINS];
        for pixel in pictures.iter().flat_map(|p| p.pixels()) {
            let rgb = [pixel.red(), pixel.green(), pixel.blue()];
            let bin = bin(rgb[0], rgb[1], rgb[2]);
            counts[bin] += 1;
            let (favourite, votes) = &mut favourites[bin];
            if *votes == 0 {
                (*favourite, *votes) = (rgb, 1);
            } else if *favourite == rgb {
                *votes += 1;
            } else {
                *votes -= 1;
            }
        }
        let mut bins: Vec<usize> = (0..BINS).filter(|b| counts[*b] > 0).collect();
        bins.sort_by_key(|b| (std::cmp::Reverse(counts[*b]), *b));
        bins.truncate(usize::from(UNCHANGED));
        let mut colours: Vec<[u8; 3]> = bins.iter().map(|b| favourites[*b].0).collect();
        if colours.is_empty() {
            colours.push([255; 3]);
        }
        let nearest = (0..BINS).map(|b| {
            let channel = |shift: u32| ((b >> shift) & ((1 << BITS) - 1)) as i32 * 8 + 4;
            let rgb = [channel(2 * BITS), channel(BITS), channel(0)];
            let distance = |c: &[u8; 3]| -> i32 {
                (0..3)
                    .map(|k| (i32::from(c[k]) - rgb[k]).pow(2) * [3, 4, 2][k])
                    .sum()
            };
            let best = (0..colours.len()).min_by_key(|i| distance(&colours[*i]));
            best.unwrap_or(0) as u8
        });
        let mut nearest: Vec<u8> = nearest.collect();
        for (i, b) in bins.iter().enumerate() {
            nearest[*b] = i as u8;
        }
        Self { colours, nearest }
    }

    /// The colours as a GIF has them: 256 times red, green, blue.
    pub(super) fn table(&self) -> Vec<u8> {
        let mut table = self.colours.as_flattened().to_vec();
        table.resize(3 * 256, 255);
        table
    }

    /// Places of a picture's colours.
    pub(super) fn indices(&self, picture: &Pixmap) -> Vec<u8> {
        let each = picture.pixels().iter();
        each.map(|p| self.nearest[bin(p.red(), p.green(), p.blue())])
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use resvg::tiny_skia::Color;

    #[test]
    fn frequent_colours_are_kept_as_they_are() {
        let mut picture = Pixmap::new(4, 4).unwrap();
        picture.fill(Color::from_rgba8(10, 200, 30, 255));
        let palette = Palette::of(&[picture.clone()]);
        let place = usize::from(palette.indices(&picture)[0]);
        assert_eq!(palette.table()[3 * place..3 * place + 3], [10, 200, 30]);
        assert_eq!(palette.table().len(), 768);
    }
}
