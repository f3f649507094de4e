//! The factors of P: exact at every key, near the natural mean between, and never spinning.

use super::factors::natural_mean;
use super::motion::{Follower, Pose, Track, carried_keys, keys};
use crate::export::drawing::{DrawnMotion, Mat3, Vec3};
use nalgebra::Rotation3;

fn rotation(x: f64, y: f64, z: f64) -> Mat3 {
    Rotation3::from_scaled_axis(Vec3::new(x, y, z)).into_inner()
}

fn poses(count: usize, gradient: impl Fn(f64) -> Mat3) -> Vec<Pose> {
    let pose = |k: usize| {
        let time = k as f64 / (count - 1) as f64;
        Pose { time, position: Vec3::new(time, 0.0, 0.0), gradient: gradient(time) }
    };
    (0..count).map(pose).collect()
}

/// The track of poses, of which each is a key.
fn followed(poses: &[Pose], is_rigid: bool) -> Result<Track, f64> {
    thinned(poses, is_rigid, |_| true)
}

/// The same with those alone that are said to be keys, and that are needed.
fn thinned(poses: &[Pose], is_rigid: bool, is_key: impl Fn(usize) -> bool) -> Result<Track, f64> {
    let mut follower = Follower::new(is_rigid, 1.0, usize::MAX);
    poses.iter().enumerate().try_for_each(|(k, pose)| follower.see(*pose, is_key(k)))?;
    Ok(follower.track)
}

/// What a player shows at a time.
fn shown(track: &Track, time: f64) -> Mat3 {
    let after = track.times.iter().position(|key| *key >= time).unwrap();
    if after == 0 || track.times[after] == time {
        return track.factors[after].product();
    }
    let (a, b) = (&track.factors[after - 1], &track.factors[after]);
    let part = (time - track.times[after - 1]) / (track.times[after] - track.times[after - 1]);
    a.between(b, part).product()
}

/// Checks a track at its keys, half-way between the poses, and that nothing spins.
fn check(name: &str, poses: &[Pose]) -> Track {
    let track = followed(poses, false).unwrap();
    let mut missed = [0.0_f64; 2];
    for pose in poses {
        let at = track.times.iter().position(|time| *time == pose.time).unwrap();
        let difference = track.factors[at].product() - pose.gradient;
        missed[0] = missed[0].max(difference.norm() / pose.gradient.norm());
    }
    for pair in poses.windows(2) {
        let time = 0.5 * (pair[0].time + pair[1].time);
        let mean = natural_mean(&pair[0].gradient, &pair[1].gradient).unwrap();
        missed[1] = missed[1].max((shown(&track, time) - mean).norm() / mean.norm());
    }
    println!(
        "{name}: {} keys of {}, missed by {:.1e}, half-way {:.1e}",
        track.times.len(),
        poses.len(),
        missed[0],
        missed[1]
    );
    // Entries of 1e-9 count as diagonal; a key half-way is asked for from 1e-3 on.
    assert!(missed[0] < 2e-9 && missed[1] < 1.5e-3, "{name}: {missed:?}");
    track
}

#[test]
fn rotating_sheared_body_is_met_at_its_keys_and_between() {
    let shear = Mat3::new(1.2, 0.5, 0.1, 0.0, 0.9, -0.2, 0.1, 0.0, 0.8);
    let track = check("tumbling", &poses(100, |t| rotation(3.0 * t, 5.0 * t, -2.0 * t) * shear));
    // The axes of stretch stay in the body.
    let turned = track.factors[0].inner.angle_to(&track.factors[99].inner);
    assert!(turned < 1e-7, "{turned}");
}

#[test]
fn stretches_that_cross_keep_their_axes() {
    let track = check("crossing", &poses(41, |t| Mat3::from_diagonal(&Vec3::new(0.5 + t, 1.5 - t, 1.0))));
    for factors in &track.factors {
        assert!(factors.inner.angle() < 1e-12 && factors.outer.angle() < 1e-12);
    }
    assert_eq!(track.times.len(), 41);
}

