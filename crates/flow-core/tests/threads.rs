//! What owns a run may change threads and be shared by them.

use flow_core::flow::{GradientFlow, Preconditioner};
use flow_core::run::{Membrane, Record, Scene, Setup, Simulation};

fn may_be_shared<T: Send + Sync>() {}

#[test]
fn what_owns_a_run_may_be_shared_by_threads() {
    may_be_shared::<Scene>();
    may_be_shared::<Setup>();
    may_be_shared::<GradientFlow>();
    may_be_shared::<Preconditioner>();
    may_be_shared::<Membrane>();
    may_be_shared::<Simulation>();
    may_be_shared::<Record>();
}
