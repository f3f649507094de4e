//! Why elements and attributes of URDF have no place in a scene.

/// The reason, by the name of the element or attribute.
pub(super) fn why(name: &str) -> &'static str {
    match name {
        "transmission" | "ros2_control" => "a scene drives a joint by an expression, `drive` of [[joint]]",
        "gazebo" | "plugin" => "it is for the simulator Gazebo",
        "sensor" => "a scene has no sensors: a recording has the motion of every body",
        "material" | "color" | "texture" => "it concerns looks only",
        "mimic" => "a scene has no joints that follow others: this one moves freely",
        "safety_controller" | "soft_lower_limit" | "soft_upper_limit" | "k_position" | "k_velocity" => {
            "it belongs to a controller; write a `drive`"
        }
        "calibration" => "it belongs to sensors of the joint",
        "friction" => "a scene has no dry friction in joints",
        "effort" => "it bounds what a controller may ask for; write it into the `drive`",
        "velocity" => "it bounds what a controller may ask for",
        "acceleration" | "jerk" => "it bounds what a controller may ask for",
        "verbose" | "collision_checking" | "contact" | "contact_coefficients" => {
            "a scene says who meets whom, and by which law, in [[contact]]"
        }
        "lower" | "upper" => "a joint of this type has no limits",
        "damping" => "a joint of this type has no coordinate that a drive could act on",
        "type" => "it is not known",
        _ => "it has no counterpart in a scene",
    }
}
