//! Models too large to be listed.

use super::*;

/// 10 000 bodies, held in chains of a hundred or not at all, with names that try everything the contract allows.
fn hostile(count: usize, held: bool) -> Value {
    let tricks = [
        "🔒\u{202e}",
        "\"'`",
        "</script><script>alert(1)</script>",
        "a b\u{301}",
        "$(rm -r)",
        "%s%n",
        "\\",
        "ーー",
        "<!--",
        "&amp;",
    ];
    let name = |k: usize| format!("{} {k} {}", tricks[k % tricks.len()], "long ".repeat(k % 7));
    let (mut bodies, mut joints) = (Map::new(), Map::new());
    bodies.insert("ground".into(), json!({ "points": { "O": [0, 0] } }));
    for k in 0..count {
        bodies.insert(
            name(k),
            json!({ "mass": 1, "inertia": 0.1, "com": [0.5, 0], "points": { "\"A\"": [0, 0], "</b>": [1, 0] },
            "pose": { "position": [k % 100, 0] } }),
        );
        if held {
            let first = if k % 100 == 0 {
                "ground.O".to_string()
            } else {
                format!("{}.</b>", name(k - 1))
            };
            joints.insert(
                format!("🦾 {k}"),
                json!({ "type": "revolute", "between": [first, format!("{}.\"A\"", name(k))] }),
            );
        }
    }
    json!({ "format": "linkdyn/1", "name": "</script>\u{202e}", "units": "SI", "gravity": [0, -9.81], "bodies": bodies, "joints": joints,
            "analysis": { "type": "assembly" } })
}

/// Lines that a terminal shows, none endless, nothing in them that it would obey.
#[track_caller]
fn readable(text: &str) {
    assert!(
        text.lines().count() <= 120,
        "{} lines",
        text.lines().count()
    );
    let widest = text
        .lines()
        .map(|line| line.chars().count())
        .max()
        .unwrap_or(0);
    assert!(widest <= 1200, "a line of {widest} characters: {text}");
    assert!(
        !text.contains(|c: char| c.is_control() && c != '\n' || c == '\u{202e}'),
        "{text}"
    );
}

#[test]
fn ten_thousand_bodies_with_wild_names_are_told_of_in_few_words() {
    let started = Instant::now();
    let folder =
        Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("hostile-{}", std::process::id()));
    for held in [true, false] {
        let file = File::new(
            &format!("hostile-{held}"),
            &hostile(10_000, held).to_string(),
        );
        let (status, stdout, stderr) = linkdyn(&["check", file.path()]);
        assert_eq!(status, Some(0), "{stderr}");
        readable(&stdout);
        readable(&stderr);
        let (status, stdout, stderr) =
            linkdyn(&["run", file.path(), "-o", folder.to_str().expect("UTF-8")]);
        assert_eq!(status, Some(0), "{stderr}");
        readable(&stdout);
        let header = fs::read_to_string(folder.join("results.csv")).expect("results");
        assert_eq!(header.lines().count(), 2);
        // Each other end: data missing everywhere, too few drivers, a name that is not there.
        for sets in [
            &[
                "--set",
                "analysis={\"type\": \"kinematics\", \"end\": 1, \"outputs\": 2}",
            ][..],
            &["--set", "points=[\"nobody.A\"]"],
        ] {
            let (status, stdout, stderr) = linkdyn(&[&["run", file.path()], sets].concat());
            assert_eq!(status, Some(2), "{stderr}");
            readable(&stdout);
            readable(&stderr);
        }
    }
    let mut bare = hostile(10_000, true);
    for body in bare["bodies"].as_object_mut().expect("bodies").values_mut() {
        body.as_object_mut()
            .expect("a body")
            .retain(|key, _| key == "points" || key == "pose");
    }
    bare["analysis"] = json!({ "type": "inverse_dynamics", "end": 1, "outputs": 2 });
    let file = File::new("hostile-bare", &bare.to_string());
    let (status, _, stderr) = linkdyn(&["run", file.path()]);
    assert_eq!(status, Some(2), "{stderr}");
    readable(&stderr);
    let (status, stdout, stderr) = linkdyn(&["check", file.path()]);
    assert_eq!(status, Some(2), "{stderr}");
    readable(&stdout);
    readable(&stderr);
    let _ = fs::remove_dir_all(&folder);
    // Some seconds on a slow machine; what grows with the square or cube of 10 000 takes minutes or hours.
    assert!(
        started.elapsed() < Duration::from_secs(60),
        "{:?}",
        started.elapsed()
    );
}
