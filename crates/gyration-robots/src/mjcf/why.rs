//! Why elements and attributes of MJCF have no place in a scene.

/// The reason, by the name of the element or attribute.
pub(super) fn why(name: &str) -> &'static str {
    match name {
        "group" => "it concerns looks: geometry of every group has its mass",
        "material" | "rgba" | "texture" | "light" | "camera" | "skin" | "texcoord" | "texuniform" | "texrepeat"
        | "visual" | "global" | "quality" | "headlight" | "map" | "scale" | "texturedir" | "discardvisual" => {
            "it concerns looks only"
        }
        "contype" | "conaffinity" | "condim" | "friction" | "solref" | "solimp" | "solmix" | "margin" | "gap"
        | "priority" | "exclude" | "pair" | "contact" | "o_margin" | "o_solref" | "o_solimp" | "o_friction" => {
            "a scene says who meets whom, and by which law, in [[contact]]"
        }
        "armature" => "a scene has no inertia of rotors: add it to that of a body",
        "frictionloss" => "a scene has no dry friction in joints",
        "solreflimit" | "solimplimit" | "solreffriction" | "solimpfriction" => "a stop has a law of its own",
        "range" | "limited" => "a joint of this type, or an input, has no limits in a scene",
        "actuatorfrcrange" | "actuatorfrclimited" => "write the bounds into the `drive`, by min and max",
        "ctrlrange" | "ctrllimited" => "an input of a `drive` is what the scene says",
        "springdamper" => "its constants follow from inertias: write them into the `drive`",
        "stiffness" | "damping" | "springref" => "a joint of this type has no coordinate that a drive could act on",
        "connect" | "weld" | "joint" | "tendon" | "flex" | "equality" => {
            "an equality is no part of the tree: write a [[joint]], if it is one"
        }
        "spatial" | "fixed" => "a scene has no tendons: write springs or a `drive`",
        "site" => "a point without mass is none of a scene",
        "key" | "keyframe" => "a scene starts with the joints at their `ref`",
        "timestep" | "integrator" | "solver" | "iterations" | "tolerance" | "cone" | "jacobian" | "impratio"
        | "ls_iterations" | "ls_tolerance" | "noslip_iterations" | "noslip_tolerance" | "ccd_iterations"
        | "ccd_tolerance" | "sdf_iterations" | "sdf_initpoints" => {
            "the solver of a scene chooses its steps by a tolerance"
        }
        "wind" | "density" | "viscosity" | "fluidshape" | "fluidcoef" => {
            "the fluid of a scene is another model: see [fluid]"
        }
        "magnetic" => "a scene has no magnetic field",
        "mocap" => "what stands still in a scene may move as its `motion` says",
        "gravcomp" => "write it as a `force` of the body",
        "balanceinertia" | "boundmass" | "boundinertia" | "settotalmass" | "shellinertia" | "exactmeshinertia"
        | "inertia" => "inertias are those of the file, or of solid geometry",
        "inertiagrouprange" => "geometry of every group has its mass: write mass = \"0\" where it has none",
        "hfield" => "a scene has no height fields: write planes, or supports with a shape",
        "composite" | "flexcomp" | "attach" | "replicate" | "deformable" => {
            "MuJoCo expands it: save the expanded model and import that"
        }
        "plugin" | "extension" | "custom" | "numeric" | "text" | "tuple" | "user" | "size" | "statistic" | "memory"
        | "nuserdata" | "njmax" | "nconmax" | "nstack" | "nkey" => "it belongs to the program MuJoCo",
        "timeconst" | "dyntype" | "dynprm" | "actdim" | "actrange" | "actlimited" | "actearly" => {
            "an actuator of a scene has no state"
        }
        "kp" | "kv" => "an actuator of this kind has no such gain",
        "dampratio" => "its damping follows from the inertia at the start: write it as kv",
        "inheritrange" => "it is the range of an input, which is what the scene says",
        "lengthrange" => "it is the range of length of a muscle, and a scene has no muscles",
        "cranklength" | "cranksite" | "slidersite" => {
            "a scene has no cranks: write their transmission into the `drive`"
        }
        "actuatorgroupdisable" => "it switches actuators off: take them out of the `drive`",
        "axis" | "ref" => "a joint of this type has no axis and no coordinate",
        "sensor" => "a scene has no sensors: a recording has the motion of every body",
        _ => "it has no counterpart in a scene",
    }
}

/// The reason of what stands in a section of sensors.
pub(super) fn why_of_sensor(_: &str) -> &'static str {
    why("sensor")
}

/// The reason of what stands in a section of equalities.
pub(super) fn why_of_equality(_: &str) -> &'static str {
    why("equality")
}

/// The reason of what a `flag` switches.
pub(super) fn why_of_flag(name: &str) -> &'static str {
    match name {
        "contact" | "filterparent" => why("contact"),
        "sensor" => why("sensor"),
        "equality" => why("equality"),
        "frictionloss" => why("frictionloss"),
        "limit" | "passive" | "spring" | "damper" | "actuation" | "clampctrl" => {
            "it switches a part of the model, which the scene has as if it were on: take it out by hand"
        }
        _ => why("solver"),
    }
}
