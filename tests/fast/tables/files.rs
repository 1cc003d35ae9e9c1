//! Tables in files beside the model.

use super::*;
use std::fs;
use std::path::{Path, PathBuf};

/// A folder of its own for a test.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("linkdyn-tables-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn load(
    folder: &Path,
    model: &Value,
) -> Result<linkdyn_model::Loaded, linkdyn_model::error::Complaints> {
    let path = folder.join("model.json");
    fs::write(&path, model.to_string()).expect("written");
    linkdyn_model::load_file(&path, &[])
}

#[test]
fn points_come_from_a_file_once() {
    let folder = folder("points");
    let named = json!({ "file": "saw.csv", "columns": ["angle", "torque"], "interpolation": "linear", "period": "1 rev" });
    let same = json!({ "points": [[0, 0], [90, 4]], "units": ["deg", "N*m"], "interpolation": "linear", "period": "1 rev" });
    let texts = [
        "# measured\nangle [deg],other,torque [N*m]\n0,7,0\n90,x,4\n",
        "\u{feff}\"angle [deg]\";other;torque [N*m]\r\n0;7;0\r\n\r\n90;8;4.0e0\r\n",
    ];
    for text in texts {
        fs::write(folder.join("saw.csv"), text).expect("written");
        let own = load(
            &folder,
            &rotor(json!("=saw(rotor.angle)"), json!({ "saw": named })),
        )
        .expect("legal");
        let known = loaded(&rotor(json!("=saw(rotor.angle)"), json!({ "saw": same })));
        assert_eq!(own.model.tables, known.model.tables);
        // what is kept needs the file no more
        assert_eq!(
            own.document["tables"]["saw"]["points"],
            json!([[0.0, 0.0], [90.0, 4.0]])
        );
        assert_eq!(loaded(&own.document).model.tables, own.model.tables);
    }
    // without names the first two columns count, and a motion takes a file as well
    fs::write(folder.join("plain.csv"), "0\t1\n0.5\t2\n").expect("written");
    let mut model = rotor(
        json!({ "of": "rotor.angle", "file": "plain.csv", "units": ["rad", "N*m"] }),
        json!({}),
    );
    model["drivers"] = json!({ "d": { "type": "rotation", "body": "rotor",
        "motion": { "type": "table", "file": "plain.csv", "units": ["s", "deg"] } } });
    model["initial"] = json!({});
    model["analysis"] = json!({ "type": "inverse_dynamics", "end": 0.5, "outputs": 3 });
    let own = load(&folder, &model).expect("legal");
    let run = outcome(&own.document);
    let angle = column(&run, "rotor.angle");
    assert!((angle[2] - 2.0_f64.to_radians()).abs() < 1e-15, "{angle:?}");
    let effort = column(&run, "driver.d.effort");
    assert!(
        (effort[0] + 1.0 + 2.0 * angle[0]).abs() < 1e-14,
        "{effort:?}"
    );
}

/// A file, whether columns are named, and what is said.
const FAULTS: &[(Option<&str>, bool, &str)] = &[
    (
        None,
        false,
        "there is no such file (looked for at DIR/gas.csv)",
    ),
    (Some(""), false, "the file is empty"),
    (Some("# nothing\n\n"), false, "the file is empty"),
    (
        Some("angle,pressure\n0,1\n"),
        true,
        r#"the file has no column "p" (its first line names 2 columns)"#,
    ),
    (
        Some("angel,p\n0,1\n"),
        true,
        r#"the file has no column "angle" (its first line names 2 columns)"#,
    ),
    (
        Some("0,1\n1,2\n"),
        true,
        r#"the first line of the file does not name its columns (leave out "columns": then the first two count)"#,
    ),
    (
        Some("angle,p\n0,1\n1,high\n"),
        true,
        "line 3, column 2: this is no number",
    ),
    (
        Some("angle;p\n0;1,5\n1;2\n"),
        true,
        "line 2, column 2: this is no number (a decimal point is a point)",
    ),
    (Some("angle,p\n0,1\n1\n"), true, "line 3 has no column 2"),
    (
        Some("angle,p\n0,1\n0,2\n"),
        true,
        "line 3: its place is not beyond the one before it (the places of a table increase)",
    ),
    (
        Some("angle,p\n0,1\n2,inf\n"),
        true,
        "line 3, column 2: this is no number",
    ),
    (
        Some("angle,p\n0,1\n"),
        true,
        "a table has at least 2 points, this file has 1",
    ),
];

#[test]
fn faults_of_files_are_told() {
    let folder = folder("faults");
    let told = |text: Option<&str>, columns: Value| {
        let path = folder.join("gas.csv");
        match text {
            Some(text) => fs::write(&path, text).expect("written"),
            None => drop(fs::remove_file(&path)),
        }
        let mut table = json!({ "file": "gas.csv" });
        if !columns.is_null() {
            table["columns"] = columns;
        }
        let said = load(
            &folder,
            &rotor(json!("=gas(rotor.angle)"), json!({ "gas": table })),
        );
        let text = said.expect_err("refused")[0].to_string();
        let (_, said) = text
            .split_once("tables.gas.file: \"gas.csv\": ")
            .unwrap_or(("", &text));
        said.replace(&folder.display().to_string(), "DIR")
    };
    let mut wrong = String::new();
    for &(text, named, expected) in FAULTS {
        let columns = named.then(|| json!(["angle", "p"]));
        let said = told(text, columns.unwrap_or_default());
        if said != expected {
            wrong += &format!("{text:?}\n    {said}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    // what is no file is not waited for
    let mut model = rotor(
        json!("=gas(rotor.angle)"),
        json!({ "gas": { "file": "." } }),
    );
    let said = load(&folder, &model).expect_err("refused").to_string();
    assert!(said.contains("this is no file"), "{said}");
    fs::write(folder.join("gas.csv"), "0,1\n1,2\n").expect("written");
    model["tables"]["gas"] = json!({ "file": "gas.csv", "points": [[0, 0], [1, 1]] });
    let said = load(&folder, &model).expect_err("refused").to_string();
    assert!(
        said.contains(r#""points" and "file" exclude each other"#),
        "{said}"
    );
    fs::write(folder.join("gas.csv"), [0xff, 0xfe, 0x00]).expect("written");
    model["tables"]["gas"] = json!({ "file": "gas.csv" });
    let said = load(&folder, &model).expect_err("refused").to_string();
    assert!(said.contains("the file is not UTF-8 text"), "{said}");
}
