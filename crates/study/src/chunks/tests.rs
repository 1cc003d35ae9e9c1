use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use super::*;
use crate::random::{Philox, below, uniform};

/// A directory of a test, removed at its end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let path =
            std::env::temp_dir().join(format!("linkdyn-study-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        Scratch(path)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn identity() -> Identity {
    Identity {
        study: "a1b2".to_string(),
        engine: "linkdyn 0.1.0".to_string(),
        inputs: vec!["parameters.r".to_string()],
        responses: vec!["peak".to_string(), "stroke, mm".to_string()],
    }
}

fn store(directory: &Path, rows: u64, per_chunk: u64) -> Store {
    Store::open(directory, identity(), Plan::new(rows, per_chunk)).expect("a directory")
}

/// Computes a chunk: a pure function of the numbers of its variants.
fn compute(store: &Store, chunk: u64) {
    let mut rows = store.rows(chunk);
    for variant in store.plan().range(chunk) {
        let u = uniform(Philox::new([1, 9]).word(u128::from(variant)));
        match variant % 7 {
            3 => rows.push(Some("does not assemble at \"b\""), &[u], &[]),
            5 => rows.push(Some("dead centre"), &[u], &[-f64::NAN, 2.0 * u]),
            _ => rows.push(None, &[u], &[u * u, 1.0 - u]),
        }
    }
    store.write(chunk, &rows).expect("it is written");
}

fn csv(store: &Store) -> Vec<u8> {
    let mut text = Vec::new();
    store.write_csv(&mut text).expect("complete");
    text
}

fn complaint(store: &Store, chunk: u64) -> String {
    let fault = store.read(chunk).expect_err("a fault").to_string();
    let path = store.path(chunk).display().to_string();
    fault.replace(&path, "FILE")
}

#[test]
fn rows_come_back_as_they_were() {
    let scratch = Scratch::new("back");
    let all = store(&scratch.0, 9, 5);
    (0..2).for_each(|chunk| compute(&all, chunk));
    let rows = all.read(0).expect("whole").expect("there");
    let row = rows.iter().nth(3).expect("a row");
    assert_eq!(
        (row.variant, row.reason),
        (3, Some("does not assemble at \"b\""))
    );
    assert!(row.responses.iter().all(|x| x.is_nan()) && row.inputs[0] < 1.0);
    let text = String::from_utf8(csv(&all)).expect("UTF-8");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 10);
    assert_eq!(lines[0], "variant,status,parameters.r,peak,\"stroke, mm\"");
    // numpy: Generator(Philox(key=[1, 9])).random(6)
    assert_eq!(
        lines[1],
        "0,ok,0.8539364934476397,0.7292075348416508,0.14606350655236033"
    );
    assert_eq!(
        lines[4],
        "3,\"does not assemble at \"\"b\"\"\",0.2959075399388763,,"
    );
    assert_eq!(
        lines[6],
        "5,dead centre,0.5995609798724366,,1.1991219597448732"
    );
}

#[test]
fn the_joined_file_is_the_same_for_any_way_to_it() {
    let [straight, shards] = ["straight", "shards"].map(Scratch::new);
    let all = store(&straight.0, 100, 9);
    (0..12).for_each(|chunk| compute(&all, chunk));
    let other = store(&shards.0, 100, 9);
    for index in [5, 2, 7, 1, 3, 6, 4] {
        let shard = Shard::new(index, 7).expect("a shard");
        let to_do = other.to_do(shard).expect("nothing is wrong");
        assert!((1..=2).contains(&to_do.len()), "{to_do:?}");
        to_do.into_iter().for_each(|chunk| compute(&other, chunk));
    }
    // Computed twice by some.
    compute(&other, 4);
    for chunk in 0..12 {
        let [a, b] =
            [all.path(chunk), other.path(chunk)].map(|path| fs::read(path).expect("there"));
        assert_eq!(a, b, "{chunk}");
    }
    assert_eq!(csv(&all), csv(&other));
    // Chunks of another size make the same joined file.
    let sizes = Scratch::new("sizes");
    let coarse = store(&sizes.0, 100, 64);
    (0..2).for_each(|chunk| compute(&coarse, chunk));
    assert_eq!(csv(&all), csv(&coarse));
}

#[test]
fn missing_ranges_are_named() {
    let scratch = Scratch::new("missing");
    let all = store(&scratch.0, 95, 10);
    [0, 3, 4, 8]
        .into_iter()
        .for_each(|chunk| compute(&all, chunk));
    let mut text = Vec::new();
    let fault = all
        .write_csv(&mut text)
        .expect_err("incomplete")
        .to_string();
    assert_eq!(
        fault,
        "6 of 10 chunks are missing: variants 10 to 29, 50 to 79, 90 to 94 (run the study, or the shards that have them)"
    );
    assert!(text.is_empty());
    assert_eq!(
        all.to_do(Shard::WHOLE).expect("readable"),
        [1, 2, 5, 6, 7, 9]
    );
}

