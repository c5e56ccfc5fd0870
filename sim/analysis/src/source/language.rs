//! How each language writes what a source needs: numbers, declarations, choices, a table.

/// A language of sources.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// OpenGL's, from 3.30 or ES 3.00 on.
    Glsl,
    /// Direct3D's.
    Hlsl,
    /// C99 and C++.
    C,
    /// Rust.
    Rust,
}

/// What is declared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Real,
    Place,
    /// A place that moves.
    Moving,
}

impl Language {
    /// The name that `--format` takes.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Glsl => "glsl",
            Self::Hlsl => "hlsl",
            Self::C => "c",
            Self::Rust => "rust",
        }
    }

    /// The shortest decimal that is this f32 and no other.
    pub(super) fn number(self, value: f32) -> String {
        format!("{value:?}{}", if self == Self::C { "f" } else { "" })
    }

    /// The name of the table.
    pub(super) const fn table_name(self) -> &'static str {
        if matches!(self, Self::Rust) { "BLYSK_TABLE" } else { "blysk_table" }
    }

    /// The table; `lines` are its rows, with comments between them.
    pub(super) fn table(self, length: usize, lines: &str) -> String {
        let name = self.table_name();
        match self {
            Self::Glsl => format!("const float {name}[{length}] = float[{length}](\n{lines}\n);\n"),
            Self::Hlsl | Self::C => format!("static const float {name}[{length}] = {{\n{lines}\n}};\n"),
            Self::Rust => format!("static {name}: [f32; {length}] = [\n{lines}\n];\n"),
        }
    }

    /// The head of the function, up to its opening brace.
    pub(super) const fn head(self) -> &'static str {
        match self {
            Self::Glsl | Self::Hlsl => "float blysk_highlight(int row, float x)\n{\n",
            Self::C => "static inline float blysk_highlight(int row, float x)\n{\n",
            Self::Rust => "pub fn blysk_highlight(row: usize, x: f32) -> f32 {\n",
        }
    }

    /// x brought into [0, 1].
    pub(super) fn clamped_x(self) -> String {
        match self {
            Self::Rust => "let x = x.clamp(0.0, 1.0);".to_owned(),
            _ => format!("x = {};", self.clamped("x")),
        }
    }

    /// A value brought into [0, 1]; in C it is named twice, so it should be a name.
    pub(super) fn clamped(self, value: &str) -> String {
        match self {
            Self::Glsl | Self::Hlsl => format!("clamp({value}, 0.0, 1.0)"),
            Self::C => self.choice(&format!("{value} < 0.0f"), "0.0f", &format!("({value} > 1.0f ? 1.0f : {value})")),
            Self::Rust => format!("{value}.clamp(0.0, 1.0)"),
        }
    }

    pub(super) fn declared(self, kind: Kind, name: &str, value: &str) -> String {
        let keyword = match (self, kind) {
            (Self::Rust, Kind::Moving) => "let mut",
            (Self::Rust, _) => "let",
            (_, Kind::Real) => "float",
            (_, Kind::Place | Kind::Moving) => "int",
        };
        format!("{keyword} {name} = {value};")
    }

    /// One of two values.
    pub(super) fn choice(self, condition: &str, yes: &str, no: &str) -> String {
        match self {
            Self::Rust => format!("if {condition} {{ {yes} }} else {{ {no} }}"),
            _ => format!("{condition} ? {yes} : {no}"),
        }
    }

    /// Lines that are a block under a condition.
    pub(super) fn block(self, condition: &str, lines: &[String]) -> String {
        let condition = if self == Self::Rust { condition.to_owned() } else { format!("({condition})") };
        format!("if {condition} {{\n        {}\n    }}", lines.join("\n        "))
    }

    /// The end of the function, with its value.
    pub(super) fn last(self, value: &str) -> String {
        if self == Self::Rust { value.to_owned() } else { self.returned(value) }
    }

    /// An end of the function before its last line.
    pub(super) fn returned(self, value: &str) -> String {
        format!("return {value};")
    }

    /// One statement under a condition.
    pub(super) fn when(self, condition: &str, action: &str) -> String {
        self.block(condition, &[action.to_owned()])
    }
}
