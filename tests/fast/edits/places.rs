//! The numbers and names of a model, where an edit can change them.

use linkdyn_model::{DriverKind, ForceKind, JointKind, Model, Motion, PointRef, Value};

fn of_motion<'m>(motion: &'m mut Motion, numbers: &mut Vec<&'m mut f64>) {
    match motion {
        Motion::Polynomial { coefficients } => numbers.extend(coefficients),
        Motion::Harmonic {
            offset,
            amplitude,
            frequency,
            phase,
        } => numbers.extend([offset, amplitude, frequency, phase]),
        Motion::Table { points, .. } => numbers.extend(points.iter_mut().flatten()),
        Motion::Cycloidal(rise)
        | Motion::Polynomial345(rise)
        | Motion::Polynomial4567(rise)
        | Motion::ModifiedSine(rise)
        | Motion::ModifiedTrapezoid(rise) => {
            numbers.extend([&mut rise.start, &mut rise.begin, &mut rise.duration]);
            numbers.extend(rise.rise.iter_mut().chain(&mut rise.end));
        }
        Motion::TrapezoidalVelocity(rise) | Motion::SCurve(rise) => {
            numbers.extend([&mut rise.start, &mut rise.begin]);
            let given = [
                &mut rise.rise,
                &mut rise.end,
                &mut rise.duration,
                &mut rise.ramp,
            ];
            numbers.extend(given.into_iter().flatten());
            let limits = [&mut rise.velocity, &mut rise.acceleration, &mut rise.jerk];
            numbers.extend(limits.into_iter().flatten().chain(&mut rise.rounding));
        }
        Motion::Sequence {
            start,
            begin,
            segments,
            ..
        } => {
            numbers.extend([start, begin]);
            for part in segments {
                let own = [
                    &mut part.rise,
                    &mut part.end,
                    &mut part.duration,
                    &mut part.ramp,
                    &mut part.rounding,
                    &mut part.dwell,
                ];
                numbers.extend(own.into_iter().flatten());
            }
        }
        Motion::ConstantVelocity { start, velocity } => numbers.extend([start, velocity]),
        Motion::ConstantAcceleration {
            start,
            velocity,
            acceleration,
        } => numbers.extend([start, velocity, acceleration]),
    }
}

fn of_value<'m>(value: &'m mut Value, numbers: &mut Vec<&'m mut f64>) {
    match value {
        Value::Constant(number) => numbers.push(number),
        Value::Motion(motion) => of_motion(motion, numbers),
        Value::Formula(_) => {}
    }
}

/// Numbers of a model that are always there.
pub fn numbers(model: &mut Model) -> Vec<&mut f64> {
    let mut numbers: Vec<&mut f64> = model.gravity.iter_mut().collect();
    for body in model.bodies.values_mut() {
        numbers.extend(body.points.values_mut().flatten());
        numbers.extend(&mut body.pose.position);
        numbers.push(&mut body.pose.angle);
        numbers.extend(body.com.iter_mut().flatten());
        numbers.extend(body.elastic.iter_mut().map(|link| &mut link.damping));
    }
    for joint in model.joints.values_mut() {
        match &mut joint.kind {
            JointKind::Prismatic { axis, angle, .. } => {
                numbers.extend(axis.iter_mut().chain([angle]))
            }
            JointKind::Slot { axis, .. } => numbers.extend(axis),
            JointKind::Gear { ratio, .. } => numbers.push(ratio),
            JointKind::Belt { radii, .. } => numbers.extend(radii),
            JointKind::Bushing(bushing) => {
                numbers.extend(&mut bushing.radial_stiffness.0);
                numbers.extend(&mut bushing.radial_damping.0);
                numbers.push(&mut bushing.torsional_stiffness);
                numbers.push(&mut bushing.free_angle);
            }
            JointKind::Rack { axis, radius, .. } => numbers.extend(axis.iter_mut().chain([radius])),
            JointKind::Fixed { angle } => numbers.push(angle),
            JointKind::Contact {
                outline, radius, ..
            } => numbers.extend(outline.iter_mut().flatten().chain([radius])),
            JointKind::Cam(cam) => numbers.extend(cam.face.iter_mut().flatten()),
            _ => {}
        }
    }
    for driver in model.drivers.values_mut() {
        of_motion(&mut driver.motion, &mut numbers);
    }
    for force in model.forces.values_mut() {
        match &mut force.kind {
            ForceKind::Spring {
                stiffness,
                damping,
                free_length: free,
                ..
            }
            | ForceKind::TorsionSpring {
                stiffness,
                damping,
                free_angle: free,
                ..
            } => {
                numbers.extend([stiffness, damping]);
                of_value(free, &mut numbers);
            }
            ForceKind::Cable {
                stiffness,
                damping,
                free_length: free,
                ..
            } => {
                numbers.extend([stiffness, damping]);
                of_value(free, &mut numbers);
            }
            ForceKind::GasSpring {
                force,
                extended,
                stroke,
                progression,
                exponent,
                damping,
                ..
            } => numbers.extend([force, extended, stroke, progression, exponent, damping]),
            ForceKind::Cylinder {
                bore,
                rod,
                pressure,
                rod_pressure,
                ..
            } => {
                numbers.extend([bore, rod]);
                of_value(pressure, &mut numbers);
                of_value(rod_pressure, &mut numbers);
            }
            ForceKind::DcMotor {
                voltage,
                torque_constant,
                resistance,
                inductance,
                gear,
                ..
            } => {
                numbers.extend([torque_constant, resistance, inductance, gear]);
                of_value(voltage, &mut numbers);
            }
            ForceKind::Load { vector, .. } => {
                vector
                    .iter_mut()
                    .for_each(|part| of_value(part, &mut numbers));
            }
            ForceKind::Torque { value, .. } | ForceKind::Actuator { force: value, .. } => {
                of_value(value, &mut numbers);
            }
        }
    }
    if let Some(analysis) = &mut model.analysis {
        numbers.extend([&mut analysis.solver.rtol, &mut analysis.solver.atol]);
        if let Some(sample) = &mut analysis.sample {
            numbers.extend([&mut sample.from, &mut sample.to, &mut sample.step]);
        }
    }
    numbers
}

