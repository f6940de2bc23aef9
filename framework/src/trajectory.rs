//! A recorded run: every step's state, centre of mass, centre of pressure and active controller,
//! and all events. Written compactly, read back bit for bit.
//!
//! simulation → [`Trajectory`] → file → drawings, digest.
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
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::{Xxh3, xxh3_64};

use crate::error::{Error, Result};
use crate::file::{Source, read_bounded, write_atomically};
use crate::model::Model;
use crate::sensors::Sensors;
use crate::supervisor::Bid;
use crate::world::Prop;

const MAGIC: &[u8; 8] = b"APLOMB-T";
const VERSION: u16 = 1;
const LARGEST_FILE: u64 = 1 << 30;
const LARGEST_CONTENT: u64 = 4 << 30;

/// Something that happened, with the time in s and the character it happened to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// s
    pub time: f64,
    /// Place among the world's characters.
    pub character: usize,
    /// What.
    pub kind: EventKind,
}

/// The kinds of events.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum EventKind {
    /// A push began.
    Push {
        /// The link that is pushed.
        link: String,
        /// N·s
        impulse: [f64; 2],
    },
    /// A command was given.
    Command {
        /// As given.
        text: String,
        /// Whether a controller answers to it and took it up.
        accepted: bool,
    },
    /// Control changed hands.
    Switch {
        /// The former controller.
        from: Option<String>,
        /// The new one.
        to: String,
        /// `start`, `succeeded`, `command`, or `failed: REASON`.
        why: String,
        /// What each controller of the pool said.
        bids: Vec<Bid>,
    },
    /// A command was refused.
    Refused {
        /// The command.
        command: String,
        /// The controller that answers to it, if one does.
        controller: Option<String>,
        /// The clause that refused, or what is wrong with the command.
        clause: String,
        /// The value that it refused.
        value: Option<f64>,
    },
    /// Something other than feet touched, after standing.
    Fell,
    /// Standing again, after a fall.
    Stood,
}

/// What is known of one character of a recording.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cast {
    /// The character file's text.
    pub model: String,
    /// Names of the pool's controllers; rows refer to them by place.
    pub controllers: Vec<String>,
}

/// What is known of the run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Name of the scenario.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// s between rows.
    pub dt: f64,
    /// The characters.
    pub cast: Vec<Cast>,
    /// The props.
    pub props: Vec<Prop>,
}

/// Numbers of a character's row beside q and q̇: com (2), com velocity (2), ground reaction force
/// (2), CoP, rear and front of the base of support, reference CoM, active controller.
const EXTRA: usize = 11;

/// A recorded run. Rows hold single-precision numbers, the engine's precision.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    /// The run.
    pub header: Header,
    /// The characters, read from the header.
    pub models: Vec<Arc<Model>>,
    /// In the order of time.
    pub events: Vec<Event>,
    rows: Vec<f32>,
    width: usize,
}

/// One character at one instant of a recording. SI units, world frame.
#[derive(Debug, Clone, Copy)]
pub struct Moment<'a> {
    /// Positions, length [`Model::dof`].
    pub q: &'a [f32],
    /// Velocities.
    pub qdot: &'a [f32],
    /// Centre of mass.
    pub com: [f32; 2],
    /// Its velocity.
    pub com_velocity: [f32; 2],
    /// Ground reaction force on the feet.
    pub force: [f32; 2],
    /// Centre of pressure, x.
    pub cop: Option<f32>,
    /// Base of support, x.
    pub support: Option<[f32; 2]>,
    /// The centre of mass that the controller aims at, x.
    pub reference: Option<f32>,
    /// Place of the active controller in its pool.
    pub active: usize,
}

fn width(models: &[Arc<Model>], props: usize) -> usize {
    models.iter().map(|m| 2 * m.dof() + EXTRA).sum::<usize>() + 3 * props
}

/// Appends a character's numbers to a row.
pub fn push_character(row: &mut Vec<f32>, now: &Sensors, reference: Option<f64>, active: usize) {
    let number = |x: Option<f64>| x.map_or(f32::NAN, |x| x as f32);
    let s = &now.state;
    row.extend(s.q.iter().chain(&s.qdot).map(|x| *x as f32));
    row.extend(
        [now.com, now.com_velocity, now.ground_reaction_force]
            .as_flattened()
            .iter()
            .map(|x| *x as f32),
    );
    row.push(number(now.cop));
    row.push(number(now.base_of_support.map(|b| b[0])));
    row.push(number(now.base_of_support.map(|b| b[1])));
    row.push(number(reference));
    row.push(active as f32);
}

