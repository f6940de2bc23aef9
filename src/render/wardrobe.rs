//! The colours of characters: skin, hair, clothes, fur; each character's own, the far side darker.
//!
//! place in the cast, [`Tone`], side → colour.

use crate::figure::{FigurePart, Tone};

/// One character's colours.
#[derive(Debug, Clone, Copy)]
struct Wardrobe {
    skin: &'static str,
    hair: &'static str,
    shirt: &'static str,
    trousers: &'static str,
    shoe: &'static str,
    fur: &'static str,
    mane: &'static str,
    belt: &'static str,
}

/// One a character, in turn.
const WARDROBES: [Wardrobe; 3] = [
    Wardrobe {
        skin: "#f3c8a2",
        hair: "#4a3324",
        shirt: "#4f97d1",
        trousers: "#66717f",
        shoe: "#9c4a38",
        fur: "#e0b46d",
        mane: "#94602f",
        belt: "#41509f",
    },
    Wardrobe {
        skin: "#d8a476",
        hair: "#2a2422",
        shirt: "#e69a45",
        trousers: "#84684c",
        shoe: "#4b4744",
        fur: "#cfa274",
        mane: "#6d4632",
        belt: "#a83f3b",
    },
    Wardrobe {
        skin: "#f2d3b5",
        hair: "#a06f38",
        shirt: "#86b673",
        trousers: "#5c6f58",
        shoe: "#5f4a35",
        fur: "#e6cc99",
        mane: "#ad7d46",
        belt: "#35805f",
    },
];

/// How much of a colour remains on the far side, and how much of it turns grey.
const FAR: [f64; 2] = [0.66, 0.3];

/// The colour of a part of the character with this place in the cast.
pub(super) fn colour(who: usize, tone: Tone, far: bool) -> String {
    let wardrobe = &WARDROBES[who % WARDROBES.len()];
    let near = match tone {
        Tone::Skin => wardrobe.skin,
        Tone::Hair => wardrobe.hair,
        Tone::Shirt => wardrobe.shirt,
        Tone::Trousers => wardrobe.trousers,
        Tone::Shoe => wardrobe.shoe,
        Tone::Fur => wardrobe.fur,
        Tone::Mane => wardrobe.mane,
        Tone::Belt => wardrobe.belt,
    };
    if far { darker(near) } else { near.to_owned() }
}

/// The colour that a character is told apart by, beside another of its kind.
pub(super) fn sign(who: usize, parts: &[FigurePart]) -> String {
    let worn = |tone: &Tone| parts.iter().any(|p| p.tone == *tone);
    let tones = [
        Tone::Shirt,
        Tone::Belt,
        Tone::Mane,
        Tone::Fur,
        Tone::Trousers,
    ];
    let tone = tones.into_iter().find(worn).unwrap_or(Tone::Skin);
    colour(who, tone, false)
}

/// A colour in the shade: darker, and less of a colour.
fn darker(colour: &str) -> String {
    let channel = |k: usize| {
        let digits = colour.get(1 + 2 * k..3 + 2 * k);
        let byte = digits.and_then(|d| u8::from_str_radix(d, 16).ok());
        f64::from(byte.unwrap_or(0))
    };
    let [r, g, b] = [0, 1, 2].map(channel);
    let grey = 0.3 * r + 0.59 * g + 0.11 * b;
    let shade = |c: f64| {
        (FAR[0] * (c + FAR[1] * (grey - c)))
            .round()
            .clamp(0.0, 255.0) as u8
    };
    let [r, g, b] = [r, g, b].map(shade);
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_far_side_is_darker_and_greyer() {
        assert_eq!(darker("#ffffff"), "#a8a8a8");
        let (near, far) = (colour(0, Tone::Shirt, false), colour(0, Tone::Shirt, true));
        let spread = |c: &str| {
            let bytes = [1, 3, 5].map(|k| u8::from_str_radix(&c[k..k + 2], 16).unwrap());
            i32::from(*bytes.iter().max().unwrap()) - i32::from(*bytes.iter().min().unwrap())
        };
        assert!(spread(&far) < spread(&near), "{near} {far}");
    }

    #[test]
    fn characters_differ_in_what_they_wear() {
        for tone in [Tone::Shirt, Tone::Trousers, Tone::Belt, Tone::Fur] {
            assert_ne!(colour(0, tone, false), colour(1, tone, false));
        }
    }
}
