//! Errors of scenes as data: keys, lines and kinds. The wording is pinned by the transcripts in `flow-cli/tests/mistakes`.

mod folder;

use flow_core::run::scene::{Fault, Place, Problem, Scene, SceneError};

use folder::Folder;

/// Lines: 2 title, 4 shape, 7–9 density, 12 rigidity, 15–16 penalty, 19 end, 22–23 accuracy, 26 frames.
const GOOD: &str = r#"
title = "good"
[curve]
shape = "trillium"

[[density]]
name = "protein"
initial = "0.5 + 0.1*cos(2*pi*s)"
mobility = "diffusion"

[energy.bending]
rigidity = 1.0

[energy.length]
penalty = 3.0
target_ratio = 1.8

[time]
end = 1.0

[accuracy]
tolerance = 1e-5
nodes = 256

[output]
frames = 10
"#;

fn message(text: &str) -> String {
    Scene::parse(text, "bad.toml").map_or_else(|error| error.to_string(), |_| String::from("no error"))
}

/// One mistake makes one problem, at its key, on its line.
#[test]
fn one_mistake_is_one_problem() {
    let cases = [
        ("rigidity = 1.0", "rigidty = 1.0", "energy.bending.rigidty", 12),
        ("rigidity = 1.0", "", "energy.bending.rigidity", 11),
        ("[energy.bending]", "[energy.bendng]", "energy.bendng", 11),
        ("end = 1.0", "end = nan", "time.end", 19),
        ("frames = 10", "times = [0.5,\n 7.0]", "output.times.1", 27),
        ("name = \"protein\"", "name = 3", "density.0.name", 7),
    ];
    assert!(Scene::parse(GOOD, "good.toml").is_ok());
    for (from, to, key, line) in cases {
        let error = Scene::parse(&GOOD.replace(from, to), "bad.toml").unwrap_err();
        let [problem] = error.problems() else { panic!("{error}") };
        assert_eq!((problem.key.as_str(), problem.line()), (key, Some(line)));
    }
}

/// What terms ask of densities is no second problem where the densities themselves are refused.
#[test]
fn consequences_of_refused_densities_are_silent() {
    let terms = "[energy.packing]\nmatrix = [[1.0, 0.1], [0.1, 1.0]]\nepsilon = 0.1\n\
                 [energy.local]\nexpression = '0.02*protein_sigma^2 + 0.02*other_sigma^2'\n\
                 [energy.membrane]\ndensity = 'protein'\nepsilon = 0.05\n";
    let one =
        "[[density]]\nname = \"protein\"\ninitial = \"0.5 + 0.1*cos(2*pi*s)\"\nmobility = \"diffusion\"\n";
    let two = format!("{one}{}", one.replace("protein", "other"));
    let good = GOOD.replace(one, &two) + terms;
    Scene::parse(&good, "good.toml").unwrap();
    let refused = [
        (good.replace(&two, &two.repeat(4)), "density"),
        (good.replace("\"other\"", "\"other-1\""), "density.1.name"),
        (good.replace("name = \"other\"", ""), "density.1.name"),
        (format!("density = 3\n{}", good.replace(&two, "")), "density"),
    ];
    for (text, key) in refused {
        let error = Scene::parse(&text, "bad.toml").unwrap_err();
        let [problem] = error.problems() else { panic!("{error}") };
        assert_eq!(problem.key, key, "{error}");
    }
    // What has nothing to do with densities is said all the same.
    let text = good.replace(&two, &two.repeat(4)).replace("epsilon = 0.05", "epsilon = -1.0");
    assert_eq!(Scene::parse(&text, "bad.toml").unwrap_err().problems().len(), 2);
}

/// What has a limit is refused before it is read, whatever it holds.
#[test]
fn more_than_there_may_be_is_refused_at_once() {
    let cases = [
        ("density", "[[density]]\nname = 'a'\n".repeat(40_000)),
        ("flow.switch", "[[flow.switch]]\ntime = 0\n".repeat(30_000)),
    ];
    for (key, tables) in cases {
        let rest = GOOD.replace("[[density]]", "").replace("name =", "title2 =");
        let rest = &rest[rest.find("[energy.bending]").unwrap()..];
        let error =
            Scene::parse(&format!("curve.shape = 'trillium'\n{rest}{tables}"), "bad.toml").unwrap_err();
        let [Problem { key: at, fault: Fault::WrongCount { count, .. }, .. }] = error.problems() else {
            panic!("{error}")
        };
        assert!(at == key && *count >= 30_000, "{error}");
    }
    let many = GOOD
        .replace("target_ratio = 1.8", "target_ratio = 1.8\n[energy.local]\nexpression = 'a1_sigma^2*a7'");
    let densities: String = (1..=7).fold(String::new(), |text, k| {
        format!("{text}\n[[density]]\nname = 'a{k}'\ninitial = 0.5\nmobility = 'diffusion'\n")
    });
    let density = many.find("[[density]]").unwrap()..many.find("[energy.bending]").unwrap();
    let scene = Scene::parse(&many.replace(&many[density], &densities), "seven.toml").unwrap();
    assert!(flow_core::run::Setup::new(&scene).is_ok(), "as many densities as there may be");
}

