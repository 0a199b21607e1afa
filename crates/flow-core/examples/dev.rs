//! Scratch.
use flow_core::energies::*;
use flow_core::expression::Expression;
use flow_core::flow::*;
use flow_core::geometry::*;
use flow_core::integrator::*;
use flow_core::operators::*;
use flow_core::run::*;
use std::time::Instant;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n: usize = a[1].parse().unwrap();
    let tol: f64 = a[2].parse().unwrap();
    let eps: f64 = a[3].parse().unwrap();
    let end: f64 = a[4].parse().unwrap();
    let solver = match a[5].as_str() {
        "f" => LinearSolver::Fourier,
        "b" => LinearSolver::Banded,
        "d" => LinearSolver::Dense,
        _ => LinearSolver::Auto,
    };
    let family = match a.get(6).map(String::as_str) {
        Some("2") => DerivativeFamily::Central2,
        Some("4") => DerivativeFamily::Central4,
        Some("8") => DerivativeFamily::Central8,
        _ => DerivativeFamily::Fourier,
    };
    let text = std::fs::read_to_string(format!("/tmp/proto/tri_{n}.txt")).unwrap();
    let v: Vec<f64> = text.split_whitespace().map(|x| x.parse().unwrap()).collect();
    let length = v[n];
    let willmore = eps == 0.0;
    let layout = Layout::new(n, usize::from(!willmore));
    let tau = std::f64::consts::TAU;
    let rho: Vec<f64> = (0..n)
        .map(|i| {
            let s = i as f64 / n as f64;
            0.9 + 0.05 * (3.0 * tau * s).cos() + 0.02 * (tau * s).cos()
        })
        .collect();
    let density = if willmore { vec![] } else { vec![rho] };
    let mut y = layout.assemble(&v[..n], &density, length);
    for repeat in 0..3 {
        let grid = PeriodicGrid::new(n);
        let d = Derivative::new(family, &grid);
        let e = |t: &str| Expression::parse(t, &["kappa", "rho"]).unwrap();
        let lines = NodalLines {
            preferred_curvature: e("1.3 - 2.0/0.76*(rho - 0.19)"),
            low_density: e("0.05 + 0.16*exp(-(kappa - 1.0)^2*ln(0.16/0.14)/0.09)"),
            high_density: e("0.80 + 0.18*exp(-(kappa + 0.3)^2*ln(0.18/0.15)/0.16)"),
        };
        let mut terms: Vec<Box<dyn EnergyTerm>> = vec![];
        if willmore {
            terms.push(Box::new(Bending::new(1.0)));
            terms.push(Box::new(Length::Penalty { penalty: 5.0, target: length }));
        } else {
            terms.push(Box::new(Agents::new(0, eps, 0.2, &lines, n).unwrap()));
            terms.push(Box::new(Length::Penalty { penalty: 3.0, target: 1.8 * length }));
        }
        let sum = EnergySum::new(terms, layout, &grid, &d);
        let map = FlowMap::new(layout, &grid, &d);
        let flow = GradientFlow::new(
            map,
            sum,
            layout,
            Box::new(Identity),
            vec![DensityMobility::Diffusion; layout.densities()],
        );
        let mut m = Membrane::new(flow, solver, 1, 0.0);
        if repeat == 0 {
            let mut rate = vec![0.0; y.len()];
            let mut w = rate.clone();
            let r = m.flow().rate(&y, &mut rate);
            println!("energy {} dissipation {:e}", r.energy, r.dissipation);
            m.linearise(&y);
            let t = Instant::now();
            for _ in 0..1000 {
                m.flow().rate(&y, &mut rate);
            }
            println!("rate {:.2} us", t.elapsed().as_secs_f64() * 1e3);
            let t = Instant::now();
            for _ in 0..1000 {
                m.flow().dissipation_at(&y);
            }
            println!("dissipation {:.2} us", t.elapsed().as_secs_f64() * 1e3);
            let t = Instant::now();
            for _ in 0..1000 {
                m.linearise(&y);
            }
            println!("linearise {:.2} us", t.elapsed().as_secs_f64() * 1e3);
            let t = Instant::now();
            for _ in 0..1000 {
                m.jacobian_product(&rate, &mut w);
            }
            println!("jv {:.2} us", t.elapsed().as_secs_f64() * 1e3);
            let t = Instant::now();
            for _ in 0..100 {
                m.factorise(1e-3);
            }
            println!("factorise {:.2} us", t.elapsed().as_secs_f64() * 1e4);
            let t = Instant::now();
            for _ in 0..1000 {
                m.precondition(&mut w);
            }
            println!("precondition {:.2} us", t.elapsed().as_secs_f64() * 1e3);
            let t = Instant::now();
            for _ in 0..1000 {
                let mut z = y.clone();
                m.finish(0.0, &mut z);
            }
            println!("finish {:.2} us", t.elapsed().as_secs_f64() * 1e3);
            let Finish::Good { .. } = m.finish(0.0, &mut y) else { panic!() };
        }
        let Finish::Good { energy, dissipation: _, integral_rates } = m.finish(0.0, &mut y.clone()) else {
            panic!()
        };
        let t = Instant::now();
        let mut c = Counters::default();
        let bdf = Bdf::new(&mut m, &y, integral_rates, tol, &mut c);
        let mut ad = Adaptive::new(bdf, AdaptiveOptions { end, most_steps: 100000 }, energy, c);
        let e0 = energy;
        let mut last = e0;
        let mut worst: f64 = 0.0;
        let verbose = repeat == 0 && a.len() > 7;
        while ad.stepper().time() < end {
            match ad.step(&mut m) {
                Ok(r) => {
                    worst = worst.max((r.energy - e0 + ad.integrals()[0]).abs());
                    if verbose {
                        println!(
                            "{} {:.4e} h {:.3e} k {} E {:.10} D {:.3e} bal {:.2e} rej {:?} kry {}",
                            ad.counters().steps,
                            r.time,
                            r.size,
                            r.order,
                            r.energy,
                            r.dissipation,
                            r.energy - e0 + ad.integrals()[0],
                            r.rejections,
                            ad.counters().krylov_iterations
                        );
                    }
                    last = r.energy;
                }
                Err(e) => {
                    println!("{e}");
                    break;
                }
            }
        }
        let el = t.elapsed().as_secs_f64();
        let yl = ad.stepper().state();
        println!(
            "time {:.2} ms E {:.8} L {:.8} balance {:.2e} defect {:.1e} {:?}",
            el * 1e3,
            last,
            yl[yl.len() - 1],
            worst,
            m.closure_defect(),
            ad.counters()
        );
        if repeat == 2 && a.len() > 8 {
            std::fs::write(&a[8], yl.iter().map(|x| format!("{x:e}\n")).collect::<String>()).unwrap();
        }
    }
}
