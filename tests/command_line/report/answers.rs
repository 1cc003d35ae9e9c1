//! What the model asks for stands on top, in the words of the terminal.

use super::*;

const MODEL: &str = r#"{"peak": { "value": "max(joint.wristpin.f)", "limits": [0, 1000], "unit": "kN" },
    "stroke": { "value": "range(piston.x)", "limits": ["50 mm", "0.2 m"] }, "swing": "range(rod.angle)",
    "never": { "value": "at(crank.angle, t = 1 h)", "limits": [0, 1] } }"#;

#[test]
fn responses_stand_on_top_and_those_that_miss_their_limits_are_marked() {
    let Some(browser) = find() else { return };
    let (page, _, _) = run(&["slider-crank", "--set", &format!("responses={MODEL}")]);
    let probe = "setTimeout(() => { const box = document.getElementById('answers'); \
        const told = () => [...box.children].map((one) => [one.className, ...[...one.children].map((part) => part.textContent)]); \
        const first = told(), top = box.getBoundingClientRect().bottom <= document.querySelector('main').getBoundingClientRect().top; \
        const edge = getComputedStyle(box.children[0]).borderTopColor !== getComputedStyle(box.children[1]).borderTopColor; \
        linkdyn.units.system = 'si'; answer({ first, top, edge, si: told() }); }, 300);";
    for size in [[1280, 900], [390, 800]] {
        let (told, visit) = ask_in(&browser, &page, probe, Some(2000), size);
        assert!(visit.console.is_empty(), "{:#?}", visit.console);
        let first = &told["first"];
        assert_eq!(
            first[0],
            json!([
                "answer missed",
                "peak",
                "1.58016 kN",
                "0 kN … 1 kN",
                "missed"
            ])
        );
        assert_eq!(
            first[1],
            json!(["answer kept", "stroke", "100 mm", "50 mm … 200 mm", "kept"])
        );
        assert_eq!(first[2], json!(["answer ", "swing", "28.955°"]));
        assert_eq!(first[3][0], "answer missed");
        assert!(told["top"] == true && told["edge"] == true, "{told:#}");
        // A declared unit stays.
        assert_eq!(told["si"][0], first[0]);
        assert_eq!(told["si"][1][2], "0.1 m");
    }
}
