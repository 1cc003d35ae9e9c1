//! Figures: numbers can be read back from them, names can't break them, files are what they say.

mod cut;
mod events;
mod images;
mod layout;
mod names;
mod pages;
mod poses;
mod reading;
mod refused;

use roxmltree::{Document, Node};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// An empty directory of its own, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("figures-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a scratch directory");
        Scratch(path)
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.0.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, text).expect("written");
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).expect("UTF-8")
    }

    fn linkdyn(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
        command
            .args(arguments)
            .current_dir(&self.0)
            .stdin(Stdio::null())
            .output()
            .expect("the binary runs")
    }

    /// Runs, asserts exit status 0 and silence on standard error.
    #[track_caller]
    fn done(&self, arguments: &[&str]) -> String {
        let output = self.linkdyn(arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(
            (output.status.code(), said.as_ref()),
            (Some(0), ""),
            "{arguments:?}"
        );
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    /// Runs, asserts exit status 2 and a text on standard error.
    #[track_caller]
    fn refused(&self, arguments: &[&str], said: &str) {
        let output = self.linkdyn(arguments);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
        assert!(
            stderr.contains(said),
            "{arguments:?}: {said:?} is not in {stderr:?}"
        );
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Elements of a class, in order.
fn of_class<'a, 'input>(document: &'a Document<'input>, class: &str) -> Vec<Node<'a, 'input>> {
    document
        .descendants()
        .filter(|node| node.attribute("class") == Some(class))
        .collect()
}

fn points(node: Node) -> Vec<[f64; 2]> {
    let text = node.attribute("points").expect("points");
    let pair = |pair: &str| {
        let (x, y) = pair.split_once(',').expect("a pair");
        [x.parse().expect("a number"), y.parse().expect("a number")]
    };
    text.split(' ').map(pair).collect()
}

/// The text of a label.
fn label(node: Node) -> String {
    node.descendants()
        .filter_map(|node| if node.is_text() { node.text() } else { None })
        .collect()
}

/// Value by place, from the outermost two printed numbers and their tick marks: slope and value at place 0.
fn axis(document: &Document, axis: usize) -> [f64; 2] {
    let [ticks, numbers] = [["x-tick", "x-number"], ["y-tick", "y-number"]][axis];
    let places: Vec<f64> = of_class(document, ticks)
        .into_iter()
        .map(|tick| points(tick)[0][axis])
        .collect();
    let numbers: Vec<f64> = of_class(document, numbers)
        .into_iter()
        .map(|number| {
            label(number)
                .replace('−', "-")
                .parse()
                .expect("a printed number")
        })
        .collect();
    assert_eq!(places.len(), numbers.len());
    let last = places.len() - 1;
    let slope = (numbers[last] - numbers[0]) / (places[last] - places[0]);
    [slope, numbers[0] - slope * places[0]]
}

/// Values of all curves as they can be read off the printed axes.
fn read_off(svg: &str) -> Vec<Vec<[f64; 2]>> {
    let document = Document::parse(svg).expect("XML");
    let axes = [axis(&document, 0), axis(&document, 1)];
    let value = |place: [f64; 2]| -> [f64; 2] {
        std::array::from_fn(|i| axes[i][1] + axes[i][0] * place[i])
    };
    of_class(&document, "curve")
        .into_iter()
        .map(|curve| points(curve).into_iter().map(value).collect())
        .collect()
}

fn cells(csv: &str, columns: [usize; 2]) -> Vec<[f64; 2]> {
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        columns.map(|column| cells[column].parse().unwrap_or(f64::NAN))
    };
    csv.lines().skip(1).map(row).collect()
}

/// Width, height and pixels per metre of a PNG.
fn png_facts(bytes: &[u8]) -> [u32; 3] {
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().expect("4 bytes"));
    let density = bytes
        .windows(4)
        .position(|word| word == b"pHYs")
        .expect("a resolution");
    assert_eq!(number(density + 4), number(density + 8));
    [number(16), number(20), number(density + 4)]
}

/// Width, height, and delay of each frame [1/100 s] of a GIF, by its blocks.
fn gif_facts(bytes: &[u8]) -> ([u16; 2], Vec<u16>) {
    assert_eq!(&bytes[..6], b"GIF89a");
    let number = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    let table = |flags: u8| {
        if flags & 0x80 == 0 {
            0
        } else {
            3 << ((flags & 7) + 1)
        }
    };
    let mut at = 13 + table(bytes[10]);
    let mut delays = Vec::new();
    let skip = |mut at: usize| {
        while bytes[at] != 0 {
            at += 1 + usize::from(bytes[at]);
        }
        at + 1
    };
    while bytes[at] != 0x3b {
        match [bytes[at], bytes[at + 1]] {
            [0x21, 0xf9] => {
                delays.push(number(at + 4));
                at = skip(at + 2);
            }
            [0x21, _] => at = skip(at + 2),
            [0x2c, _] => at = skip(at + 10 + table(bytes[at + 9]) + 1),
            other => panic!("no block of a GIF: {other:?}"),
        }
    }
    assert_eq!(at + 1, bytes.len());
    ([number(6), number(8)], delays)
}
