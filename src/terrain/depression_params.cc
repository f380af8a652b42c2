#include "terrain/depression_params.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "math/angles.h"

namespace rockyard::terrain {
namespace {

using core::Setting;

void VisitPlaces(std::vector<double>& x_m, std::vector<double>& y_m, core::FieldVisitor& v) {
  v.Reals("x_m", x_m, Setting("x of every middle", {-1000.0, 1000.0}));
  v.Reals("y_m", y_m, Setting("y of every middle", {-1000.0, 1000.0}));
}

void VisitProfile(std::string_view width_name, std::vector<double>& width_m,
                  std::vector<double>& depth_m, std::vector<double>& flank_m,
                  core::FieldVisitor& v) {
  v.Reals(width_name, width_m,
          Setting("width of every one at the top, from edge to edge", {0.05, 100.0}));
  v.Reals("depth_m", depth_m,
          Setting("depth of every one below the ground around it", {0.001, 10.0}));
  v.Reals("flank_m", flank_m,
          Setting("horizontal width of every flank, from the edge to the level floor; an empty "
                  "list: half of the width, no floor",
                  {0.01, 50.0}));
}

// One list against x_m.
void RequireLength(std::string_view name, std::size_t size, std::size_t wanted,
                   core::FieldVisitor& v) {
  v.Require(name, size == wanted,
            "has " + std::to_string(size) + " entries where x_m has " + std::to_string(wanted),
            "give every list one entry for each place");
}

// Flanks that meet before they reach the floor.
void RequireFlanks(const std::vector<double>& width_m, const std::vector<double>& flank_m,
                   core::FieldVisitor& v) {
  if (flank_m.empty()) return;
  RequireLength("flank_m", flank_m.size(), width_m.size(), v);
  for (std::size_t i = 0; i < std::min(flank_m.size(), width_m.size()); ++i) {
    v.Require("flank_m[" + std::to_string(i) + "]", flank_m[i] <= 0.5 * width_m[i],
              "is wider than half of the whole", "use at most half of the width");
  }
}

double FlankOf(const std::vector<double>& flank_m, std::size_t i, double half_width_m) {
  return flank_m.empty() ? half_width_m : flank_m[i];
}

}  // namespace

double Depression::Distance_m(double at_x_m, double at_y_m) const {
  const double dx_m = at_x_m - x_m;
  const double dy_m = at_y_m - y_m;
  const double c = std::cos(direction_rad);
  const double s = std::sin(direction_rad);
  // Beyond an end only what is beyond counts along the segment.
  const double beyond_m = std::max(std::abs(c * dx_m + s * dy_m) - half_length_m, 0.0);
  return std::hypot(beyond_m, c * dy_m - s * dx_m);
}

bool DitchesParams::IsSound() const {
  const std::size_t size = x_m.size();
  return y_m.size() == size && direction_deg.size() == size && length_m.size() == size &&
         width_m.size() == size && depth_m.size() == size &&
         (flank_m.empty() || flank_m.size() == size);
}

void DitchesParams::Visit(core::FieldVisitor& v) {
  VisitPlaces(x_m, y_m, v);
  v.Reals("direction_deg", direction_deg,
          Setting("direction of every ditch, from +x towards +y", {-360.0, 360.0}));
  v.Reals("length_m", length_m,
          Setting("length of every ditch at the top, round ends included; 0 for one without an end",
                  {0.0, 2000.0}));
  VisitProfile("width_m", width_m, depth_m, flank_m, v);
  RequireLength("y_m", y_m.size(), x_m.size(), v);
  RequireLength("direction_deg", direction_deg.size(), x_m.size(), v);
  RequireLength("length_m", length_m.size(), x_m.size(), v);
  RequireLength("width_m", width_m.size(), x_m.size(), v);
  RequireLength("depth_m", depth_m.size(), x_m.size(), v);
  RequireFlanks(width_m, flank_m, v);
  for (std::size_t i = 0; i < std::min(length_m.size(), width_m.size()); ++i) {
    v.Require("length_m[" + std::to_string(i) + "]",
              length_m[i] == 0.0 || length_m[i] >= width_m[i], "is less than the width",
              "use at least the width, or 0 for a ditch without an end");
  }
}

bool PitsParams::IsSound() const {
  const std::size_t size = x_m.size();
  return y_m.size() == size && diameter_m.size() == size && depth_m.size() == size &&
         (flank_m.empty() || flank_m.size() == size);
}

void PitsParams::Visit(core::FieldVisitor& v) {
  VisitPlaces(x_m, y_m, v);
  VisitProfile("diameter_m", diameter_m, depth_m, flank_m, v);
  RequireLength("y_m", y_m.size(), x_m.size(), v);
  RequireLength("diameter_m", diameter_m.size(), x_m.size(), v);
  RequireLength("depth_m", depth_m.size(), x_m.size(), v);
  RequireFlanks(diameter_m, flank_m, v);
}

std::vector<Depression> ListDepressions(const DitchesParams& ditches, const PitsParams& pits) {
  std::vector<Depression> all;
  for (std::size_t i = 0; i < ditches.x_m.size(); ++i) {
    const double half_width_m = 0.5 * ditches.width_m[i];
    // The round ends reach half a width beyond the segment.
    const double half_length_m = ditches.length_m[i] == 0.0
                                     ? std::numeric_limits<double>::infinity()
                                     : 0.5 * ditches.length_m[i] - half_width_m;
    all.push_back({ditches.x_m[i], ditches.y_m[i], math::DegToRad(ditches.direction_deg[i]),
                   half_length_m, half_width_m, FlankOf(ditches.flank_m, i, half_width_m),
                   ditches.depth_m[i]});
  }
  for (std::size_t i = 0; i < pits.x_m.size(); ++i) {
    const double half_width_m = 0.5 * pits.diameter_m[i];
    all.push_back({pits.x_m[i], pits.y_m[i], 0.0, 0.0, half_width_m,
                   FlankOf(pits.flank_m, i, half_width_m), pits.depth_m[i]});
  }
  return all;
}

}  // namespace rockyard::terrain
