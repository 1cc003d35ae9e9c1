//! Cross-sections.

use super::Case;

pub const CASES: &[Case] = &[
    Case {
        what: "cross-section without type",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "material": "steel" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 73: bodies.crank.section: "type" is missing (one of "rectangle", "circle", "tube" or "general")"#,
        ],
    },
    Case {
        what: "cross-section of no kind",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "rectangel", "width": 8, "height": 12 },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 107: bodies.crank.section.type: "rectangel": unknown type (did you mean "rectangle"?)"#,
        ],
    },
    Case {
        what: "rectangle without height",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "rectangle", "width": 8, "material": "steel" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 73: bodies.crank.section: "height" is missing (as in "height": "12 mm")"#,
        ],
    },
    Case {
        what: "cross-section by nothing but its type",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "general", "material": "steel" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 73: bodies.crank.section: "area" is missing (as in "area": "2 cm^2")"#,
            r#"line 8, column 73: bodies.crank.section: "second_moment" is missing (as in "second_moment": "0.8 cm^4")"#,
            r#"line 8, column 73: bodies.crank.section: "section_modulus" is missing (as in "section_modulus": "0.7 cm^3")"#,
        ],
    },
    Case {
        what: "cross-section of negative width and no height",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "rectangle", "width": -8, "height": 0, "material": "steel" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 129: bodies.crank.section.width: -8: must be greater than 0"#,
            r#"line 8, column 143: bodies.crank.section.height: 0: must be greater than 0"#,
        ],
    },
    Case {
        what: "wall thicker than half the tube",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "tube", "diameter": 10, "wall": 6, "material": "steel" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 139: bodies.crank.section.wall: 6: the wall is thicker than half the diameter (a full bar is a "circle")"#,
        ],
    },
    Case {
        what: "unknown end of an axis",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "B", "type": "rectangle", "width": "8 mm", "height": "12 mm" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 94: bodies.crank.section.to: "B": the body has no point "B" (its points: O, A)"#,
        ],
    },
    Case {
        what: "axis of one point",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "A", "to": "A", "type": "rectangle", "width": "8 mm", "height": "12 mm" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 94: bodies.crank.section.to: "A": the axis begins and ends at "A" (give two points apart from each other, between which the link is straight)"#,
        ],
    },
    Case {
        what: "axis without an end",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "type": "rectangle", "width": "8 mm", "height": "12 mm" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 73: bodies.crank.section: "to" is missing (as in "to": "B")"#,
        ],
    },
    Case {
        what: "one station",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "rectangle", "width": "8 mm", "height": "12 mm", "stations": 1 },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 168: bodies.crank.section.stations: 1: must not be less than 2"#,
        ],
    },
    Case {
        what: "half a station",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "rectangle", "width": "8 mm", "height": "12 mm", "stations": 2.5 },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 168: bodies.crank.section.stations: 2.5: a whole number is expected"#,
        ],
    },
    Case {
        what: "material misspelt",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "rectangle", "width": "8 mm", "height": "12 mm", "material": "aluminum" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 168: bodies.crank.section.material: "aluminum": unknown material (did you mean "aluminium"?)"#,
        ],
    },
    Case {
        what: "unknown material",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "rectangle", "width": "8 mm", "height": "12 mm", "material": "wood" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 168: bodies.crank.section.material: "wood": unknown material (one of "steel", "stainless_steel", "aluminium", "titanium", "brass", "cast_iron", "pom" or "pa6")"#,
        ],
    },
    Case {
        what: "material and density",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "rectangle", "width": "8 mm", "height": "12 mm", "material": "steel", "density": 7850 },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 188: bodies.crank.section.density: 7850: the "material" has its own density (give either the material, or "young_modulus" and "density")"#,
        ],
    },
    Case {
        what: "material and modulus",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "rectangle", "width": "8 mm", "height": "12 mm", "material": "steel", "young_modulus": "210 GPa" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 194: bodies.crank.section.young_modulus: "210 GPa": the "material" has its own young_modulus (give either the material, or "young_modulus" and "density")"#,
        ],
    },
    Case {
        what: "bar heavier than its body",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "circle", "diameter": 50, "material": "steel" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 73: bodies.crank.section: a bar of this cross-section weighs 1.5413 kg, more than the body's 0.8 kg (correct the dimensions, the material or the body's "mass")"#,
        ],
    },
    Case {
        what: "dimension of another kind",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "general", "area": "2 cm", "second_moment": "3 cm^4", "section_modulus": "1 cm^3", "density": "7.85 N" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 126: bodies.crank.section.area: "2 cm": "cm" is not a unit of area (such as "m^2")"#,
            r#"line 8, column 201: bodies.crank.section.density: "7.85 N": "N" is not a unit of density (such as "kg/m^3")"#,
        ],
    },
    Case {
        what: "mass that cannot be spread",
        edits: &[(
            r#""com": [50, 0],"#,
            r#""com": [40, 0], "section": { "from": "O", "to": "A", "type": "rectangle", "width": "8 mm", "height": "12 mm" },"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 8, column 73: bodies.crank.section: the mass cannot be spread evenly along the axis, as the centre of mass is not in its middle (give a "material" or a "density": what the bar does not have is then a lump at its own centre of mass)"#,
        ],
    },
    Case {
        what: "axis without length",
        edits: &[
            (
                r#""com": [50, 0],"#,
                r#""com": [50, 0], "section": { "from": "O", "to": "A", "type": "rectangle", "width": "8 mm", "height": "12 mm" },"#,
            ),
            (r#""A": [100, 0] }, "pose""#, r#""A": [0, 0] }, "pose""#),
        ],
        sets: &[],
        complaints: &[
            r#"line 8, column 94: bodies.crank.section.to: "A": the axis has no length: "O" and "A" are in the same place (give two points apart from each other, between which the link is straight)"#,
        ],
    },
    Case {
        what: "cross-section of ground",
        edits: &[(
            r#""Q": [300, 0] } }"#,
            r#""Q": [300, 0] }, "section": { "from": "O", "to": "Q", "type": "rectangle", "width": "8 mm", "height": "12 mm" } }"#,
        )],
        sets: &[],
        complaints: &[
            r#"line 7, column 59: bodies.ground.section: "section": ground is fixed, what it carries inside is not computed: give the section to a body joined to it by a fixed joint"#,
        ],
    },
];