#[test]
fn all_problems_are_reported_at_once_in_the_order_of_their_lines() {
    let text = GOOD
        .replace("rigidity = 1.0", "rigidity = -1")
        .replace("penalty = 3.0", "penalty = inf")
        .replace("end = 1.0", "end = 0")
        .replace("tolerance = 1e-5", "tolerance = 2");
    let error = Scene::parse(&text, "bad.toml").unwrap_err();
    let lines: Vec<Option<usize>> = error.problems().iter().map(Problem::line).collect();
    assert_eq!(lines, [Some(12), Some(15), Some(19), Some(22)]);
    assert!(error.to_string().starts_with("4 problems in bad.toml:\n"));
    assert_eq!(error.problems()[3].key, "accuracy.tolerance");
}

#[test]
fn a_wrong_override_is_shown_as_it_was_given() {
    let set = |key: &str, value: &str| {
        let error = Scene::parse_with(GOOD, "bad.toml", &[(key.to_owned(), value.to_owned())]).unwrap_err();
        let [problem] = error.problems() else { panic!("{error}") };
        assert_eq!(problem.place, Place::Override { key: key.to_owned(), value: value.to_owned() });
        (problem.key.clone(), error.to_string())
    };
    assert_eq!(set("accuracy.tolerance", "7").0, "accuracy.tolerance");
    assert_eq!(set("density.protein.initial", "0.5 +").0, "density.0.initial");
    assert_eq!(set("energy.regularization.delte", "3").0, "energy.regularization.delte");
    assert_eq!(set("curve", "{shape = 'circle'}").0, "curve.radius");
    let nowhere = ["density.lipid.initial", "density.1.initial", "time.end.value", "time..end", ""];
    for key in nowhere.map(str::to_owned).into_iter().chain(["a.".repeat(100_000)]) {
        assert!(set(&key, "1").1.contains("cannot be set"), "{key:.40}");
    }
}

#[test]
fn problems_of_a_scene_that_a_program_wrote_are_at_keys() {
    let text = GOOD.replace("rigidity = 1.0", "rigidity = -1").replace("[time]\nend = 1.0", "");
    let error = Scene::parse(&text, "scene").unwrap_err().at_keys();
    let places: Vec<&Place> = error.problems().iter().map(|problem| &problem.place).collect();
    assert_eq!(places, [&Place::Key("energy.bending.rigidity".into()), &Place::Key("time".into())]);
    let message = error.to_string();
    assert!(
        message.contains("scene, energy.bending.rigidity\n  `energy.bending.rigidity` = -1"),
        "{message}"
    );
    assert!(message.contains("scene, time\n  `time` is missing") && !message.contains("line "), "{message}");
}

#[test]
fn files_that_are_no_scenes() {
    assert!(matches!(Scene::read("no/such/scene.toml"), Err(SceneError::Unreadable { .. })));
    let large = "#".repeat((1 << 20) + 1);
    assert!(matches!(Scene::parse(&large, "large"), Err(SceneError::TooLarge { .. })));
    let folder = Folder::new("not-text");
    let file = folder.file("scene.toml");
    std::fs::write(&file, b"title = \"\xff\"").unwrap();
    let error = Scene::read(&file).unwrap_err();
    assert!(error.to_string().contains("byte 9 is not UTF-8"), "{error}");
}

/// Nothing that a file may hold makes the reader panic, hang or print control characters.
#[test]
fn hostile_input_is_refused_politely() {
    let deep = 100_000;
    let hostile = [
        String::new(),
        "\u{feff}".to_owned(),
        "\0".to_owned(),
        "title = \"\0\"".to_owned(),
        "title = \"\u{1b}[31mred".to_owned(),
        "[curve]\nshape = \"\\u0000\\u001b[31m\"".to_owned(),
        "\"\\u001b[31m\" = 1\n\"\" = 2".to_owned(),
        format!("a = {}", "[".repeat(deep)),
        format!("a = {}1{}", "[".repeat(deep), "]".repeat(deep)),
        format!("a = {}", "{a=".repeat(deep)),
        format!("{}a = 1", "a.".repeat(deep)),
        format!("[{}a]", "a.".repeat(deep)),
        "[[density]]\n".repeat(50_000),
        (0..80_000).map(|i| format!("k{i}=1")).collect::<Vec<_>>().join("\n"),
        "x".repeat(1 << 20),
        format!("{} = 1", "é".repeat(1 << 19)),
        "curve = 1\ndensity = 1\nenergy = 1\nflow = 1\ntime = 1\naccuracy = 1\noutput = 1\ntitle = 1"
            .to_owned(),
        "curve = []\ndensity = [1, [], {}]\nenergy = {}\ntime = {}\noutput = {times = []}".to_owned(),
        "time = {end = 99999999999999999999999999}\naccuracy = {nodes = -9223372036854775808}".to_owned(),
        "time = {end = 0xffffffffffffffffffff, max_steps = 9223372036854775807}".to_owned(),
        "time = {end = 1979-05-27T07:32:00Z}".to_owned(),
        "curve = {shape = 'points', file = '/dev/zero'}".to_owned(),
        "curve = {shape = 'points', file = ''}".to_owned(),
        "curve = {shape = \"points\", file = \"\\u001b[31m\\u0000\"}".to_owned(),
        "curve = {shape = \"polar\", r = \"1 + \\u001b[31m\"}".to_owned(),
        "curve = {shape = 'points', points = [[nan, inf], [], 1, 'x']}".to_owned(),
    ];
    for text in hostile {
        let message = message(&text);
        assert_ne!(message, "no error", "{text:.80}");
        assert!(!message.chars().any(|c| c.is_control() && c != '\n'), "{message:?}");
        assert!(message.len() < 20_000, "{} bytes", message.len());
    }
}
