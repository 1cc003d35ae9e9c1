//! Standard output that ends early.

use super::*;

#[test]
#[cfg(unix)]
fn a_reader_that_goes_away_is_no_fault() {
    for arguments in [
        &["models", "four-bar"][..],
        &["--help"],
        &["run", "four-bar"],
        &["schema"],
    ] {
        let mut child = command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the binary runs");
        drop(child.stdout.take());
        let ran: Ran = child.wait_with_output().expect("ends").into();
        assert_eq!(
            (ran.status, ran.stderr.as_str()),
            (Some(0), ""),
            "{arguments:?}"
        );
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_behind_standard_output_is_told() {
    let full = fs::File::options()
        .write(true)
        .open("/dev/full")
        .expect("there");
    let ran: Ran = command(&["models"])
        .stdout(full)
        .output()
        .expect("runs")
        .into();
    assert_eq!(ran.status, Some(5), "{ran:?}");
    assert!(
        ran.stderr.contains("standard output can't be written"),
        "{ran:?}"
    );
}
