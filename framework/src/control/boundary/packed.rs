//! The numbers of a radial boundary in one string: support vectors and weights.
//!
//! lists of numbers ↔ `ROWS x WIDTH crc32:CHECKSUM DATA`, a string of a boundary file.
//!
//! DATA is base64 of a zlib stream, CHECKSUM that of what is in the stream. The stream has a column
//! after the other, and of a column the lowest byte of every row, then the next byte of every row,
//! and so on. A component of a support vector is a whole number of ten-thousandths: 4 bytes, those
//! of 2n for n ≥ 0 and of −2n − 1 for n < 0. A weight is an f64: its 8 bytes. Both come back bit
//! for bit. Plain lists are read as well; they are also what vectors are written as that are no
//! ten-thousandths.

use std::fmt;
use std::io::{Read, Write};
use std::marker::PhantomData;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use flate2::{Compression, Crc};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};

/// At most this many features a boundary, so that they fit into an array on the stack.
pub const MOST_FEATURES: usize = 64;
/// At most this many support vectors a boundary.
pub const MOST_SUPPORT_VECTORS: usize = 20_000;
/// Steps of a component within 1.
const STEPS: f64 = 10_000.0;
const ACCEPTED: &str = "a list of numbers, or 'ROWS x WIDTH crc32:CHECKSUM DATA' as `aplomb train preconditions` writes it";

/// A row of what is packed.
trait PackedRow: Sized {
    /// Bytes of a number.
    const BYTES: usize;

    /// The numbers' words; none if they would not come back bit for bit.
    fn words(&self) -> Option<Vec<u64>>;

    fn of_words(words: &[u64]) -> Self;
}

/// A support vector.
impl PackedRow for Vec<f64> {
    const BYTES: usize = 4;

    fn words(&self) -> Option<Vec<u64>> {
        let word = |z: &f64| {
            // Beyond the range of i32, and for what is not a number, another number comes back.
            let n = (z * STEPS).round() as i32;
            let fits = (f64::from(n) / STEPS).to_bits() == z.to_bits();
            fits.then_some(u64::from(((n << 1) ^ (n >> 31)).cast_unsigned()))
        };
        self.iter().map(word).collect()
    }

    fn of_words(words: &[u64]) -> Self {
        let number = |word: &u64| {
            let half = (word >> 1) as i32;
            f64::from(if word & 1 == 0 { half } else { !half }) / STEPS
        };
        words.iter().map(number).collect()
    }
}

/// A weight.
impl PackedRow for f64 {
    const BYTES: usize = 8;

    fn words(&self) -> Option<Vec<u64>> {
        Some(vec![self.to_bits()])
    }

    fn of_words(words: &[u64]) -> Self {
        words.first().map_or(f64::NAN, |w| Self::from_bits(*w))
    }
}

fn checksum(bytes: &[u8]) -> u32 {
    let mut crc = Crc::new();
    crc.update(bytes);
    crc.sum()
}

/// None if there is nothing to pack, or it would not come back bit for bit.
fn pack<R: PackedRow>(rows: &[R]) -> Option<String> {
    let words: Vec<Vec<u64>> = rows.iter().map(R::words).collect::<Option<_>>()?;
    let width = words.first()?.len();
    if width == 0 || words.iter().any(|row| row.len() != width) {
        return None;
    }
    let mut planes = Vec::with_capacity(words.len() * width * R::BYTES);
    for column in 0..width {
        for byte in 0..R::BYTES {
            planes.extend(words.iter().map(|row| row[column].to_le_bytes()[byte]));
        }
    }
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(&planes).ok()?;
    let data = STANDARD.encode(encoder.finish().ok()?);
    let (rows, crc) = (words.len(), checksum(&planes));
    Some(format!("{rows} x {width} crc32:{crc:08x} {data}"))
}

