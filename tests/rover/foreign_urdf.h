// A rover as others write it: the look of a file that xacro has expanded. Its root lies on the body
// 0.4 m above the ground and 0.05 m ahead of the rover's middle, wheels have frames turned about x
// with axes along z, axes of the right side point the other way, wheels hang below what steers
// them, and the right rocker follows the left one.
#pragma once

#include <fmt/format.h>

#include <string>

namespace rockyard::rover {

// One side. Frames of rockers and bogies lie at their pivots, 0.25 and 0.28 m from the middle.
inline std::string ForeignSide(const std::string& n, int sign) {
  const auto wheel = [&](const std::string& axle, const std::string& parent,
                         const std::string& xyz) {
    return fmt::format(R"(
  <link name="{n}_{axle}_tyre">
    <inertial><mass value="1.5"/><inertia ixx="0.0066" iyy="0.0066" izz="0.0108" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><mesh filename="package://other/wheel.dae"/></geometry><material name="grey"/></visual>
    <collision><geometry><cylinder radius="0.12" length="0.1"/></geometry></collision>
  </link>
  <joint name="{n}_{axle}_roll" type="continuous">
    <parent link="{parent}"/><child link="{n}_{axle}_tyre"/>
    <origin xyz="{xyz}" rpy="-1.5707963267948966 0 0"/>
    <axis xyz="0 0 {sign}"/>
    <limit effort="35" velocity="1.5"/>
    <dynamics damping="0.1"/>
  </joint>)",
                       fmt::arg("n", n), fmt::arg("axle", axle), fmt::arg("parent", parent),
                       fmt::arg("xyz", xyz), fmt::arg("sign", sign));
  };
  const auto steered = [&](const std::string& axle, const std::string& parent,
                           const std::string& xyz) {
    return fmt::format(R"(
  <link name="{n}_{axle}_fork">
    <inertial>
      <origin xyz="0 0 -0.2"/><mass value="0.4"/>
      <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/>
    </inertial>
  </link>
  <joint name="{n}_{axle}_steer" type="revolute">
    <parent link="{parent}"/><child link="{n}_{axle}_fork"/>
    <origin xyz="{xyz}"/>
    <axis xyz="0 0 {sign}"/>
    <limit lower="-1.2" upper="1.2" effort="35" velocity="0.6"/>
  </joint>)",
                       fmt::arg("n", n), fmt::arg("axle", axle), fmt::arg("parent", parent),
                       fmt::arg("xyz", xyz), fmt::arg("sign", sign)) +
           wheel(axle, fmt::format("{}_{}_fork", n, axle), "0 0 -0.2");
  };
  // Struts and hubs beside the wheels, in the frame of the arm.
  const auto strut = [&](const std::string& x, double y, double knee_z, double hub_z) {
    return fmt::format(R"(
    <collision><origin xyz="{x} {y} {mid}"/><geometry><cylinder radius="0.02" length="{length}"/></geometry></collision>
    <collision><origin xyz="{x} {y} {hub}"/><geometry><sphere radius="0.05"/></geometry></collision>)",
                       fmt::arg("x", x), fmt::arg("y", y), fmt::arg("mid", 0.5 * (knee_z + hub_z)),
                       fmt::arg("length", knee_z - hub_z), fmt::arg("hub", hub_z));
  };
  const auto lateral = [&](double y) { return fmt::format("{}", sign * y); };
  return fmt::format(R"(
  <link name="{n}_main_arm">
    <inertial><mass value="3"/><inertia ixx="0.01" iyy="0.2" izz="0.2" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0.2 {rocker_y} -0.035" rpy="0 1.7438 0"/><geometry><cylinder radius="0.02" length="0.4"/></geometry></collision>{rocker_strut}
  </link>
  <link name="{n}_bracket">
    <inertial><mass value="0.5"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>
  </link>
  <joint name="{n}_bracket_weld" type="fixed"><parent link="{n}_main_arm"/><child link="{n}_bracket"/></joint>
  <joint name="{n}_main_pivot" type="revolute">
    <parent link="base_link"/><child link="{n}_main_arm"/>
    <origin xyz="0.05 {pivot_y} 0.05" rpy="0 0 0"/>
    <axis xyz="0 {sign} 0"/>
    <limit lower="-0.4" upper="0.4" effort="0" velocity="5"/>{mimic}
  </joint>
  <link name="{n}_rear_arm">
    <inertial><mass value="2"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.04" iyz="0" izz="0.04"/></inertial>{bogie_struts}
  </link>
  <joint name="{n}_rear_pivot" type="revolute">
    <parent link="{n}_main_arm"/><child link="{n}_rear_arm"/>
    <origin xyz="-0.375 {bogie_y} -0.15"/>
    <axis xyz="0 {sign} 0"/>
    <limit lower="-0.8" upper="0.8" effort="0" velocity="5"/>
  </joint>)",
                     fmt::arg("n", n), fmt::arg("sign", sign), fmt::arg("rocker_y", lateral(0.03)),
                     fmt::arg("pivot_y", lateral(0.25)), fmt::arg("bogie_y", lateral(0.03)),
                     fmt::arg("rocker_strut", strut("0.4", sign * 0.03, -0.07, -0.33)),
                     fmt::arg("bogie_struts",
                              strut("0.225", 0.0, 0.08, -0.18) + strut("-0.225", 0.0, 0.08, -0.18)),
                     fmt::arg("mimic", sign > 0 ? "" : R"(
    <mimic joint="l_main_pivot" multiplier="1"/>)")) +
         steered("front", n + "_main_arm", fmt::format("0.4 {} -0.13", lateral(0.15))) +
         wheel("middle", n + "_rear_arm", fmt::format("0.225 {} -0.18", lateral(0.12))) +
         steered("rear", n + "_rear_arm", fmt::format("-0.225 {} 0.02", lateral(0.12)));
}

