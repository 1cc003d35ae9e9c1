//! Writes the curves that `path` begins with: `cargo run --release -p linkdyn-synthesis --example curves -- FILE`.

use std::{env, fs};

fn main() -> std::io::Result<()> {
    let file = env::args().nth(1).expect("a file");
    let all = linkdyn_synthesis::path::all_of_random_points(&mut |count| println!("{count}"));
    let floats = all
        .iter()
        .flatten()
        .flat_map(|z| [z.re as f32, z.im as f32]);
    fs::write(file, floats.flat_map(f32::to_le_bytes).collect::<Vec<u8>>())
}