/// What is wrong with the text, and what is accepted.
fn unpack<R: PackedRow>(text: &str) -> Result<Vec<R>, String> {
    let parts: Vec<&str> = text.split_whitespace().collect();
    let [rows, "x", width, crc, data] = parts[..] else {
        return Err(format!(
            "{} parts of packed numbers; accepted: {ACCEPTED}",
            parts.len()
        ));
    };
    let number = |what: &str, found: &str, most: usize| {
        let number = found.parse().ok().filter(|n| (1..=most).contains(n));
        let found = found.get(..20).unwrap_or(found);
        number.ok_or_else(|| format!("{what} is '{found}'; accepted: 1 to {most}"))
    };
    let rows: usize = number("the number of rows", rows, MOST_SUPPORT_VECTORS)?;
    let width: usize = number("the width of a row", width, MOST_FEATURES)?;
    let right = rows * width * R::BYTES;
    let damaged = |how: String| {
        format!(
            "packed numbers are damaged: {how}; accepted: {rows} rows of {width} as they were written"
        )
    };
    let packed = STANDARD
        .decode(data)
        .map_err(|e| damaged(format!("no base64: {e}")))?;
    let mut planes = Vec::with_capacity(right);
    // One byte more than is right tells that there are too many, and no more is ever unpacked.
    ZlibDecoder::new(&packed[..])
        .take(right as u64 + 1)
        .read_to_end(&mut planes)
        .map_err(|e| damaged(e.to_string()))?;
    if planes.len() != right {
        let more = if planes.len() > right {
            "more than "
        } else {
            ""
        };
        let found = planes.len().min(right);
        return Err(damaged(format!("{more}{found} bytes instead of {right}")));
    }
    if crc.strip_prefix("crc32:") != Some(&format!("{:08x}", checksum(&planes))) {
        return Err(damaged("the checksum does not fit".to_owned()));
    }
    let word = |row: usize, column: usize| {
        let at = |byte: usize| u64::from(planes[(column * R::BYTES + byte) * rows + row]);
        (0..R::BYTES).fold(0, |word, byte| word | at(byte) << (8 * byte))
    };
    let row = |row| {
        R::of_words(
            &(0..width)
                .map(|column| word(row, column))
                .collect::<Vec<_>>(),
        )
    };
    Ok((0..rows).map(row).collect())
}

fn serialize<R: PackedRow + Serialize, S: Serializer>(
    rows: &[R],
    to: S,
) -> Result<S::Ok, S::Error> {
    match pack(rows) {
        Some(text) => to.serialize_str(&text),
        None => rows.serialize(to),
    }
}

/// Packed or a plain list.
struct Either<R>(PhantomData<R>);

impl<'de, R: PackedRow + Deserialize<'de>> Visitor<'de> for Either<R> {
    type Value = Vec<R>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(ACCEPTED)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Vec<R>, E> {
        unpack(text).map_err(E::custom)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<R>, A::Error> {
        let mut rows = Vec::new();
        while let Some(row) = list.next_element()? {
            rows.push(row);
        }
        Ok(rows)
    }
}

/// Support vectors, for serde.
pub(super) mod vectors {
    use super::*;

    pub(in super::super) fn serialize<S: Serializer>(
        rows: &[Vec<f64>],
        to: S,
    ) -> Result<S::Ok, S::Error> {
        super::serialize(rows, to)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Vec<Vec<f64>>, D::Error> {
        from.deserialize_any(Either(PhantomData))
    }
}

/// Weights, for serde.
pub(super) mod weights {
    use super::*;

