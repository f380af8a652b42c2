// Messages of a drive in which every member has a value of its own, and all members of a message by
// name. Tests and the plugin `echo` list members alike, so that a member that is lost or swapped on
// the way from one to the other shows. A member that is added does not compile here before it is
// listed, too.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "messages/site_map.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"

namespace rockyard::plugin {

// Members by their paths.
class MemberList {
 public:
  template <typename Number>
  void Add(const std::string& path, Number value) {
    values_[path] = static_cast<double>(value);
  }
  template <typename List>
  void AddList(const std::string& path, const List& list) {
    std::size_t i = 0;
    for (const auto& value : list) Add(path + "[" + std::to_string(i++) + "]", value);
    Add(path + ".size", i);
  }
  void AddPlace(const std::string& path, const messages::Goal& place) {
    const auto& [x_m, y_m] = place;
    Add(path + ".x_m", x_m);
    Add(path + ".y_m", y_m);
  }
  void AddPose(const std::string& path, const messages::PoseEstimate& pose) {
    const auto& [x_m, y_m, heading_rad, distance_m] = pose;
    Add(path + ".x_m", x_m);
    Add(path + ".y_m", y_m);
    Add(path + ".heading_rad", heading_rad);
    Add(path + ".distance_m", distance_m);
  }
  void AddAttitude(const std::string& path, const messages::AttitudeEstimate& attitude) {
    const auto& [roll_rad, pitch_rad, z_m] = attitude;
    Add(path + ".roll_rad", roll_rad);
    Add(path + ".pitch_rad", pitch_rad);
    Add(path + ".z_m", z_m);
  }

  const std::map<std::string, double>& values() const { return values_; }