/// Hash over every step's row.
#[derive(Clone)]
pub struct Digest(Xxh3);

impl std::fmt::Debug for Digest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Digest({})", self.text())
    }
}

impl Default for Digest {
    fn default() -> Self {
        Self(Xxh3::new())
    }
}

impl Digest {
    /// Takes in one row.
    pub fn row(&mut self, row: &[f32]) {
        for x in row {
            self.0.update(&x.to_bits().to_le_bytes());
        }
    }

    /// 32 hexadecimal digits.
    #[must_use]
    pub fn text(&self) -> String {
        format!("{:032x}", self.0.digest128())
    }
}

impl Trajectory {
    /// An empty recording.
    #[must_use]
    pub fn new(header: Header, models: Vec<Arc<Model>>) -> Self {
        let width = width(&models, header.props.len());
        Self {
            header,
            models,
            events: Vec::new(),
            rows: Vec::new(),
            width,
        }
    }

    /// Appends a step's row: every character's numbers, then (x, y, angle) of every prop.
    ///
    /// # Panics
    /// If the row has another length than the header implies.
    pub fn push_row(&mut self, row: &[f32]) {
        assert_eq!(row.len(), self.width, "row of another run");
        self.rows.extend_from_slice(row);
    }

    /// Number of recorded steps.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len() / self.width.max(1)
    }

    /// Whether nothing was recorded.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// s from the first to the last step.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.len().saturating_sub(1) as f64 * self.header.dt
    }

    /// The step nearest to a time.
    #[must_use]
    pub fn step_at(&self, time: f64) -> usize {
        ((time / self.header.dt).round().max(0.0) as usize).min(self.len().saturating_sub(1))
    }

    fn row(&self, step: usize) -> &[f32] {
        &self.rows[step * self.width..(step + 1) * self.width]
    }

    /// A character at a step.
    #[must_use]
    pub fn moment(&self, step: usize, character: usize) -> Moment<'_> {
        let start = width(&self.models[..character], 0);
        let dof = self.models[character].dof();
        let row = &self.row(step)[start..];
        let (q, rest) = row.split_at(dof);
        let (qdot, x) = rest.split_at(dof);
        let some = |x: f32| (!x.is_nan()).then_some(x);
        Moment {
            q,
            qdot,
            com: [x[0], x[1]],
            com_velocity: [x[2], x[3]],
            force: [x[4], x[5]],
            cop: some(x[6]),
            support: some(x[7]).zip(some(x[8])).map(|(a, b)| [a, b]),
            reference: some(x[9]),
            active: x[10] as usize,
        }
    }

    /// (x, y, angle) of a prop at a step.
    #[must_use]
    pub fn prop(&self, step: usize, prop: usize) -> [f32; 3] {
        let start = width(&self.models, 0) + 3 * prop;
        let row = &self.row(step)[start..start + 3];
        [row[0], row[1], row[2]]
    }

    /// Name of the controller that was active.
    #[must_use]
    pub fn controller(&self, step: usize, character: usize) -> &str {
        let active = self.moment(step, character).active;
        self.header.cast[character]
            .controllers
            .get(active)
            .map_or("", String::as_str)
    }

    /// The digest of all rows: the same as the run's that was recorded.
    #[must_use]
    pub fn digest(&self) -> String {
        let mut digest = Digest::default();
        for step in 0..self.len() {
            digest.row(self.row(step));
        }
        digest.text()
    }

    /// Writes the recording, whole or not at all.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(&self, path: &Path) -> Result<()> {
        let fail = |reason: String| Error::Write {
            path: path.to_owned(),
            reason,
        };
        let planes = to_planes(&self.rows, self.width);
        let parts = (&self.header, &self.events, planes);
        let content = postcard::to_stdvec(&parts).map_err(|e| fail(e.to_string()))?;
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        encoder
            .write_all(&content)
            .map_err(|e| fail(e.to_string()))?;
        let packed = encoder.finish().map_err(|e| fail(e.to_string()))?;
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend((packed.len() as u64).to_le_bytes());
        bytes.extend(xxh3_64(&packed).to_le_bytes());
        bytes.extend(packed);
        write_atomically(path, &bytes)
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

    fn recording() -> Trajectory {
        let model = Model::load("humanoid").unwrap();
        let cast = Cast {
            model: model.source.clone(),
            controllers: vec!["rest".into()],
        };
        let header = Header {
            scenario: "x".into(),
            seed: 3,
            dt: 1e-3,
            cast: vec![cast],
            props: vec![],
        };
        let mut t = Trajectory::new(header, vec![Arc::clone(&model)]);
        let mut now = Sensors::new(&model, 9.81);
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
