//! DXF in ASCII as of R2000, millimetres.
//!
//! Source: Autodesk, DXF Reference (2000): tables, blocks and objects that a reader expects stand in every file.

use std::collections::HashSet;
use std::fmt::Display;
use std::fmt::Write as _;

use super::outline::{Layer, Sheet};
use crate::form::Form;

/// Colours of layers, by the numbers of DXF: black or white, blue, red, green, magenta, orange, cyan.
const COLOURS: [u8; 7] = [7, 5, 1, 3, 6, 30, 4];

/// Handles of what other entries name.
const MODEL: u32 = 0x20;
const PAPER: u32 = 0x21;
const ROOT: u32 = 0x22;
const GROUPS: u32 = 0x23;

/// The file of a drawing.
pub fn dxf(sheet: &Sheet) -> String {
    let mut file = File {
        text: String::new(),
        handle: 0x30,
    };
    let names = names(&sheet.layers);
    // Handles that are given later begin there: far beyond those of the file.
    file.put(0, "SECTION").put(2, "HEADER");
    file.put(9, "$ACADVER").put(1, "AC1015");
    file.put(9, "$DWGCODEPAGE").put(3, "ANSI_1252");
    file.put(9, "$INSUNITS").put(70, 4);
    file.put(9, "$MEASUREMENT").put(70, 1);
    file.put(9, "$HANDSEED").put(5, "FFFFFFF");
    file.put(0, "ENDSEC");
    file.tables(&names);
    file.blocks();
    file.put(0, "SECTION").put(2, "ENTITIES");
    let mm = sheet.millimetres();
    for (layer, name) in sheet.layers.iter().zip(&names) {
        for form in &layer.forms {
            file.form(form, name, &mm);
        }
    }
    file.put(0, "ENDSEC");
    file.objects();
    file.put(0, "EOF");
    file.text
}

/// Names of layers without the signs that they may not have, each once in any case.
fn names(layers: &[Layer]) -> Vec<String> {
    let mut taken = HashSet::from(["0".to_owned()]);
    let legal = |letter: char| match letter {
        '<' | '>' | '/' | '\\' | '"' | ':' | ';' | '?' | '*' | '|' | '=' | ',' | '`' => '_',
        other if other.is_control() => '_',
        other => other,
    };
    let named = |layer: &Layer| {
        let stem: String = layer.name.chars().map(legal).take(200).collect();
        let more = (2..).map(|k: usize| format!("{stem}_{k}"));
        let mut names = std::iter::once(stem.clone()).chain(more);
        let free = names.find(|name| taken.insert(name.to_lowercase()));
        free.unwrap_or_default()
    };
    layers.iter().map(named).collect()
}

struct File {
    text: String,
    /// The last handle that was given.
    handle: u32,
}

impl File {
    fn put(&mut self, code: i32, value: impl Display) -> &mut Self {
        // Writing to a text does not fail.
        let _ = writeln!(self.text, "{code}\n{value}");
        self
    }

    /// A text in ASCII.
    fn words(&mut self, code: i32, text: &str) -> &mut Self {
        let mut ascii = String::new();
        for letter in text.chars() {
            match letter {
                ' '..='~' => ascii.push(letter),
                other if other.is_control() => ascii.push(' '),
                other => {
                    let mut units = [0; 2];
                    for unit in other.encode_utf16(&mut units) {
                        let _ = write!(ascii, "\\U+{unit:04X}");
                    }
                }
            }
        }
        self.put(code, ascii)
    }

    fn new_handle(&mut self) -> String {
        self.handle += 1;
        format!("{:X}", self.handle)
    }

    fn place(&mut self, code: i32, [x, y]: [f64; 2], mm: &impl Fn(f64) -> f64) -> &mut Self {
        self.put(code, mm(x))
            .put(code + 10, mm(y))
            .put(code + 20, 0)
    }

    /// The head of a table with so many entries; returns its handle.
    fn table(&mut self, name: &str, count: usize) -> String {
        let handle = self.new_handle();
        self.put(0, "TABLE")
            .put(2, name)
            .put(5, &handle)
            .put(330, 0);
        self.put(100, "AcDbSymbolTable").put(70, count);
        if name == "DIMSTYLE" {
            self.put(100, "AcDbDimStyleTable");
        }
        handle
    }

    /// The head of an entry of a table.
    fn entry(&mut self, table: &str, kind: &str, class: &str, name: &str) -> &mut Self {
        let handle = self.new_handle();
        // Styles of dimensions have their handle elsewhere.
        let code = if kind == "DIMSTYLE" { 105 } else { 5 };
        self.put(0, kind).put(code, handle).put(330, table);
        self.put(100, "AcDbSymbolTableRecord").put(100, class);
        self.words(2, name)
    }