 private:
  std::map<std::string, double> values_;
};

inline void AddReport(const messages::HazardReport& from, MemberList& list) {
  const auto& [scan_number, stripe_hazard] = from;
  list.Add("report.scan_number", scan_number);
  list.AddList("report.stripe_hazard", stripe_hazard);
}

inline void AddCloud(const messages::PointCloud& from, MemberList& list) {
  const auto& [number, direction, points_R] = from;
  list.Add("cloud.number", number);
  list.Add("cloud.direction", direction);
  for (std::size_t i = 0; i < points_R.size(); ++i) {
    list.AddList("cloud.points_R[" + std::to_string(i) + "]", points_R[i]);
  }
}

inline void AddLook(const messages::LookMoment& from, MemberList& list) {
  const auto& [number, time_s, estimate, odometry, attitude] = from;
  list.Add("look.number", number);
  list.Add("look.time_s", time_s);
  list.AddPose("look.estimate", estimate);
  list.AddPose("look.odometry", odometry);
  list.AddAttitude("look.attitude", attitude);
}

inline void AddImage(const std::string& path, const messages::LookImage& from, MemberList& list) {
  const auto& [width, height, grey, camera] = from;
  list.Add(path + ".width", width);
  list.Add(path + ".height", height);
  list.AddList(path + ".grey", grey);
  const auto& [C_R, A_R, H_R, V_R] = camera;
  list.AddList(path + ".C_R", C_R);
  list.AddList(path + ".A_R", A_R);
  list.AddList(path + ".H_R", H_R);
  list.AddList(path + ".V_R", V_R);
}

inline void AddImages(const messages::LookImages& from, MemberList& list) {
  const auto& [number, direction, left, right] = from;
  list.Add("images.number", number);
  list.Add("images.direction", direction);
  AddImage("images.left", left, list);
  AddImage("images.right", right, list);
}

inline void AddFelt(const messages::VehicleState& from, MemberList& list) {
  const auto& [articulation, specific_force_R, motor_current_A, contact] = from;
  if (articulation) {
    const auto& [left_rocker, right_rocker, left_bogie, right_bogie] = *articulation;
    list.Add("felt.left_rocker_rad", left_rocker);
    list.Add("felt.right_rocker_rad", right_rocker);
    list.Add("felt.left_bogie_rad", left_bogie);
    list.Add("felt.right_bogie_rad", right_bogie);
  }
  if (specific_force_R) list.AddList("felt.specific_force_R", *specific_force_R);
  if (motor_current_A) list.AddList("felt.motor_current_A", *motor_current_A);
  if (contact) list.AddList("felt.contact", *contact);
}

inline std::map<std::string, double> MembersOf(const navigation::NavigatorInput& input) {
  const auto& [time_s, events, estimate, attitude, odometry, report, cloud, look, vehicle_hazard,
               touches_behind, notices_stuck, covariance, felt, images] = input;
  MemberList list;
  list.Add("time_s", time_s);
  list.Add("events", events.bits());
  list.AddPose("estimate", estimate);
  list.AddAttitude("attitude", attitude);
  list.AddPose("odometry", odometry);
  if (report != nullptr) AddReport(*report, list);
  if (cloud != nullptr) AddCloud(*cloud, list);
  if (look != nullptr) AddLook(*look, list);
  if (vehicle_hazard != nullptr) {
    const auto& [kind, side] = *vehicle_hazard;
    list.Add("vehicle_hazard.kind", kind);
    list.Add("vehicle_hazard.side", side);
  }
  list.Add("touches_behind", touches_behind);
  list.Add("notices_stuck", notices_stuck);
  if (covariance != nullptr) {
    for (int row = 0; row < messages::kPoseCoordinates; ++row) {
      list.AddList("covariance[" + std::to_string(row) + "]", covariance->row(row));
    }
  }
  if (felt != nullptr) AddFelt(*felt, list);
  if (images != nullptr) AddImages(*images, list);
  return list.values();
}

inline void AddRover(const messages::RoverBelief& from, MemberList& list) {
  const auto& [drive, length_m, width_m, belly_clearance_m, wheel_width_m, max_rocker_rad,
               max_bogie_rad, max_tilt_rad, suspension] = from;
  static_cast<void>(suspension);  // plugins and processes are not told
  list.Add("rover.length_m", length_m);
  list.Add("rover.width_m", width_m);
  list.Add("rover.belly_clearance_m", belly_clearance_m);
  list.Add("rover.wheel_width_m", wheel_width_m);
  list.Add("rover.max_rocker_rad", max_rocker_rad);
  list.Add("rover.max_bogie_rad", max_bogie_rad);
  list.Add("rover.max_tilt_rad", max_tilt_rad);
  const auto& [wheel_radius_m, radius_ratio, wheel_x_m, wheel_y_m, steered, steering_offset_rad,
               max_steer_rad, max_wheel_speed_m_s] = drive;
  list.Add("rover.wheel_radius_m", wheel_radius_m);
  list.AddList("rover.radius_ratio", radius_ratio);
  list.AddList("rover.wheel_x_m", wheel_x_m);
  list.AddList("rover.wheel_y_m", wheel_y_m);
  list.AddList("rover.steered", steered);
  list.Add("rover.steering_offset_rad", steering_offset_rad);
  list.Add("rover.max_steer_rad", max_steer_rad);
  list.Add("rover.max_wheel_speed_m_s", max_wheel_speed_m_s);
}

// Route, limits and who is told of the end are none of a plugin's.
inline std::map<std::string, double> MembersOf(const navigation::NavigatorSetup& setup) {
  const auto& [goal, judges_hazards, full_speed_m_s, route, places, rover, site_map, random_seed,
               operations_per_s, control_period_s, limits, on_end] = setup;
  MemberList list;
  list.AddPlace("goal", goal);
  list.Add("judges_hazards", judges_hazards);
  list.Add("full_speed_m_s", full_speed_m_s);
  for (std::size_t i = 0; i < places.size(); ++i) {
    list.AddPlace("places[" + std::to_string(i) + "]", places[i]);
  }
  AddRover(rover, list);
  if (site_map != nullptr) {
    const auto& [x0_m, y0_m, step_m, nx, ny, height_m, height_sd_m, rock_share] = *site_map;
    list.Add("site_map.x0_m", x0_m);
    list.Add("site_map.y0_m", y0_m);
    list.Add("site_map.step_m", step_m);
    list.Add("site_map.nx", nx);
    list.Add("site_map.ny", ny);
    list.AddList("site_map.height_m", height_m);
    list.Add("site_map.height_sd_m", height_sd_m);
    list.AddList("site_map.rock_share", rock_share);
  }
  // All 64 bits, which one double does not hold.
  list.Add("random_seed.high", random_seed >> 32);
  list.Add("random_seed.low", random_seed & 0xffffffffu);
  list.Add("operations_per_s", operations_per_s);
  list.Add("control_period_s", control_period_s);
  return list.values();
}

inline std::map<std::string, double> MembersOf(const navigation::NavigatorDecision& decision) {
  const auto& [status, look, motion, looks_on_the_move, until, work_ops] = decision;
  MemberList list;
  list.Add("status", status);
  list.Add("look", look ? static_cast<int>(*look) + 1 : 0);
  const auto& [kind, curvature_per_m, direction, curvature_rate_per_m2, speed_share, end_m, move] =
      motion;
  list.Add("motion.kind", kind);
  list.Add("motion.curvature_per_m", curvature_per_m);
  list.Add("motion.direction", direction);
  list.Add("motion.curvature_rate_per_m2", curvature_rate_per_m2);
  list.Add("motion.speed_share", speed_share);
  list.Add("motion.end_m", end_m);
  list.Add("motion.move", move);
  list.Add("looks_on_the_move", looks_on_the_move);
  const auto& [period_s, distance_m, turn_rad, near_goal_m] = until;
  list.Add("until.period_s", period_s);
  list.Add("until.distance_m", distance_m);
  list.Add("until.turn_rad", turn_rad);
  list.Add("until.near_goal_m", near_goal_m);
  list.Add("work_ops", work_ops);
  return list.values();
}

// Returns as many bytes, which count up.
inline std::vector<std::uint8_t> Bytes(std::uint8_t first, std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  std::iota(bytes.begin(), bytes.end(), first);
  return bytes;
}

// An input with all that an input can have. Every number is another one, and short in decimals.
struct WholeInput {
  WholeInput() {
    for (int row = 0; row < messages::kPoseCoordinates; ++row) {
      for (int column = 0; column < messages::kPoseCoordinates; ++column) {
        covariance(row, column) = 100.5 + 10.0 * std::min(row, column) + std::max(row, column);
      }
    }
    input = {.time_s = 12.5,
             .events = navigation::Events(2 + 4 + 1024),  // start, look, hazard
             .estimate = {1.5, 2.5, 0.25, 3.5},
             .attitude = {0.125, -0.125, 0.0625},
             .odometry = {4.5, 5.5, 0.75, 6.5},
             .report = &report,
             .cloud = &cloud,
             .look = &look,
             .vehicle_hazard = &hazard,
             .touches_behind = true,
             .notices_stuck = false,
             .covariance = &covariance,
             .felt = &felt,
             .images = &images};
  }
  WholeInput(const WholeInput&) = delete;
  WholeInput& operator=(const WholeInput&) = delete;

