//! What holds of every figure.
#![allow(clippy::unwrap_used)] // a failed test may panic

/// All points of the lines, circles and anchors of text of an SVG document lie on the page.
pub fn assert_inside(svg: &str) {
    let attributes = |name: &str| {
        let start = format!(" {name}=\"");
        let values = svg.split(&start).skip(1).map(|part| part.split('"').next().unwrap());
        values.map(str::to_owned).collect::<Vec<_>>()
    };
    let view = attributes("viewBox")[0].split(' ').map(|n| n.parse().unwrap()).collect::<Vec<f64>>();
    let assert_at = |value: &str, size: f64| {
        let value: f64 = value.parse().unwrap();
        assert!((0.0..=size).contains(&value), "{value} of {size}");
    };
    for points in attributes("points") {
        for point in points.split_whitespace() {
            let (x, y) = point.split_once(',').unwrap();
            assert_at(x, view[2]);
            assert_at(y, view[3]);
        }
    }
    for (names, size) in [(["x", "cx"], view[2]), (["y", "cy"], view[3])] {
        names.iter().flat_map(|name| attributes(name)).for_each(|value| assert_at(&value, size));
    }
    assert!(attributes("font-family").iter().all(|font| font == "DejaVu Sans, sans-serif"));
}
