//! Which links lie in front of which, as seen from a character's right side.
//!
//! model → links in layers, from back to front.

use aplomb_framework::character::Model;

/// Links that are edged together, since no line parts them where they are joined.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Layer {
    pub(super) far: bool,
    /// From back to front.
    pub(super) links: Vec<usize>,
    /// Those in front of all that, whatever it wears.
    pub(super) arms: Vec<usize>,
}

/// Which side a link is on, by the end of its name: `_r` is near, `_l` is far.
fn side(model: &Model, link: usize) -> i8 {
    let name = &model.links[link].name;
    i8::from(name.ends_with("_r")) - i8::from(name.ends_with("_l"))
}

fn parent(model: &Model, link: usize) -> Option<usize> {
    model.links[link].joint.as_ref().map(|j| j.parent)
}

/// The link and all above it, up to the root.
fn ancestors(model: &Model, link: usize) -> Vec<usize> {
    std::iter::successors(Some(link), |l| parent(model, *l)).collect()
}

/// Limbs: links of one side that hang together.
fn limbs(model: &Model, wanted: i8) -> Vec<Vec<usize>> {
    let mut limbs: Vec<Vec<usize>> = Vec::new();
    for link in (0..model.links.len()).filter(|l| side(model, *l) == wanted) {
        let above = parent(model, link);
        let same = limbs
            .iter_mut()
            .find(|l| above.is_some_and(|p| l.contains(&p)));
        match same {
            Some(limb) => limb.push(link),
            None => limbs.push(vec![link]),
        }
    }
    limbs
}

/// Far arms, far legs; tail, trunk and head, near legs, near arms in one layer.
pub(super) fn layers(model: &Model) -> Vec<Layer> {
    let stands = |limb: &Vec<usize>| limb.iter().any(|l| model.is_foot(*l));
    let (legs, arms): (Vec<_>, Vec<_>) = limbs(model, -1).into_iter().partition(stands);
    let far = arms.into_iter().chain(legs);
    let mut layers: Vec<Layer> = far
        .map(|links| Layer {
            far: true,
            links,
            arms: Vec::new(),
        })
        .collect();

    let mut spine = ancestors(model, model.trunk);
    spine.extend(ancestors(model, model.head));
    let middle = (0..model.links.len()).filter(|l| side(model, *l) == 0);
    let (trunk, others): (Vec<_>, Vec<_>) = middle.partition(|l| spine.contains(l));
    let (legs, arms): (Vec<_>, Vec<_>) = limbs(model, 1).into_iter().partition(stands);
    layers.push(Layer {
        far: false,
        links: [others, trunk, legs.concat()].concat(),
        arms: arms.concat(),
    });
    layers
}
