//! The engine's colliders of outlines.
//!
//! [`Shape`] → `ColliderBuilder`, in the frame of the link or prop.

use rapier2d::prelude::*;

use crate::character::{Outline, Shape, Solid};
use crate::world::vector::vector;

/// The collider of a link's or a prop's outline.
pub(crate) fn outline(shape: &Shape) -> ColliderBuilder {
    built(&shape.solid())
}

fn built(solid: &Solid) -> ColliderBuilder {
    match solid {
        Solid::Ball { radius, centre } => {
            ColliderBuilder::ball(*radius as f32).translation(vector(*centre))
        }
        Solid::Capsule {
            radius,
            ends: [from, to],
        } => ColliderBuilder::capsule_from_endpoints(vector(*from), vector(*to), *radius as f32),
        Solid::Cuboid { half, centre } => {
            let [half_width, half_height] = half.map(|x| x as f32);
            ColliderBuilder::cuboid(half_width, half_height).translation(vector(*centre))
        }
        Solid::Polygon(Outline { corners, radius }) => {
            let corners: Vec<Vector> = corners.iter().map(|c| vector(*c)).collect();
            let sharp = *radius <= 0.0;
            let polygon = if sharp {
                ColliderBuilder::convex_polyline(corners)
            } else {
                ColliderBuilder::round_convex_polyline(corners, *radius as f32)
            };
            // Corners that span no area touch nothing.
            polygon.unwrap_or_else(|| ColliderBuilder::ball(*radius as f32))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_reach_as_far_as_their_corners_and_radius() {
        let corners = vec![[-0.3, 0.0], [0.3, 0.0], [0.0, 0.4]];
        for radius in [0.0, 0.1] {
            let corners = corners.clone();
            let collider = built(&Solid::Polygon(Outline { corners, radius })).build();
            let bounds = collider.shape().compute_local_aabb();
            let reach = [bounds.mins.x, bounds.mins.y, bounds.maxs.x, bounds.maxs.y];
            let expected = [-0.3 - radius, -radius, 0.3 + radius, 0.4 + radius];
            for (found, expected) in reach.into_iter().zip(expected) {
                assert!((f64::from(found) - expected).abs() < 1e-6, "{bounds:?}");
            }
        }
    }
}
