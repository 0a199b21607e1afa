//! The Gauss–Legendre rule of ten points on [0, 1], exact for polynomials of degree 19.

/// Points of the rule, increasing.
pub(super) const POINTS: [f64; 10] = [
    0.01304673574141414,
    0.06746831665550775,
    0.1602952158504878,
    0.2833023029353764,
    0.4255628305091844,
    0.5744371694908156,
    0.7166976970646236,
    0.8397047841495122,
    0.9325316833444922,
    0.9869532642585859,
];

/// Weights of the rule; their sum is 1.
pub(super) const WEIGHTS: [f64; 10] = [
    0.03333567215434407,
    0.0747256745752903,
    0.10954318125799102,
    0.13463335965499817,
    0.14776211235737644,
    0.14776211235737644,
    0.13463335965499817,
    0.10954318125799102,
    0.0747256745752903,
    0.03333567215434407,
];

/// The mean over [0, 1] of a function with `values` at the points.
pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().zip(&WEIGHTS).map(|(value, weight)| value * weight).sum()
}

/// The sums of 0, 1, … all `values`, compensated after Neumaier (ZAMM 54 (1974) 39).
pub(super) fn cumulative(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let (mut sum, mut lost) = (0.0_f64, 0.0);
    let mut sums = vec![0.0];
    for value in values {
        let next = sum + value;
        lost += if sum.abs() >= value.abs() { (sum - next) + value } else { (value - next) + sum };
        sum = next;
        sums.push(sum + lost);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_degree_19_are_exact() {
        for degree in 0..20 {
            let mean = mean(&POINTS.map(|x| x.powi(degree)));
            assert!((mean * f64::from(degree + 1) - 1.0).abs() < 1e-15, "degree {degree}: {mean}");
        }
    }

    #[test]
    fn cumulative_sums_lose_nothing() {
        assert_eq!(cumulative([1.0, 1e100, 1.0, -1e100].into_iter()), [0.0, 1.0, 1e100, 1e100, 2.0]);
    }
}
