//! Evidence that the results are true: published and independent references, regular twins of redundant mechanisms, and
//! mutants of models that must break nothing. It takes long.

#[path = "../common/fuzz/mod.rs"]
mod fuzz;
#[path = "../common/linkage.rs"]
mod linkage;
// The fast tests use the rest.
#[allow(dead_code)]
#[path = "../common/models.rs"]
mod models;
#[path = "../common/rigid.rs"]
mod rigid;

// In the order of their names tests are run: those of the lock, which take longest, are not the last.
mod films;
mod jams;
mod linkages;
mod lock;
mod mutants;
mod paths;
mod redundant;
mod sampling;
mod validation;