inline std::string ForeignUrdf() {
  return R"(<?xml version="1.0" ?>
<!-- |    This document was autogenerated by xacro from other.urdf.xacro    | -->
<robot name="other" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base_footprint"/>
  <joint name="footprint" type="fixed">
    <parent link="base_footprint"/><child link="base_link"/><origin xyz="0.02 0 0.1"/>
  </joint>
  <link name="base_link">
    <inertial>
      <origin xyz="-0.05 0 0.05"/><mass value="30"/>
      <inertia ixx="0.6" ixy="0.01" ixz="0" iyy="1.4" iyz="0" izz="1.8"/>
    </inertial>
    <collision><origin xyz="-0.05 0 0.05"/><geometry><box size="0.7 0.4 0.2"/></geometry></collision>
    <collision><origin xyz="-0.05 0 0.1625" rpy="0 0 1.5707963267948966"/><geometry><box size="0.9 1.3 0.025"/></geometry></collision>
  </link>
  <link name="mast">
    <inertial><mass value="2"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>
    <collision><geometry><cylinder radius="0.03" length="0.8"/></geometry></collision>
  </link>
  <joint name="mast_weld" type="fixed">
    <parent link="base_link"/><child link="mast"/><origin xyz="0.35 0 0.6" rpy="0 0 0.3"/>
  </joint>
  <link name="tool">
    <inertial><mass value="1"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base_link"/><child link="tool"/><origin xyz="0.45 0 -0.05" rpy="0 0.4 0"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="10" velocity="1"/>
  </joint>
  <transmission name="drive"><type>transmission_interface/SimpleTransmission</type></transmission>
  <gazebo reference="base_link"><mu1>0.9</mu1></gazebo>
  <gazebo><plugin filename="libother.so" name="other"/></gazebo>)" +
         ForeignSide("l", 1) + ForeignSide("r", -1) + "\n</robot>\n";
}

// The same with the first `from` replaced by `to`.
inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return "NOT IN THE TEXT: " + from;
  return text.replace(at, from.size(), to);
}

}  // namespace rockyard::rover
