//! Elastic links.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "elastic ground",
        edits: &[(
            r#""Q": [300, 0] } }"#,
            r#""Q": [300, 0] }, "elastic": { "from": "O", "to": "Q", "section": { "type": "circle", "diameter": 6 }, "material": "steel" } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 7, column 59: bodies.ground.elastic: "elastic": ground is rigid and fixed: give it to a body joined to it by a fixed joint"#,
        ],
    },
    Case {
        what: "elastic link of nothing",
        edits: &[(r#""coupler": { "#, r#""coupler": { "elastic": {}, "#)],
        sets: &[],
        complaints: &[
            r#"line 10, column 29: bodies.coupler.elastic: "from" is missing (as in "from": "A")"#,
            r#"line 10, column 29: bodies.coupler.elastic: "to" is missing (as in "to": "B")"#,
            r#"line 10, column 29: bodies.coupler.elastic: "section" is missing (how stiff it is: by a "section" and a "material", by "bending_stiffness" and "mass_per_length", or by "modal" data)"#,
        ],
    },
    Case {
        what: "elastic link without any key that it has",
        edits: &[(r#""coupler": { "#, r#""coupler": { "elastic": true, "#)],
        sets: &[],
        complaints: &[
            r#"line 10, column 29: bodies.coupler.elastic: true: an object is expected, not true or false (as in "elastic": { "from": "A", "to": "B", "section": { "type": "rectangle", "width": "8 mm", "height": "8 mm" }, "material": "steel" })"#,
        ],
    },
    Case {
        what: "elastic link with the words of a surface",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "young_modulus": "207 GPa", "poisson_ratio": 0.3 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 29: bodies.coupler.elastic: "from" is missing (as in "from": "A")"#,
            r#"line 10, column 29: bodies.coupler.elastic: "to" is missing (as in "to": "B")"#,
            r#"line 10, column 29: bodies.coupler.elastic: "section" is missing (how stiff it is: by a "section" and a "material", by "bending_stiffness" and "mass_per_length", or by "modal" data)"#,
            r#"line 10, column 59: bodies.coupler.elastic.poisson_ratio: "poisson_ratio": unknown key (known keys: from, to, section, material, young_modulus, density, bending_stiffness, axial_stiffness, mass_per_length, modal, modes, elements, frame, axial, cracks, foreshortening, damping, amplitudes, rates, note)"#,
        ],
    },
    Case {
        what: "elastic link to a point that is not there",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "a", "to": "C", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 39: bodies.coupler.elastic.from: "a": the body has no point "a" (did you mean "A"? its points: A, B)"#,
            r#"line 10, column 50: bodies.coupler.elastic.to: "C": the body has no point "C" (its points: A, B)"#,
        ],
    },
    Case {
        what: "elastic link from a point to itself",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "A", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 50: bodies.coupler.elastic.to: "A": the axis begins and ends at "A" (give two points apart from each other, between which the link is straight)"#,
        ],
    },
    Case {
        what: "elastic link between two points in one place",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
            ),
            (r#""B": [250, 0]"#, r#""B": [0, 0]"#),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 50: bodies.coupler.elastic.to: "B": the axis has no length: "A" and "B" are in the same place (give two points apart from each other, between which the link is straight)"#,
        ],
    },
    Case {
        what: "elastic link of no material",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 } }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 29: bodies.coupler.elastic: it is not known what the link is made of: "young_modulus" is missing (add "material": "steel", or "young_modulus": "210 GPa" and "density": "7850 kg/m^3")"#,
        ],
    },
    Case {
        what: "elastic link without density",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "young_modulus": "70 GPa" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 29: bodies.coupler.elastic: it is not known what the link is made of: "density" is missing (add "material": "steel", or "young_modulus": "210 GPa" and "density": "7850 kg/m^3")"#,
        ],
    },
    Case {
        what: "elastic link of a material with a density",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "density": 7800 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 135: bodies.coupler.elastic.density: 7800: the "material" has its own density (give either the material, or "young_modulus" and "density")"#,
        ],
    },
    Case {
        what: "elastic link of two stiffnesses",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "bending_stiffness": "13 N*m^2" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 145: bodies.coupler.elastic.bending_stiffness: "13 N*m^2": "section" and "bending_stiffness" exclude each other (keep one of them)"#,
        ],
    },
    Case {
        what: "elastic link of a cross-section and of its numbers",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "axial_stiffness": "6e6 N", "mass_per_length": "0.2 kg/m" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 143: bodies.coupler.elastic.axial_stiffness: "6e6 N": beside "section" there is no "axial_stiffness" (leave it out: it follows from the cross-section and from what the link is made of)"#,
            r#"line 10, column 171: bodies.coupler.elastic.mass_per_length: "0.2 kg/m": beside "section" there is no "mass_per_length" (leave it out: it follows from the cross-section and from what the link is made of)"#,
        ],
    },
    Case {
        what: "elastic link of no stiffness",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "material": "steel" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 29: bodies.coupler.elastic: "section" is missing (how stiff it is: by a "section" and a "material", by "bending_stiffness" and "mass_per_length", or by "modal" data)"#,
        ],
    },
    Case {
        what: "elastic link of a stiffness and a material",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "bending_stiffness": 13, "mass_per_length": 0.2, "material": "steel", "density": 7850 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 116: bodies.coupler.elastic.material: "steel": beside "bending_stiffness" there is no "material" (give "mass_per_length" and, where it stretches, "axial_stiffness"; or a "section" instead of "bending_stiffness")"#,
            r#"line 10, column 136: bodies.coupler.elastic.density: 7850: beside "bending_stiffness" there is no "density" (give "mass_per_length" and, where it stretches, "axial_stiffness"; or a "section" instead of "bending_stiffness")"#,
        ],
    },
    Case {
        what: "elastic link of a stiffness without mass",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "bending_stiffness": 13 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 29: bodies.coupler.elastic: "mass_per_length" is missing beside "bending_stiffness" (as in "mass_per_length": "0.5 kg/m")"#,
        ],
    },
    Case {
        what: "elastic link that stretches without a stiffness",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "bending_stiffness": 13, "mass_per_length": 0.2, "axial": true }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 29: bodies.coupler.elastic: "axial_stiffness" is missing for a link that stretches (as in "axial_stiffness": "1e7 N")"#,
        ],
    },
    Case {
        what: "elastic elements without a stiffness along them",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "bending_stiffness": 13, "mass_per_length": 0.2, "elements": 8 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 29: bodies.coupler.elastic: "axial_stiffness" is missing for a link that stretches (as in "axial_stiffness": "1e7 N")"#,
        ],
    },
    Case {
        what: "elastic link of other dimensions",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "bending_stiffness": "13 N*m", "axial_stiffness": "3 N/m", "mass_per_length": "0.2 kg" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 76: bodies.coupler.elastic.bending_stiffness: "13 N*m": "N*m" is not a unit of bending stiffness (such as "N*m^2")"#,
            r#"line 10, column 105: bodies.coupler.elastic.axial_stiffness: "3 N/m": "N/m" is not a unit of force (such as "N")"#,
            r#"line 10, column 133: bodies.coupler.elastic.mass_per_length: "0.2 kg": "kg" is not a unit of line density (such as "kg/m")"#,
        ],
    },
    Case {
        what: "elastic link without modes",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "modes": 0 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 133: bodies.coupler.elastic.modes: 0: must not be less than 1"#,
        ],
    },
    Case {
        what: "elastic link of too many modes",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "modes": 40 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 133: bodies.coupler.elastic.modes: 40: must not be greater than 12"#,
        ],
    },
    Case {
        what: "elastic link without elements",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "elements": 0 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 136: bodies.coupler.elastic.elements: 0: must not be less than 1"#,
        ],
    },
    Case {
        what: "elastic link of modes and elements",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "modes": 2, "elements": 8 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 133: bodies.coupler.elastic.modes: 2: a chain of elements has no "modes" (elements bend and stretch between nodes with places of their own; leave it out, or give "modes" instead of "elements")"#,
        ],
    },
    Case {
        what: "elastic elements in a frame, that stretch and come closer",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "elements": 8, "frame": "chord", "axial": true, "foreshortening": false }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 148: bodies.coupler.elastic.frame: "chord": a chain of elements has no "frame" (elements bend and stretch between nodes with places of their own; leave it out, or give "modes" instead of "elements")"#,
            r#"line 10, column 166: bodies.coupler.elastic.axial: true: a chain of elements has no "axial" (elements bend and stretch between nodes with places of their own; leave it out, or give "modes" instead of "elements")"#,
            r#"line 10, column 190: bodies.coupler.elastic.foreshortening: false: a chain of elements has no "foreshortening" (elements bend and stretch between nodes with places of their own; leave it out, or give "modes" instead of "elements")"#,
        ],
    },
    Case {
        what: "elastic elements with amplitudes",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "elements": 8, "amplitudes": [1], "rates": [0] }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 153: bodies.coupler.elastic.amplitudes: a chain of elements has no "amplitudes" (elements bend and stretch between nodes with places of their own; leave it out, or give "modes" instead of "elements")"#,
            r#"line 10, column 167: bodies.coupler.elastic.rates: a chain of elements has no "rates" (elements bend and stretch between nodes with places of their own; leave it out, or give "modes" instead of "elements")"#,
        ],
    },
    Case {
        what: "elastic link without amplitudes and with a rate of another dimension",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "amplitudes": [], "rates": ["1 mm"] }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 138: bodies.coupler.elastic.amplitudes: a list of at least 1 is expected, this one has 0"#,
            r#"line 10, column 152: bodies.coupler.elastic.rates[0]: "1 mm": "mm" is not a unit of velocity (such as "m/s")"#,
        ],
    },
    Case {
        what: "elastic link with an unknown frame",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "frame": "pinned" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 133: bodies.coupler.elastic.frame: "pinned": unknown frame (one of "chord" or "tangent")"#,
        ],
    },
    Case {
        what: "elastic link that stretches in words, and by a number",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "axial": "yes", "foreshortening": 0 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 133: bodies.coupler.elastic.axial: "yes": true or false is expected, not text (as in "axial": true)"#,
            r#"line 10, column 158: bodies.coupler.elastic.foreshortening: 0: true or false is expected, not a number (as in "foreshortening": false)"#,
        ],
    },
    Case {
        what: "elastic link with negative damping",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "damping": -0.01 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 135: bodies.coupler.elastic.damping: -0.01: must not be negative"#,
        ],
    },
    Case {
        what: "elastic link with the words of a beam",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "damping_time": "1 ms" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 124: bodies.coupler.elastic.damping_time: "damping_time": unknown key (did you mean "damping"?)"#,
        ],
    },
    Case {
        what: "elastic link of an unknown shape",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "square", "width": 6 }, "material": "steel" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 76: bodies.coupler.elastic.section.type: "square": unknown type (one of "rectangle", "circle", "tube" or "general")"#,
        ],
    },
    Case {
        what: "elastic link without height",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "rectangle", "width": 6 }, "material": "steel" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 66: bodies.coupler.elastic.section: "height" is missing (as in "height": "8 mm")"#,
        ],
    },
    Case {
        what: "elastic link with a thick wall",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "tube", "diameter": 6, "wall": 4 }, "material": "steel" }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 107: bodies.coupler.elastic.section.wall: 4: the wall is thicker than half the diameter (a full bar is a "circle")"#,
        ],
    },
    Case {
        what: "elastic link with a material in its cross-section",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6, "material": "steel" } }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 29: bodies.coupler.elastic: it is not known what the link is made of: "young_modulus" is missing (add "material": "steel", or "young_modulus": "210 GPa" and "density": "7850 kg/m^3")"#,
            r#"line 10, column 101: bodies.coupler.elastic.section.material: "material": unknown key (known keys: type, diameter, note)"#,
        ],
    },
    Case {
        what: "elastic link with a point beside it",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
            ),
            (r#""B": [250, 0]"#, r#""B": [250, 0], "P": [100, 40]"#),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 171: bodies.coupler.points.P: the point is 40 mm beside the axis of the elastic link (give it to a rigid body, which a fixed joint holds at a point of the axis)"#,
        ],
    },
    Case {
        what: "elastic link with points beyond its ends",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
            ),
            (
                r#""B": [250, 0]"#,
                r#""B": [250, 0], "P": [260, 0], "Q": [-0.1, 0]"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 171: bodies.coupler.points.P: the point is beyond the ends of the elastic link (give it to a rigid body, which a fixed joint holds at a point of the axis)"#,
            r#"line 10, column 186: bodies.coupler.points.Q: the point is beyond the ends of the elastic link (give it to a rigid body, which a fixed joint holds at a point of the axis)"#,
        ],
    },
    Case {
        what: "elastic link that weighs something else",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 3e-4, "com": [120, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 176: bodies.coupler.mass: 0.2: the elastic link weighs 0.05548838 kg, and not 0.2 kg (leave it out, or correct what the link is made of; further masses are bodies of their own, held by fixed joints)"#,
            r#"line 10, column 192: bodies.coupler.inertia: 3e-4: the elastic link has an inertia of 0.0002891268 kg·m², and not of 0.0003 kg·m² (leave it out, or correct what the link is made of; further masses are bodies of their own, held by fixed joints)"#,
            r#"line 10, column 205: bodies.coupler.com: it is 5 mm away from the middle of the elastic link (leave it out, or correct what the link is made of; further masses are bodies of their own, held by fixed joints)"#,
        ],
    },
    Case {
        what: "elastic link with a mass of its own, and no centre of mass",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.05549 }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 176: bodies.coupler.mass: 0.05549: the elastic link weighs 0.05548838 kg, and not 0.05549 kg (leave it out, or correct what the link is made of; further masses are bodies of their own, held by fixed joints)"#,
        ],
    },
    Case {
        what: "outline on an elastic link",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
            ),
            (
                r#""axis": [1, 0] }"#,
                r#""axis": [1, 0] },
    "g": { "type": "contact", "between": ["coupler.A", "slider.C"], "outline": [[0, 5], [250, 5]] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 21, column 43: joints.g.between[0]: "coupler.A": "coupler" is elastic, and would bend the outline (give the outline to a rigid body, which a fixed joint holds at a point of "coupler")"#,
        ],
    },
    Case {
        what: "cam on an elastic link",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
            ),
            (
                r#""axis": [1, 0] }"#,
                r#""axis": [1, 0] },
    "g": { "type": "cam", "between": ["coupler.A", "slider.C"], "follower": "knife", "profile": { "type": "circle", "radius": 20 } }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 21, column 39: joints.g.between[0]: "coupler.A": "coupler" is elastic, and would bend the profile (give the profile to a rigid body, which a fixed joint holds at a point of "coupler")"#,
        ],
    },
    Case {
        what: "modal data with all that a bar has",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "modal": { "mass": [[0.08]], "stiffness": [[13300]], "momentum": [[0, 0.1]], "radial": [0], "angular_momentum": [0.014] }, "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 1e-3, "com": [125, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 64: bodies.coupler.elastic.modal: "section" and "modal" exclude each other (keep one of them)"#,
        ],
    },
    Case {
        what: "modal data with the words of a bar",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "modal": { "mass": [[0.08]], "stiffness": [[13300]], "momentum": [[0, 0.1]], "radial": [0], "angular_momentum": [0.014] }, "density": 7800, "axial_stiffness": 1e6, "modes": 2, "frame": "chord", "axial": false, "foreshortening": true, "elements": 3 }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 1e-3, "com": [125, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 189: bodies.coupler.elastic.density: 7800: beside "modal" there is no "density" (leave it out: the matrices of "modal" say all of this)"#,
            r#"line 10, column 214: bodies.coupler.elastic.axial_stiffness: 1e6: beside "modal" there is no "axial_stiffness" (leave it out: the matrices of "modal" say all of this)"#,
            r#"line 10, column 228: bodies.coupler.elastic.modes: 2: beside "modal" there is no "modes" (leave it out: the matrices of "modal" say all of this)"#,
            r#"line 10, column 240: bodies.coupler.elastic.frame: "chord": beside "modal" there is no "frame" (leave it out: the matrices of "modal" say all of this)"#,
            r#"line 10, column 258: bodies.coupler.elastic.axial: false: beside "modal" there is no "axial" (leave it out: the matrices of "modal" say all of this)"#,
            r#"line 10, column 283: bodies.coupler.elastic.foreshortening: true: beside "modal" there is no "foreshortening" (leave it out: the matrices of "modal" say all of this)"#,
            r#"line 10, column 301: bodies.coupler.elastic.elements: 3: beside "modal" there is no "elements" (leave it out: the matrices of "modal" say all of this)"#,
        ],
    },
    Case {
        what: "modal data of nothing",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "modal": {} }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 1e-3, "com": [125, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 64: bodies.coupler.elastic.modal: "mass" is missing (in SI, as in "mass": [[0.08, 0], [0, 0.08]])"#,
            r#"line 10, column 64: bodies.coupler.elastic.modal: "stiffness" is missing (in SI, as in "stiffness": [[13300, 0], [0, 213000]])"#,
            r#"line 10, column 64: bodies.coupler.elastic.modal: "momentum" is missing (of two amplitudes, in SI, as in "momentum": [[0, 0.1], [0, 0]])"#,
            r#"line 10, column 64: bodies.coupler.elastic.modal: "radial" is missing (of two amplitudes, in SI, as in "radial": [0, 0])"#,
            r#"line 10, column 64: bodies.coupler.elastic.modal: "angular_momentum" is missing (of two amplitudes, in SI, as in "angular_momentum": [0.014, -0.007])"#,
        ],
    },
    Case {
        what: "modal data without amplitudes",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "modal": { "mass": [], "stiffness": [[]], "momentum": [], "radial": [], "angular_momentum": [] } }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 1e-3, "com": [125, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 74: bodies.coupler.elastic.modal.mass: a list of at least 1 is expected, this one has 0"#,
            r#"line 10, column 92: bodies.coupler.elastic.modal.stiffness[0]: a list of at least 1 is expected, this one has 0"#,
            r#"line 10, column 109: bodies.coupler.elastic.modal.momentum: a list of at least 1 is expected, this one has 0"#,
            r#"line 10, column 123: bodies.coupler.elastic.modal.radial: a list of at least 1 is expected, this one has 0"#,
            r#"line 10, column 147: bodies.coupler.elastic.modal.angular_momentum: a list of at least 1 is expected, this one has 0"#,
        ],
    },
    Case {
        what: "modal data of ragged matrices",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "modal": { "mass": [[1, 0], [0]], "stiffness": [[1, 0], [0, 1], [0, 0]], "momentum": [[0, 1], [0, 0]], "radial": [0, 0], "angular_momentum": [0, 0], "damping": [[1]], "gyroscopic": [[0, 1, 0], [0]] } }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 1e-3, "com": [125, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 74: bodies.coupler.elastic.modal.mass: the matrix is not 2 by 2 (all matrices have as many rows and columns as "mass" has rows)"#,
            r#"line 10, column 102: bodies.coupler.elastic.modal.stiffness: the matrix is not 2 by 2 (all matrices have as many rows and columns as "mass" has rows)"#,
            r#"line 10, column 215: bodies.coupler.elastic.modal.damping: the matrix is not 2 by 2 (all matrices have as many rows and columns as "mass" has rows)"#,
            r#"line 10, column 236: bodies.coupler.elastic.modal.gyroscopic: the matrix is not 2 by 2 (all matrices have as many rows and columns as "mass" has rows)"#,
        ],
    },
    Case {
        what: "modal data of matrices that are not symmetric",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "modal": { "mass": [[1, 0.2], [0.1, 1]], "stiffness": [[1, 2], [3, 1]], "momentum": [[0, 1], [0, 0]], "radial": [0, 0], "angular_momentum": [0, 0], "damping": [[1, 0], [1, 1]], "gyroscopic": [[0, 1], [1, 0]] } }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 1e-3, "com": [125, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 74: bodies.coupler.elastic.modal.mass: the matrix is not symmetric (entry [i][j] equals entry [j][i])"#,
            r#"line 10, column 109: bodies.coupler.elastic.modal.stiffness: the matrix is not symmetric (entry [i][j] equals entry [j][i])"#,
            r#"line 10, column 214: bodies.coupler.elastic.modal.damping: the matrix is not symmetric (entry [i][j] equals entry [j][i])"#,
            r#"line 10, column 246: bodies.coupler.elastic.modal.gyroscopic: the matrix is not antisymmetric (entry [i][j] is minus entry [j][i])"#,
        ],
    },
    Case {
        what: "modal data of lists that are too short and too long",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "modal": { "mass": [[0.08]], "stiffness": [[13300]], "momentum": [[0, 1], [0, 0]], "radial": [0, 0, 0], "angular_momentum": [0, 0], "points": { "B": { "displacement": [[0, 0], [0, 1]], "rotation": [1, 2, 3] } } } }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 1e-3, "com": [125, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 120: bodies.coupler.elastic.modal.momentum: a list of 1 is expected, this one has 2 (there is one amplitude for each row of "mass")"#,
            r#"line 10, column 148: bodies.coupler.elastic.modal.radial: a list of 1 is expected, this one has 3 (there is one amplitude for each row of "mass")"#,
            r#"line 10, column 179: bodies.coupler.elastic.modal.angular_momentum: a list of 1 is expected, this one has 2 (there is one amplitude for each row of "mass")"#,
            r#"line 10, column 222: bodies.coupler.elastic.modal.points.B.displacement: a list of 1 is expected, this one has 2 (there is one amplitude for each row of "mass")"#,
            r#"line 10, column 252: bodies.coupler.elastic.modal.points.B.rotation: a list of 1 is expected, this one has 3 (there is one amplitude for each row of "mass")"#,
        ],
    },
    Case {
        what: "modal data of points that are not there",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "modal": { "mass": [[0.08]], "stiffness": [[13300]], "momentum": [[0, 0.1]], "radial": [0], "angular_momentum": [0.014], "points": { "C": { "displacement": [[0, 0]], "rotation": [1] } } } }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 1e-3, "com": [125, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 193: bodies.coupler.elastic.modal.points.C: the body has no point "C" (its points: A, B)"#,
        ],
    },
    Case {
        what: "modal data of a point that does not turn",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "modal": { "mass": [[0.08]], "stiffness": [[13300]], "momentum": [[0, 0.1]], "radial": [0], "angular_momentum": [0.014], "points": { "B": { "displacement": [[0]] } } } }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 1e-3, "com": [125, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 193: bodies.coupler.elastic.modal.points.B: "rotation" is missing (of two amplitudes, as in "rotation": [-10.5, 21])"#,
            r#"line 10, column 212: bodies.coupler.elastic.modal.points.B.displacement[0]: a list of 2 is expected, this one has 1"#,
        ],
    },
    Case {
        what: "modal data without mass",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "modal": { "mass": [[0.08]], "stiffness": [[13300]], "momentum": [[0, 0.1]], "radial": [0], "angular_momentum": [0.014] } }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 16: bodies.coupler: "mass" is missing beside the modal data (give mass, inertia and centre of mass of the body where it is not deflected)"#,
            r#"line 10, column 16: bodies.coupler: "inertia" is missing beside the modal data (give mass, inertia and centre of mass of the body where it is not deflected)"#,
        ],
    },
    Case {
        what: "modal data from a point to itself",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "A", "modal": { "mass": [[0.08]], "stiffness": [[13300]], "momentum": [[0, 0.1]], "radial": [0], "angular_momentum": [0.014] } }, "#,
            ),
            (
                r#""B": [250, 0] } }"#,
                r#""B": [250, 0] }, "mass": 0.2, "inertia": 1e-3, "com": [125, 0] }"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 10, column 50: bodies.coupler.elastic.to: "A": the axis begins and ends at "A" (give two points apart from each other, between which the link is straight)"#,
        ],
    },
    Case {
        what: "response of a section that is not there, and of one that is",
        edits: &[
            (
                r#""coupler": { "#,
                r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "#,
            ),
            (
                r#""points": ["coupler.B"],"#,
                r#""points": ["coupler.B"],
  "responses": { "c": { "value": "max(coupler.section_C.x) + max(coupler.section_B.x)" }, "q": { "value": "max(abs(coupler.q1)) + max(coupler.q1_rate)*1 s" }, "n": { "value": "max(coupler.node1.x)" } },"#,
            ),
        ],
        sets: &[],
        complaints: &[
            r#"line 32, column 39: responses.c.value: "max(coupler.section_C.x) + max(coupler.section_B.x)": there is no column, parameter or number "coupler.section_C.x" (did you mean "coupler.section_A.x"?)"#,
            r#"line 32, column 181: responses.n.value: "max(coupler.node1.x)": there is no column, parameter or number "coupler.node1.x" (did you mean "coupler.omega"?)"#,
        ],
    },
    Case {
        what: "internal forces of a chain of elements",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "elements": 8 }, "section": { "from": "A", "to": "B", "type": "circle", "diameter": 6 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 152: bodies.coupler.section: the internal forces of a chain of elements are not computed (leave out "section", or describe the elastic link by a cross-section and "modes")"#,
        ],
    },
    Case {
        what: "internal forces along another axis than that of the elastic link",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel" }, "section": { "from": "B", "to": "A", "type": "circle", "diameter": 6 }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 137: bodies.coupler.section: the axis of "section" is not that of "elastic" (give both the same "from" and "to")"#,
        ],
    },
    Case {
        what: "cracks in a circle, and beyond the end",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "circle", "diameter": 6 }, "material": "steel", "cracks": [{ "at": 900, "depth": 0.2 }] }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 134: bodies.coupler.elastic.cracks: how much a crack yields is known of a rectangle alone (give the "section" as a "rectangle")"#,
            r#"line 10, column 143: bodies.coupler.elastic.cracks[0].at: 900: the link ends at 250 mm (give the place of the crack between both ends)"#,
        ],
    },
    Case {
        what: "crack deeper than is known of, and without a place",
        edits: &[(
            r#""coupler": { "#,
            r#""coupler": { "elastic": { "from": "A", "to": "B", "section": { "type": "rectangle", "width": 6, "height": 6 }, "material": "steel", "cracks": [{ "at": 90, "depth": 0.7 }, { "depth": 0.1 }] }, "#,
        )],
        sets: &[],
        complaints: &[
            r#"line 10, column 169: bodies.coupler.elastic.cracks[0].depth: 0.7: must not be greater than 0.6"#,
            r#"line 10, column 176: bodies.coupler.elastic.cracks[1]: "at" is missing (as in "at": "60 mm")"#,
        ],
    },
];
