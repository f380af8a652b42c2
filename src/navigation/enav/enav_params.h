// Parameters of ENav but for ACE's (ace_params.h): maps, the tree of paths, and the drive cycle.
// What is published of it is said in enav_params.cc, which also names who reports it where the text
// itself could not be read; the rest is assumed. A default decides the records of scenarios that
// leave it out; a bound only refuses files.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"
#include "navigation/enav/ace_params.h"

namespace rockyard::navigation {

struct EnavMapParams {
  double height_cell_m = 0.1;
  double height_side_m = 20.0;
  double stand_lengths = 0.65;
  double cost_cell_m = 0.5;
  double cost_side_m = 60.0;
  std::int64_t fit_cells = 1;
  std::int64_t min_points = 10;
  double eigen_ratio = 2.0;
  double extreme_tilt_rad = math::DegToRad(25.0);
  double tilt_weight = 1.0;
  double roughness_weight = 10.0;
  double unseen_factor = 2.0;

  void Visit(core::FieldVisitor& v);
};

// Which rover the lengths of the tree are for.
enum class TreeLengths {
  kAsTold,       // whatever the rover
  kByWheelbase,  // for a wheelbase of 2.26 m, Perseverance's: others have them in proportion
};

struct EnavTreeParams {
  std::int64_t num_turns = 14;
  double turn_span_rad = math::DegToRad(360.0);
  std::int64_t num_first_arcs = 11;
  std::int64_t num_second_arcs = 11;
  double arc_m = 3.0;
  double max_curvature_per_m = 0.5;
  double check_spacing_m = 0.25;
  double turn_check_rad = 0.0;
  TreeLengths lengths = TreeLengths::kAsTold;

  void Visit(core::FieldVisitor& v);
};

// What follows where a cycle has used up its checks before a path passed.
enum class OverBudget {
  kStop,  // no path in this cycle
  kGoOn,  // the rest of the paths are checked
};

// How looking, planning and driving follow each other.
enum class EnavCycle {
  kStopAndLook,  // one after the other
  kCsod,  // it looks and plans while it drives an arc, and stands to steer and to turn in place
};

struct EnavContinuousParams {
  EnavCycle cycle = EnavCycle::kStopAndLook;
  double look_fraction = 0.0;

  void Visit(core::FieldVisitor& v);
};

struct EnavDriveParams {
  double execute_arc_m = 1.0;
  double execute_turn_rad = math::DegToRad(30.0);
  double map_weight = 1.0;
  std::int64_t max_checks = 300;
  OverBudget over_budget = OverBudget::kStop;
  double check_ms = 12.5;
  std::int64_t max_retries = 12;
  double retry_turn_rad = math::DegToRad(30.0);
  std::int64_t max_fruitless_cycles = 60;
  double progress_m = 0.25;
  double felt_radius_m = 0.1;
  std::int64_t max_felt = 6;
  double goal_tolerance_m = 0.25;
  double time_out_s = 0.0;

  void Visit(core::FieldVisitor& v);
};

struct EnavParams {
  AceParams ace;
  EnavMapParams map;
  EnavTreeParams tree;
  EnavDriveParams drive;
  EnavContinuousParams continuous;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::TreeLengths> {
  static constexpr std::array<std::string_view, 2> kNames{"as_told", "by_wheelbase"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::OverBudget> {
  static constexpr std::array<std::string_view, 2> kNames{"stop", "go_on"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::EnavCycle> {
  static constexpr std::array<std::string_view, 2> kNames{"stop_and_look", "csod"};
};
