//! The file of a recording. Written compactly, whole or not at all; read back bit for bit.
//!
//! [`Trajectory`] → header, events and rows as byte planes → deflated bytes, and back.
//!
//! File: `APLOMB-T`, version (u16), length and XXH3 digest of the rest (u64 each, little-endian),
//! then deflated [`postcard`] of the parts. Rows are stored as columns, each value XORed with its
//! predecessor and split into byte planes, which deflates well.

use std::io::{Read, Write};
use std::path::Path;
use std::sync::Arc;

use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use xxhash_rust::xxh3::xxh3_64;

use crate::character::Model;
use crate::events::Event;
use crate::input::{Error, Result, Source, read_bounded, write_atomically};
use crate::run::trajectory::{Cast, Header, Trajectory};

const MAGIC: &[u8; 8] = b"APLOMB-T";
const VERSION: u16 = 4;
const LARGEST_FILE: u64 = 1 << 30;
const LARGEST_CONTENT: u64 = 4 << 30;

impl Trajectory {
    /// Writes the recording, whole or not at all.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(&self, path: &Path) -> Result<()> {
        let bytes = self.encode().map_err(|reason| Error::Write {
            path: path.to_owned(),
            reason,
        })?;
        write_atomically(path, &bytes)
    }

    /// The recording as the bytes of its file.
    ///
    /// # Errors
    /// [`Error::Invalid`] of what the format cannot hold.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        self.encode()
            .map_err(|reason| Error::refused("recording", reason, "what its file can hold"))
    }

    fn encode(&self) -> std::result::Result<Vec<u8>, String> {
        let planes = to_planes(&self.rows, self.width);
        let parts = (&self.header, &self.events, planes);
        let content = postcard::to_stdvec(&parts).map_err(|e| e.to_string())?;
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(&content).map_err(|e| e.to_string())?;
        let packed = encoder.finish().map_err(|e| e.to_string())?;
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend((packed.len() as u64).to_le_bytes());
        bytes.extend(xxh3_64(&packed).to_le_bytes());
        bytes.extend(packed);
        Ok(bytes)
    }

    /// Reads a recording.
    ///
    /// # Errors
    /// [`Error::Read`] for a file that is no recording, is of another version, cut short or
    /// damaged.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = read_bounded(path, LARGEST_FILE)?;
        Self::decode(&bytes).map_err(|reason| Error::Read {
            path: path.to_owned(),
            reason,
        })
    }

    fn decode(bytes: &[u8]) -> std::result::Result<Self, String> {
        let rest = bytes
            .strip_prefix(MAGIC)
            .ok_or("it is no trajectory of aplomb")?;
        let (version, rest) = rest.split_first_chunk::<2>().ok_or("it is cut short")?;
        let version = u16::from_le_bytes(*version);
        if version != VERSION {
            return Err(format!("it is of version {version}; accepted: {VERSION}"));
        }
        let (length, rest) = rest.split_first_chunk::<8>().ok_or("it is cut short")?;
        let (hash, packed) = rest.split_first_chunk::<8>().ok_or("it is cut short")?;
        let length = u64::from_le_bytes(*length);
        if (packed.len() as u64) < length {
            return Err(format!(
                "it is cut short: {} of {length} bytes",
                packed.len()
            ));
        }
        if packed.len() as u64 > length || xxh3_64(packed) != u64::from_le_bytes(*hash) {
            return Err("it is damaged: its checksum does not fit".to_owned());
        }
        let mut content = Vec::new();
        let mut decoder = DeflateDecoder::new(packed).take(LARGEST_CONTENT);
        decoder
            .read_to_end(&mut content)
            .map_err(|e| format!("it is damaged: {e}"))?;
        let (header, events, planes): (Header, Vec<Event>, Vec<u8>) =
            postcard::from_bytes(&content).map_err(|e| format!("it is damaged: {e}"))?;
        if !(header.dt.is_finite() && header.dt > 0.0) || header.cast.is_empty() {
            return Err("it is damaged: no step size or no character".to_owned());
        }
        let parse = |c: &Cast| Model::parse(&Source::new("recorded character", c.model.as_str()));
        let models = header.cast.iter().map(|c| parse(c).map(Arc::new));
        let models = models
            .collect::<Result<Vec<_>>>()
            .map_err(|e| e.to_string())?;
        let mut trajectory = Self::new(header, models);
        if !planes.len().is_multiple_of(4 * trajectory.width) {
            return Err("it is damaged: its last step is incomplete".to_owned());
        }
        trajectory.rows = from_planes(&planes, trajectory.width);
        trajectory.events = events;
        let last = |e: &Event| e.character < trajectory.models.len() && e.time.is_finite();
        if !trajectory.events.iter().all(last) {
            return Err("it is damaged: an event of an unknown character".to_owned());
        }
        Ok(trajectory)
    }
}

