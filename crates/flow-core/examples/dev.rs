//! Scratch.
use flow_core::integrator::*;
use flow_core::run::*;
use std::time::Instant;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let (_, text) = *Scene::shipped().iter().find(|(n, _)| *n == a[1]).unwrap();
    let mut out = String::new();
    let mut verbose = false;
    let mut set = vec![];
    for x in &a[2..] {
        let (k, v) = x.split_once('=').unwrap();
        if k == "out" { out = v.into() } else if k == "v" { verbose = true } else { set.push((k.to_string(), v.to_string())) }
    }
    let scene = Scene::parse_with(text, "x", &set).unwrap();
    let Setup { membrane: mut m, state: y, .. } = Setup::new(&scene).unwrap();
    if !verbose {
        let mut rate = vec![0.0; y.len()];
        let mut w = rate.clone();
        m.rate(&y, &mut rate);
        m.linearise(&y);
        let time = |name: &str, f: &mut dyn FnMut()| { let mut best = f64::MAX; for _ in 0..20 { let t = Instant::now(); for _ in 0..20 { f(); } best = best.min(t.elapsed().as_secs_f64() / 20.0); } print!("{name} {:.2} us  ", best * 1e6); };
        time("rate", &mut || { m.rate(&y, &mut rate); });
        time("linearise", &mut || { m.linearise(&y); });
        time("jv", &mut || { m.jacobian_product(&rate, &mut w); });
        time("factorise", &mut || { m.factorise(1e-3); });
        time("precondition", &mut || { m.precondition(&mut w); });
        time("finish", &mut || { m.finish(0.0, &mut y.clone()); });
        println!();
    }
    let mut best = f64::MAX;
    for _ in 0..if verbose { 1 } else { 5 } {
        let mut s = Simulation::new(&scene).unwrap();
        while s.step(&mut Quiet) {}
        let state = s.state();
        let r = s.into_record();
        if verbose { for f in r.frames.iter().step_by(6) { println!("F {:.3e} bal {:.3e}", f.time, f.energy_balance); } }
        if verbose { for i in 0..r.steps.time.len() { println!("{} {:.4e} h {:.3e} k {} E {:.10} D {:.3e}", i, r.steps.time[i], r.steps.size[i], r.steps.order[i], r.steps.energy[i], r.steps.dissipation[i]); } }
        if r.counters.integration_seconds < best {
            best = r.counters.integration_seconds;
            let l = r.frames.last().unwrap();
            println!("{:.2} ms t {:.3} E {:.8} L {:.8} bal {:.1e} mass {:?} {:?} {:?}", best * 1e3, l.time, l.energy, l.length, r.frames.iter().map(|f| f.energy_balance.abs()).fold(0., f64::max), l.mass.first().map(|m| m / r.frames[0].mass[0] - 1.0), r.stop_reason, r.counters);
        }
        if !out.is_empty() { std::fs::write(&out, state.iter().map(|x| format!("{x:e}\n")).collect::<String>()).unwrap(); }
    }
}