  messages::HazardReport report{7, {true, false, false, true, true}};
  messages::PointCloud cloud{
      8, messages::LookDirection::kBehind, {{10.25, 11.25, 12.25}, {13.25, 14.25, 15.25}}};
  messages::LookMoment look{
      9, 11.5, {16.5, 17.5, 1.25, 18.5}, {19.5, 20.5, -1.25, 21.5}, {0.375, -0.375, 0.1875}};
  messages::VehicleHazard hazard{messages::VehicleHazardKind::kMotorCurrent,
                                 messages::HazardSide::kRight};
  messages::PoseCovariance covariance;
  messages::VehicleState felt{
      .articulation = messages::Articulation{22.5, 23.5, 24.5, 25.5},
      .specific_force_R = math::Vector3(26.5, 27.5, 28.5),
      .motor_current_A = messages::PerWheel<double>{29.5, 30.5, 31.5, 32.5, 33.5, 34.5},
      .contact = messages::ContactSwitches{true, false, true, false, false, true, true}};
  messages::LookImages images{
      10,
      messages::LookDirection::kBehind,
      {5,
       4,
       Bytes(200, 20),
       {{1.75, 2.75, 3.75}, {4.75, 5.75, 6.75}, {7.75, 8.75, 9.75}, {0.875, -1.75, -2.75}}},
      {11,
       6,
       Bytes(100, 66),
       {{-3.75, -4.75, -5.75}, {-6.75, -7.75, -8.75}, {-9.75, 35.5, 36.5}, {37.5, 38.5, 39.5}}}};
  navigation::NavigatorInput input;
};

// The same of a setup. The seed is one that no double holds.
inline navigation::NavigatorSetup WholeSetup() {
  auto map = std::make_shared<messages::SiteMap>();
  *map = {-1.5, -2.5, 0.5, 2, 1, {3.25, 4.25}, 0.53125, {0.34375, 0.40625}};
  messages::RoverBelief rover;
  rover.length_m = 0.65625;
  rover.width_m = 0.46875;
  rover.belly_clearance_m = 0.15625;
  rover.wheel_width_m = 0.078125;
  rover.max_rocker_rad = 0.28125;
  rover.max_bogie_rad = 0.59375;
  rover.max_tilt_rad = 0.71875;
  rover.drive.wheel_radius_m = 0.109375;
  rover.drive.max_wheel_speed_m_s = 0.140625;
  rover.drive.max_steer_rad = 0.84375;
  rover.drive.steering_offset_rad = -0.03125;
  rover.drive.wheel_x_m = {51.5, 52.5, 53.5, 54.5, 55.5, 56.5};
  rover.drive.wheel_y_m = {61.5, 62.5, 63.5, 64.5, 65.5, 66.5};
  rover.drive.radius_ratio = {71.5, 72.5, 73.5, 74.5, 75.5, 76.5};
  rover.drive.steered = {true, false, true, true, false, false};
  return {.goal = {41.5, 42.5},
          .judges_hazards = false,
          .full_speed_m_s = 0.09375,
          .places = {{41.5, 42.5}, {43.5, 44.5}},
          .rover = rover,
          .site_map = std::move(map),
          .random_seed = 18446744073709551557u,
          .operations_per_s = 2500000.5,
          .control_period_s = 0.046875};
}

// The same of a decision, which can be done.
inline navigation::NavigatorDecision WholeDecision() {
  return {.status = navigation::NavigatorStatus::kDriving,
          .look = messages::LookDirection::kBehind,
          .motion = {messages::MotionKind::kArc, 0.125, -1, 0.25, 0.5, 7.5, 11},
          .looks_on_the_move = true,
          .until = {1.5, 2.5, 3.5, 4.5},
          .work_ops = 6.5};
}

}  // namespace rockyard::plugin
