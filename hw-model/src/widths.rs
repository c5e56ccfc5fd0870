//! Formats stated by hand instead of derived, by the names of their registers.
//!
//! They are checked: a register that could overflow is refused. A coefficient and a hand-over have one format in all
//! segments, which is stated once, for the first.

use std::fmt;
use std::ops::Index;

use serde::de::{MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use crate::format::QFormat;
use crate::registers::{MAX_DEGREE, Register, Table};

/// The formats that a configuration states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StatedWidths {
    formats: Table<Option<QFormat>>,
}

/// Registers whose formats can be stated, with the names they have there, in the order of files. The variable is u: in
/// the power form it is x, which has the input's format. The last stage's result is not among them: it has the fraction
/// bits of the output.
pub const STATED: [(Register, &str); 14] = [
    (Register::V, "u"),
    (Register::C(0, 4), "c4"),
    (Register::C(0, 3), "c3"),
    (Register::C(0, 2), "c2"),
    (Register::C(0, 1), "c1"),
    (Register::C(0, 0), "c0"),
    (Register::T(1), "t1"),
    (Register::T(2), "t2"),
    (Register::T(3), "t3"),
    (Register::Cut, "cut"),
    (Register::HandOver(1), "hand_over"),
    (Register::TailA, "tail_a"),
    (Register::TailB, "tail_b"),
    (Register::Divisor, "divisor"),
];
const _: () = assert!(MAX_DEGREE == 4, "c4 and t3 are the last that can be stated");

/// The names alone, for messages.
const NAMES: &[&str] = &{
    let mut names = [""; STATED.len()];
    let mut i = 0;
    while i < names.len() {
        names[i] = STATED[i].1;
        i += 1;
    }
    names
};

impl StatedWidths {
    /// True where none is stated.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.iter().next().is_none()
    }

    /// States a format, or takes it back.
    pub fn set(&mut self, register: Register, format: Option<QFormat>) {
        self.formats[register.of_any_segment()] = format;
    }

    /// The same formats and one more, or one less.
    #[must_use]
    pub fn with(mut self, register: Register, format: Option<QFormat>) -> Self {
        self.set(register, format);
        self
    }

    /// Those of the ends of segments alone, which have nothing to do with the output.
    #[must_use]
    pub fn of_ends(&self) -> Self {
        [Register::Cut, Register::HandOver(1)]
            .into_iter()
            .fold(Self::default(), |widths, end| widths.with(end, self[end]))
    }

    /// What is stated, in the order of [`STATED`].
    pub fn iter(&self) -> impl Iterator<Item = (Register, QFormat)> {
        STATED.into_iter().filter_map(|(register, _)| Some((register, self[register]?)))
    }
}

impl Index<Register> for StatedWidths {
    type Output = Option<QFormat>;
    fn index(&self, register: Register) -> &Option<QFormat> {
        &self.formats[register.of_any_segment()]
    }
}

impl Serialize for StatedWidths {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (register, name) in STATED {
            if let Some(format) = self[register] {
                map.serialize_entry(name, &format)?;
            }
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for StatedWidths {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(ByName)
    }
}

struct ByName;

impl<'de> Visitor<'de> for ByName {
    type Value = StatedWidths;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("struct StatedWidths")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<StatedWidths, A::Error> {
        let mut widths = StatedWidths::default();
        let mut seen = [false; STATED.len()];
        while let Some(name) = map.next_key::<std::borrow::Cow<'de, str>>()? {
            let Some(index) = STATED.iter().position(|&(_, known)| known == name) else {
                return Err(de::Error::unknown_field(&name, NAMES));
            };
            let (register, name) = STATED[index];
            if std::mem::replace(&mut seen[index], true) {
                return Err(de::Error::duplicate_field(name));
            }
            widths.set(register, map.next_value()?);
        }
        Ok(widths)
    }
}