/// Rows as columns of XORed bits in byte planes.
fn to_planes(rows: &[f32], width: usize) -> Vec<u8> {
    let mut planes = Vec::with_capacity(4 * rows.len());
    for column in 0..width {
        for byte in 0..4 {
            let mut last = 0_u32;
            for x in rows.iter().skip(column).step_by(width) {
                let bits = x.to_bits();
                planes.push((bits ^ last).to_le_bytes()[byte]);
                last = bits;
            }
        }
    }
    planes
}

fn from_planes(planes: &[u8], width: usize) -> Vec<f32> {
    let len = planes.len() / (4 * width);
    let mut rows = vec![0.0_f32; len * width];
    for column in 0..width {
        let at = |byte: usize, i: usize| planes[(4 * column + byte) * len + i];
        let mut last = 0_u32;
        for i in 0..len {
            last ^= u32::from_le_bytes([at(0, i), at(1, i), at(2, i), at(3, i)]);
            rows[i * width + column] = f32::from_bits(last);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::events::EventKind;
    use crate::run::trajectory::push_character;
    use crate::run::trajectory::tests::of_humanoids;

    fn recording() -> Trajectory {
        let (mut t, mut now) = of_humanoids(1);
        for i in 0..50 {
            now.state.q[4] = f64::from(i).sin();
            let mut row = Vec::new();
            push_character(&mut row, &now, (i % 2 == 0).then_some(0.1), 0);
            t.push_row(&row);
        }
        t.events.push(Event {
            time: 0.01,
            character: 0,
            kind: EventKind::Fell,
        });
        t
    }

    #[test]
    fn a_recording_is_read_back_bit_for_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.trajectory");
        let t = recording();
        t.write(&path).unwrap();
        let back = Trajectory::read(&path).unwrap();
        assert_eq!(back.digest(), t.digest());
        assert_eq!(
            (back.len(), &back.events, &back.header),
            (50, &t.events, &t.header)
        );
        assert_eq!(back.moment(7, 0).reference, None);
        assert_eq!(back.controller(7, 0), "rest");
    }

    #[test]
    fn truncated_damaged_and_foreign_files_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.trajectory");
        recording().write(&path).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        assert_eq!(recording().to_bytes().unwrap(), bytes);
        for cut in 0..bytes.len() {
            assert!(Trajectory::decode(&bytes[..cut]).is_err(), "cut at {cut}");
        }
        let mut damaged = bytes.clone();
        let last = damaged.len() - 1;
        damaged[last] ^= 1;
        assert!(
            Trajectory::decode(&damaged)
                .unwrap_err()
                .contains("checksum")
        );
        let mut newer = bytes;
        newer[8] = 9;
        assert!(
            Trajectory::decode(&newer)
                .unwrap_err()
                .contains("version 9")
        );
        assert!(
            Trajectory::decode(b"GIF89a")
                .unwrap_err()
                .contains("no trajectory")
        );
    }
}