    fn tables(&mut self, names: &[String]) {
        self.put(0, "SECTION").put(2, "TABLES");
        for empty in ["VIEW", "UCS"] {
            self.table(empty, 0);
            self.put(0, "ENDTAB");
        }
        let table = self.table("VPORT", 1);
        self.entry(&table, "VPORT", "AcDbViewportTableRecord", "*Active")
            .put(70, 0);
        self.put(0, "ENDTAB");
        let table = self.table("LTYPE", 3);
        for name in ["ByBlock", "ByLayer", "Continuous"] {
            self.entry(&table, "LTYPE", "AcDbLinetypeTableRecord", name)
                .put(70, 0)
                .put(3, "")
                .put(72, 65)
                .put(73, 0)
                .put(40, 0);
        }
        self.put(0, "ENDTAB");
        let table = self.table("LAYER", names.len() + 1);
        let own = names
            .iter()
            .map(String::as_str)
            .zip(COLOURS.into_iter().cycle());
        for (name, colour) in std::iter::once(("0", 7)).chain(own) {
            self.entry(&table, "LAYER", "AcDbLayerTableRecord", name)
                .put(70, 0)
                .put(62, colour)
                .put(6, "Continuous");
        }
        self.put(0, "ENDTAB");
        let table = self.table("STYLE", 1);
        self.entry(&table, "STYLE", "AcDbTextStyleTableRecord", "Standard")
            .put(70, 0)
            .put(40, 0)
            .put(41, 1)
            .put(50, 0)
            .put(71, 0)
            .put(42, 2.5)
            .put(3, "txt")
            .put(4, "");
        self.put(0, "ENDTAB");
        let table = self.table("APPID", 1);
        self.entry(&table, "APPID", "AcDbRegAppTableRecord", "ACAD")
            .put(70, 0);
        self.put(0, "ENDTAB");
        let table = self.table("DIMSTYLE", 1);
        self.entry(&table, "DIMSTYLE", "AcDbDimStyleTableRecord", "Standard")
            .put(70, 0);
        self.put(0, "ENDTAB");
        let table = self.table("BLOCK_RECORD", 2);
        for (handle, name) in [(MODEL, "*Model_Space"), (PAPER, "*Paper_Space")] {
            self.put(0, "BLOCK_RECORD").put(5, format!("{handle:X}"));
            self.put(330, &table).put(100, "AcDbSymbolTableRecord");
            self.put(100, "AcDbBlockTableRecord").put(2, name);
        }
        self.put(0, "ENDTAB").put(0, "ENDSEC");
    }

    fn blocks(&mut self) {
        self.put(0, "SECTION").put(2, "BLOCKS");
        for (owner, name) in [(MODEL, "*Model_Space"), (PAPER, "*Paper_Space")] {
            for (kind, class) in [("BLOCK", "AcDbBlockBegin"), ("ENDBLK", "AcDbBlockEnd")] {
                let handle = self.new_handle();
                self.put(0, kind)
                    .put(5, handle)
                    .put(330, format!("{owner:X}"));
                self.put(100, "AcDbEntity").put(8, 0).put(100, class);
                if kind == "BLOCK" {
                    self.put(2, name).put(70, 0);
                    self.put(10, 0).put(20, 0).put(30, 0);
                    self.put(3, name).put(1, "");
                }
            }
        }
        self.put(0, "ENDSEC");
    }

    fn objects(&mut self) {
        self.put(0, "SECTION").put(2, "OBJECTS");
        self.put(0, "DICTIONARY")
            .put(5, format!("{ROOT:X}"))
            .put(330, 0);
        self.put(100, "AcDbDictionary").put(281, 1);
        self.put(3, "ACAD_GROUP").put(350, format!("{GROUPS:X}"));
        self.put(0, "DICTIONARY").put(5, format!("{GROUPS:X}"));
        self.put(330, format!("{ROOT:X}"));
        self.put(100, "AcDbDictionary").put(281, 1);
        self.put(0, "ENDSEC");
    }

    fn form(&mut self, form: &Form, layer: &str, mm: &impl Fn(f64) -> f64) {
        let (kind, class) = match form {
            Form::Line { .. } => ("LWPOLYLINE", "AcDbPolyline"),
            Form::Circle { .. } => ("CIRCLE", "AcDbCircle"),
            Form::Point(_) => ("POINT", "AcDbPoint"),
            Form::Text { .. } => ("TEXT", "AcDbText"),
        };
        let handle = self.new_handle();
        self.put(0, kind)
            .put(5, handle)
            .put(330, format!("{MODEL:X}"));
        self.put(100, "AcDbEntity").words(8, layer).put(100, class);
        match form {
            Form::Line { corners, closed } => {
                self.put(90, corners.len()).put(70, u8::from(*closed));
                for corner in corners {
                    let [x, y] = corner.place.map(mm);
                    self.put(10, x).put(20, y);
                    if corner.bulge != 0.0 {
                        self.put(42, corner.bulge);
                    }
                }
            }
            Form::Circle { centre, radius } => {
                self.place(10, *centre, mm).put(40, mm(*radius));
            }
            Form::Point(at) => {
                self.place(10, *at, mm);
            }
            Form::Text { at, height, text } => {
                self.place(10, *at, mm).put(40, mm(*height));
                self.words(1, text).put(100, "AcDbText");
            }
        }
    }
}
