//! The built-in characters are what their files say.

use aplomb_framework::character::Model;

#[test]
fn characters_have_their_mass_and_degrees_of_freedom() {
    let told = [
        ("humanoid", 80.0, 15),
        ("lion", 180.0, 25),
        ("sumo", 180.0, 15),
    ];
    assert_eq!(told.len(), Model::built_in().len());
    for (name, mass, dof) in told {
        let model = Model::load(name).unwrap();
        assert_eq!(model.name, name);
        assert_eq!(model.dof(), dof, "{name}");
        let found = model.total_mass();
        assert!((found - mass).abs() < 1e-9, "{name}: {found} kg");
    }
}

#[test]
fn both_sides_of_a_character_are_alike() {
    for (name, _) in Model::built_in() {
        let model = Model::load(name).unwrap();
        for (j, joint) in model.joints().enumerate() {
            let other = &model.links[model.mirrored_joint(j) + 1];
            let (own, twin) = (&model.links[j + 1], other.joint.as_ref().unwrap());
            assert_eq!((own.mass, own.inertia), (other.mass, other.inertia));
            assert_eq!((joint.range, joint.muscles), (twin.range, twin.muscles));
        }
    }
}
