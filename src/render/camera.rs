//! From the world to the picture.

/// Where a picture looks: level, from the characters' right side, so that forward is to the right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// World x in the middle of the picture, m.
    pub x: f64,
    /// px per m.
    pub scale: f64,
    /// Picture size, px.
    pub width: f64,
    /// px
    pub height: f64,
    /// Height of the ground line above the picture's lower edge, px.
    pub ground: f64,
}

impl Camera {
    /// Picture coordinates of a world point; x to the right, y down, px.
    #[must_use]
    pub fn at(&self, point: [f64; 2]) -> [f64; 2] {
        [
            self.width / 2.0 + (point[0] - self.x) * self.scale,
            self.height - self.ground - point[1] * self.scale,
        ]
    }

    /// World x at the left and right edge, m.
    #[must_use]
    pub fn span(&self) -> [f64; 2] {
        let half = 0.5 * self.width / self.scale;
        [self.x - half, self.x + half]
    }

    /// How large marks and texts are beside those of a film strip.
    pub(super) fn mark_size(&self) -> f64 {
        mark_size(self.scale)
    }
}

/// How large marks are at a scale in px per m.
pub(super) fn mark_size(scale: f64) -> f64 {
    (scale / 85.0).clamp(0.75, 2.5)
}
