//! What can't be drawn.

use super::*;

#[test]
fn what_can_not_be_drawn_is_told() {
    let scratch = Scratch::new("refused");
    scratch.write(
        "r.csv",
        "time[s],crank.omega[rad/s],crank.x[m],what[m]\n0,1,2,no\n1,2,3,no\n",
    );
    let plot = |file: &str, rest: &[&str], said: &str| {
        let arguments = [&["plot", file, "-o", "a.svg"], rest].concat();
        scratch.refused(&arguments, said);
    };
    plot(
        "r.csv",
        &["--y", "crank.omga"],
        "r.csv: --y crank.omga: no column of that name (did you mean \"crank.omega\"",
    );
    plot(
        "r.csv",
        &["--y", "zz*"],
        "(there are: time, crank.omega, crank.x, what)",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--x", "tme"],
        "--x tme: no column of that name (did you mean \"time\"?)",
    );
    plot(
        "r.csv",
        &["--y", "what"],
        "line 2: \"no\" in column \"what[m]\" is not a number",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--units", "furlong"],
        "--units furlong: not a unit",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--x-unit", "deg"],
        "--x-unit deg: time[s] can't be told in it",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--x-range", "2:1"],
        "the first number must be less",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--size", "20x20", "--font-size", "40"],
        "too small",
    );
    plot(
        "r.csv",
        &["--y", "crank.x", "--label", "a", "--label", "b"],
        "--label: 2 given for 1 columns",
    );
    scratch.refused(
        &["plot", "r.csv", "--y", "time", "-o", "a.pdf"],
        "must end in .svg or .png",
    );
    let huge = [
        "plot",
        "r.csv",
        "--y",
        "crank.x",
        "--size",
        "2000x2000",
        "--dpi",
        "2400",
        "-o",
        "a.png",
    ];
    scratch.refused(&huge, "pixels are too many");
    assert!(
        !scratch.0.join("a.svg").exists(),
        "a refusal leaves no file"
    );
}

#[test]
fn what_is_no_table_can_not_be_drawn() {
    let scratch = Scratch::new("no-table");
    scratch.write("empty.csv", "");
    scratch.write("header.csv", "time[s],a[m]\n");
    scratch.write("other.csv", "x,y\n1,2\n");
    scratch.write("void.csv", "time[s],a[m]\n0,\n1,\n");
    scratch.write("none/readme", "");
    let plot = |file: &str, rest: &[&str], said: &str| {
        let arguments = [&["plot", file, "-o", "a.svg"], rest].concat();
        scratch.refused(&arguments, said);
    };
    plot("empty.csv", &["--y", "a"], "empty.csv: the file is empty");
    plot(
        "header.csv",
        &["--y", "a"],
        "header.csv: there is a header and no row",
    );
    plot("other.csv", &["--y", "y"], "names no column as name[unit]");
    plot("void.csv", &["--y", "a"], "nothing to draw");
    plot(
        "none",
        &["--y", "a"],
        "none: a directory without results.csv",
    );
    plot(
        "nowhere",
        &["--y", "a"],
        "nowhere: no such file or directory",
    );
    assert!(
        !scratch.0.join("a.svg").exists(),
        "a refusal leaves no file"
    );
}

#[test]
fn what_can_not_be_animated_is_told() {
    let scratch = Scratch::new("not-animated");
    scratch.write("bare/results.csv", "time[s],crank.x[m]\n0,1\n");
    let animate = |results: &str, rest: &[&str], said: &str| {
        let arguments = [&["animate", results], rest].concat();
        scratch.refused(&arguments, said);
    };
    animate(
        "bare",
        &["-o", "a.gif"],
        "summary.json: no such file (name the model with --model",
    );
    animate(
        "bare",
        &["-o", "a.gif", "--model", "four-bar"],
        "no column crank.y, crank.angle",
    );
    animate(
        "bare",
        &["-o", "a.gif", "--model", "five-bar"],
        "no bundled model of that name",
    );
    animate(
        "bare",
        &["-o", "a.mp4"],
        "must end in .gif, .apng, .svg or .png",
    );
    animate(
        "bare",
        &["-o", "a.gif", "--fps", "1000"],
        "a number from 0.1 to 60 is wanted",
    );
    animate(
        "bare",
        &["-o", "a.gif", "--fps", "60"],
        "--fps 60: a GIF shows 50 frames per second at most (write .apng for 60): a.gif",
    );
    animate(
        "bare",
        &["-o", "a.apng", "--strip"],
        "--strip: only for poses, and an .apng is a film (write .svg or .png): a.apng",
    );
    let ground = r#"{ "format": "linkdyn/1", "units": "SI", "bodies": { "ground": { "points": { "O": [0, 0] } } },
        "analysis": { "type": "kinematics", "end": 1, "outputs": 3 } }"#;
    scratch.write("ground.json", ground);
    animate(
        "bare",
        &["-o", "a.gif", "--model", "ground.json"],
        "nothing to draw: the model has no body but the ground",
    );
    assert!(
        !scratch.0.join("a.gif").exists(),
        "a refusal leaves no file"
    );
}

#[test]
fn what_a_run_leaves_can_not_be_animated_in_every_way() {
    let scratch = Scratch::new("not-so-animated");
    let animate = |results: &str, rest: &[&str], said: &str| {
        let arguments = [&["animate", results], rest].concat();
        scratch.refused(&arguments, said);
    };
    scratch.done(&[
        "run",
        "four-bar",
        "--set",
        "analysis.outputs=3",
        "-o",
        "out",
    ]);
    animate(
        "out",
        &["-o", "a.svg", "--poses", "1000"],
        "1000 poses: from 1 to 64 can be drawn",
    );
    animate(
        "out",
        &["-o", "a.gif", "--width", "4000", "--duration", "600"],
        "pixels for all frames are too many",
    );
    scratch.write(
        "out/summary.json",
        r#"{"drawing":{"bodies":[],"joints":[],"springs":[],"traces":[[9,[0,0]]]}}"#,
    );
    animate(
        "out",
        &["-o", "a.gif"],
        "summary.json: the key \"drawing\" names a body that it does not have",
    );
    for (text, said) in [
        (
            r#"{"drawing":[1e999]}"#,
            "summary.json: not JSON that can be read (name the model with --model",
        ),
        (
            "{}",
            "summary.json: has no key \"drawing\", which tells the shape",
        ),
    ] {
        scratch.write("out/summary.json", text);
        animate("out", &["-o", "a.gif"], said);
    }
    for rest in [
        &["-o", "a.gif", "--poses", "4"][..],
        &["-o", "a.gif", "--strip"],
        &["-o", "a.gif", "--dpi", "100"],
    ] {
        animate("out", rest, "only for poses, and a .gif is a film");
    }
    animate(
        "out",
        &["-o", "a.svg", "--fps", "4"],
        "--fps: only for a film",
    );
    let columns = "analysis.columns=[\"crank.*\"]";
    scratch.done(&[
        "run",
        "four-bar",
        "--set",
        "analysis.outputs=3",
        "--set",
        columns,
        "-o",
        "few",
    ]);
    animate(
        "few",
        &["-o", "a.gif"],
        "no column coupler.x, coupler.y, coupler.angle, rocker.x and 2 more",
    );
    assert!(
        !scratch.0.join("a.gif").exists(),
        "a refusal leaves no file"
    );
}
