//! Scenes whose values a program has changed after they were read: what is no scene any more is refused, and what is run is
//! what the record says.

mod folder;

use flow_core::run::scene::{Bending, Formula, Frames, Membrane, Nodes, Shape, Spacing};
use flow_core::run::{Quiet, Scene, SceneError, SetupError, Simulation, evaluate, predict, run};

use folder::Folder;

const CIRCLE: &str = "
# A comment that an unchanged scene keeps.
curve = { shape = 'circle', radius = 1.0 }
energy.bending.rigidity = 1.0
time = { end = 0.01 }
accuracy = { tolerance = 1e-4, nodes = 32 }
output = { frames = 2 }
";

fn circle() -> Scene {
    Scene::parse(CIRCLE, "circle.toml").unwrap_or_else(|error| panic!("{error}"))
}

fn formula(text: &str, variables: &[&str]) -> Formula {
    Formula::parse(text, variables).unwrap_or_else(|error| panic!("{error}"))
}

fn bending(preferred: Formula) -> Bending {
    Bending { rigidity: 1.0, preferred_curvature: Some(preferred), density: None }
}

/// The keys at which a changed scene is refused, by all that would run it.
fn refused_at(change: impl Fn(&mut Scene)) -> Vec<String> {
    let mut scene = circle();
    change(&mut scene);
    let keys = |error: &SetupError| -> Vec<String> {
        let SetupError::Scene(error) = error else { panic!("{error}") };
        assert!(error.to_string().starts_with("the scene as changed, "), "{error}");
        error.problems().iter().map(|problem| problem.key.clone()).collect()
    };
    let found = keys(&Simulation::new(&scene).expect_err("refused"));
    assert_eq!(keys(&predict(&scene).expect_err("refused")), found);
    assert_eq!(keys(&run(&scene, &mut Quiet).expect_err("refused")), found);
    assert!(scene.self_contained("circle.toml").is_err());
    assert!(evaluate(&scene, &[1.0; 32], &[std::f64::consts::TAU; 32], &[]).is_err());
    found
}

/// `bc` prints numbers without the zero before the point.
#[test]
fn numbers_may_be_written_as_calculators_write_them() {
    let with = |key: &str, value: &str| {
        let set = [(key.to_owned(), value.to_owned())];
        let scene = Scene::parse_with(CIRCLE, "circle.toml", &set).unwrap_or_else(|error| panic!("{error}"));
        Scene::parse(scene.text(), "again").unwrap_or_else(|error| panic!("{error}"))
    };
    for (text, value) in [(".001", 1e-3), ("1.e-3", 1e-3), ("01e-3", 1e-3), ("+.05", 0.05)] {
        assert_eq!(with("accuracy.tolerance", text).accuracy.tolerance, value);
    }
    assert_eq!(with("title", "1.2.3").title, "1.2.3");
}

#[test]
fn names_that_are_numbers_elsewhere_need_no_quotes() {
    let text = format!(
        "{CIRCLE}\nenergy.membrane = {{ density = 'a', epsilon = 0.1 }}
        density = [{{ name = 'a', initial = 1.0, mobility = 'diffusion' }}]"
    );
    for name in ["nan", "inf", "true", "'nan'"] {
        let set = [("density.a.name", name), ("energy.membrane.density", name)];
        let set = set.map(|(key, value)| (key.to_owned(), value.to_owned()));
        let scene = Scene::parse_with(&text, "circle.toml", &set).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.density[0].name, name.trim_matches('\''));
    }
}

#[test]
fn changes_that_make_no_scene_are_refused_at_their_keys() {
    for count in [0, 1, 1 << 40, usize::MAX] {
        assert_eq!(refused_at(|scene| scene.accuracy.nodes = Nodes::Count(count)), ["accuracy.nodes"]);
    }
    let spaced = |frames| Frames::Spaced { frames, spacing: Spacing::Linear };
    assert_eq!(refused_at(|scene| scene.output.frames = spaced(usize::MAX)), ["output.frames"]);
    assert_eq!(refused_at(|scene| scene.time.max_steps = Some(u64::MAX)), ["time.max_steps"]);
    for value in [f64::NAN, f64::INFINITY, -1.0] {
        assert_eq!(refused_at(|scene| scene.time.end = value), ["time.end"]);
        assert_eq!(refused_at(|scene| scene.accuracy.tolerance = value), ["accuracy.tolerance"]);
    }
    let unknown = Membrane { density: "nobody".to_owned(), epsilon: 0.1 };
    let keys = refused_at(|scene| scene.energy.membrane = Some(unknown.clone()));
    assert!(keys[0].starts_with("energy.membrane"), "{keys:?}");
}