#[test]
fn a_body_without_deformation_does_not_spin() {
    let noise = |t: f64| Mat3::from_fn(|i, j| 1e-12 * (1e4 * t * (1.0 + (i + 3 * j) as f64)).sin());
    let wobble = |t: f64| rotation(7.0 * t, 1.0, 0.0) * (Mat3::identity() + noise(t));
    let track = check("rounding", &poses(50, wobble));
    for pair in track.factors.windows(2) {
        assert!(pair[0].inner.angle_to(&pair[1].inner) < 1e-9);
        assert!(pair[0].outer.angle_to(&pair[1].outer) < 0.15);
    }
}

#[test]
fn axes_that_turn_quickly_get_keys_in_between() {
    // Stretches that come within 1e-3 of each other, and part again along the diagonals: the axes turn by 45° in a
    // moment.
    let near = |t: f64| {
        let (along, across) = (0.3 * (0.5 - t), 1e-3);
        Mat3::identity() + Mat3::new(along, across, 0.0, across, -along, 0.0, 0.0, 0.0, 0.0)
    };
    check("avoided crossing", &poses(8, near));
    // A shear that grows: the axes turn all the time.
    check("simple shear", &poses(12, |t| Mat3::new(1.0, 4.0 * t, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)));
    // A bar that is pressed along one axis, let go, and pressed along another.
    let pressed = |t: f64| {
        let amount = 0.5 * (1.0 - 2.0 * t);
        let axis = if amount > 0.0 { Vec3::x() } else { Vec3::new(1.0, 1.0, 0.5).normalize() };
        Mat3::identity() - amount.abs() * axis * axis.transpose()
    };
    check("pressed twice", &poses(31, pressed));
}

#[test]
fn needles_and_plates_are_met() {
    let bar = Mat3::from_diagonal(&Vec3::new(100.0, 0.1, 0.1));
    check("needle", &poses(30, |t| rotation(0.0, 2.0 * t, 0.0) * bar * rotation(0.0, 0.0, 0.5)));
    let plate = Mat3::from_diagonal(&Vec3::new(10.0, 10.0, 0.01));
    check("plate", &poses(30, |t| rotation(t, 2.0 * t, 0.0) * plate));
}

#[test]
fn a_body_turned_inside_out_is_told() {
    let poses = poses(3, |t| Mat3::from_diagonal(&Vec3::new(1.0, 1.0, 1.0 - 2.0 * t)));
    assert_eq!(followed(&poses, false), Err(0.5));
}

#[test]
fn keys_are_samples_and_thinned_alike() {
    let times: Vec<f64> = (0..=200).map(|k| f64::from(k) * 0.01).collect();
    assert_eq!(keys(&times, 1), (0..=200).collect::<Vec<_>>());
    // Ten seconds at 1 kHz: 60 keys a second.
    let times: Vec<f64> = (0..=10_000).map(|k| f64::from(k) * 1e-3).collect();
    let chosen = keys(&times, 1);
    assert!((550..=601).contains(&chosen.len()), "{}", chosen.len());
    assert_eq!((chosen[0], chosen[chosen.len() - 1]), (0, 10_000));
    // A millisecond in 10 000 samples: 300 keys.
    let times: Vec<f64> = (0..=10_000).map(|k| f64::from(k) * 1e-7).collect();
    assert!((280..=301).contains(&keys(&times, 1).len()));
    assert_eq!(keys(&[0.0], 1), [0]);
    assert_eq!(keys(&[], 1), [0_usize; 0]);
}

/// A sixtieth of a second between keys, a thousandth between samples: what lies between is shown as it was recorded.
#[test]
fn what_turns_fast_or_strains_fast_keeps_the_samples_that_it_needs() {
    let spinning = |t: f64| rotation(0.0, 0.0, 300.0 * t) * rotation(0.3, 0.0, 0.0);
    let ringing = |t: f64| {
        rotation(0.0, 40.0 * t, 0.0) * Mat3::from_diagonal(&Vec3::new(1.0, 1.0, (400.0 * t).cos() * 0.2 + 1.0))
    };
    let slow = |t: f64| rotation(0.0, 0.0, 2.0 * t);
    for (name, gradient, is_rigid, least, most) in [
        ("top", &spinning as &dyn Fn(f64) -> Mat3, true, 110, 500),
        ("spun disc", &spinning, false, 110, 500),
        ("ringing", &ringing, false, 300, 1001),
        ("slow", &slow, true, 60, 62),
    ] {
        let poses = poses(1001, gradient);
        let track = thinned(&poses, is_rigid, |k| k % 17 == 0 || k == 1000).unwrap();
        let missed = poses.iter().map(|pose| (shown(&track, pose.time) - pose.gradient).norm() / pose.gradient.norm());
        let missed = missed.fold(0.0, f64::max);
        println!("{name}: {} keys, {} of them samples, missed by {missed:.1e}", track.times.len(), track.samples);
        assert!(missed < 1e-2, "{name}: {missed}");
        assert!((least..=most).contains(&track.samples), "{name}: {}", track.samples);
    }
}

