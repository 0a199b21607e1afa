//! Scenes that are right: what they hold, what they are written back as, and how `--set` changes them.

mod folder;

use flow_core::run::scene::{
    Derivative, Frames, Length, LengthTarget, Nodes, NormalMobility, Scene, Shape, Spacing,
};

use folder::Folder;

const SMALL: &str = "
curve = { shape = 'circle', radius = 2 }
time.end = 1
[energy.bending]
rigidity = 1
";

fn parse(text: &str) -> Scene {
    Scene::parse(text, "test.toml").unwrap_or_else(|error| panic!("{error}"))
}

fn set(text: &str, changes: &[(&str, &str)]) -> Scene {
    let changes: Vec<(String, String)> = changes.iter().map(|&(k, v)| (k.to_owned(), v.to_owned())).collect();
    Scene::parse_with(text, "test.toml", &changes).unwrap_or_else(|error| panic!("{error}"))
}

/// Equality of everything but the text that the scene came from.
fn assert_same(a: &Scene, b: &Scene) {
    assert_eq!(a.to_toml(), b.to_toml());
}

#[test]
fn every_shipped_scene_parses_and_survives_being_written_out() {
    for (name, text) in Scene::shipped() {
        let scene = parse(text);
        assert_eq!(scene.text(), *text);
        assert!(!scene.title.is_empty(), "{name}");
        let resolved = scene.to_toml();
        println!("# {name}\n{resolved}");
        assert_same(&parse(&resolved), &scene);
    }
}

#[test]
fn three_fold_holds_what_it_says() {
    let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "three_fold").unwrap();
    let scene = parse(text);
    assert_eq!(scene.curve.shape, Shape::Trillium {});
    assert_eq!(scene.curve.turning_number, 1);
    assert_eq!(scene.density[0].name, "protein");
    assert_eq!(scene.density[0].initial.formula().unwrap().variables(), ["s"]);
    let agents = scene.energy.agents.as_ref().unwrap();
    assert_eq!((agents.density.as_str(), agents.epsilon, agents.delta), ("protein", 0.05, 0.2));
    assert_eq!(agents.preferred_curvature.text(), "1.3 - 2.0/0.76*(rho - 0.19)");
    assert_eq!(scene.energy.length, Some(Length::Penalty { penalty: 3.0, target: LengthTarget::Ratio(1.8) }));
    assert_eq!(scene.energy.bending, None);
    assert_eq!((scene.time.end, scene.time.stop_at_equilibrium), (1000.0, true));
    assert_eq!((scene.accuracy.tolerance, scene.accuracy.nodes), (1e-5, Nodes::Auto));
    assert_eq!(scene.output.frames, Frames::Spaced { frames: 200, spacing: Spacing::Log });
}

#[test]
fn defaults() {
    let scene = parse(SMALL);
    assert_eq!(scene.title, "");
    assert!(scene.density.is_empty() && scene.time.stop_at_equilibrium && scene.time.max_steps.is_none());
    assert_eq!((scene.accuracy.tolerance, scene.accuracy.nodes), (1e-5, Nodes::Auto));
    assert_eq!(scene.accuracy.derivative, Derivative::Auto);
    assert_eq!(scene.output.frames, Frames::Spaced { frames: 200, spacing: Spacing::Linear });
    assert_same(&parse(&scene.to_toml()), &scene);
}

#[test]
fn every_shape_survives_being_written_out() {
    let points =
        "points = [[1, 0], [0.7, 0.7], [0, 1], [-0.7, 0.7], [-1, 0], [-0.7, -0.7], [0, -1], [0.7, -0.7]]";
    let shapes = [
        "shape = 'ellipse'\nsemi_axes = [2, 1]".to_owned(),
        "shape = 'trillium'\nturning_number = 1".to_owned(),
        "shape = 'polar'\nr = '1 + 0.5*cos(phi)'".to_owned(),
        "shape = 'polar'\nr = '0.5 + cos(phi)'\nturning_number = 2".to_owned(),
        "shape = 'parametric'\nx = '2*cos(phi)'\ny = 'sin(phi)'".to_owned(),
        "shape = 'figure-eight'".to_owned(),
        "shape = 'figure-eight'\nsize = 2".to_owned(),
        format!("shape = 'points'\n{points}"),
    ];
    for shape in shapes {
        let text = format!("[curve]\n{shape}\n[time]\nend = 1\n[energy.length]\ntension = 1");
        let scene = parse(&text);
        assert_same(&parse(&scene.to_toml()), &scene);
        let turns = if shape.contains("eight") {
            0
        } else {
            1 + i32::from(shape.contains("= 2") && shape.contains("polar"))
        };
        assert_eq!(scene.curve.turning_number, turns, "{shape}");
    }
}

