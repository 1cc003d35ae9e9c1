//! Sliders of the page of `run --watch`.

use std::fs;
use std::time::{Duration, Instant};

use super::watching::bundled;
use super::{Live, SHOWN};

/// Moves a slider to a part of its way.
fn slide(name: &str, part: f64) -> String {
    format!(
        "{{ const {{ slider }} = knobs.made.get('{name}'); slider.value = Math.round(Number(slider.min) + {part} * (slider.max - slider.min)); \
         slider.dispatchEvent(new Event('input')); }}"
    )
}

/// Types a value.
fn enter(name: &str, text: &str) -> String {
    format!(
        "{{ const {{ field }} = knobs.made.get('{name}'); field.value = '{text}'; field.dispatchEvent(new Event('change')); }}"
    )
}

const POINT: &str = "JSON.stringify(linkdyn.shapes.place([2, 2], linkdyn.player.row))";
const GHOST: &str = "JSON.stringify(linkdyn.ghost.shapes.place([2, 2], linkdyn.ghost.row))";
const HAS_GHOST: &str = "linkdyn.ghost.row !== null";
/// Whether the canvas would be another one without the ghost.
const IS_DRAWN: &str = "(() => { const { canvas, paint } = linkdyn.stage, take = () => { paint(); return canvas.toDataURL(); }; \
    const draw = linkdyn.ghost.draw, first = take(); linkdyn.ghost.draw = () => {}; const without = take(); \
    linkdyn.ghost.draw = draw; return first !== without && take() === first; })()";

#[test]
fn a_slider_moves_the_mechanism_before_its_ghost() {
    let Some(mut live) = Live::of(&bundled("four-bar")) else {
        return;
    };
    live.tab.wait(SHOWN);
    live.report("linkdyn.player.seek(60); linkdyn.stage.zoom(1.2)");
    let (saved, view) = (
        live.report(POINT),
        live.report("String(linkdyn.stage.view)"),
    );
    let peak = "linkdyn.endsOf(linkdyn.byName.get('driver.motor.effort'))[1]";
    let effort = live.report(peak).as_f64().expect("a number");
    let names = "[...knobs.made.values()].map(({ name, value, unit, least, most }) => [name, value, unit, least, most].join(' ')).join()";
    assert_eq!(
        live.tab.value(names),
        "base 300 mm 150 600,crank 100 mm 50 200,coupler 250 mm 125 500,rocker 200 mm 100 400"
    );

    live.tab.value(&slide("crank", 0.2));
    assert_eq!(live.tab.value("knobs.made.get('crank').now"), 80);
    live.wait_in_report(HAS_GHOST);
    live.tab.wait("!document.getElementById('write').disabled");
    assert_ne!(live.report(POINT), saved);
    assert_eq!(live.report(GHOST), saved, "the ghost is what is saved");
    assert_eq!(live.report(IS_DRAWN), true);
    assert_eq!(live.report("String(linkdyn.stage.view)"), view);
    assert!(
        live.report(peak).as_f64().expect("a number") < 0.9 * effort,
        "plots follow"
    );

    // A value that can't be has a message; the picture stays, and the slider goes on.
    live.tab.value(&enter("crank", "1 m"));
    live.tab.wait("faults.textContent !== ''");
    assert_eq!(live.report("document.body.classList.contains('old')"), true);
    live.tab.value(&enter("crank", "3 s"));
    live.tab
        .wait("knobs.made.get('crank').why.textContent.includes('mm')");
    live.tab.value(&enter("crank", "9.5 cm"));
    live.tab
        .wait("faults.textContent === '' && knobs.made.get('crank').now === 95");
    live.wait_in_report("!document.body.classList.contains('old')");

    live.tab.value("document.getElementById('back').click()");
    live.wait_in_report("linkdyn.ghost.row === null");
    assert_eq!(live.report(POINT), saved);
    assert_eq!(live.tab.value("knobs.made.get('crank').now"), 100);
}

#[test]
fn a_value_is_written_into_the_file_and_nothing_else_changes() {
    let text = bundled("four-bar");
    let odd = "\"base\":\"300 mm\" ,\n\t\"crank\" : { \"note\": \"100 mm, or 1\",  \"value\" : \"100.00  mm\", \"tolerance\": \"2 mm\" },\r\n  \
        \"share\": 1.0e0, \"coupler\": \"=share*250 mm\", ";
    let text = text.replace(
        "\"base\": \"300 mm\", \"crank\": \"100 mm\", \"coupler\": \"250 mm\", ",
        odd,
    );
    assert!(text.contains(odd));
    let Some(mut live) = Live::of(&text) else {
        return;
    };
    live.tab.wait(SHOWN);
    let names = "[...knobs.made.keys()].join()";
    assert_eq!(live.tab.value(names), "base,crank,share,rocker");
    for (name, value) in [("base", "310"), ("crank", "101.5 mm"), ("share", "1.05")] {
        live.tab.value(&enter(name, value));
        let number = value.trim_end_matches(" mm");
        live.tab
            .wait(&format!("knobs.made.get('{name}').now === {number}"));
    }
    live.tab.value("document.getElementById('write').click()");
    let expected = text
        .replace("\"base\":\"300 mm\"", "\"base\":\"310 mm\"")
        .replace("100.00  mm", "101.5  mm")
        .replace("1.0e0", "1.05");
    let begun = Instant::now();
    let written = || fs::read_to_string(&live.watching.model).expect("there");
    while written() != expected {
        assert!(begun.elapsed() < Duration::from_secs(30), "{}", written());
        std::thread::sleep(Duration::from_millis(10));
    }
    live.tab.wait("last === 2 && pictured === 2");
    assert_eq!(
        live.tab.value("document.getElementById('write').disabled"),
        true
    );
    assert_eq!(live.report(HAS_GHOST), false);
    assert_eq!(live.tab.value("knobs.made.get('share').value"), 1.05);
    assert_eq!(live.tab.value("faults.textContent"), "");
}
