//! Ready parts.

use super::Case;

/// The base model with a part beside its load, and what is said of it.
macro_rules! part {
    ($what:literal, $part:literal, $($said:literal),+ $(,)?) => {
        Case {
            what: $what,
            edits: &[(
                r#""vector": [0, 5] }"#,
                concat!(r#""vector": [0, 5] },
    "part": "#, $part),
            )],
            sets: &[],
            complaints: &[$($said),+],
        }
    };
}

pub const CASES: &[Case] = &[
    part!(
        "gas spring without its numbers",
        r#"{ "type": "gas_spring", "between": ["ground.Q", "coupler.B"], "force": "400 N" }"#,
        r#"line 29, column 13: forces.part: "extended" is missing (as in "extended": "500 mm")"#,
        r#"line 29, column 13: forces.part: "stroke" is missing (as in "stroke": "200 mm")"#,
    ),
    part!(
        "gas spring with a negative force and a progression below 1",
        r#"{ "type": "gas_spring", "between": ["ground.Q", "coupler.B"], "force": "-400 N", "extended": 500, "stroke": 200, "progression": 0.8 }"#,
        r#"line 29, column 84: forces.part.force: "-400 N": must be greater than 0"#,
        r#"line 29, column 141: forces.part.progression: 0.8: must not be less than 1"#,
    ),
    part!(
        "gas spring whose stroke is its length",
        r#"{ "type": "gas_spring", "between": ["ground.Q", "coupler.B"], "force": "400 N", "extended": 500, "stroke": 500 }"#,
        r#"line 29, column 120: forces.part.stroke: 500: a stroke of 500 mm leaves no length of 500 mm at full extension ("extended" is the distance of its points, with the tube: more than two strokes as a rule)"#,
    ),
    part!(
        "gas spring with limits",
        r#"{ "type": "gas_spring", "between": ["ground.Q", "coupler.B"], "force": "400 N", "extended": 500, "stroke": 200, "limits": [300, 500] }"#,
        r#"line 29, column 125: forces.part.limits: "limits": they follow from "extended" and "stroke""#,
    ),
    part!(
        "gas spring with a stiffness",
        r#"{ "type": "gas_spring", "between": ["ground.Q", "coupler.B"], "force": "400 N", "extended": 500, "stroke": 200, "stiffness": "2 N/mm" }"#,
        r#"line 29, column 125: forces.part.stiffness: "stiffness": it follows from "progression" and "stroke""#,
    ),
    part!(
        "gas spring whose force is a formula",
        r#"{ "type": "gas_spring", "between": ["ground.Q", "coupler.B"], "force": "=2 N/mm*slider.x", "extended": 500, "stroke": 200 }"#,
        r#"line 29, column 93: forces.part.force: "=2 N/mm*slider.x": there is no parameter "slider" (write it into "parameters")"#,
    ),
    part!(
        "gas spring of one body that is not there",
        r#"{ "type": "gas_spring", "between": ["ground.Q", "lid.B"], "force": "400 N", "extended": 500, "stroke": 200 }"#,
        r#"line 29, column 61: forces.part.between[1]: "lid.B": there is no body "lid" (the bodies: ground, crank, coupler, rocker, slider)"#,
    ),
    part!(
        "gas spring with restitution of stops that yield",
        r#"{ "type": "gas_spring", "between": ["ground.Q", "coupler.B"], "force": "400 N", "extended": 500, "stroke": 200, "restitution": 0.5, "stop_stiffness": "1 N/mm" }"#,
        r#"line 29, column 140: forces.part.restitution: 0.5: the stops yield, since there is a "stop_stiffness": what they give back follows from stiffness and damping (leave out one of them)"#,
    ),
    part!(
        "gas spring with damping of stops that do not yield",
        r#"{ "type": "gas_spring", "between": ["ground.Q", "coupler.B"], "force": "400 N", "extended": 500, "stroke": 200, "stop_damping": "1 N*s/mm" }"#,
        r#"line 29, column 141: forces.part.stop_damping: "1 N*s/mm": "stop_stiffness" is missing: a stop with damping yields (give the stiffness of the stops, or "restitution" instead of the damping)"#,
    ),
    part!(
        "gas spring that is as long as a force",
        r#"{ "type": "gas_spring", "between": ["ground.Q", "coupler.B"], "force": "400 N", "extended": "500 N", "stroke": 200 }"#,
        r#"line 29, column 105: forces.part.extended: "500 N": "N" is not a unit of length (such as "m")"#,
    ),
    part!(
        "cylinder without pressure",
        r#"{ "type": "cylinder", "between": ["ground.Q", "coupler.B"], "bore": 40 }"#,
        r#"line 29, column 13: forces.part: "pressure" is missing (as in "pressure": "6 bar")"#,
    ),
    part!(
        "cylinder whose rod is as thick as its bore",
        r#"{ "type": "cylinder", "between": ["ground.Q", "coupler.B"], "bore": 40, "rod": 40, "pressure": "6 bar" }"#,
        r#"line 29, column 92: forces.part.rod: 40: a rod of 40 mm is no thinner than the bore of 40 mm (both are diameters)"#,
    ),
    part!(
        "cylinder with a force",
        r#"{ "type": "cylinder", "between": ["ground.Q", "coupler.B"], "bore": 40, "force": "100 N", "pressure": "6 bar" }"#,
        r#"line 29, column 85: forces.part.force: "force": it follows from the pressures"#,
    ),
    part!(
        "cylinder whose pressure is a force",
        r#"{ "type": "cylinder", "between": ["ground.Q", "coupler.B"], "bore": 40, "pressure": "600 N" }"#,
        r#"line 29, column 97: forces.part.pressure: "600 N": "N" is not a unit of stress (such as "Pa")"#,
    ),
    part!(
        "cylinder whose pressure is a formula of a force",
        r#"{ "type": "cylinder", "between": ["ground.Q", "coupler.B"], "bore": 40, "pressure": "=600 N*cos(crank.angle)" }"#,
        r#"line 29, column 97: forces.part.pressure: "=600 N*cos(crank.angle)": this is a force [N], where a stress [Pa] is wanted (its factors carry units, as in -0.5 N*s/m * slider.vx)"#,
    ),
    part!(
        "cylinder without a bore",
        r#"{ "type": "cylinder", "between": ["ground.Q", "coupler.B"], "bore": 0, "pressure": "6 bar" }"#,
        r#"line 29, column 81: forces.part.bore: 0: must be greater than 0"#,
    ),
    part!(
        "cylinder whose pressure is a table without points",
        r#"{ "type": "cylinder", "between": ["ground.Q", "coupler.B"], "bore": 40, "pressure": { "of": "crank.angle", "points": [] } }"#,
        r#"line 29, column 130: forces.part.pressure.points: a table has 2 to 100000 points, this one has 0 (as in [["0 deg", "30 bar"], ["90 deg", "5 bar"]])"#,
    ),
    part!(
        "motor without a winding",
        r#"{ "type": "dc_motor", "body": "crank", "voltage": "24 V", "torque_constant": "25 mN*m/A" }"#,
        r#"line 29, column 13: forces.part: "resistance" is missing (as in "resistance": "0.6 ohm")"#,
    ),
    part!(
        "motor with a voltage in newtons",
        r#"{ "type": "dc_motor", "body": "crank", "voltage": "24 N", "torque_constant": "25 mN*m/A", "resistance": "0.6 ohm" }"#,
        r#"line 29, column 63: forces.part.voltage: "24 N": "N" is not a unit of voltage (such as "V")"#,
    ),
    part!(
        "motor without a gear",
        r#"{ "type": "dc_motor", "body": "crank", "voltage": "24 V", "torque_constant": "25 mN*m/A", "resistance": "0.6 ohm", "gear": 0 }"#,
        r#"line 29, column 136: forces.part.gear: 0: must not be zero"#,
    ),
    part!(
        "motor with an inductance in inverse dynamics",
        r#"{ "type": "dc_motor", "body": "crank", "voltage": "24 V", "torque_constant": "25 mN*m/A", "resistance": "0.6 ohm", "inductance": "2 mH" }"#,
        r#"line 29, column 142: forces.part.inductance: "2 mH": the current is integrated in a free motion, and drivers prescribe this one (leave it out: the current is then the steady one, or take "dynamics")"#,
    ),
    part!(
        "motor with the inertia of its rotor",
        r#"{ "type": "dc_motor", "body": "crank", "voltage": "24 V", "torque_constant": "25 mN*m/A", "resistance": "0.6 ohm", "inertia": 5 }"#,
        r#"line 29, column 128: forces.part.inertia: "inertia": add g²·J of the rotor to the "inertia" of the body that it turns"#,
    ),
    part!(
        "motor with a value",
        r#"{ "type": "dc_motor", "body": "crank", "voltage": "24 V", "torque_constant": "25 mN*m/A", "resistance": "0.6 ohm", "value": 5 }"#,
        r#"line 29, column 128: forces.part.value: "value": it follows from the voltage"#,
    ),
    part!(
        "motor of a body that is not there",
        r#"{ "type": "dc_motor", "body": "krank", "voltage": "24 V", "torque_constant": "25 mN*m/A", "resistance": "0.6 ohm" }"#,
        r#"line 29, column 43: forces.part.body: "krank": there is no body "krank" (did you mean "crank"?)"#,
    ),
    part!(
        "motor by its words of another maker",
        r#"{ "type": "motor", "body": "crank", "voltage": "24 V" }"#,
        r#"line 29, column 23: forces.part.type: "motor": unknown type (one of "spring", "actuator", "gas_spring", "cylinder", "dc_motor", "cable", "torsion_spring", "force" or "torque")"#,
    ),
];
