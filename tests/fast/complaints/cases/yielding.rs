//! Belts and bushings.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "belt without radii",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "belt", "between": ["crank.O", "rocker.Q"], "pretension": "200 N" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 10: joints.g: "radii" is missing (of both bodies, as in "radii": ["30 mm", "60 mm"])"#,
        ],
    },
    Case {
        what: "belt with a radius that is zero and a negative pretension",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "belt", "between": ["crank.O", "rocker.Q"], "radii": ["30 mm", 0], "pretension": "-200 N" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 83: joints.g.radii[1]: 0: must be greater than 0"#,
            r#"line 21, column 101: joints.g.pretension: "-200 N": must not be negative"#,
        ],
    },
    Case {
        what: "belt with damping that does not stretch, with limits",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "belt", "between": ["crank.O", "rocker.Q"], "radii": ["30 mm", "60 mm"], "damping": "2 N*s/m", "limits": [0, 1] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 104: joints.g.damping: "2 N*s/m": "stiffness" is missing: a belt with damping stretches (give the stiffness of a strand, as in "stiffness": "50 N/mm")"#,
            r#"line 21, column 115: joints.g.limits: "limits": a belt turns without end: give limits to the revolute joints of its pulleys"#,
        ],
    },
    Case {
        what: "belt whose strands run otherwise",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "belt", "between": ["crank.O", "rocker.Q"], "radii": ["30 mm", "60 mm"], "strands": "twisted" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 104: joints.g.strands: "twisted": unknown strands (one of "open" or "crossed")"#,
        ],
    },
    Case {
        what: "belt of pulleys that no body holds",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "belt", "between": ["crank.A", "rocker.Q"], "radii": ["30 mm", "60 mm"] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 39: joints.g.between: no third body holds both crank.A and rocker.Q (pin both pulleys to one body, or name as "carrier" the body in which the line between them turns by less than half a turn)"#,
        ],
    },
    Case {
        what: "belt on one body",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "belt", "between": ["crank.A", "crank.O"], "radii": ["30 mm", "60 mm"], "carrier": "ground" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 39: joints.g.between: both points are of "crank" (a joint connects two bodies)"#,
        ],
    },
    Case {
        what: "belt with a radius too much, and a carrier that is not there",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "belt", "between": ["crank.O", "rocker.Q"], "radii": ["30 mm", "60 mm", 3], "carrier": "frame" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 73: joints.g.radii: a list of 2 is expected, this one has 3"#,
            r#"line 21, column 107: joints.g.carrier: "frame": there is no body "frame" (the bodies: ground, crank, coupler, rocker, slider)"#,
        ],
    },
    Case {
        what: "bushing without stiffness",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "bushing", "between": ["crank.O", "rocker.Q"] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 10: joints.g: "radial_stiffness" is missing (as in "radial_stiffness": "800 N/mm", or "radial_stiffness": ["800 N/mm", "200 N/mm"] along x and y of the first body)"#,
        ],
    },
    Case {
        what: "bushing that does not resist, along one axis and in damping",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "bushing", "between": ["crank.O", "rocker.Q"], "radial_stiffness": ["800 N/mm", 0], "radial_damping": -3, "torsional_stiffness": "-2 N*m/rad" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 100: joints.g.radial_stiffness[1]: 0: must be greater than 0"#,
            r#"line 21, column 122: joints.g.radial_damping: -3: must not be negative"#,
            r#"line 21, column 149: joints.g.torsional_stiffness: "-2 N*m/rad": must not be negative"#,
        ],
    },
    Case {
        what: "bushing with three axes",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "bushing", "between": ["crank.O", "rocker.Q"], "radial_stiffness": ["800 N/mm", "200 N/mm", "1 N/mm"] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 87: joints.g.radial_stiffness: a list of 2 is expected, this one has 3"#,
        ],
    },
    Case {
        what: "bushing with the words of a spring, and limits",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "bushing", "between": ["crank.O", "rocker.Q"], "stiffness": "800 N/mm", "damping": 3, "limits": [0, 1], "radial_stiffness": "800 N/mm" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 67: joints.g.stiffness: "stiffness": a bushing has two: "radial_stiffness" and "torsional_stiffness""#,
            r#"line 21, column 92: joints.g.damping: "damping": a bushing has two: "radial_damping" and "torsional_damping""#,
            r#"line 21, column 106: joints.g.limits: "limits": a bushing yields without end; a "revolute" joint has limits"#,
        ],
    },
    Case {
        what: "bushing of other dimensions",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "bushing", "between": ["crank.O", "rocker.Q"], "radial_stiffness": "3 N*m/rad", "torsional_stiffness": "800 N/mm", "free_angle": "3 mm" }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 87: joints.g.radial_stiffness: "3 N*m/rad": "N*m/rad" is not a unit of stiffness (such as "N/m")"#,
            r#"line 21, column 123: joints.g.torsional_stiffness: "800 N/mm": "N/mm" is not a unit of angular stiffness (such as "N*m/rad")"#,
            r#"line 21, column 149: joints.g.free_angle: "3 mm": "mm" is not a unit of angle (such as "rad")"#,
        ],
    },
    Case {
        what: "bushing with clearance and friction",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "bushing", "between": ["crank.O", "rocker.Q"], "radial_stiffness": "800 N/mm", "clearance": {}, "friction": {} }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 99: joints.g.clearance: "clearance": only a revolute joint can have clearance"#,
            r#"line 21, column 116: joints.g.friction: "friction": only revolute and prismatic joints can have friction"#,
        ],
    },
    Case {
        what: "beam without a section",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "beam", "between": ["crank.O", "rocker.Q"] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 10: joints.g: "section" is missing (as in "section": { "type": "rectangle", "width": "20 mm", "height": "1 mm", "material": "steel" })"#,
        ],
    },
    Case {
        what: "beam of nothing",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "beam", "between": ["crank.O", "rocker.Q"], "section": { "type": "circle", "diameter": 3 } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 10: joints.g: the beam has no length: both points are in the same place as drawn (give its "length", and the "angles" of its ends in both bodies, or draw the bodies apart by their "pose")"#,
            r#"line 21, column 75: joints.g.section: it is not known what the beam is made of (add "material": "steel", or "young_modulus": "210 GPa")"#,
        ],
    },
    Case {
        what: "beam of two materials",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "beam", "between": ["crank.O", "rocker.Q"], "length": 80, "section": { "type": "circle", "diameter": 3, "material": "steel", "young_modulus": "200 GPa" } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 162: joints.g.section.young_modulus: "200 GPa": the "material" has its own young_modulus (give either the material, or "young_modulus")"#,
        ],
    },
    Case {
        what: "beam of an unknown shape",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "beam", "between": ["crank.O", "rocker.Q"], "section": { "type": "square", "width": 3, "material": "steel" } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 85: joints.g.section.type: "square": unknown type (one of "rectangle", "circle", "tube" or "general")"#,
        ],
    },
    Case {
        what: "beam with a thick wall",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "beam", "between": ["crank.O", "rocker.Q"], "length": 80, "section": { "type": "tube", "diameter": 3, "wall": 2, "material": "steel" } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 130: joints.g.section.wall: 2: the wall is thicker than half the diameter (a full bar is a "circle")"#,
        ],
    },
    Case {
        what: "beam without width",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "beam", "between": ["crank.O", "rocker.Q"], "section": { "type": "rectangle", "height": 3, "material": "steel" } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 75: joints.g.section: "width" is missing (as in "width": "20 mm")"#,
        ],
    },
    Case {
        what: "beam of an impossible material",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "beam", "between": ["crank.O", "rocker.Q"], "section": { "type": "circle", "diameter": 3, "material": "steel", "poisson_ratio": 0.7 } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 148: joints.g.section.poisson_ratio: 0.7: must not be greater than 0.5"#,
        ],
    },
    Case {
        what: "beam with the words of a spring",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "beam", "between": ["crank.O", "rocker.Q"], "length": 80, "section": { "type": "circle", "diameter": 3, "material": "steel" }, "stiffness": 3, "damping": 1, "limits": [0, 1] }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 147: joints.g.stiffness: "stiffness": the "section" of a beam has its stiffness"#,
            r#"line 21, column 163: joints.g.damping: "damping": a beam has a "damping_time", by which its stiffness is multiplied"#,
            r#"line 21, column 177: joints.g.limits: "limits": a beam yields without end; a "revolute" joint has limits"#,
        ],
    },
    Case {
        what: "beam of negative length and damping",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "beam", "between": ["crank.O", "rocker.Q"], "section": { "type": "circle", "diameter": 3, "material": "steel" }, "length": -1, "damping_time": -2 }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 143: joints.g.length: -1: must be greater than 0"#,
            r#"line 21, column 163: joints.g.damping_time: -2: must not be negative"#,
        ],
    },
    Case {
        what: "beam with the material of a link's bar",
        edits: &[(
            r#""axis": [1, 0] }"#,
            r#""axis": [1, 0] },
    "g": { "type": "beam", "between": ["crank.O", "rocker.Q"], "length": 80, "section": { "type": "circle", "diameter": 3, "material": "steel", "density": 7800 } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 21, column 145: joints.g.section.density: "density": unknown key (known keys: type, diameter, material, young_modulus, poisson_ratio, note)"#,
        ],
    },
];
