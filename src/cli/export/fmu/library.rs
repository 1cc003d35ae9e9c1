//! The prebuilt libraries of the engine (`crates/fmi`), and for which system each is.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::exit::{BadInput, Failure};

/// The library that was built into this command.
#[cfg(has_fmu_library)]
const BUILT_IN: Option<&[u8]> = Some(include_bytes!(env!("LINKDYN_FMU_LIBRARY")));
#[cfg(not(has_fmu_library))]
const BUILT_IN: Option<&[u8]> = None;

/// A library.
pub struct Library {
    /// Where it runs.
    pub system: System,
    /// The file.
    pub bytes: Vec<u8>,
}

/// Processor and operating system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct System {
    processor: Processor,
    kind: OperatingSystem,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Processor {
    X86,
    Arm,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum OperatingSystem {
    Linux,
    Windows,
    Darwin,
}

impl System {
    /// That which a library is for, by its first bytes: ELF, PE or Mach-O, of 64 bits.
    fn of(bytes: &[u8]) -> Option<Self> {
        let short = |at: usize| Some(u16::from_le_bytes(*bytes.get(at..)?.first_chunk()?));
        let long = |at: usize| Some(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?));
        let (kind, machine) = match bytes.first_chunk()? {
            b"\x7fELF" => (OperatingSystem::Linux, u32::from(short(18)?)),
            [b'M', b'Z', ..] => (
                OperatingSystem::Windows,
                u32::from(short(long(0x3c)? as usize + 4)?),
            ),
            [0xcf, 0xfa, 0xed, 0xfe] => (OperatingSystem::Darwin, long(4)?),
            _ => return None,
        };
        let processor = match (kind, machine) {
            (OperatingSystem::Linux, 62)
            | (OperatingSystem::Windows, 0x8664)
            | (OperatingSystem::Darwin, 0x0100_0007) => Processor::X86,
            (OperatingSystem::Linux, 183)
            | (OperatingSystem::Windows, 0xaa64)
            | (OperatingSystem::Darwin, 0x0100_000c) => Processor::Arm,
            _ => return None,
        };
        Some(System { processor, kind })
    }

    /// The path of the library in a unit. FMI 2.0 has no folders for ARM: those of FMI 3.0 are used.
    pub fn path(self, version: u8, identifier: &str) -> String {
        let (system, ending, old) = match self.kind {
            OperatingSystem::Linux => ("linux", "so", "linux64"),
            OperatingSystem::Windows => ("windows", "dll", "win64"),
            OperatingSystem::Darwin => ("darwin", "dylib", "darwin64"),
        };
        let processor = match self.processor {
            Processor::X86 => "x86_64",
            Processor::Arm => "aarch64",
        };
        // On a Mac there is one folder for both.
        let is_old = version == 2
            && (self.processor == Processor::X86 || self.kind == OperatingSystem::Darwin);
        let folder = if is_old {
            old.to_owned()
        } else {
            format!("{processor}-{system}")
        };
        format!("binaries/{folder}/{identifier}.{ending}")
    }
}

/// The libraries of a unit: those that are given, and for this system, if none of them is, that of this command.
///
/// # Errors
/// Where there is none, or a file is no library.
pub fn all(given: &[PathBuf]) -> Result<Vec<Library>, Failure> {
    let mut all: Vec<Library> = Vec::new();
    for path in given {
        let library = read(path)?;
        if all.iter().any(|other| other.system == library.system) {
            return Err(BadInput(vec![format!(
                "--library {}: there is a library for its system already",
                path.display()
            )]));
        }
        all.push(library);
    }
    let own = match BUILT_IN {
        Some(bytes) => Some(bytes.to_vec()),
        None => beside().and_then(|path| fs::read(path).ok()),
    };
    let own = own.and_then(|bytes| {
        Some(Library {
            system: System::of(&bytes)?,
            bytes,
        })
    });
    all.extend(own.filter(|own| all.iter().all(|other| other.system != own.system)));
    if all.is_empty() {
        return Err(BadInput(vec![format!(
            "this command was built without the library that a functional mock-up unit needs (`cargo build --release -p linkdyn-fmi` \
             makes it; then give --library {name}, or put it next to the command)",
            name = file_name()
        )]));
    }
    Ok(all)
}

/// A library next to this command.
fn beside() -> Option<PathBuf> {
    let own = env::current_exe().ok()?;
    Some(own.parent()?.join(file_name()))
}

fn file_name() -> String {
    format!(
        "{}linkdyn_fmi{}",
        env::consts::DLL_PREFIX,
        env::consts::DLL_SUFFIX
    )
}

fn read(path: &Path) -> Result<Library, Failure> {
    let name = path.display();
    let refuse = |why: &str| BadInput(vec![format!("--library {name}: {why}")]);
    let bytes = fs::read(path).map_err(|why| refuse(&format!("can't be read: {why}")))?;
    let system = System::of(&bytes).ok_or_else(|| {
        refuse("no library for Linux, Windows or macOS on x86-64 or ARM (`cargo build --release -p linkdyn-fmi` makes one)")
    })?;
    let entry = b"fmi3InstantiateCoSimulation";
    if !bytes.windows(entry.len()).any(|part| part == entry) {
        return Err(refuse(
            "a library, but not that of linkdyn (`cargo build --release -p linkdyn-fmi` makes it)",
        ));
    }
    Ok(Library { system, bytes })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn systems_are_known_by_the_first_bytes() {
        let elf = [b"\x7fELF".to_vec(), vec![0; 14], vec![62, 0]].concat();
        let mut pe = vec![0; 0x90];
        pe[..2].copy_from_slice(b"MZ");
        pe[0x3c] = 0x80;
        pe[0x84..0x86].copy_from_slice(&[0x64, 0xaa]);
        let mach = [0xcf, 0xfa, 0xed, 0xfe, 0x0c, 0, 0, 1];
        let path = |bytes: &[u8], version| {
            System::of(bytes).map(|system| system.path(version, "four_bar"))
        };
        assert_eq!(
            path(&elf, 3).as_deref(),
            Some("binaries/x86_64-linux/four_bar.so")
        );
        assert_eq!(
            path(&elf, 2).as_deref(),
            Some("binaries/linux64/four_bar.so")
        );
        assert_eq!(
            path(&pe, 3).as_deref(),
            Some("binaries/aarch64-windows/four_bar.dll")
        );
        assert_eq!(
            path(&mach, 2).as_deref(),
            Some("binaries/darwin64/four_bar.dylib")
        );
        assert_eq!(path(b"#!/bin/sh", 3), None);
        assert_eq!(path(&elf[..19], 3), None);
    }
}
