//! A row of N parallel four-bars, problem A02 of the IFToMM library of computational benchmark problems, as a model file of any size.

use std::fmt::Write;

/// More loops make a file that the loader refuses for its size.
pub const MOST_LOOPS: usize = 50_000;

/// The model file with that many loops, laid out like the others.
pub fn text(loops: usize) -> String {
    let mut text = String::with_capacity(1500 + 900 * loops);
    // Writing to a String can't fail.
    let _ = write(&mut text, loops);
    text
}

fn write(text: &mut String, loops: usize) -> std::fmt::Result {
    let feet: Vec<String> = (0..=loops).map(|k| format!("\"O{k}\": [{k}, 0]")).collect();
    write!(
        text,
        r#"{{
  "format": "linkdyn/1",
  "name": "N-four-bar, N = {loops}",
  "about": "A row of equal four-bars, rods of 1 m and 1 kg, let go upright with 1 m/s; flat twice in a turn, where all loops are singular at once. `linkdyn models nfourbar --n 40` prints any N",
  "source": "Problem A02 of the IFToMM library of computational benchmark problems (N-four-bar mechanism; the library's data are for N = 40)",
  "note": "All rockers stay parallel: with theta from upright, theta'' = (g/L) 3 (3N + 1) / (2 (4N + 1)) sin theta.",
  "units": "SI",
  "gravity": [0, -9.81],
  "bodies": {{
    "ground": {{ "points": {{ {} }} }}"#,
        feet.join(", ")
    )?;
    for k in 0..=loops {
        rod(
            text,
            "rocker",
            k,
            &format!("\"position\": [{k}, 0], \"angle\": \"90 deg\""),
        )?;
        if k < loops {
            rod(text, "coupler", k, &format!("\"position\": [{k}, 1]"))?;
        }
    }
    text.push_str("\n  },\n  \"joints\": {\n");
    for k in 0..=loops {
        pin(
            text,
            "foot",
            k,
            &format!("ground.O{k}"),
            &format!("rocker{k}.A"),
        )?;
        if k < loops {
            text.push_str(",\n");
            pin(
                text,
                "left",
                k,
                &format!("rocker{k}.B"),
                &format!("coupler{k}.A"),
            )?;
            text.push_str(",\n");
            pin(
                text,
                "right",
                k,
                &format!("coupler{k}.B"),
                &format!("rocker{}.B", k + 1),
            )?;
            text.push_str(",\n");
        }
    }
    text.push_str(
        r#"
  },
  "initial": { "rocker0": { "angle": "90 deg", "angular_velocity": -1 } },
  "points": ["rocker0.B"],
  "analysis": { "type": "dynamics", "end": 10, "outputs": 201, "solver": { "rtol": 1e-9, "atol": 1e-12 } }
}
"#,
    );
    Ok(())
}

/// A uniform rod after the body before it.
fn rod(text: &mut String, name: &str, k: usize, pose: &str) -> std::fmt::Result {
    let name = format!("\"{name}{k}\":");
    write!(
        text,
        ",\n    {name:12} {{ \"mass\": 1, \"inertia\": 0.08333333333333333, \"com\": [0.5, 0], \
         \"points\": {{ \"A\": [0, 0], \"B\": [1, 0] }}, \"pose\": {{ {pose} }} }}"
    )
}

fn pin(text: &mut String, name: &str, k: usize, first: &str, second: &str) -> std::fmt::Result {
    let name = format!("\"{name}{k}\":");
    write!(
        text,
        "    {name:10} {{ \"type\": \"revolute\", \"between\": [\"{first}\", \"{second}\"] }}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_is_the_family_at_its_default() {
        assert_eq!(include_str!("../../../../models/nfourbar.json"), text(2));
    }
}
