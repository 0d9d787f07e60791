//! Two methods that share nothing, films without cells and rings of columns, agree wherever tables have nodes.
#![allow(clippy::unwrap_used)]

use sommerfeld_database::direction::Direction;
use sommerfeld_database::node_film::NodeFilm;
use sommerfeld_film::Cavitation;

#[test]
fn films_of_nodes_are_within_their_error_of_rings() {
    const TOLERANCE: f64 = 2e-5;
    let mut by_rings = 0;
    for closure in [Cavitation::Gumbel, Cavitation::Reynolds] {
        for width_ratio in [0.2, 0.5, 1.0] {
            let mut film = NodeFilm::new(closure, width_ratio, TOLERANCE);
            for eps in [0.0, 0.3, 0.8, 0.95, 0.99, 0.999] {
                for k in 0..4 {
                    let angle = Direction::angle(eps, -0.9 + 0.55 * f64::from(k));
                    let own = film.solve(eps, angle, false).unwrap();
                    if own.by_rings {
                        by_rings += 1;
                        continue;
                    }
                    let rings = film.rings(eps, angle, false).unwrap();
                    let [along, across] = [0, 1].map(|row| own.force[row] - rings.force[row]);
                    let off = along.hypot(across) / rings.force[0].hypot(rings.force[1]);
                    let place =
                        format!("{closure:?} {width_ratio} {eps} {angle}: {own:?} {rings:?}");
                    assert!(off < own.error + rings.error, "{off:e} {place}");
                    assert!((own.peak / rings.peak - 1.0).abs() < 3e-3, "{place}");
                    assert!(
                        (own.side_flow / rings.side_flow - 1.0).abs() < 5e-3,
                        "{place}"
                    );
                    assert!(
                        (own.full_film_share - rings.full_film_share).abs() < 0.04,
                        "{place}"
                    );
                }
            }
        }
    }
    println!("{by_rings} of 144 by rings");
    assert!(by_rings < 40, "{by_rings}");
}
