//! Raster images and films are what they say.

use super::*;

#[test]
fn a_png_has_the_size_and_resolution_asked_for() {
    let scratch = Scratch::new("png");
    scratch.write("r.csv", "time[s],a[m]\n0,1\n1,2\n");
    scratch.done(&[
        "plot", "r.csv", "--y", "a", "--size", "127x50.8", "--dpi", "200", "-o", "a.png",
    ]);
    // 5 in × 2 in; 200 dots per 25.4 mm.
    assert_eq!(png_facts(&scratch.read("a.png")), [1000, 400, 7874]);
    scratch.done(&["plot", "r.csv", "--y", "a", "--width", "180", "-o", "a.svg"]);
    let svg = scratch.text("a.svg");
    let root = Document::parse(&svg).expect("XML");
    assert_eq!(root.root_element().attribute("width"), Some("180mm"));
}

#[test]
fn figures_are_the_same_every_time() {
    let scratch = Scratch::new("same");
    scratch.write("r.csv", "time[s],a[m]\n0,1\n1,2\n2,0\n");
    for file in ["a.svg", "b.svg", "a.png", "b.png"] {
        scratch.done(&["plot", "r.csv", "--y", "a", "-o", file]);
    }
    assert_eq!(scratch.read("a.svg"), scratch.read("b.svg"));
    assert_eq!(scratch.read("a.png"), scratch.read("b.png"));
}

#[test]
fn a_film_has_the_frames_and_delays_asked_for() {
    let scratch = Scratch::new("film");
    scratch.done(&[
        "run",
        "four-bar",
        "--set",
        "analysis.outputs=41",
        "-o",
        "out",
    ]);
    let said = scratch.done(&[
        "animate",
        "out",
        "-o",
        "a.gif",
        "--fps",
        "30",
        "--duration",
        "1",
        "--width",
        "200",
    ]);
    assert!(said.contains("30 frames in 1 s, 2 × real time"), "{said}");
    let ([width, _], delays) = gif_facts(&scratch.read("a.gif"));
    assert_eq!(
        (width, delays.len(), delays.iter().sum::<u16>()),
        (200, 30, 100)
    );
    assert!(
        delays.iter().all(|delay| (3..=4).contains(delay)),
        "{delays:?}"
    );
    // By itself as long as the motion.
    scratch.done(&[
        "animate",
        "out/results.csv",
        "-o",
        "b.gif",
        "--fps",
        "10",
        "--width",
        "100",
    ]);
    assert_eq!(gif_facts(&scratch.read("b.gif")).1, [10; 20]);
}

/// An animated PNG tells the length of a frame as a fraction of a second: 60 frames per second exactly, in so many frames.
#[test]
fn an_animated_png_is_as_fast_as_asked_for() {
    let scratch = Scratch::new("apng");
    scratch.done(&[
        "run",
        "four-bar",
        "--set",
        "analysis.outputs=41",
        "-o",
        "out",
    ]);
    let said = scratch.done(&["animate", "out", "-o", "a.apng", "--width", "120"]);
    assert!(said.contains("120 frames in 2 s, 1 × real time"), "{said}");
    let bytes = scratch.read("a.apng");
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().expect("4 bytes"));
    let mut at = 8;
    let (mut frames, mut data) = (0, 0);
    while at < bytes.len() {
        let [long, content] = [number(at) as usize, at + 8];
        match &bytes[at + 4..content] {
            // Frames, and times that they are shown: again and again.
            b"acTL" => assert_eq!([number(content), number(content + 4)], [120, 0]),
            b"fcTL" => {
                let delay = number(content + 20);
                assert_eq!((delay >> 16) * 60, delay & 0xffff, "frame {frames}");
                frames += 1;
            }
            b"IDAT" | b"fdAT" => data += 1,
            _ => {}
        }
        at = content + long + 4;
    }
    assert_eq!((at, frames), (bytes.len(), 120));
    assert!(data >= 120, "{data}");
}

/// Curves below or beside a mechanism make the film higher, or leave it less room, and stay in its limits.
#[test]
fn films_have_curves_with_a_cursor() {
    let scratch = Scratch::new("curves");
    scratch.done(&["run", "lock", "-o", "out", "--no-report"]);
    let film = |more: &[&str]| {
        scratch.done(&[&["animate", "out", "-o", "a.gif", "--fps", "10"], more].concat());
        let bytes = scratch.read("a.gif");
        assert!(bytes.len() <= 2_000_000, "{more:?}: {} bytes", bytes.len());
        let ([wide, high], delays) = gif_facts(&bytes);
        (wide, high, delays.len(), bytes)
    };
    let alone = film(&[]);
    let torque = ["--y", "driver.motor.effort"];
    let below = film(&torque);
    assert_eq!((below.0, below.2), (alone.0, alone.2));
    assert!(below.1 > alone.1 + 200, "{} after {}", below.1, alone.1);
    let beside = film(
        &[
            &torque[..],
            &["--beside", "--x", "driver.motor.value", "--units", "deg"],
        ]
        .concat(),
    );
    assert!(beside.0 == alone.0 && beside.1 < below.1, "{}", beside.1);
    let smooth = [
        "animate", "out", "-o", "a.apng", "--width", "200", "--fps", "5",
    ];
    scratch.done(&[&smooth[..], &torque].concat());
    assert!(scratch.read("a.apng").len() <= 2_000_000);
    for (more, said) in [
        (&["--y", "driver.motor.efort"][..], "did you mean"),
        (
            &["--y", "driver.motor.effort", "--units", "mm"],
            "--units mm: no column",
        ),
        (&["--x", "time"], "--y"),
    ] {
        scratch.refused(&[&["animate", "out", "-o", "b.gif"], more].concat(), said);
    }
    let poses = [
        "animate",
        "out",
        "-o",
        "b.svg",
        "--y",
        "driver.motor.effort",
    ];
    scratch.refused(&poses, "--y: only for a film");
}

/// A film fits into a mail and a slide: 2 MB at most, by default. `tests/evidence` tries all bundled models.
#[test]
fn films_are_small() {
    let scratch = Scratch::new("small");
    for model in ["lock", "jansen-leg"] {
        scratch.done(&["run", model, "-o", model, "--no-report"]);
        scratch.done(&["animate", model, "-o", "film.gif"]);
        let bytes = scratch.read("film.gif");
        assert!(bytes.len() <= 2_000_000, "{model}: {} bytes", bytes.len());
        assert!(gif_facts(&bytes).0[0] == 480, "{model}");
    }
}
