use super::*;

/// Every channel, each of some owner.
fn all() -> Vec<Channel> {
    let mut all = vec![Channel::Time];
    all.extend(BodyQuantity::ALL.map(|quantity| Channel::Body(0, quantity)));
    all.extend(PointQuantity::ALL.map(|quantity| Channel::Point(0, quantity)));
    all.extend(JointQuantity::ALL.map(|quantity| Channel::Joint(0, quantity)));
    all.extend(RelativeQuantity::ALL.map(|quantity| Channel::Relative(0, quantity)));
    all.extend(DriverQuantity::ALL.map(|quantity| Channel::Driver(0, quantity)));
    all.extend(EnergyQuantity::ALL.map(Channel::Energy));
    all.extend(LoadQuantity::ALL.map(|quantity| Channel::Load(0, quantity)));
    all.extend(ShakingQuantity::ALL.map(Channel::Shaking));
    all.extend(TransmissionQuantity::OF_ALL.map(Channel::Transmission));
    all.push(Channel::Transmission(TransmissionQuantity::Angle(0)));
    all.push(Channel::Output(0));
    let states = [StateQuantity::Value, StateQuantity::Rate];
    all.extend(states.map(|quantity| Channel::State(0, quantity)));
    all.extend(states.map(|quantity| Channel::Measure(0, quantity)));
    all.extend(SectionQuantity::PEAKS.map(|quantity| Channel::Section(0, quantity)));
    let station = SectionQuantity::of_station(10);
    all.extend(station.map(|quantity| Channel::Section(0, quantity)));
    all
}

#[test]
fn every_name_reads_back_as_its_channel() {
    // Owners with names that are words of ours, too.
    for owner in [
        "b",
        "6\" bar",
        "joint",
        "energy",
        "transmission",
        "angle",
        "time",
    ] {
        for channel in all() {
            let owner = match channel {
                Channel::Point(..) => format!("{owner}.{owner}"),
                Channel::Time | Channel::Energy(_) | Channel::Shaking(_) => String::new(),
                Channel::Transmission(quantity) if quantity.name() != "angle" => String::new(),
                // no output, no state and no measure is called like a quantity of a body
                Channel::Output(_) | Channel::State(..) | Channel::Measure(..)
                    if owner == "angle" =>
                {
                    continue;
                }
                Channel::Body(..)
                | Channel::Joint(..)
                | Channel::Relative(..)
                | Channel::Output(_)
                | Channel::State(..)
                | Channel::Measure(..)
                | Channel::Driver(..)
                | Channel::Load(..)
                | Channel::Section(..)
                | Channel::Transmission(_) => owner.to_string(),
            };
            let name = channel.name(&owner);
            assert_eq!(
                Channel::read(&name),
                Some((channel, owner.as_str())),
                "{name}"
            );
            assert_eq!(channel.with_owner(7).name(&owner), name);
        }
    }
}

#[test]
fn other_names_are_none_of_ours() {
    for name in [
        "",
        "x",
        "Time",
        "crank.",
        "crank.force",
        "joint.b",
        "joint.b.ratio",
        "output.",
        "a.b.c.x",
        "section.rod.axial_force_0",
        "section.rod.axial_force_01",
        "section.rod.axial_force",
    ] {
        assert_eq!(Channel::read(name), None, "{name}");
    }
}
