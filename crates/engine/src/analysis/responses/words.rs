//! The responses of a model, put together with the columns of a run.

use super::items::Listed;
use super::{Over, Reducer, Responses, TakenFrom};
use linkdyn_model::error::{Complaint, Complaints};
use linkdyn_model::response::{
    Catalogue, Compiled, Input, Item, Known, Place, Program, Reduce, Results, Values,
};
use linkdyn_model::{Checked, Unit};
use linkdyn_output::{Channel, Column, ColumnId, TIME};

/// A response, ready to be evaluated.
#[derive(Debug, Clone)]
pub struct Response {
    /// Its name.
    pub name: String,
    /// The expression as the model has it.
    pub text: String,
    /// Its unit in SI; empty of a plain number.
    pub unit: String,
    /// The unit in which it is shown, with its size in SI.
    pub shown: Option<(String, f64)>,
    /// Lower and upper limit in SI.
    pub limits: Option<[f64; 2]>,
    /// The parameters that it names.
    pub parameters: Vec<String>,
    /// Whether it needs anything but rows: contacts, events, or numbers of the whole run.
    pub needs_report: bool,
    pub(super) first_parameter: usize,
    pub(super) total: Program,
    pub(super) sources: Vec<TakenFrom>,
}

/// The columns of a run, and what else its model names.
struct Table<'c> {
    columns: &'c [Column],
    catalogue: Catalogue,
}

impl Results for Table<'_> {
    fn find(&self, name: &str) -> Option<Known> {
        let column = self.catalogue.column_name(name);
        if let Some(index) = self.columns.iter().position(|one| one.name == column) {
            let known = self.catalogue.find(name);
            let of_unit = || Unit::parse(self.columns[index].unit).map(|unit| unit.powers);
            let powers = match known.filter(|known| matches!(known.place, Place::Row(_))) {
                Some(known) => known.powers,
                None => of_unit().unwrap_or_default(),
            };
            return Some(Known {
                place: Place::Row(index),
                powers,
            });
        }
        self.catalogue
            .find(name)
            .filter(|known| !matches!(known.place, Place::Row(_)))
    }

    fn missing(&self, name: &str, parameters: &[String]) -> Complaint {
        if self.catalogue.find(name).is_none() {
            return self.catalogue.missing(name, parameters);
        }
        let said = Complaint::new("", format!("this analysis has no column {name:?}"));
        let words = ["joint.", "driver.", "force.", "energy.", "shaking."];
        match words.iter().any(|word| name.starts_with(word)) {
            _ if name.starts_with("transmission.") => said.hint(
                "it needs \"transmission\" in the analysis, drivers that determine the motion, and a joint of the output body that is not on ground",
            ),
            true => said.hint(
                "kinematics has no forces, statics no velocities, and energy needs masses: see \"type\" of the analysis",
            ),
            false => said.hint("the columns: linkdyn run MODEL -o -"),
        }
    }
}

impl Responses {
    /// The responses of a model whose runs have these columns.
    ///
    /// # Errors
    /// What is wrong with each of them.
    pub fn new(model: &Checked, columns: &[Column]) -> Result<Responses, Complaints> {
        let mut responses = Responses::default();
        if model.responses.is_empty() {
            return Ok(responses);
        }
        responses.joints = model.joints.keys().cloned().collect();
        let table = Table {
            columns,
            catalogue: Catalogue::of(model),
        };
        let mut complaints = Vec::new();
        for (name, response) in &model.responses {
            match response.compile(&table) {
                Ok(compiled) => responses.add(name, response, compiled, columns),
                Err(complaint) => complaints.push(Complaint {
                    path: format!("responses.{name}"),
                    ..complaint
                }),
            }
        }
        if complaints.is_empty() {
            Ok(responses)
        } else {
            Err(Complaints(complaints))
        }
    }

    fn add(
        &mut self,
        name: &str,
        response: &linkdyn_model::Response,
        compiled: Compiled,
        columns: &[Column],
    ) {
        let needs_report = compiled.needs_report();
        let first_parameter = self.parameters.len();
        let values = response.parameters.values();
        self.parameters
            .extend(values.map(|constant| constant.value));
        let parameters = [first_parameter, self.parameters.len()];
        let first = self.reducers.len();
        for reduce in compiled.reductions {
            let reducer = self.reducer(reduce, parameters, columns);
            self.reducers.push(reducer);
        }
        let mut sources = Vec::new();
        let total = compiled.total.map(|input| {
            sources.push(match input {
                Input::Reduced(index) => TakenFrom::Reducer(first + index),
                Input::Fact(fact) => TakenFrom::Fact(fact),
            });
            sources.len() - 1
        });
        self.depth = self.depth.max(total.depth());
        let shown = response.unit.as_ref().and_then(|text| {
            let unit = Unit::parse(text).ok()?;
            let size = unit.convert(1.0, Unit::si(unit.powers))?;
            Some((text.clone(), size))
        });
        self.list.push(Response {
            name: name.to_owned(),
            text: response.value.clone(),
            unit: compiled.unit,
            shown,
            limits: response.limits,
            parameters: response.parameters.keys().cloned().collect(),
            needs_report,
            first_parameter,
            total,
            sources,
        });
    }

    fn reducer(&mut self, reduce: Reduce, parameters: [usize; 2], columns: &[Column]) -> Reducer {
        let over = match reduce.values {
            Values::Row(value) => {
                // every reduction of rows may need to know when they are
                self.time = columns
                    .iter()
                    .position(|column| column.name == TIME)
                    .map(|time| self.place(time, columns));
                let mut placed = |program: Program| {
                    let program = program.map(|column| self.place(column, columns));
                    self.depth = self.depth.max(program.depth());
                    program
                };
                Over::Rows {
                    value: placed(value),
                    equation: reduce.equation.map(|sides| sides.map(&mut placed)),
                }
            }
            Values::Item(list, program) => {
                let mut items: Vec<Item> = Vec::new();
                let program = program.map(|item| {
                    if !items.contains(&item) {
                        items.push(item);
                    }
                    items.iter().position(|known| *known == item).unwrap_or(0)
                });
                self.depth = self.depth.max(program.depth());
                Over::Items(Listed {
                    list,
                    items,
                    program,
                })
            }
        };
        Reducer {
            reduction: reduce.reduction,
            over,
            parameters,
            text: reduce.text,
        }
    }

    /// The place of a column among those that are needed.
    fn place(&mut self, column: usize, columns: &[Column]) -> usize {
        let id = ColumnId::at(column);
        if let Some(place) = self.needed.iter().position(|known| *known == id) {
            return place;
        }
        self.needed.push(id);
        self.columns.push(columns[column].name.clone());
        let may_be_empty = matches!(
            columns[column].channel,
            Some(Channel::Transmission(_) | Channel::Output(_))
        );
        self.may_be_empty.push(may_be_empty);
        self.needed.len() - 1
    }
}
