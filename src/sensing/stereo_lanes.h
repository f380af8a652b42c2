// Loops over the columns of an image row that the stereo sensor spends its time in, side by side in
// the registers of the processor. Each operation rounds as its scalar form does and none is fused,
// so that results are the same on every processor.
#pragma once

#include <cstddef>

namespace rockyard::sensing {

// The cut of an image row through a rock, see RowCut: one over the depth at column c is
//   (approach_0 + approach_1 c + sqrt((quadratic c + 2 linear) c + constant)) inverse_outside_1.
struct RockRow {
  double quadratic = 0.0;
  double linear = 0.0;
  double constant = 0.0;
  double approach_0 = 0.0;
  double approach_1 = 0.0;
  double inverse_outside_1 = 0.0;
};

// Raises the pixels [first, first + count) of a row to the rock's, all of whose rays must meet it
// but for rounding.
void RaiseToRock(const RockRow& rock, std::size_t first, std::size_t count, double* row);

// Finds the pixels above 0 in [first, first + count) of a row that the rock, seen from the other
// eye, could hide: those whose inverse depth p is less than the rock's at column c - scale_px_m p
// by slack_m p^2 or more. Writes their columns, ascending, and returns how many they are.
// `columns` has room for `count` and 8 more.
std::size_t FindBehindRock(const RockRow& rock, double scale_px_m, double slack_m,
                           std::size_t first, std::size_t count, const double* row, int* columns);

// Where the pixels of a row look: pixel c along start + c step, plus `down`, from `eye`, in one
// coordinate.
struct RowRays {
  double eye;
  double start;
  double step;
  double down;
};

// Writes a coordinate of the points of `count` pixels at their inverse depths: eye + ray / inverse
// depth. Where the latter is 0 anything is written. Room is needed for 8 more.
void PlacePoints(const RowRays& rays, const double* inverse_depths, std::size_t count,
                 double* coordinates);

}  // namespace rockyard::sensing