#[test]
fn points_come_from_a_file_beside_the_scene() {
    let folder = Folder::new("points");
    let circle = |i: i32| (f64::from(i) * std::f64::consts::TAU / 16.0).sin_cos();
    let rows: Vec<String> = (0..=16).map(|i| circle(i % 16)).map(|(y, x)| format!("{x} {y}")).collect();
    std::fs::write(folder.file("points.txt"), rows.join("\n")).unwrap();
    let text = SMALL.replace("shape = 'circle', radius = 2", "shape = 'points', file = 'points.txt'");
    std::fs::write(folder.file("scene.toml"), &text).unwrap();
    let scene = Scene::read(folder.file("scene.toml")).unwrap();
    let Shape::Points { points } = &scene.curve.shape else { panic!("{:?}", scene.curve) };
    assert_eq!((points.len(), points[0]), (16, [1.0, 0.0]));
    assert_same(&parse(&scene.to_toml()), &scene);
}

#[test]
fn local_energies_see_the_densities_in_order() {
    let text = format!(
        "{SMALL}
        [energy.local]
        expression = 'kappa^2 + kappa_sigma^2 + lipid*protein_sigma'
        [[density]]
        name = 'protein'
        initial = 0.25
        mobility = 'diffusion'
        [[density]]
        name = 'lipid'
        initial = 's'
        mobility = 'diffusion'"
    );
    let scene = parse(&text);
    let variables = ["kappa", "kappa_sigma", "protein", "protein_sigma", "lipid", "lipid_sigma"];
    assert_eq!(scene.energy.local.as_ref().unwrap().expression.variables(), variables);
    assert_same(&parse(&scene.to_toml()), &scene);
}

#[test]
fn every_mobility_survives_being_written_out() {
    for normal in NormalMobility::ALL {
        for (density, weight) in
            [("diffusion", ""), ("diffusion", "weight = '1 + 0.5*s'"), ("exchange", ""), ("none", "")]
        {
            let text = format!(
                "{SMALL}
                [flow]
                normal_mobility = '{}'
                [[density]]
                name = 'protein'
                initial = 0.25
                mobility = '{density}'
                {weight}",
                normal.name()
            );
            let scene = parse(&text);
            assert_eq!(scene.flow.normal_mobility, *normal);
            assert_eq!(scene.density[0].mobility.name(), density);
            assert_eq!(scene.density[0].weight.is_some(), !weight.is_empty());
            assert_same(&parse(&scene.to_toml()), &scene);
        }
    }
}

#[test]
fn windows_and_unix_files_are_the_same_scene() {
    let (_, text) = Scene::shipped()[0];
    let windows = format!("\u{feff}{}", text.replace('\n', "\r\n"));
    assert_same(&parse(&windows), &parse(text));
    assert_eq!(parse(&windows).text(), windows);
}

#[test]
fn set_changes_adds_and_creates() {
    let (_, text) = Scene::shipped()[0];
    let changes = [
        ("accuracy.tolerance", "1e-3"),
        ("accuracy.nodes", "auto"),
        ("title", "by hand: a = \"b\""),
        ("density.0.initial", "0.5"),
        ("density.protein.initial", "0.5 + 0.1*s"),
        ("energy.regularization.delta", "0.1"),
        ("curve", "{shape = 'circle', radius = 3}"),
        ("accuracy.nodes", "64"),
    ];
    let scene = set(text, &changes);
    assert_eq!((scene.accuracy.tolerance, scene.accuracy.nodes), (1e-3, Nodes::Count(64)));
    assert_eq!(scene.title, "by hand: a = \"b\"");
    assert_eq!(scene.density[0].initial.formula().unwrap().text(), "0.5 + 0.1*s");
    assert_eq!(scene.energy.regularization.as_ref().unwrap().delta, 0.1);
    assert_eq!(scene.curve.shape, Shape::Circle { radius: 3.0 });
    println!("{}", scene.text());
    let again = parse(scene.text());
    assert_eq!(again, scene);
    assert_eq!(set(text, &[]), parse(text));
}

#[test]
fn an_empty_value_takes_a_key_out() {
    let text = format!("title = 'small'\n{SMALL}[output]\nframes = 3\nspacing = 'log'\n");
    let times = set(&text, &[("output.frames", ""), ("output.spacing", ""), ("output.times", "[0.1, 0.2]")]);
    assert_eq!(times.output.frames, Frames::At { times: vec![0.1, 0.2] });
    assert_eq!(parse(times.text()).output, times.output);
    assert_eq!(set(&text, &[("title", "")]).title, "");
    assert_eq!(set(&text, &[("output", "")]).output, parse(SMALL).output);
    for key in ["output.frmes", "energy.area.penalty", "density.0", "no"] {
        let changes = [(key.to_owned(), String::new())];
        let error = Scene::parse_with(&text, "test.toml", &changes).unwrap_err().to_string();
        assert!(error.contains("cannot be set"), "{error}");
    }
}