#[test]
fn formulas_in_other_variables_are_refused() {
    let of_nothing = bending(formula("2*rho", &["rho"]));
    let keys = refused_at(|scene| scene.energy.bending = Some(of_nothing.clone()));
    assert!(keys[0].starts_with("energy.bending"), "{keys:?}");
    let of_others = bending(formula("2*x + y", &["x", "y"]));
    let keys = refused_at(|scene| scene.energy.bending = Some(of_others.clone()));
    assert_eq!(keys, ["energy.bending.preferred_curvature"]);
}

/// The text of a formula does not tell the order of its variables.
#[test]
fn formulas_whose_variables_are_in_another_order_are_read_anew() {
    let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "three_fold").expect("shipped");
    let scene = Scene::parse(text, "three_fold").unwrap();
    let mut local = scene.clone();
    let parsed = Scene::parse_with(
        text,
        "three_fold",
        &[("energy.local.expression".to_owned(), "kappa^2 + protein".to_owned())],
    );
    local.energy = parsed.unwrap().energy;
    let term = local.energy.local.as_mut().expect("a local term");
    let mut variables: Vec<String> = term.expression.variables().to_vec();
    variables.reverse();
    let variables: Vec<&str> = variables.iter().map(String::as_str).collect();
    term.expression = formula("kappa^2 + protein", &variables);
    let checked = local.clone().checked().unwrap();
    let expected = ["kappa", "kappa_sigma", "protein", "protein_sigma"];
    assert_eq!(checked.energy.local.as_ref().unwrap().expression.variables(), expected);
}

#[test]
fn the_record_holds_what_was_run() {
    let mut scene = circle();
    scene.accuracy.nodes = Nodes::Count(64);
    scene.curve.shape = Shape::Circle { radius: 2.0 };
    let record = run(&scene, &mut Quiet).unwrap();
    assert_eq!(record.nodes(), 64);
    for text in [&record.scene, &record.resolved_scene] {
        let again = Scene::parse(text, "again").unwrap();
        assert_eq!((again.accuracy, again.curve), (scene.accuracy.clone(), scene.curve.clone()));
    }
    let again = record.to_scene().unwrap();
    assert_eq!(run(&again, &mut Quiet).unwrap().frames, record.frames);
}

#[test]
fn a_scene_that_holds_what_was_read_keeps_its_text() {
    let scene = circle();
    assert_eq!(run(&scene, &mut Quiet).unwrap().scene, CIRCLE);
    let mut back = scene.clone();
    back.accuracy.nodes = Nodes::Count(64);
    back.accuracy.nodes = Nodes::Count(32);
    assert_eq!(back.checked().unwrap(), scene);
}

#[test]
fn points_of_a_file_stand_in_the_text_of_a_changed_scene() -> Result<(), SceneError> {
    let folder = Folder::new("changes");
    let circle = |i: i32| (f64::from(i) * std::f64::consts::TAU / 16.0).sin_cos();
    let rows: Vec<String> = (0..16).map(circle).map(|(y, x)| format!("{x} {y}")).collect();
    std::fs::write(folder.file("points.txt"), rows.join("\n")).unwrap();
    let text = CIRCLE.replace("shape = 'circle', radius = 1.0", "shape = 'points', file = 'points.txt'");
    std::fs::write(folder.file("scene.toml"), text).unwrap();
    let scene = Scene::read(folder.file("scene.toml"))?;
    assert!(!scene.holds_points());

    let mut changed = scene.clone();
    changed.time.end = 0.005;
    assert!(changed.holds_points());
    let checked = changed.clone().checked()?;
    assert_eq!((checked.time.end, &checked.curve), (0.005, &scene.curve));
    assert!(checked.text().contains("points = ["));
    assert_eq!(changed.self_contained("scene.toml")?, checked);
    // The file is gone, and nobody asks for it.
    let record = run(&changed, &mut Quiet).unwrap();
    assert_eq!(record.to_scene()?.curve, scene.curve);

    // Another curve in place of the file's.
    let mut round = scene;
    round.curve.shape = Shape::Circle { radius: 1.0 };
    assert!(!round.holds_points());
    assert_eq!(round.self_contained("scene.toml")?.curve.shape, round.curve.shape);
    Ok(())
}
