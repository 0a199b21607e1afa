//! Seeded mistakes: every message names the key, the line, the value, the bound and one thing to try.
//!
//! `cargo test -p flow-core --test scene_errors -- --nocapture` prints all messages, to be read as a user would.

use flow_core::run::scene::{Place, Scene, SceneError};

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

const AGENTS: &str = "[energy.agents]
density = 'protein'
epsilon = 0.05
delta = 0.2
preferred_curvature = '1.3 - 2*rho'
low_density = 0.1
high_density = '0.8 + 0.1*exp(-kappa^2)'
";

/// What is replaced in `GOOD`, by what, and what the message must say.
type Mistake = (&'static str, &'static str, &'static [&'static str]);

const MISTAKES: &[Mistake] = &[
    ("rigidity = 1.0", "rigidty = 1.0", &["line 12 | rigidty = 1.0", "did you mean `rigidity`"]),
    (
        "rigidity = 1.0",
        "",
        &["line 11 | [energy.bending]", "`energy.bending.rigidity` is missing", "rigidity = 1.0"],
    ),
    (
        "rigidity = 1.0",
        "rigidity = -1",
        &["line 12", "`energy.bending.rigidity` = -1", "at least 0", "try rigidity"],
    ),
    (
        "rigidity = 1.0",
        "rigidity = nan",
        &["line 12", "`energy.bending.rigidity` = nan", "finite", "try rigidity"],
    ),
    ("rigidity = 1.0", "rigidity = 1e-400", &["line 12", "1e-400", "too small", "try rigidity"]),
    (
        "rigidity = 1.0",
        "rigidity = \"1.0\"",
        &["line 12", "must be a number", "the text \"1.0\"", "remove the quotes"],
    ),
    (
        "rigidity = 1.0",
        "rigidity = 1\npreferred_curvature = \"0.5*rho + kappa\"",
        &["line 13", "`energy.bending.preferred_curvature`", "column 11"],
    ),
    (
        "rigidity = 1.0",
        "rigidity = 1\npreferred_curvature = \"0.5*rho\"\ndensity = \"lipid\"",
        &["line 14", "`energy.bending.density`", "\"lipid\"", "did you mean `protein`"],
    ),
    ("[energy.bending]", "[energy.bendng]", &["line 11 | [energy.bendng]", "did you mean `bending`"]),
    (
        "[energy.bending]\nrigidity",
        "[energy.area]\npresure",
        &["line 12", "unknown key `energy.area.presure`", "did you mean"],
    ),
    (
        "[energy.bending]\nrigidity",
        "[energy.area]\ntarget = 3.0\npressure",
        &["line 12", "`energy.area.target` and `energy.area.pressure` exclude", "keep `pressure` alone"],
    ),
    (
        "[energy.bending]\nrigidity",
        "[energy.area]\npenalty",
        &["line 11", "`energy.area.target_ratio` is missing", "target = 3.1"],
    ),
    (
        "[energy.bending]\nrigidity = 1.0",
        "[energy.area]\npenalty = -1.0\ntarget = 0",
        &["line 12", "`energy.area.penalty` = -1.0", "at least 0", "try penalty"],
    ),
    (
        "[energy.bending]\nrigidity = 1.0",
        "[energy.area]\npenalty = 1.0\ntarget_ratio = 0",
        &["line 13", "`energy.area.target_ratio` = 0", "greater than 0", "as target"],
    ),
    (
        "[energy.bending]\nrigidity = 1.0",
        "[energy.adhesion]\nkernel = \"exp(-r)\"",
        &["line 12", "`energy.adhesion.kernel`", "column 6", "`q`"],
    ),
    (
        "[energy.bending]\nrigidity = 1.0",
        "[energy.adhesion]\nkernel = \"exp(-q)\"\ncutoff = 0.0",
        &["line 13", "`energy.adhesion.cutoff` = 0.0", "greater than 0", "drop the key"],
    ),
    (
        "[energy.bending]\nrigidity = 1.0",
        "[energy.membrane]\ndensity = \"proten\"\nepsilon = 0.1",
        &["line 12", "`energy.membrane.density`", "did you mean `protein`"],
    ),
    (
        "[energy.bending]\nrigidity = 1.0",
        "[energy.membrane]\ndensity = \"protein\"\nepsilon = 0",
        &["line 13", "`energy.membrane.epsilon` = 0", "greater than 0", "0.01"],
    ),
    (
        "[energy.bending]\nrigidity = 1.0",
        "[energy.packing]\nmatrix = [[1, 0], [0, 1]]\nepsilon = 0.1",
        &["line 12", "entries of `energy.packing.matrix` is 2, but it must be 1", "one row for each density"],
    ),
    (
        "[energy.bending]\nrigidity = 1.0",
        "[energy.packing]\nmatrix = [[-1.5]]\nepsilon = 0.1",
        &["line 12", "`energy.packing.matrix`", "lowest eigenvalue is -1.5", "greater than 0", "larger"],
    ),
    (
        "[time]",
        "[flow]\nstop_on_contact = 1\n[time]",
        &["line 19", "`flow.stop_on_contact` must be true or false", "the integer 1"],
    ),
    (
        "tolerance = 1e-5",
        "tolerance = 0.5",
        &["line 22", "`accuracy.tolerance` = 0.5", "between 1e-11 and 0.1", "try 1e-5"],
    ),
    ("tolerance = 1e-5", "tolerance = 1e-12", &["line 22", "1e-12", "between 1e-11 and 0.1", "try 1e-5"]),
    ("tolerance = 1e-5", "tolerance = 1e999", &["line 22", "1e999", "too large", "try 1e-5"]),
    ("nodes = 256", "nodes = 4", &["line 23", "`accuracy.nodes` = 4", "between 8 and 65536", "try 256"]),
    (
        "nodes = 256",
        "nodes = 256.5",
        &["line 23", "`accuracy.nodes`", "an integer", "256.5", "without a decimal point"],
    ),
    (
        "nodes = 256",
        "nodes = \"many\"",
        &["line 23", "`accuracy.nodes`", "\"many\"", "an integer or \"auto\""],
    ),
    (
        "nodes = 256",
        "derivative = \"central-5\"",
        &["line 23", "\"central-5\"", "did you mean `central-", "`fourier`"],
    ),
    (
        "nodes = 256",
        "linear_solver = \"magic\"",
        &["line 23", "`accuracy.linear_solver`", "\"magic\"", "`banded`"],
    ),
    ("end = 1.0", "end = inf", &["line 19", "`time.end` = inf", "finite", "try end"]),
    ("end = 1.0", "end = 0", &["line 19", "`time.end` = 0", "greater than 0", "try end"]),
    (
        "end = 1.0",
        "end = 1.0\nstop_at_equilibrium = \"true\"",
        &["line 20", "true or false", "remove the quotes"],
    ),
    (
        "end = 1.0",
        "end = 1.0\nequilibrium_tolerance = 1",
        &["line 20", "= 1 ", "greater than 0 and at most 0.01", "1e-7"],
    ),
    (
        "end = 1.0",
        "end = 1.0\nmax_steps = 0",
        &["line 20", "`time.max_steps` = 0", "between 1", "drop the key"],
    ),
    ("[time]\nend = 1.0", "", &["whole file", "`time` is missing", "[time] with end = 1.0"]),
    ("frames = 10", "frames = 0", &["line 26", "`output.frames` = 0", "between 1 and 100000", "try 200"]),
    ("frames = 10", "frames = 10\ntimes = [0.5]", &["line 26", "`output.frames` and `output.times`", "keep"]),
    (
        "frames = 10",
        "times = [0.5, 0.25]",
        &["line 26", "`output.times` must increase", "0.25 follows 0.5", "sort"],
    ),
    (
        "frames = 10",
        "times = [0.5,\n 7.0]",
        &["line 27 | 7.0]", "`output.times.1` = 7.0", "between 0 and 1", "time.end"],
    ),
    (
        "frames = 10",
        "spacing = \"logarithmic\"",
        &["line 26", "\"logarithmic\"", "did you mean `log`", "`linear`"],
    ),
    (
        "frames = 10",
        "fields = [\"normal-force\", \"excess-denisty\"]",
        &[
            "line 26",
            "`output.fields.1`",
            "\"excess-denisty\"",
            "did you mean `excess-density`",
            "`energy-density`",
        ],
    ),
    (
        "frames = 10",
        "fields = \"normal-force\"",
        &["line 26", "`output.fields` must be a list of names", "[brackets]"],
    ),
    (
        "shape = \"trillium\"",
        "shape = \"circel\"",
        &["line 4", "`curve.shape`", "\"circel\"", "did you mean `circle`"],
    ),
    (
        "shape = \"trillium\"",
        "shape = \"circle\"",
        &["line 3 | [curve]", "`curve.radius` is missing", "radius = 1.0"],
    ),
    (
        "shape = \"trillium\"",
        "shape = \"circle\"\nradius = 0",
        &["line 5", "`curve.radius` = 0", "greater than 0"],
    ),
    (
        "shape = \"trillium\"",
        "shape = \"trillium\"\nradius = 1",
        &["line 5", "unknown key `curve.radius`", "`turning_number`"],
    ),
    (
        "shape = \"trillium\"",
        "shape = \"trillium\"\nturning_number = 2",
        &["line 5", "= 2", "must be 1", "drop the key"],
    ),
    (
        "shape = \"trillium\"",
        "shape = \"ellipse\"\nsemi_axes = [2.0]",
        &["line 5", "is 1, but it must be 2", "[2.0, 1.0]"],
    ),
    (
        "shape = \"trillium\"",
        "shape = \"polar\"\nr = \"1 + cos(3*phj)\"",
        &["line 5", "`curve.r`", "column 11"],
    ),
    (
        "shape = \"trillium\"",
        "shape = \"points\"\nfile = \"no/such\"",
        &["line 5", "`curve.file`", "no/such", "folder"],
    ),
    (
        "shape = \"trillium\"",
        "shape = \"points\"\npoints = [[0, 1], [1, 0]]",
        &["line 5", "is 2, but it must be between 8 and"],
    ),
    ("initial = \"0.5 +", "initial = \"kappa +", &["line 8", "`density.0.initial`", "column 1"]),
    (
        "mobility = \"diffusion\"",
        "mobility = \"reaction\"",
        &["line 9", "`density.0.mobility`", "\"reaction\"", "`diffusion`, `exchange`, `none`"],
    ),
    (
        "mobility = \"diffusion\"",
        "mobility = \"exchnage\"",
        &["line 9", "\"exchnage\"", "did you mean `exchange`"],
    ),
    (
        "mobility = \"diffusion\"",
        "mobility = \"exchange\"\nweight = 2",
        &["line 10 | weight = 2", "`density.0.weight`", "`mobility` = \"exchange\"", "drop the weight"],
    ),
    (
        "mobility = \"diffusion\"",
        "mobility = \"none\"\nweight = \"1 + s\"",
        &["line 10", "`density.0.weight`", "`mobility` = \"none\"", "mobility = \"diffusion\""],
    ),
    (
        "mobility = \"diffusion\"",
        "mobility = \"diffusion\"\nweight = \"1 + 2*cos(2*pi*s)\"",
        &["line 10", "`density.0.weight`", "at s = 0.33", "greater than 0", "add a constant"],
    ),
    (
        "mobility = \"diffusion\"",
        "mobility = \"diffusion\"\nweight = 0",
        &["line 10", "`density.0.weight`", "greater than 0"],
    ),
    (
        "mobility = \"diffusion\"",
        "mobility = \"diffusion\"\nweight = \"1 + rho\"",
        &["line 10", "`density.0.weight`", "column 5"],
    ),
    (
        "mobility = \"diffusion\"",
        "mobility = \"diffusion\"\nwieght = 1",
        &["line 10", "unknown key", "did you mean `weight`"],
    ),
    (
        "mobility = \"diffusion\"",
        "mobility = \"difusion\"",
        &["line 9", "\"difusion\"", "did you mean `diffusion`"],
    ),
    (
        "name = \"protein\"",
        "name = \"kappa\"",
        &["line 7", "`density.0.name`", "\"kappa\"", "choose another"],
    ),
    ("name = \"protein\"", "name = \"my protein\"", &["line 7", "\"my protein\"", "start with a letter"]),
    (
        "name = \"protein\"",
        "name = 3",
        &["line 7", "must be text in quotes", "integer 3", "put it in quotes"],
    ),
    (
        "[time]",
        "[[density]]\nname = \"protein\"\ninitial = 0\nmobility = \"diffusion\"\n[time]",
        &["line 19", "density.0", "of its own"],
    ),
    (
        "[[density]]",
        "[density]",
        &["line 6 | [density]", "`density` must be a list of tables", "[[density]]"],
    ),
    (
        "target_ratio = 1.8",
        "target_ratio = 0",
        &["line 16", "`energy.length.target_ratio` = 0", "greater than 0", "try"],
    ),
    (
        "target_ratio = 1.8",
        "target_ratio = 1\ntarget = 6",
        &["line 16", "`energy.length.target`", "exclude", "keep one"],
    ),
    ("target_ratio = 1.8", "", &["line 14", "`energy.length.target_ratio` is missing", "target = "]),
    (
        "target_ratio = 1.8",
        "tension = 1.0",
        &["line 15", "`energy.length.tension` exclude", "keep `tension` alone"],
    ),
    (
        "[time]",
        "[energy.local]\nexpression = \"kappa^2 + lipid\"\n[time]",
        &["line 19", "`energy.local.expression`", "column 11"],
    ),
    (
        "[time]",
        "[flow]\nnormal_mobility = \"incompresible\"\n[time]",
        &["line 19", "\"incompresible\"", "did you mean `incompressible`", "`surface-diffusion`"],
    ),
    (
        "nodes = 256\n",
        "linear_solver = \"banded\"\n[flow]\nnormal_mobility = \"surface-diffusion\"\n",
        &[
            "line 23 | linear_solver",
            "`accuracy.linear_solver` does not go with `flow.normal_mobility` = \"surface-diffusion\"",
            "order of the flow to 8",
            "use \"auto\"",
        ],
    ),
    (
        "nodes = 256\n",
        "nodes = 16\n[flow]\nnormal_mobility = \"incompressible\"\n",
        &["line 23", "`accuracy.nodes` = 16", "between 21 and 65536", "try 128"],
    ),
    (
        "[time]",
        "[flow]\ngauge = \"arc-length\"\n[time]",
        &["line 19", "\"arc-length\"", "`scaled-arc-length`"],
    ),
    (
        "mobility = \"diffusion\"",
        "mobility = \"diffusion\"\nweight = \"1\"\n[flow]\ngauge = \"co-moving\"",
        &["`flow` and `density.weight` exclude", "fraction of the arc length", "scaled-arc-length"],
    ),
    (
        "[time]",
        "[flow]\ngauge = \"graded\"\n[time]",
        &["line 18 | [flow]", "`flow.grading` is missing", "grading = \"1 + 0.6*cos(4*pi*s)\""],
    ),
    (
        "[time]",
        "[flow]\ngrading = \"1 + 0.5*cos(2*pi*s)\"\n[time]",
        &[
            "line 19 | grading",
            "`flow.grading` does not go with `gauge` = \"scaled-arc-length\"",
            "use gauge = \"graded\"",
        ],
    ),
    (
        "[time]",
        "[flow]\ngauge = \"graded\"\ngrading = \"cos(2*pi*s)\"\n[time]",
        &[
            "line 20 | grading",
            "`flow.grading` = \"cos(2*pi*s)\" is ",
            " at s = ",
            "greater than 0",
            "add a constant",
        ],
    ),
    (
        "[time]",
        "[[flow.switch]]\ntime = 0.3\ngauge = \"scaled-arc-length\"\n[[flow.switch]]\ntime = 0.2\ngauge = \"scaled-arc-length\"\n[time]",
        &["line 22 | time = 0.2", "`flow.switch.1.time` must increase", "0.2 follows 0.3"],
    ),
    (
        "[time]",
        "[[flow.switch]]\ntime = -1.0\ngauge = \"scaled-arc-length\"\n[time]",
        &["line 19 | time = -1.0", "`flow.switch.0.time`", "between 0 and 1"],
    ),
    (
        "[time]",
        "[[flow.switch]]\ntime = 0.1\n[time]",
        &["line 18", "`flow.switch.0.gauge` is missing", "gauge = \"scaled-arc-length\""],
    ),
    (
        "[time]",
        "[flow]\ngauge = \"graded\"\ngrading = \"1 + cos(phi)\"\n[time]",
        &["line 20 | grading", "`flow.grading`", "phi"],
    ),
    ("[time]", "[tiem]", &["line 18 | [tiem]", "unknown key `tiem`", "did you mean `time`"]),
    ("title = \"good\"", "title = good", &["line 2 | title = good", "not valid TOML at column 9", "quotes"]),
    ("end = 1.0", "end = 1.0\nend = 2.0", &["line 20 | end = 2.0", "duplicate key", "only once"]),
    ("end = 1.0", "end = ", &["line 19 | end =", "no value after `=`", "remove the line"]),
];

