//! Outputs whose accuracy is requested: their columns, points, positions and limits.

use super::Rules;
use super::names::Names;
use crate::accuracy::Column;
use crate::error::Complaint;
use crate::shape::Named;
use crate::{AccuracyOutput, GROUND, Measured};

/// All rules of one output but those on names.
pub(super) fn accuracy(rules: &mut Rules<'_>) {
    let Some(accuracy) = &rules.model.accuracy else {
        return;
    };
    for (name, output) in &accuracy.outputs {
        let path = format!("accuracy.outputs.{name}");
        if rules.holes.has(&path) {
            continue;
        }
        let at = format!("{path}.at");
        if let Some(position) = output.at.as_ref().filter(|_| !rules.holes.has(&at)) {
            let hint = "name the driver whose value says the position";
            rules.lacks_driver(&at, position.driver.as_ref(), hint);
        }
        rules.width(&path, output.limits, "the lower deviation", "[-0.1, 0.1]");
        distance(rules, output, &path);
    }
}

/// A distance is that of points of two bodies.
fn distance(rules: &mut Rules<'_>, output: &AccuracyOutput, path: &str) {
    let Measured::Distance([first, second]) = &output.of else {
        return;
    };
    let known = |index: usize| !rules.holes.has(&format!("{path}.distance[{index}]"));
    if first.body == second.body && known(0) && known(1) {
        let message = format!("both points are of {:?}", first.body);
        let hint = "their distance does not depend on the mechanism";
        rules.complain(format!("{path}.distance"), message, hint);
    }
}

impl Names<'_, '_> {
    /// Names in the columns of outputs.
    pub(super) fn columns(&mut self) {
        let outputs = self.model.accuracy.iter().flat_map(|all| &all.outputs);
        for (name, output) in outputs {
            if let Measured::Column(column) = &output.of {
                self.column(&format!("accuracy.outputs.{name}.column"), column);
            }
        }
    }

    fn column(&mut self, path: &str, column: &str) {
        if !self.is_open(path) {
            return;
        }
        let complaint = match Column::read(column) {
            Some(Column::Body(GROUND, _) | Column::Point { body: GROUND, .. }) => {
                Complaint::new(path, "ground is fixed, it has no error")
            }
            Some(Column::Body(body, _)) => return self.name(path, Named::Body, body),
            Some(Column::Joint(joint, _)) => return self.name(path, Named::Joint, joint),
            Some(Column::Driver(driver)) => return self.name(path, Named::Driver, driver),
            Some(Column::Length(force)) => match self.model.forces.get(force) {
                Some(found) if found.kind.ends().is_some() => return,
                Some(_) => Complaint::new(path, "only springs and actuators have a length")
                    .hint("\"distance\" is of any two points"),
                None => return self.force(path, force),
            },
            Some(Column::Point { body, point }) => {
                return self.point(path, &format!("{body}.{point}"));
            }
            None if column.contains('[') => {
                Complaint::new(path, "the name of a column goes without its unit").hint(format!(
                    "write {:?}",
                    column.split('[').next().unwrap_or_default().trim_end()
                ))
            }
            None => Complaint::new(path, "no column of positions or forces is called so").hint(
                "as in \"rocker.angle\", \"coupler.P.x\", \"joint.b.fx\" or \"driver.motor.effort\"",
            ),
        };
        self.rules.complaints.push(complaint);
    }
}