/// Axes of stretch that turn by 120° and stay: each key begins at the quaternions of the last.
#[test]
fn factors_keep_their_length_however_many_keys_there_are() {
    let turned = |t: f64| {
        let angle = (10.0 * t).min(1.2);
        let axes = rotation(angle, angle, angle);
        axes * Mat3::from_diagonal(&Vec3::new(1.2, 1.05, 0.9)) * axes.transpose()
    };
    let track = check("axes that stay", &poses(1001, turned));
    let lengths = track.factors.iter().flat_map(|factors| [factors.outer.norm(), factors.inner.norm()]);
    let off = lengths.map(|length| (length - 1.0).abs()).fold(0.0, f64::max);
    assert!(off < 1e-15, "{off:e}");
}

/// A shaker at 59 Hz and a drum at 300 rad/s, whose bodies have 60 keys a second.
#[test]
fn supports_have_keys_of_their_own_where_they_move_fast() {
    let times: Vec<f64> = (0..=60).map(|k| f64::from(k) / 60.0).collect();
    let motion = |text: &str| serde_json::from_str::<DrawnMotion>(text).unwrap();
    let shaker =
        motion(r#"{ "oscillate": { "direction": [0, 0, 1], "amplitude": 0.01, "frequency": 59, "phase": 0 } }"#);
    let drum = motion(r#"[{ "rotate": { "axis": [0, 1, 0], "point": [0.01, 0, 0], "rate": -300 } }]"#);
    for (name, motion) in [("shaker", &shaker), ("drum", &drum)] {
        let keys = carried_keys(motion, &times);
        assert!(times.iter().all(|time| keys.contains(time)), "{name}");
        let mut missed = 0.0_f64;
        for pair in keys.windows(2) {
            let middle = motion.carried(0.5 * (pair[0] + pair[1])).1;
            missed = missed.max((middle - 0.5 * (motion.carried(pair[0]).1 + motion.carried(pair[1]).1)).norm());
        }
        println!("{name}: {} keys, missed by {missed:.1e} m of 0.01", keys.len());
        assert!(missed < 1e-4, "{name}: {missed}");
    }
    let slow = motion(r#"{ "velocity": [1, 0, 0] }"#);
    assert_eq!(carried_keys(&slow, &times), times);
    assert_eq!(carried_keys(&slow, &[]), [0.0; 0]);
}

/// A body that is shaken at 59 Hz, with 60 keys a second: it would seem to swing once a second.
#[test]
fn what_goes_to_and_fro_between_keys_keeps_the_samples_that_it_needs() {
    let mut poses = poses(1001, |_| Mat3::identity());
    poses.iter_mut().for_each(|pose| pose.position.z = 0.2 * (std::f64::consts::TAU * 59.0 * pose.time).sin());
    let track = thinned(&poses, true, |k| k % 17 == 0 || k == 1000).unwrap();
    let place = |time: f64| {
        let after = track.times.iter().position(|key| *key >= time).unwrap();
        let before = after.saturating_sub(1);
        let span = track.times[after] - track.times[before];
        let part = if span > 0.0 { (time - track.times[before]) / span } else { 1.0 };
        track.positions[before].lerp(&track.positions[after], part)
    };
    let missed = poses.iter().map(|pose| (place(pose.time) - pose.position).norm()).fold(0.0, f64::max);
    println!("{} keys, missed by {missed:.1e} of the size", track.times.len());
    assert!(missed <= 1e-2 && track.times.len() > 400, "{missed:e}, {} keys", track.times.len());
}
