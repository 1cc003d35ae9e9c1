//! `linkdyn import`: mechanisms in the files of other programs.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

const FILES: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/crates/exchange/tests/linkages"
);

/// Exit status, standard output and standard error.
fn import(arguments: &[&str], input: Option<&str>) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    command.arg("import").args(arguments);
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().expect("it runs");
    let mut stdin = child.stdin.take().expect("a pipe");
    // A command that does not read closes the pipe.
    let _ = stdin.write_all(input.unwrap_or_default().as_bytes());
    drop(stdin);
    let Output {
        status,
        stdout,
        stderr,
    } = child.wait_with_output().expect("it ends");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    (status.code(), text(stdout), text(stderr))
}

fn link(name: &str) -> String {
    let links = fs::read_to_string(format!("{FILES}/pmks-links.txt")).expect("links");
    let found = links
        .lines()
        .find_map(|line| line.strip_prefix(name)?.strip_prefix('\t'));
    format!("https://app.pmksplus.com/?{}", found.expect("a link"))
}

/// A folder of its own.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join(format!("import-{}-{name}", std::process::id()));
    fs::create_dir_all(&path).expect("made");
    path
}

const PAGE: &str = "left out: page: colours, grid, labels, scale and what is selected\n";

#[test]
fn a_link_is_printed_written_and_read_from_a_pipe_alike() {
    let link = link("four-bar");
    let (status, printed, said) = import(&[&link], None);
    assert_eq!((status, said.as_str()), (Some(0), PAGE));
    assert!(
        printed.starts_with(
            "{\n  \"format\": \"linkdyn/1\",\n  \"name\": \"Mechanism from PMKS+\",\n"
        ),
        "{printed}"
    );
    let (status, piped, said) = import(&["-"], Some(&link));
    assert_eq!((status, &piped, said.as_str()), (Some(0), &printed, PAGE));
    let content = link.split_once('?').expect("content").1;
    let (status, content, _) = import(&["-", "--from", "pmks"], Some(content));
    assert_eq!((status, &content), (Some(0), &printed));

    let folder = folder("link");
    let path = folder.join("mine.json");
    let file = path.to_str().expect("UTF-8");
    let (status, told, said) = import(&[&link, "-o", file], None);
    assert_eq!(
        (status, told, said.as_str()),
        (
            Some(0),
            format!(
                "{file}: 3 moving bodies, 4 joints. Next:\n  linkdyn check {file}\n  linkdyn edit {file}\n"
            ),
            PAGE
        )
    );
    assert_eq!(fs::read_to_string(&path).expect("written"), printed);
    // It is not overwritten without a word.
    fs::write(&path, "mine").expect("written");
    let (status, told, said) = import(&[&link, "-o", file], None);
    assert_eq!((status, told.as_str()), (Some(2), ""));
    assert!(
        said.contains("mine.json") && said.contains("--force"),
        "{said}"
    );
    assert_eq!(fs::read_to_string(&path).expect("there"), "mine");
    let (status, ..) = import(&[&link, "-o", file, "--force"], None);
    assert_eq!(
        (status, fs::read_to_string(&path).expect("written")),
        (Some(0), printed)
    );
    fs::remove_dir_all(folder).expect("removed");
}

#[test]
fn a_file_is_known_by_its_content_or_by_its_ending() {
    let plate = format!("{FILES}/mechanism-plate.json");
    let (status, printed, said) = import(&[&plate, "--length", "mm"], None);
    assert_eq!((status, said.as_str()), (Some(0), ""));
    assert!(
        printed.contains("\"units\": { \"length\": \"mm\" }"),
        "{printed}"
    );
    let (status, _, said) = import(&[&plate], None);
    assert_eq!(status, Some(0));
    assert_eq!(
        said,
        "left out: file: a unit of length: m is taken; --length mm says another\n"
    );
    let folder = folder("file");
    let table = folder.join("arm.csv");
    fs::write(
        &table,
        "joint,x [mm],y [mm],bodies\nA,0,0,ground arm\nB,30,40,arm\n",
    )
    .expect("written");
    let (status, printed, said) = import(&[table.to_str().expect("UTF-8")], None);
    assert_eq!((status, said.as_str()), (Some(0), ""));
    assert!(printed.contains("\"name\": \"arm\""), "{printed}");
    fs::remove_dir_all(folder).expect("removed");
}

#[test]
fn what_can_not_be_read_is_told_with_exit_status_2() {
    let link = link("four-bar");
    let damaged = &link[..link.len() - 9];
    let shown: String = link.chars().take(60).collect();
    let told = [
        (
            vec![damaged],
            None,
            format!("error: {shown}…: the link is damaged: its length is 48 modulo 62, and it says no length (a character was lost or changed on the way: copy the link again)\n"),
        ),
        (
            vec!["-"],
            Some("hello"),
            "error: -: neither its name nor its first characters say what it is (--from says it: pmks, pylinkage, mjcf, urdf, sdf, dxf, svg, csv)\n".to_owned(),
        ),
        (
            vec!["-", "--from", "csv"],
            Some("body,point,x,y\na,A,1,one\n"),
            "error: -: line 2: \"one\" is no number (write coordinates as plain numbers, such as 12.5)\n".to_owned(),
        ),
        (
            vec!["-", "--length", "kg"],
            Some("{}"),
            "error: -: --length: \"kg\" is no unit of length (mm, cm, m, in, ft or another that linkdyn docs format lists)\n".to_owned(),
        ),
    ];
    for (arguments, input, expected) in told {
        let (status, printed, said) = import(&arguments, input);
        assert_eq!(
            (status, printed.as_str(), said),
            (Some(2), "", expected),
            "{arguments:?}"
        );
    }
    let (status, _, said) = import(&["nowhere.csv"], None);
    assert_eq!(status, Some(2));
    assert!(
        said.starts_with("error: nowhere.csv: can't be read: "),
        "{said}"
    );
    let (status, _, said) = import(&["-", "--from", "stl"], None);
    assert_eq!(status, Some(2));
    assert!(
        said.contains("invalid value 'stl' for '--from <FORMAT>'")
            && said.contains("pmks, pylinkage, mjcf"),
        "{said}"
    );
}
