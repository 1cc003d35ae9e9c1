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

mod mutants;
mod redundant;
mod validation;
mod validation_lock;
