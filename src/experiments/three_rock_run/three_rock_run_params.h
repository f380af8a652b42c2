// Parameters of the experiment "three_rock_run": from which layouts it draws, and what a run has to
// show to be like the run that Matthies 1995 tells of (section 5, figures 7 and 8). A default
// decides the records of scenarios that leave it out; a bound only refuses files.
#pragma once

#include <array>
#include <cstdint>

#include "core/fields.h"
#include "math/angles.h"
#include "trial/drive_params.h"

namespace rockyard::experiments {

// Lowest and highest value of a uniform distribution.
using UniformRange = std::array<double, 2>;

// The distributions from which one rock is drawn.
struct RockPrior {
  UniformRange along_m;   // where on the rover's way
  UniformRange offset_m;  // of its centre beside the rover's way, to the left
  UniformRange height_m;  // above the ground
  UniformRange diameter_m;

  void Visit(core::FieldVisitor& v);
};

// The prior of the layout. The paper names the rocks and gives no place or size of any, so that
// every range is assumed. All numbers of a layout are independent and uniform.
struct ThreeRockPrior {
  UniformRange goal_m{7.2, 8.0};
  RockPrior a{{0.0, 0.30}, {-0.35, 0.35}, {0.10, 0.35}, {0.15, 0.50}};
  RockPrior b{{3.2, 5.2}, {-0.45, 0.45}, {0.05, 0.20}, {0.08, 0.20}};
  RockPrior c{{0.8, 2.2}, {-0.45, 0.45}, {0.08, 0.25}, {0.08, 0.30}};
  std::int64_t tries = 3000;

  void Visit(core::FieldVisitor& v);
};

// What is told of the run, as bounds.
struct ThreeRockTold {
  double length_m = 8.1;
  double length_tolerance_m = 0.5;
  double a_path_m = 2.6;
  double a_path_tolerance_m = 0.3;
  double c_turn_rad = math::DegToRad(20.0);
  double c_turn_tolerance_rad = math::DegToRad(12.0);
  std::int64_t b_scrapes = 1;
  bool false_alarm = false;

  void Visit(core::FieldVisitor& v);
};

struct ThreeRockRunParams {
  ThreeRockPrior prior;
  ThreeRockTold told;

  void Visit(core::FieldVisitor& v) {
    v.Group("prior", prior, "from what the layouts of the rocks are drawn");
    v.Group("told", told, "what a run has to show to count as one like the published run");
  }
};

// Requires the light stripe and a navigator that reads its reports, level ground without rocks of
// its own in an open arena that holds the longest course, and a straight course from the origin.
// Each failure names the parameter, what is wrong and a remedy.
void RequireThreeRockRun(const ThreeRockRunParams& run, const trial::DriveParams& drive,
                         core::FieldVisitor& v);

}  // namespace rockyard::experiments