fn message(text: &str) -> String {
    Scene::parse(text, "bad.toml").map_or_else(|error| error.to_string(), |_| String::from("no error"))
}

#[test]
fn every_mistake_has_a_message_that_teaches() {
    assert!(Scene::parse(GOOD, "good.toml").is_ok());
    let mut failures = Vec::new();
    for (from, to, words) in MISTAKES {
        assert!(GOOD.contains(from), "nothing to replace: {from}");
        let message = message(&GOOD.replace(from, to));
        println!("{message}\n");
        for word in words.iter().filter(|word| !message.contains(**word)) {
            failures.push(format!("no `{word}` in:\n{message}"));
        }
        if !message.starts_with("bad.toml, ") {
            failures.push(format!("more than one problem, or no source:\n{message}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
}

#[test]
fn mistakes_in_agents() {
    let with = |from: &str, to: &str| message(&format!("{GOOD}{}", AGENTS.replace(from, to)));
    assert_eq!(with("", ""), "no error");
    let cases: [(&str, &str, &[&str]); 4] = [
        ("'protein'", "'protien'", &["line 28", "\"protien\"", "did you mean `protein`"]),
        (
            "epsilon = 0.05",
            "epsilon = 0.0",
            &["line 29", "`energy.agents.epsilon` = 0.0", "greater than 0", "0.05"],
        ),
        ("'1.3 - 2*rho'", "'1.3 - 2*kappa'", &["line 31", "`energy.agents.preferred_curvature`", "column 9"]),
        ("low_density", "lower_density", &["line 32", "did you mean `low_density`"]),
    ];
    for (from, to, words) in cases {
        let message = with(from, to);
        println!("{message}\n");
        for word in words {
            assert!(message.contains(word), "no `{word}` in:\n{message}");
        }
    }
    let without = message(&format!("{}{AGENTS}", GOOD.replace("protein", "lipid")));
    assert!(without.contains("densities are `lipid`"), "{without}");
}

/// `GOOD` with a second density from line 11 on, and one more table, from line 17 on, instead of the bending.
fn with_two_densities(table: &str) -> String {
    let lipid = "[[density]]\nname = 'lipid'\ninitial = 0.5\nmobility = 'diffusion'\n\n[energy.bending]\n";
    let text = GOOD.replace("[energy.bending]\n", &format!("\n{lipid}"));
    text.replace("[energy.bending]\nrigidity = 1.0", table)
}

#[test]
fn mistakes_with_several_densities() {
    let packing = |matrix: &str| format!("[energy.packing]\nepsilon = 0.1\nmatrix = {matrix}");
    let bending =
        |rest: &str| format!("[energy.bending]\nrigidity = 1.0\npreferred_curvature = 'rho^2'\n{rest}");
    let cases: [(String, &[&str]); 8] = [
        (packing("[[1.0, 0.5], [0.5, 1.0]]"), &["no error"]),
        (bending("density = 'lipid'"), &["no error"]),
        (
            bending(""),
            &["line 17 | [energy.bending]", "`energy.bending.density` is missing", "`rho` stands for"],
        ),
        (
            packing("[\n[1.0, 0.5],\n[0.4, 1.0]]"),
            &[
                "line 21",
                "`energy.packing.matrix.1`",
                "entry 0 (from 0) is 0.4",
                "entry 1 of row 0 is 0.5",
                "symmetric",
            ],
        ),
        (
            packing("[[1.0, 2.0], [2.0, 1.0]]"),
            &["line 19", "not positive definite", "eigenvalue is -1.000000", "greater than 0"],
        ),
        (
            packing("[[1.0, 2.0], [2.0]]"),
            &[
                "line 19",
                "entries of `energy.packing.matrix.1` is 1, but it must be 2",
                "one number for each",
            ],
        ),
        (packing("[[1.0, 'x'], [2.0, 1.0]]"), &["line 19", "`energy.packing.matrix.0.1` must be a number"]),
        (packing("3.0"), &["line 19", "must be a list", "the number 3.0", "brackets"]),
    ];
    for (table, words) in cases {
        let message = message(&with_two_densities(&table));
        println!("{message}\n");
        for word in words {
            assert!(message.contains(word), "no `{word}` in:\n{message}");
        }
    }
}

#[test]
fn what_needs_a_density_says_so() {
    let without = &GOOD[..GOOD.find("[[density]]").unwrap()];
    let rest = &GOOD[GOOD.find("[energy.length]").unwrap()..];
    let message = |table: &str| message(&format!("{without}{table}\n{rest}"));
    let bending = message("[energy.bending]\nrigidity = 1\npreferred_curvature = 'rho'");
    assert!(
        bending
            .contains("`energy.bending.preferred_curvature` depends on `rho`, but the scene has no density")
    );
    let packing = message("[energy.packing]\nmatrix = []\nepsilon = 1");
    assert!(
        packing.contains(
            "`energy.packing.matrix` packs the densities of the scene, but the scene has no density"
        )
    );
    assert_eq!(message("[energy.bending]\nrigidity = 1\npreferred_curvature = '1/3'"), "no error");
    assert_eq!(message("[energy.local]\nexpression = 'kappa^4'"), "no error");
}

#[test]
fn an_unknown_key_and_a_missing_one_are_two_problems() {
    let message = message(&GOOD.replace("rigidity = 1.0", "stiffness = 1.0"));
    assert!(message.contains("line 12") && message.contains("line 11"), "{message}");
    assert!(
        message.contains("unknown key `energy.bending.stiffness`: the keys here are `rigidity`"),
        "{message}"
    );
}

#[test]
fn all_problems_are_reported_at_once_in_the_order_of_their_lines() {
    let text = GOOD
        .replace("rigidity = 1.0", "rigidity = -1")
        .replace("penalty = 3.0", "penalty = inf")
        .replace("end = 1.0", "end = 0")
        .replace("tolerance = 1e-5", "tolerance = 2");
    let error = Scene::parse(&text, "bad.toml").unwrap_err();
    println!("{error}");
    let lines: Vec<Option<usize>> =
        error.problems().iter().map(flow_core::run::scene::Problem::line).collect();
    assert_eq!(lines, [Some(12), Some(15), Some(19), Some(22)]);
    assert!(error.to_string().starts_with("4 problems in bad.toml:\n"));
    assert_eq!(error.problems()[3].key, "accuracy.tolerance");
}

#[test]
fn a_wrong_override_is_shown_as_it_was_given() {
    let set = |key: &str, value: &str| {
        let error = Scene::parse_with(GOOD, "bad.toml", &[(key.to_owned(), value.to_owned())]).unwrap_err();
        println!("{error}\n");
        assert!(matches!(error.problems()[0].place, Place::Override { .. }), "{error}");
        error.to_string()
    };
    let tolerance = set("accuracy.tolerance", "7");
    assert!(tolerance.contains("--set accuracy.tolerance=7") && tolerance.contains("between 1e-11"));
    assert!(set("acuracy.tolerance", "1e-3").contains("did you mean `accuracy`"));
    assert!(set("energy.regularization", "3").contains("must be a table"));
    assert!(set("energy.regularization.delte", "3").contains("did you mean `delta`"));
    assert!(set("density.lipid.initial", "0.5").contains("none of them is `lipid`"));
    assert!(set("density.1.initial", "0.5").contains("1 entries"));
    assert!(set("density.protein.initial", "0.5 +").contains("density.protein.initial=0.5 +"));
    assert!(set("time.end.value", "1").contains("is a value, not a table"));
    assert!(set("time..end", "1").contains("not a dotted path"));
    assert!(set("", "1").contains("not a dotted path"));
    assert!(set(&"a.".repeat(100_000), "1").contains("not a dotted path"));
    assert!(set("curve", "{shape = 'circle'}").contains("`curve.radius` is missing"));
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
    let file = std::env::temp_dir().join(format!("curveflow-not-text-{}.toml", std::process::id()));
    std::fs::write(&file, b"title = \"\xff\"").unwrap();
    let error = Scene::read(&file).unwrap_err();
    std::fs::remove_file(&file).unwrap();
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
        (0..80_000).fold(String::new(), |text, i| format!("{text}k{i}=1\n")),
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
