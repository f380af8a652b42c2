// Ditches and pits in the ground, one by one.
#pragma once

#include <cstddef>
#include <vector>

#include "core/fields.h"

namespace rockyard::terrain {

// A ditch or a pit: all that lies nearer than half_width_m to a segment of a line. A pit is a
// segment of no length.
struct Depression {
  double x_m = 0.0;  // middle of the segment, in the world frame
  double y_m = 0.0;
  double direction_rad = 0.0;  // of the segment, from +x towards +y
  double half_length_m = 0.0;  // of the segment; infinite for a ditch without an end
  double half_width_m = 0.0;   // at the top
  double flank_m = 0.0;        // horizontal width of the flank, at most half_width_m
  double depth_m = 0.0;        // below the ground around it

  // Returns the distance of a point from the segment, m.
  double Distance_m(double x_m, double y_m) const;
};

// Straight trenches with round ends. Each list has one entry for every ditch; flank_m may be empty.
struct DitchesParams {
  std::vector<double> x_m;  // middles
  std::vector<double> y_m;
  std::vector<double> direction_deg;
  std::vector<double> length_m;
  std::vector<double> width_m;
  std::vector<double> depth_m;
  std::vector<double> flank_m;

  // Returns whether all lists are as long as they have to be.
  bool IsSound() const;
  void Visit(core::FieldVisitor& v);
};

// Round holes. Each list has one entry for every pit; flank_m may be empty.
struct PitsParams {
  std::vector<double> x_m;  // centres
  std::vector<double> y_m;
  std::vector<double> diameter_m;
  std::vector<double> depth_m;
  std::vector<double> flank_m;

  // Returns whether all lists are as long as they have to be.
  bool IsSound() const;
  void Visit(core::FieldVisitor& v);
};

// Returns the ditches, then the pits, in the order of their lists, which must be
// sound.
std::vector<Depression> ListDepressions(const DitchesParams& ditches, const PitsParams& pits);

}  // namespace rockyard::terrain
