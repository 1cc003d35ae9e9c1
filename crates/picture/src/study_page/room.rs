//! How much a page has room for.

/// Variants that are drawn, at most: more points than that are one blot.
const MOST_ROWS: usize = 20_000;
/// Variants that can be played, at most.
const MOST_MOTIONS: usize = 200;
/// Bytes that numbers of variants may take, before base64 makes a third more of them, and those of motions.
const ROOM_ROWS: usize = 2_000_000;
const ROOM_MOTIONS: usize = 900_000;
/// Size of a number \[bytes\].
const BYTES: usize = 4;
/// Columns of a row besides its values: its number in two parts, and its reason.
const OWN: usize = 3;
/// More instants than this look like a continuous motion.
const MOST_INSTANTS: usize = 121;
/// With fewer instants a motion jerks.
const FEWEST_INSTANTS: usize = 24;

/// Size of a row \[bytes\].
fn row_bytes(columns: usize) -> usize {
    BYTES * (OWN + columns)
}

/// Size of an instant of a motion \[bytes\].
fn instant_bytes(bodies: usize) -> usize {
    BYTES * (1 + 3 * bodies)
}

/// How many variants of so many columns a page draws.
pub fn most_rows(columns: usize) -> usize {
    (ROOM_ROWS / row_bytes(columns)).clamp(1, MOST_ROWS)
}

/// How many motions of so many moving bodies a page plays.
pub fn most_motions(bodies: usize) -> usize {
    (ROOM_MOTIONS / (FEWEST_INSTANTS * instant_bytes(bodies))).min(MOST_MOTIONS)
}

/// How many instants each of so many motions has in the page, at most.
pub fn most_instants(motions: usize, bodies: usize) -> usize {
    (ROOM_MOTIONS / (motions.max(1) * instant_bytes(bodies))).clamp(2, MOST_INSTANTS)
}
