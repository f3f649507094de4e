//! `gyration import`: the scene, both lists, and what is refused.

use crate::common::Sandbox;

const ROBOT: &str = r#"<robot name="arm">
  <link name="world"/>
  <joint name="shoulder" type="revolute">
    <parent link="world"/>
    <child link="arm"/>
    <axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="5" velocity="2"/>
    <dynamics damping="0.1"/>
  </joint>
  <link name="arm">
    <inertial>
      <origin xyz="0.5 0 0"/>
      <mass value="1"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.01"/>
    </inertial>
  </link>
</robot>
"#;

#[test]
fn a_robot_becomes_a_scene_that_runs_and_says_what_it_lacks() {
    let sandbox = Sandbox::new();
    sandbox.write("arm.urdf", ROBOT);
    let said = sandbox.done(&["import", "arm.urdf"]);
    assert_eq!(said.stdout, "");
    assert!(
        said.stderr.contains("left out: arm.urdf:7: limit of joint \"shoulder\": effort = \"5\""),
        "{}",
        said.stderr
    );
    assert!(said.stderr.contains("chosen: arm.urdf: stop"), "{}", said.stderr);
    assert!(said.stderr.contains("2 left out, 4 chosen"), "{}", said.stderr);
    assert_eq!(sandbox.names(), ["arm.toml", "arm.urdf"]);
    sandbox.done(&["run", "arm.toml", "--quiet", "--set", "time.end=0.1"]);
    let again = sandbox.refused(2, &["import", "arm.urdf"]);
    assert!(again.stderr.contains("arm.toml is there already") && again.stderr.contains("--force"), "{}", again.stderr);
    sandbox.done(&["import", "arm.urdf", "--force", "--quiet"]);
    let printed = sandbox.done(&["import", "arm.urdf", "-o", "-"]);
    assert_eq!(printed.stdout, std::fs::read_to_string(sandbox.path("arm.toml")).unwrap());
}

#[test]
fn a_file_that_is_no_robot_is_refused_and_leaves_nothing() {
    let sandbox = Sandbox::new();
    sandbox.write("arm.urdf", &ROBOT.replace("value=\"1\"", "value=\"-1\"").replace("0 1 0", "0 0 0"));
    let said = sandbox.refused(2, &["import", "arm.urdf"]);
    for told in ["arm.urdf:6: axis of joint \"shoulder\": xyz is zero", "arm.urdf:11: ", "-1.0 kg", "2 errors", "fix: "]
    {
        assert!(said.stderr.contains(told), "{told}: {}", said.stderr);
    }
    assert_eq!(sandbox.names(), ["arm.urdf"]);
    let missing = sandbox.refused(3, &["import", "leg.urdf"]);
    assert!(missing.stderr.contains("leg.urdf: cannot be read"), "{}", missing.stderr);
    sandbox.write("arm.urdf", ROBOT);
    let nowhere = sandbox.refused(3, &["import", "arm.urdf", "-o", "no/folder/arm.toml"]);
    assert!(nowhere.stderr.contains("cannot write no/folder/arm.toml"), "{}", nowhere.stderr);
}
