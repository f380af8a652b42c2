// Parameters of the map of GESTALT: its grid, its tests and the vehicle (Goldberg 2002, table 1 and
// section 4, steps 1 to 3). Defaults of table 1 are the table's, and a test holds them to it; each
// enum names the readings of what the paper leaves open. A default decides the records of every
// scenario that leaves it out. Meanings, units and origins stand in map_params.cc.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::navigation {

// The height h of the hazard formulas. Section 4 says "rover clearance height"; table 1 has no
// clearance.
enum class HazardHeight {
  kObstHeight,     // rover.obst_height_m
  kClearance,      // rover.clearance_m
  kWheelDiameter,  // twice rover.wheel_radius_m, which no printed formula uses
};

// The reference from which the elevations of a patch count in the step test.
enum class StepReference {
  kLevel,  // as printed: a smooth slope is a step from its low end to its high one
  kPlane,  // from the patch's own plane, where it has one: slopes are left to the pitch test
};

// The goodness of a roughness hazard, with r the residual and f the roughness fraction.
enum class RoughnessFormula {
  kAsPrinted,  // 255 (1 - min(1, f r/h)): a smaller f means an earlier but a milder hazard
  kDivided,    // 255 (1 - min(1, r/(f h)))
};

// The square that stands for the vehicle whatever its heading.
enum class PatchSize {
  kWidth,   // obstacles grow by half the vehicle's width (section 4)
  kLength,  // they grow by half its length: covers the vehicle while it drives along an axis of the
            // map
};

// What a plane that fails the coverage or the eigenvalue test leads to.
enum class FailedFit {
  kStepOrUnknown,   // the cell is unknown unless there is a step hazard
  kUnknown,         // the cell is unknown, whatever its steps
  kSkipPlaneTests,  // no roughness and no pitch hazard; unknown only if no other test is enabled
};

// The certainty of a cell that was evaluated.
enum class CellCertainty {
  kFull,      // 255 (section 4, step 3)
  kOfHazard,  // that of the deciding hazard's pair; 255 without a hazard
};

// Which cells a cell borders.
enum class BorderNeighbours { kEight, kFour };

struct GestaltGridParams {
  double x0_m = 0.0;
  double y0_m = 0.0;
  double xN_m = 10.0;
  double yN_m = 10.0;
  double xstep_m = 0.2;
  double ystep_m = 0.2;

  // Return table 1's xelts and yelts: cells along each axis, the last one whole.
  int nx() const;
  int ny() const;

  void Visit(core::FieldVisitor& v);
};

// Table 1's enabled-tests.
struct GestaltTestParams {
  bool step = true;
  bool rough = true;
  bool pitch = false;
  bool border = true;

  void Visit(core::FieldVisitor& v);
};

// A (goodness, certainty) pair of table 1.
struct GoodnessPair {
  std::int64_t goodness = 0;
  std::int64_t certainty = 0;

  bool operator==(const GoodnessPair&) const = default;

  void Visit(core::FieldVisitor& v);
};

struct GestaltPairParams {
  GoodnessPair unknown{11, 0};
  GoodnessPair unknown_rovers{0, 0};
  GoodnessPair border{250, 128};
  GoodnessPair step_obst{0, 255};
  GoodnessPair pitch_obst{0, 255};
  GoodnessPair rough_obst{0, 255};

  void Visit(core::FieldVisitor& v);
};

// What GESTALT believes of its vehicle, beside the true one (rover.geometry): a drive is refused
// where length or width is off by more than a factor of two, and no condition looks closer.
struct GestaltRoverParams {
  bool modelled = true;
  double length_m = 1.04;
  double width_m = 0.84;
  double obst_height_m = 0.20;
  double wheel_radius_m = 0.10;
  double max_pitch_rad = math::DegToRad(25.0);
  double clearance_m = 0.20;

  void Visit(core::FieldVisitor& v);
};

struct GestaltMapParams {
  GestaltGridParams grid;
  std::int64_t max_idles = 2000;
  double grid_dist_timeout_m = 3.0;
  GestaltTestParams tests;
  std::int64_t outliers_per_cell = 0;
  double eigen_ratio = 2.0;
  double min_cell_coverage = 0.5;
  double min_patch_share = 0.5;
  std::int64_t min_cell_points = 2;
  HazardHeight hazard_height = HazardHeight::kObstHeight;
  StepReference step_reference = StepReference::kLevel;
  RoughnessFormula roughness_formula = RoughnessFormula::kAsPrinted;
  double roughness_fraction = 1.0;
  PatchSize patch = PatchSize::kWidth;
  FailedFit failed_fit = FailedFit::kStepOrUnknown;
  CellCertainty certainty = CellCertainty::kFull;
  BorderNeighbours border_neighbours = BorderNeighbours::kEight;
  GestaltPairParams pairs;
  GestaltRoverParams rover;

  // Returns h of the hazard formulas.
  double HazardHeight_m() const;
  // Returns the side of the square that stands for the vehicle.
  double PatchSide_m() const;
  // Returns the distance from the rover, m, beyond which nothing is known in some direction.
  double Reach_m() const;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::HazardHeight> {
  static constexpr std::array<std::string_view, 3> kNames{"obst_height", "clearance",
                                                          "wheel_diameter"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::StepReference> {
  static constexpr std::array<std::string_view, 2> kNames{"level", "plane"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::RoughnessFormula> {
  static constexpr std::array<std::string_view, 2> kNames{"as_printed", "divided"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::PatchSize> {
  static constexpr std::array<std::string_view, 2> kNames{"width", "length"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::FailedFit> {
  static constexpr std::array<std::string_view, 3> kNames{"step_or_unknown", "unknown",
                                                          "skip_plane_tests"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::CellCertainty> {
  static constexpr std::array<std::string_view, 2> kNames{"full", "of_hazard"};
};

template <>
struct rockyard::core::EnumNames<rockyard::navigation::BorderNeighbours> {
  static constexpr std::array<std::string_view, 2> kNames{"eight", "four"};
};
