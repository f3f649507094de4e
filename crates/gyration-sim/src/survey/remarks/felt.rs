//! How far spheres that feel one another through the fluid are right: two are, in a fluid that does not strain.

use crate::format::significant;
use gyration::model::Model;
use gyration::signal::Signal;
use gyration::tensor::Mat3;

/// What is not as for two, or for one beside a wall, and who has nobody to feel.
pub(super) fn notes(model: &Model) -> Vec<String> {
    let inclusion = |body: &usize| model.bodies[*body].inclusion.as_ref();
    let bodies = || 0..model.bodies.len();
    let felt: Vec<usize> = bodies().filter(|body| inclusion(body).is_some_and(|it| it.neighbours.is_some())).collect();
    let walled = || bodies().filter(|body| inclusion(body).is_some_and(|it| it.walls.is_some()));
    let of_spheres = match felt[..] {
        [] | [_, _] => None,
        [alone] => Some(format!(
            "no other inclusion says `neighbours = true`: \"{}\" feels nobody through the fluid",
            model.name(alone)
        )),
        _ => Some(format!(
            "{} spheres feel one another through the fluid by their far field and, two by two, exactly: what three \
             near one another do at a time beyond that is left out",
            felt.len()
        )),
    };
    let sum = "what each of them changes of the drag is added, as if the others were not there";
    let of_walls = walled()
        .next()
        .filter(|_| model.supports.len() > 1)
        .map(|body| format!("\"{}\" feels {} planes through the fluid: {sum}", model.name(body), model.supports.len()));
    let both = || walled().find(|body| felt.len() > 1 && felt.binary_search(body).is_ok());
    let of_both =
        both().map(|body| format!("\"{}\" feels walls and other spheres through the fluid: {sum}", model.name(body)));
    of_spheres.into_iter().chain(unequal(model, &felt)).chain(of_walls).chain(of_both).collect()
}

/// The ratio of radii up to which the series for two spheres leaves out a thousandth in touch.
const UNEQUAL: f64 = 10.0;

fn unequal(model: &Model, felt: &[usize]) -> Option<String> {
    let radius = |body: &usize| 0.5 * model.bodies[*body].size;
    let smallest = felt.iter().min_by(|a, b| radius(a).total_cmp(&radius(b)))?;
    let largest = felt.iter().max_by(|a, b| radius(a).total_cmp(&radius(b)))?;
    let ratio = radius(largest) / radius(smallest);
    (ratio > UNEQUAL).then(|| {
        format!(
            "\"{}\" is {} times as large as \"{}\": nearer than a tenth of their mean radius, what the fluid between \
             them does to the smaller one is known to some per cent of its drag alone at best",
            model.name(*largest),
            significant(ratio, 3),
            model.name(*smallest)
        )
    })
}

/// What the strain of the undisturbed flow leaves out.
pub(super) fn warning(model: &Model) -> Option<String> {
    let (spheres, fluid) = (model.spheres()?, model.fluid.as_ref()?);
    let strains = match &fluid.gradient {
        Signal::Constant(gradient) => gradient + gradient.transpose() != Mat3::zeros(),
        _ => true,
    };
    strains.then(|| {
        format!(
            "the undisturbed flow strains, and the {} spheres that feel one another are carried along by it as if each \
             were alone: the flow about a sphere that does not strain with the fluid is left out of what others feel",
            spheres.bodies().len()
        )
    })
}