/// Numbers of a model that may be left out.
pub fn options(model: &mut Model) -> Vec<&mut Option<f64>> {
    let mut options = Vec::new();
    for body in model.bodies.values_mut() {
        options.extend([&mut body.mass, &mut body.inertia]);
        if let Some(link) = body.elastic.as_deref_mut() {
            options.extend([&mut link.young_modulus, &mut link.density]);
            options.extend([&mut link.bending_stiffness, &mut link.axial_stiffness]);
            options.push(&mut link.mass_per_length);
        }
    }
    for initial in model.initial.values_mut() {
        options.extend([&mut initial.x, &mut initial.angle, &mut initial.vy]);
        options.push(&mut initial.angular_velocity);
    }
    for joint in model.joints.values_mut() {
        let friction = match &mut joint.kind {
            JointKind::Revolute {
                clearance,
                friction,
                pin_radius,
            } => {
                options.push(pin_radius);
                if let Some(clearance) = clearance.as_deref_mut() {
                    options.extend([&mut clearance.radius, &mut clearance.bearing_radius]);
                    options.push(&mut clearance.axial_length);
                    if let Some(normal) = &mut clearance.normal {
                        options.extend([&mut normal.stiffness, &mut normal.exponent]);
                        options.extend([&mut normal.restitution, &mut normal.damping]);
                    }
                    if let Some(impact) = &mut clearance.impact {
                        options.extend([&mut impact.restitution, &mut impact.friction]);
                    }
                }
                friction
            }
            JointKind::Prismatic {
                friction,
                guide_length,
                ..
            } => {
                options.push(guide_length);
                friction
            }
            JointKind::Gear { angle, .. } => {
                options.push(angle);
                continue;
            }
            JointKind::Cam(cam) => {
                options.push(&mut cam.roller_radius);
                continue;
            }
            JointKind::Belt { pretension, .. } => {
                options.push(pretension);
                continue;
            }
            JointKind::Rack { offset, .. } => {
                options.push(offset);
                continue;
            }
            _ => continue,
        };
        if let Some(friction) = friction.as_deref_mut() {
            options.extend([&mut friction.coefficient, &mut friction.static_coefficient]);
            options.extend([
                &mut friction.threshold_velocity,
                &mut friction.lower_velocity,
            ]);
            options.extend([
                &mut friction.upper_velocity,
                &mut friction.bristle_stiffness,
            ]);
        }
    }
    if let Some(analysis) = &mut model.analysis {
        options.extend([&mut analysis.end, &mut analysis.solver.max_step]);
        options.push(&mut analysis.solver.initial_step);
    }
    options
}

fn of_point(point: &mut PointRef) -> [&mut String; 2] {
    [&mut point.body, &mut point.point]
}

/// Texts of a model that name something.
pub fn names(model: &mut Model) -> Vec<&mut String> {
    let mut names: Vec<&mut String> = model.points.iter_mut().flat_map(of_point).collect();
    for joint in model.joints.values_mut() {
        names.extend(joint.between.iter_mut().flat_map(of_point));
        if let JointKind::Gear { carrier, .. } | JointKind::Belt { carrier, .. } = &mut joint.kind {
            names.extend(carrier);
        }
    }
    for driver in model.drivers.values_mut() {
        match &mut driver.kind {
            DriverKind::Rotation { body, relative_to } => {
                names.push(body);
                names.extend(relative_to);
            }
            DriverKind::Translation { joint } => names.push(joint),
            DriverKind::Length { between } => names.extend(between.iter_mut().flat_map(of_point)),
            DriverKind::Point { point, .. } => names.extend(of_point(point)),
        }
    }
    for force in model.forces.values_mut() {
        match &mut force.kind {
            ForceKind::Spring { between, .. }
            | ForceKind::Actuator { between, .. }
            | ForceKind::GasSpring { between, .. }
            | ForceKind::Cylinder { between, .. } => {
                names.extend(between.iter_mut().flat_map(of_point));
            }
            ForceKind::Cable { through, .. } => names.extend(through.iter_mut().flat_map(of_point)),
            ForceKind::TorsionSpring { between, .. } => names.extend(between),
            ForceKind::Load { at, .. } => names.extend(of_point(at)),
            ForceKind::Torque {
                body, relative_to, ..
            }
            | ForceKind::DcMotor {
                body, relative_to, ..
            } => {
                names.push(body);
                names.extend(relative_to);
            }
        }
    }
    if let Some(analysis) = &mut model.analysis {
        names.push(&mut analysis.solver.method);
        names.extend(analysis.sample.as_mut().map(|sample| &mut sample.driver));
        names.extend(
            analysis
                .transmission
                .as_mut()
                .map(|wanted| &mut wanted.output),
        );
    }
    names
}
