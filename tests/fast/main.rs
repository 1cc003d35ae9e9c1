//! Tests of the library: laws, closed forms, messages, architecture. Each takes less than a second or two.
//!
//! `cargo test --test fast` is the loop of whoever edits the engine.

// The benches use the rest.
#[allow(dead_code)]
#[path = "../common/benchmarks.rs"]
mod benchmarks;
#[path = "../common/linkage.rs"]
mod linkage;
#[path = "../common/long.rs"]
mod long;
#[path = "../common/mechanisms.rs"]
mod mechanisms;
#[path = "../common/models.rs"]
mod models;
#[path = "../common/ode.rs"]
mod ode;
#[path = "../common/rigid.rs"]
mod rigid;
#[path = "../common/row.rs"]
mod row;
#[path = "../common/transform.rs"]
mod transform;
#[path = "../common/write.rs"]
mod write;

mod accuracy;
mod acting;
mod admission;
mod allocate;
mod allocations;
mod architecture;
mod assemblies;
mod assembly;
mod beams;
mod belts;
mod bundled;
mod bushings;
mod cable;
mod cams;
mod complaints;
mod complaints_clearance;
mod contact;
mod crossing;
mod departures;
mod dynamics;
mod edits;
mod elastic;
mod extremes;
mod face;
mod family;
mod flat_start;
mod fly_bys;
mod formulas;
mod golden;
mod gradients;
mod impacts;
mod integrate;
mod interrupt;
mod jacobian;
mod joint_friction;
mod joints;
mod laws;
mod lengths;
mod measures;
mod outlines;
mod outputs;
mod parts;
mod racks;
mod responses;
mod robots;
mod rolling;
mod schema;
mod sections;
mod several_freedoms;
mod shaking;
mod side_by_side;
mod similarity;
mod simulation;
mod singular;
mod starts;
mod state_space;
mod states;
mod statics;
mod sticking;
mod stops;
mod synthesis;
mod tables;
mod timed;
mod transmission;
mod unbounded;
