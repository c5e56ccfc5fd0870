//! What the parts of a data path take on a device.

use serde::{Deserialize, Serialize};

/// Where the delays come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Device {
    /// A table that comes with Blysk, by its name.
    Named(String),
    /// A table in the configuration itself.
    Table(Delays),
}

/// The delays of a device, in nanoseconds, each with the wires that belong to it.
///
/// A part takes a constant and, where carries run through it, something for each bit: an adder of w bits takes
/// `add` + w·`carry`. The tables that come with Blysk are fitted to placements of the emitted RTL
/// (`scripts/delays.py`).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Delays {
    /// From the clock to the output of a register, and what the next one wants before its edge.
    pub register: f64,
    /// From the clock to the output of the ROM's memory, more than a register's.
    pub rom: f64,
    /// One level of logic.
    pub lut: f64,
    /// Into and out of a chain of carries.
    pub add: f64,
    /// Each bit of such a chain.
    pub carry: f64,
    /// Through a multiplier of `multiplier_bits`.
    pub multiply: f64,
    /// Instead of `rom`, to a rank right behind the memory, on a device whose memories have a register at the output.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rom_to_register: Option<f64>,
    /// The same of a multiplier, instead of `multiply`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub multiply_to_register: Option<f64>,
    /// To the enables of a rank of registers.
    pub enable: f64,
    /// The operands that one multiplier takes, in bits without a sign.
    pub multiplier_bits: u32,
}

/// The tables that come with Blysk, with their names.
const KNOWN: [(&str, &str); 2] = [("ecp5", include_str!("ecp5.json")), ("up5k", include_str!("up5k.json"))];

impl Device {
    /// The delays.
    ///
    /// # Errors
    /// When there is no table of that name; says which there are.
    pub fn delays(&self) -> Result<Delays, String> {
        match self {
            Self::Table(delays) => Ok(*delays),
            Self::Named(name) => {
                let known = KNOWN.iter().find(|(known, _)| known == name);
                let text = known.map(|(_, text)| *text).ok_or_else(|| {
                    let names = Self::names().collect::<Vec<_>>().join(", ");
                    format!("no table of delays is called {name:?}: use one of {names}, or a table of your own")
                })?;
                serde_json::from_str(text).map_err(|error| error.to_string())
            }
        }
    }

    /// The names of the tables that come with Blysk.
    pub fn names() -> impl Iterator<Item = &'static str> {
        KNOWN.iter().map(|(name, _)| *name)
    }

    /// For people: the name, or that it is a table.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Named(name) => name,
            Self::Table(_) => "the device of the table",
        }
    }
}

impl Delays {
    /// True of delays that a device can have.
    ///
    /// # Errors
    /// Names the field and what would be right.
    pub fn check(&self) -> Result<(), String> {
        let Self { register, rom, lut, add, carry, multiply, enable, .. } = *self;
        let named = [
            ("register", register),
            ("rom", rom),
            ("lut", lut),
            ("add", add),
            ("carry", carry),
            ("multiply", multiply),
            ("enable", enable),
            ("rom_to_register", self.rom_to_register.unwrap_or_default()),
            ("multiply_to_register", self.multiply_to_register.unwrap_or_default()),
        ];
        for (name, ns) in named {
            if !(0.0..=1000.0).contains(&ns) {
                return Err(format!("\"{name}\" is a delay in nanoseconds: use 0 to 1000, not {ns}"));
            }
        }
        if register == 0.0 {
            return Err("\"register\" is above 0: no path is shorter than what a register takes".to_owned());
        }
        if !(2..=64).contains(&self.multiplier_bits) {
            let bits = self.multiplier_bits;
            return Err(format!("\"multiplier_bits\" are those of an operand: use 2 to 64, not {bits}"));
        }
        Ok(())
    }

    /// An adder, a subtraction or a comparison of this many bits.
    #[must_use]
    pub fn adder(&self, bits: u32) -> f64 {
        self.add + f64::from(bits) * self.carry
    }

    /// The number of multipliers that a product of such operands takes.
    #[must_use]
    pub fn pieces(&self, multiplicand: u32, variable: u32) -> u32 {
        multiplicand.div_ceil(self.multiplier_bits) * variable.div_ceil(self.multiplier_bits)
    }

    /// The products of the pieces of two operands.
    ///
    /// `registered` where a rank follows them, before any sum.
    #[must_use]
    pub fn partial_products(&self, multiplicand: u32, registered: bool) -> f64 {
        match (multiplicand, registered) {
            // A multiplicand of one bit lets the variable through or not.
            (1, _) => self.lut,
            (_, true) => self.multiply_to_register.unwrap_or(self.multiply),
            (_, false) => self.multiply,
        }
    }

    /// The ROM's memory; `registered` where a rank follows it.
    #[must_use]
    pub fn memory(&self, registered: bool) -> f64 {
        if registered { self.rom_to_register.unwrap_or(self.rom) } else { self.rom }
    }

    /// The sum of the products of pieces: two at a time.
    #[must_use]
    pub fn sum_of_pieces(&self, multiplicand: u32, variable: u32) -> f64 {
        let levels = self.pieces(multiplicand, variable).next_power_of_two().trailing_zeros();
        f64::from(levels) * self.adder(multiplicand + variable)
    }
}
