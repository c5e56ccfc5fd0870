//! Save files of GTKWave: which signals of a dump are shown, in which groups, as which numbers.
//!
//! A line is a signal by its full name, with `[high:0]` where it has several bits. Before it stand its flags
//! (`@` and a number in hex), and for a fixed-point number how many of its bits are fraction.

use std::fmt::Write;
use std::path::Path;

use hw_model::datapath::Datapath;
use hw_model::format::QFormat;
use hw_model::registers::Register;

use super::dut_ports::signal;
use super::probes::{VALID_FLAGS, ports, probes, valid_wave};

/// Flags of GTKWave (its `analyzer.h`): how a value is shown, and what begins and ends a group.
const DECIMAL: u32 = 1 << 2;
const BINARY: u32 = 1 << 3;
const RIGHT_JUSTIFIED: u32 = 1 << 5;
const BLANK: u32 = 1 << 9;
const SIGNED: u32 = 1 << 10;
const GROUP_BEGIN: u32 = 1 << 23;
const GROUP_END: u32 = 1 << 24;
const FIXED_POINT: u32 = 1 << 30;

/// What the names of save files end in, without the dot.
pub const EXTENSION: &str = "gtkw";

/// Which signals a dump has below the pipeline's scope.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Names {
    /// A scope for each rank, as in the waves of `blysk simulate`.
    Ranks,
    /// Those of the RTL; they are shown under the names of traces.
    Rtl,
    /// The ports alone: the module is the user's own, with registers of other names.
    Ports,
    /// The testbench's signals at the ports, which the user's own module may call otherwise.
    Testbench,
}

impl Names {
    /// Twenty or thirty cycles on the screen: the power of two by which a unit of time is drawn smaller. Our waves
    /// count ns, the testbench's ps.
    const fn zoom(self) -> u32 {
        match self {
            Self::Ranks => 7,
            Self::Rtl | Self::Ports | Self::Testbench => 17,
        }
    }
}

/// The text of a save file for a dump in which the pipeline stands in `scope`. `dump` is the dump's file name, in the
/// directory of the save file.
#[must_use]
pub fn save_file(datapath: &Datapath, names: Names, scope: &str, dump: Option<&str>) -> String {
    let mut file = SaveFile { scope, text: String::new() };
    if let Some(dump) = dump.filter(|name| is_plain(name)) {
        // With its own name in it, the dump is looked for beside it, wherever GTKWave is called.
        let save = Path::new(dump).with_extension(EXTENSION);
        file.line(format_args!("[dumpfile] \"{dump}\"\n[savefile] \"{}\"", save.display()));
    }
    file.line(format_args!("[timestart] 0\n*-{}.000000 -1", names.zoom()));
    file.group("ports", |file| {
        for port in ports(datapath) {
            let name = if names == Names::Testbench { signal(port.name) } else { port.name };
            file.signal(None, name, port.format, port.name == "status_o");
        }
    });
    match names {
        Names::Ranks => file.ranks(datapath, false),
        Names::Rtl => {
            let flags = QFormat::field(datapath.rank_count() as u32);
            file.group("valid flags", |file| file.signal(None, VALID_FLAGS, flags, true));
            file.ranks(datapath, true);
        }
        Names::Ports | Names::Testbench => {}
    }
    file.text
}

/// A name that can stand between quotes.
fn is_plain(name: &str) -> bool {
    !name.contains(|character: char| character == '"' || character.is_control())
}

struct SaveFile<'a> {
    scope: &'a str,
    text: String,
}

impl SaveFile<'_> {
    fn line(&mut self, line: std::fmt::Arguments<'_>) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.text, "{line}");
    }

    /// A group for each rank.
    fn ranks(&mut self, datapath: &Datapath, in_rtl: bool) {
        let probes = probes(datapath);
        for rank in 0..datapath.rank_count() {
            self.group(&format!("rank {rank}, {}", datapath.rank_name(rank)), |file| {
                if !in_rtl {
                    file.signal(None, &valid_wave(datapath, rank), QFormat::field(1), true);
                }
                for probe in probes.iter().filter(|probe| probe.rank == rank) {
                    let path = if in_rtl { &probe.path } else { &probe.wave };
                    let label = in_rtl.then_some(probe.name.as_str());
                    file.signal(label, path, probe.register.format, probe.register.register == Register::Status);
                }
            });
        }
    }

    fn group(&mut self, name: &str, signals: impl FnOnce(&mut Self)) {
        self.line(format_args!("@{:x}\n-{name}", GROUP_BEGIN | BLANK));
        signals(self);
        self.line(format_args!("@{:x}\n-{name}", GROUP_END | BLANK));
    }

    /// A signal, under another name if there is a label.
    fn signal(&mut self, label: Option<&str>, path: &str, format: QFormat, bit_by_bit: bool) {
        let (width, fraction) = (format.width(), format.fraction_bits());
        let mut flags = RIGHT_JUSTIFIED;
        flags |= match () {
            () if width == 1 || bit_by_bit => BINARY,
            () if format.is_signed() => SIGNED,
            () => DECIMAL,
        };
        let fixed_point = flags & BINARY == 0 && fraction > 0;
        if fixed_point {
            flags |= FIXED_POINT;
        }
        self.line(format_args!("@{flags:x}"));
        if fixed_point {
            self.line(format_args!("[fpshift_count] {fraction}"));
        }
        let label = label.map_or_else(String::new, |label| format!("+{{{label}}} "));
        let bits = if width > 1 { format!("[{}:0]", width - 1) } else { String::new() };
        let scope = self.scope;
        self.line(format_args!("{label}{scope}.{path}{bits}"));
    }
}
