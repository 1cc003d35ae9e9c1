//! The profiles of cams as files for whoever makes them.
//!
//! | file           | holds                                                                                     |
//! | -------------- | ----------------------------------------------------------------------------------------- |
//! | `cam-NAME.csv` | angle, places of the profile and of the pitch curve, curvature                            |
//! | `cam-NAME.svg` | both curves and the cam's point, one unit for a millimetre                                |
//! | `cam-NAME.dxf` | the profile as a closed polyline in millimetres (R12), the pitch curve on a layer of its own |

use std::fmt::Write;
use std::path::PathBuf;

use linkdyn_engine::system::compile::{Profile, profiles};
use linkdyn_model::Checked;
use linkdyn_output::{Column, Directory, Trajectory, WriteError, csv};

/// Millimetres in a metre.
const MILLIMETRES: f64 = 1e3;
/// Room around a drawing, by its size.
const MARGIN: f64 = 0.05;

/// Writes the files of all cams; `None` if there are no cams.
pub(crate) fn write(directory: &Directory, model: &Checked) -> Result<Vec<PathBuf>, WriteError> {
    let mut paths = Vec::new();
    for profile in profiles(model) {
        let name = file_name(&profile, model);
        let table = table(&profile);
        let path = directory.write_with(&format!("{name}.csv"), |file| csv::write(&table, file))?;
        let svg = directory.write(&format!("{name}.svg"), svg(&profile).as_bytes())?;
        let dxf = directory.write(&format!("{name}.dxf"), dxf(&profile).as_bytes())?;
        paths.extend([path, svg, dxf]);
    }
    Ok(paths)
}

/// A name that every file system takes; with the joint's number where another joint would get the same.
fn file_name(profile: &Profile, model: &Checked) -> String {
    let plain = |name: &str| -> String {
        let sign = |c: char| {
            if c.is_alphanumeric() || c == '-' {
                c
            } else {
                '_'
            }
        };
        name.chars().map(sign).collect::<String>().to_lowercase()
    };
    let own = plain(&profile.name);
    let same = model.joints.keys().filter(|name| plain(name) == own);
    match same.count() {
        0 | 1 => format!("cam-{own}"),
        _ => format!("cam-{own}-{}", profile.joint + 1),
    }
}

fn table(profile: &Profile) -> Trajectory {
    let columns = [
        ("angle", "rad"),
        ("profile.x", "m"),
        ("profile.y", "m"),
        ("pitch.x", "m"),
        ("pitch.y", "m"),
        ("curvature", "1/m"),
    ];
    let mut table = Trajectory::new(columns.map(|(name, unit)| Column::new(name, unit)).into());
    for row in &profile.rows {
        table.push_row(row);
    }
    table
}

/// Corners of the profile, and of the pitch curve where it is another, once around \[mm\].
fn curves(profile: &Profile) -> [Vec<[f64; 2]>; 2] {
    let once = &profile.rows[..profile.rows.len() - 1];
    let corners = |first: usize| {
        let places = once.iter().map(|row| [row[first], row[first + 1]]);
        places.map(|place| place.map(|x| x * MILLIMETRES)).collect()
    };
    let [own, pitch]: [Vec<[f64; 2]>; 2] = [corners(1), corners(3)];
    let is_same = own == pitch;
    [own, if is_same { Vec::new() } else { pitch }]
}

fn svg(profile: &Profile) -> String {
    let curves = curves(profile);
    let places = || curves.iter().flatten().flatten();
    let far = places().fold(0.0, |most: f64, x| most.max(x.abs())) * (1.0 + MARGIN);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w:.3}mm\" height=\"{w:.3}mm\" viewBox=\"{x:.3} {x:.3} {w:.3} {w:.3}\" \
         fill=\"none\" stroke=\"black\" stroke-width=\"{thin:.4}\">\n",
        w = 2.0 * far,
        x = -far,
        thin = 0.004 * far,
    );
    let dashes = ["", &format!(" stroke-dasharray=\"{:.4}\"", 0.03 * far)];
    for (curve, dash) in curves.iter().zip(dashes) {
        if curve.is_empty() {
            continue;
        }
        let corners: Vec<String> = curve
            .iter()
            .map(|[x, y]| format!("{x:.6},{:.6}", -y))
            .collect();
        let _ = writeln!(text, "<polygon points=\"{}\"{dash}/>", corners.join(" "));
    }
    let cross = 0.04 * far;
    let _ = writeln!(
        text,
        "<path d=\"M{:.4},0H{cross:.4}M0,{:.4}V{cross:.4}\"/>\n</svg>",
        -cross, -cross
    );
    text
}

fn dxf(profile: &Profile) -> String {
    let mut text = String::from("0\nSECTION\n2\nENTITIES\n");
    for (curve, layer) in curves(profile).iter().zip(["PROFILE", "PITCH"]) {
        if curve.is_empty() {
            continue;
        }
        let _ = write!(
            text,
            "0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n1\n10\n0\n20\n0\n30\n0\n"
        );
        for [x, y] in curve {
            let _ = write!(
                text,
                "0\nVERTEX\n8\n{layer}\n10\n{x:.9}\n20\n{y:.9}\n30\n0\n"
            );
        }
        let _ = write!(text, "0\nSEQEND\n8\n{layer}\n");
    }
    let _ = write!(
        text,
        "0\nPOINT\n8\nPROFILE\n10\n0\n20\n0\n30\n0\n0\nENDSEC\n0\nEOF\n"
    );
    text
}