    pub(in super::super) fn serialize<S: Serializer>(
        rows: &[f64],
        to: S,
    ) -> Result<S::Ok, S::Error> {
        super::serialize(rows, to)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Vec<f64>, D::Error> {
        from.deserialize_any(Either(PhantomData))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::boundary::DecisionFunction;
    use crate::input::Source;
    use proptest::prelude::*;

    fn any_gaussian() -> impl Strategy<Value = DecisionFunction> {
        (1..40_usize, 1..6_usize).prop_flat_map(|(rows, width)| {
            let row = prop::collection::vec(-600_000..600_000_i32, width);
            let support = prop::collection::vec(row, rows);
            let weights = prop::collection::vec(-30.0..30.0_f64, rows);
            (support, weights).prop_map(|(steps, weights)| DecisionFunction::Gaussian {
                gamma: 0.5,
                offset: 0.25,
                support: steps
                    .iter()
                    .map(|row| row.iter().map(|n| f64::from(*n) / STEPS).collect())
                    .collect(),
                weights,
            })
        })
    }

    fn parse(text: &str) -> Result<DecisionFunction, String> {
        let source = Source::new("x.ron", text);
        source.parse().map_err(|e| e.to_string())
    }

    proptest! {
        #[test]
        fn packed_numbers_come_back_bit_for_bit(decision in any_gaussian()) {
            let text = ron::to_string(&decision).unwrap();
            prop_assert!(text.contains(" crc32:") && !text.contains('['), "{text}");
            prop_assert_eq!(parse(&text).unwrap(), decision);
        }

        #[test]
        fn damage_is_refused_or_harmless(
            decision in any_gaussian(),
            at in 0.0..1.0_f64,
            byte in 0x20..0x7f_u8,
            cut in any::<bool>(),
        ) {
            let whole = ron::to_string(&decision).unwrap();
            let at = (at * whole.len() as f64) as usize;
            let mut text = whole.clone().into_bytes();
            if cut {
                text.remove(at);
            } else {
                text[at] = byte;
            }
            let text = String::from_utf8(text).unwrap();
            if let Ok(DecisionFunction::Gaussian { support, weights, .. }) = parse(&text) {
                let DecisionFunction::Gaussian { support: s, weights: w, .. } = decision else {
                    unreachable!()
                };
                prop_assert!(support == s && weights == w, "{text}");
            }
        }

        #[test]
        fn whatever_is_in_the_string_never_panics(text in "[0-9]{1,6} x [0-9]{1,3} crc32:[0-9a-f]{8} [A-Za-z0-9+/=]{0,80}|.{0,60}") {
            prop_assert!(unpack::<Vec<f64>>(&text).is_err());
            prop_assert!(unpack::<f64>(&text).is_err());
        }
    }

    #[test]
    fn refusals_name_place_problem_and_what_is_accepted() {
        let support = pack(&[vec![0.5, -0.25], vec![1.0, 2.0]]).unwrap();
        let text = |support: &str| {
            format!(
                "Gaussian(gamma: 1.0,\n offset: 0.0,\n support: \"{support}\", weights: [1.0, 2.0])"
            )
        };
        assert!(parse(&text(&support)).is_ok());
        let zeros = pack(&vec![vec![0.0; 8]; 20_000]).unwrap();
        let bomb = format!("2 x 2 crc32:00000000 {}", zeros.rsplit(' ').next().unwrap());
        let data = support.rsplit(' ').next().unwrap();
        for (bad, message) in [
            (String::new(), "0 parts of packed numbers; accepted: a list"),
            (
                support.replace("2 x", "3 x"),
                "16 bytes instead of 24; accepted: 3 rows of 2 as",
            ),
            (
                support.replace("2 x", "1 x"),
                "more than 8 bytes instead of 8",
            ),
            (
                support.replace("2 x", "20001 x"),
                "rows is '20001'; accepted: 1 to 20000",
            ),
            (
                support.replace("x 2", "x 65"),
                "row is '65'; accepted: 1 to 64",
            ),
            (
                support.replace("crc32:", "crc32:0"),
                "the checksum does not fit",
            ),
            (
                support.replace(data, &data[..data.len() / 8 * 4]),
                "packed numbers are damaged: ",
            ),
            (support.replace(data, "?"), "no base64"),
            (bomb, "more than 16 bytes instead of 16"),
        ] {
            let refusal = parse(&text(&bad)).unwrap_err();
            assert!(refusal.contains("x.ron:3:12: "), "{refusal}");
            assert!(refusal.contains(message), "{message}: {refusal}");
        }
    }

    #[test]
    fn what_would_change_is_written_as_a_list() {
        for row in [vec![0.123_45], vec![-0.0], vec![f64::NAN], vec![1e9]] {
            assert_eq!(pack(&[row]), None);
        }
        assert_eq!(pack(&[vec![0.5], vec![]]), None);
    }
}
