//! Pieces of a tooth profile.

use bevel_differential::contact::stiffness::*;

#[test]
fn rises_are_the_derivatives_of_the_heights() {
    let spans = [
        Span { piece: Piece::Arc { x: 6e-3, y: 22e-3, radius: 1e-3 }, from: -1.2, to: 0.1 },
        Span {
            piece: Piece::Trochoid { pitch: 45e-3, depth: 4e-3, radius: 1e-3, offset: 1.2e-3, half_pitch: 0.157 },
            from: 0.0,
            to: 11e-3,
        },
        Span { piece: Piece::Radial { slope: 0.1 }, from: 20e-3, to: 21e-3 },
        Span { piece: Piece::Involute { base: 25e-3, angle: 0.17 }, from: 0.0, to: 15e-3 },
    ];
    for span in spans {
        for share in [0.01, 0.3, 0.8] {
            let (u, h) = (span.from + share * (span.to - span.from), 1e-5 * (span.to - span.from));
            let point = span.piece.at(u);
            let rise = (span.piece.at(u + h).height - span.piece.at(u - h).height) / (2.0 * h);
            assert!((point.rise / rise - 1.0).abs() < 1e-6, "{span:?}: {} {rise}", point.rise);
        }
    }
}
