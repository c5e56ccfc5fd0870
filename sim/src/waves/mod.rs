//! Waves, with the names of traces and of the RTL (`hierarchy.rs`).
//!
//! The clock has a period of 10 ns and rises at 5, 15, 25, … ns. Registers and inputs change with the
//! rising edge, so what cycle k shows stands from 10·k − 5 to 10·k + 5 ns, its last instant being the edge at
//! which [`Cycle`] is taken. A register that was never loaded is `x`. The last edge has its effect too: half a cycle
//! follows it, in which nothing is presented ([`crate::run::settle`]).
//!
//! Here is what the waves show; how a file says it is the business of one `Sink` for each format.

mod fst;
mod hierarchy;
mod sink;
mod vcd;

use std::io::{self, Seek, Write};
use std::path::Path;

use hw_model::datapath::{Datapath, RankRegister};
use hw_model::format::QFormat;
use vectors::rtl::probes::{ports, probes};
use vectors::rtl::{self, Names};

use crate::run::Cycle;
use hierarchy::Hierarchy;
use sink::Sink;

const HALF_PERIOD: u64 = 5;

/// A file format of waves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WaveFormat {
    /// Value change dump: text, which every viewer reads.
    Vcd,
    /// The binary format of GTKWave: a small part of the size.
    Fst,
}

impl WaveFormat {
    /// Every format, in the order above.
    pub const ALL: [Self; 2] = [Self::Vcd, Self::Fst];

    /// What the names of its files end in, without the dot.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Vcd => "vcd",
            Self::Fst => "fst",
        }
    }
}

/// What GTKWave shows of the waves in the file `dump`: ports and ranks in groups,
/// registers as the numbers they are.
#[must_use]
pub fn save_file(name: &str, datapath: &Datapath, dump: &Path) -> String {
    let dump = dump.file_name().and_then(|name| name.to_str());
    rtl::save_file(datapath, Names::Ranks, &hierarchy::top(name), dump)
}

/// The bits of a signal; `None` is unknown.
type Word = Option<u128>;

/// The number of the clock, and of the signal after it.
const CLOCK: usize = 0;
const FIRST: usize = CLOCK + 1;

/// A signal as it stands.
struct Wire {
    width: u32,
    /// `None` before its first value.
    last: Option<Word>,
}

/// Writes waves cycle by cycle.
pub struct WaveWriter<'a> {
    sink: Box<dyn Sink + 'a>,
    /// Every signal but the clock.
    wires: Vec<Wire>,
    registers: Vec<Vec<RankRegister>>,
    input: QFormat,
    output: QFormat,
    /// Whether the reset is active low.
    reset_low: bool,
    /// Room for the bits of one signal.
    bits: Vec<u8>,
}

impl<'a> WaveWriter<'a> {
    /// Writes the header: one module named after the configuration, with scopes inside.
    ///
    /// # Errors
    /// When `output` cannot be written.
    pub fn new<W: Write + Seek + 'a>(
        format: WaveFormat,
        output: W,
        name: &str,
        datapath: &Datapath,
    ) -> io::Result<Self> {
        let probes = probes(datapath);
        let hierarchy = Hierarchy::new(name, datapath, &ports(datapath), &probes);
        let of_rank = |rank| probes.iter().filter(move |probe| probe.rank == rank);
        let registers =
            (0..datapath.rank_count()).map(|rank| of_rank(rank).map(|probe| probe.register).collect()).collect();
        let wire = |&width| Wire { width, last: None };
        let wires = hierarchy.widths.iter().skip(FIRST).map(wire).collect();
        let sink: Box<dyn Sink + 'a> = match format {
            WaveFormat::Vcd => Box::new(vcd::VcdSink::new(output, &hierarchy)?),
            WaveFormat::Fst => Box::new(fst::FstSink::new(output, &hierarchy)?),
        };
        let formats = datapath.formats();
        let (input, output) = (formats.input, formats.output);
        let reset_low = datapath.control().reset.is_active_low();
        Ok(Self { sink, wires, registers, input, output, reset_low, bits: Vec::new() })
    }

    /// Writes one cycle: the rising edge that began it with all that changed there, and the falling
    /// edge in its middle.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn cycle(&mut self, cycle: &Cycle<'_>) -> io::Result<()> {
        let middle = 2 * HALF_PERIOD * cycle.index;
        if cycle.index > 0 {
            self.sink.time(middle - HALF_PERIOD)?;
            self.sink.change(CLOCK, b"1")?;
            self.changes(cycle)?;
            self.sink.time(middle)?;
            self.sink.change(CLOCK, b"0")
        } else {
            self.sink.time(0)?;
            self.sink.change(CLOCK, b"0")?;
            self.changes(cycle)
        }
    }

    fn changes(&mut self, cycle: &Cycle<'_>) -> io::Result<()> {
        let words = self.words(cycle);
        for ((signal, wire), word) in (FIRST..).zip(&mut self.wires).zip(words) {
            if wire.last == Some(word) {
                continue;
            }
            wire.last = Some(word);
            let bit = |place: u32| match word {
                None => b'x',
                Some(word) if word >> place & 1 == 1 => b'1',
                Some(_) => b'0',
            };
            self.bits.clear();
            self.bits.extend((0..wire.width).rev().map(bit));
            self.sink.change(signal, &self.bits)?;
        }
        Ok(())
    }

    /// The word of every signal but the clock, in their order.
    fn words(&self, cycle: &Cycle<'_>) -> Vec<Word> {
        let (inputs, outputs) = (cycle.inputs, cycle.outputs);
        let shown = cycle.ranks.result_loaded();
        let flag = |flag: bool| Some(u128::from(flag));
        let mut words = vec![
            // The level of the port.
            flag(inputs.reset != self.reset_low),
            flag(inputs.in_valid),
            flag(outputs.in_ready),
            Some(inputs.address.into()),
            Some(self.input.to_word(inputs.x).into()),
            flag(outputs.out_valid),
            flag(inputs.out_ready),
            shown.then(|| self.output.to_word(outputs.intensity).into()),
            shown.then_some(outputs.status.bits().into()),
        ];
        for (rank, registers) in cycle.ranks.iter().zip(&self.registers) {
            words.push(flag(rank.valid));
            words.extend(registers.iter().map(|register| {
                let word = || register.format.to_word(register.bits(&rank.signals)).into();
                rank.loaded.then(word)
            }));
        }
        words.push(Some(cycle.ranks.valid()));
        words
    }

    /// Writes what the last edge brought, up to the falling edge behind it, and flushes.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn finish(mut self, settled: &Cycle<'_>) -> io::Result<()> {
        self.cycle(settled)?;
        self.sink.finish()
    }
}
