//! Proposition 3 of the paper: the membrane flux makes up for the change of length of every labelled piece.

use curveflow_tests::physics::labelled_pieces::measure;

#[test]
fn pieces_gain_in_length_what_flows_into_them() {
    // Pieces end between nodes: fields are interpolated there, which takes the order of the family.
    for (derivative, bound) in [("fourier", 3e-12), ("central-8", 1e-9), ("central-2", 2e-4)] {
        let pieces = measure(derivative);
        assert_eq!(pieces.len(), 12);
        for piece in pieces {
            let flux_error = (piece.inflow - piece.predicted).abs() / piece.scale;
            assert!(flux_error < bound, "{derivative}: {flux_error:.1e}, {piece:?}");
            // Central differences in the step by which the curve is moved.
            let moved_error = (piece.measured - piece.predicted).abs() / piece.scale;
            assert!(moved_error < 1e-8, "{derivative}: {moved_error:.1e}, {piece:?}");
        }
    }
}