#[test]
fn chunks_of_others_are_refused() {
    let scratch = Scratch::new("others");
    compute(&store(&scratch.0, 20, 10), 0);
    let with = |change: fn(&mut Identity), per_chunk| {
        let mut identity = identity();
        change(&mut identity);
        let other =
            Store::open(&scratch.0, identity, Plan::new(20, per_chunk)).expect("a directory");
        assert!(other.to_do(Shard::WHOLE).is_err());
        complaint(&other, 0)
    };
    assert_eq!(
        with(|identity| identity.study = "ffff".to_string(), 10),
        "FILE: a chunk of another study (a1b2, this one is ffff): choose another directory, or delete it"
    );
    assert_eq!(
        with(|identity| identity.engine = "linkdyn 0.2.0".to_string(), 10),
        "FILE: computed by linkdyn 0.1.0, this is linkdyn 0.2.0: results of two versions are not joined (choose another directory, or delete it)"
    );
    assert_eq!(
        with(|_| (), 5),
        "FILE: variants 0 to 9, where 0 to 4 belong (chunks of another size: choose another directory, or delete it)"
    );
    assert_eq!(
        with(|identity| identity.responses.truncate(1), 10),
        "FILE: columns parameters.r, peak, stroke, mm, where parameters.r, peak belong (choose another directory, or delete it)"
    );
}

#[test]
fn broken_files_are_refused_and_computed_again() {
    let scratch = Scratch::new("broken");
    let all = store(&scratch.0, 4, 4);
    compute(&all, 0);
    let whole = fs::read(all.path(0)).expect("there");
    let put = |bytes: &[u8]| fs::write(all.path(0), bytes).expect("writable");
    for length in 0..whole.len() {
        put(&whole[..length]);
        let found = complaint(&all, 0);
        assert!(
            found.starts_with(&format!("FILE: {length} bytes, where ")),
            "{found}"
        );
        assert_eq!(all.to_do(Shard::WHOLE).expect("not refused"), [0]);
    }
    for place in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[place] ^= 4;
        put(&bytes);
        let found = complaint(&all, 0);
        let known = ["not a chunk", "damaged", "bytes, where"];
        assert!(
            known.iter().any(|part| found.contains(part)),
            "{place}: {found}"
        );
    }
    let last = whole.len() - 40;
    put(&[&whole[..last], &[whole[last] ^ 1], &whole[last + 1..]].concat());
    assert_eq!(
        complaint(&all, 0),
        "FILE: damaged, its checksum does not fit (delete it, so that it is computed again)"
    );
    put(b"variant,status\n");
    assert_eq!(
        complaint(&all, 0),
        "FILE: not a chunk of a study, or one of another format (move it away)"
    );
    put(&whole[..whole.len() - 1]);
    compute(&all, 0);
    assert_eq!(fs::read(all.path(0)).expect("there"), whole);
}

#[test]
fn parts_of_killed_writers_are_ignored_and_removed() {
    let scratch = Scratch::new("parts");
    let all = store(&scratch.0, 8, 4);
    let left = scratch.0.join(".chunk-00000000.0123456789abcdef.part");
    fs::write(&left, b"linkdyn chunk/1\nhalf").expect("writable");
    assert_eq!(all.to_do(Shard::WHOLE).expect("nothing is wrong"), [0, 1]);
    compute(&all, 1);
    assert!(left.exists(), "another chunk's part may be in use");
    compute(&all, 0);
    let names = fs::read_dir(&scratch.0).expect("there").flatten();
    let mut names: Vec<_> = names.map(|entry| entry.file_name()).collect();
    names.sort();
    assert_eq!(names, ["chunk-00000000.bin", "chunk-00000001.bin"]);
}

#[test]
fn rows_of_another_chunk_are_not_written() {
    let scratch = Scratch::new("wrong");
    let all = store(&scratch.0, 8, 4);
    let fault = all.write(1, &all.rows(0)).expect_err("a fault");
    assert!(matches!(fault, ChunkFault::Rows { .. }), "{fault}");
}

/// Where the killed child of the next test works; without it, as a test of its own, it works undisturbed.
const PLACE: &str = "LINKDYN_STUDY_KILLED";

#[test]
fn a_study_is_completed_chunk_by_chunk() {
    let scratch = Scratch::new("child");
    let place = std::env::var_os(PLACE).map_or(scratch.0.clone(), PathBuf::from);
    let all = store(&place, 3000, 50);
    for chunk in all.to_do(Shard::WHOLE).expect("nothing is refused") {
        compute(&all, chunk);
    }
    assert_eq!(all.to_do(Shard::WHOLE).expect("nothing is refused"), [0; 0]);
}

/// Processes killed 20 times, at random moments after each has brought two chunks more, leave whole chunks and parts; the joined file
/// is the one of a quiet run.
#[test]
fn killed_studies_resume() {
    let [quiet, killed] = ["quiet", "killed"].map(Scratch::new);
    let philox = Philox::new([14, 0]);
    let all = store(&killed.0, 3000, 50);
    for number in 0..20 {
        let exe = std::env::current_exe().expect("this test");
        let mut child = Command::new(exe)
            .args([
                "--exact",
                "chunks::tests::a_study_is_completed_chunk_by_chunk",
            ])
            .env(PLACE, &killed.0)
            .stdout(Stdio::null())
            .spawn()
            .expect("a process");
        let target = 2 * (number + 1);
        while !all.path(target - 1).exists() && child.try_wait().is_ok_and(|end| end.is_none()) {
            std::thread::sleep(Duration::from_micros(100));
        }
        let within_a_chunk = below(philox.word(u128::from(number)), 2000);
        std::thread::sleep(Duration::from_micros(within_a_chunk));
        child.kill().expect("it is ours");
        child.wait().expect("it ends");
        let left = all.to_do(Shard::WHOLE).expect("nothing is refused");
        assert!(left.len() as u64 <= 60 - target, "{left:?} after {number}");
    }
    for chunk in all.to_do(Shard::WHOLE).expect("nothing is refused") {
        compute(&all, chunk);
    }
    let straight = store(&quiet.0, 3000, 50);
    (0..60).for_each(|chunk| compute(&straight, chunk));
    assert_eq!(csv(&all), csv(&straight));
}
