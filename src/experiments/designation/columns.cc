#include "experiments/designation/columns.h"

namespace rockyard::experiments {

const truth::RecordSchema& DesignationColumns() {
  using enum truth::ColumnRole;
  static const truth::RecordSchema kColumns{
      {"range_m", "m", "true range along the ground, from the lander's mast", kFactor},
      {"designations", "1", "goals that operators designated", kTrials},
      {"beyond", "1", "with a disparity of 0 or less: no place is told", kCount, "designations"},
      {"found", "1", "with a place", kMainCount, "designations"},
      {"near_enough", "1", "told within near_enough_m along the ground, pan error included", kCount,
       "designations"},
      {"doubled", "1", "told at more than twice the true range", kCount, "designations"},
      {"downrange_m", "m", "told less true place, away from the lander", kSum, "found"},
      {"downrange_error_m", "m", "the same", kSquares, "found"},
      {"downrange_cubes_m3", "m3", "its third powers, for the skewness", kSum, "found"},
      {"downrange_spread_m", "m",
       "its magnitude times the root of pi/2: the standard deviation of a normal error", kSum,
       "found"},
      {"crossrange_m", "m", "told less true place, to the left", kSum, "found"},
      {"crossrange_error_m", "m", "the same", kSquares, "found"},
      {"crossrange_spread_m", "m", "its magnitude times the root of pi/2", kSum, "found"},
      {"height_m", "m", "told less true height", kSum, "found"},
      {"height_error_m", "m", "the same", kSquares, "found"},
      {"panned_downrange_m", "m", "downrange error, pan error included", kSum, "found"},
      {"panned_downrange_error_m", "m", "the same", kSquares, "found"},
      {"panned_crossrange_m", "m", "crossrange error, pan error included", kSum, "found"},
      {"panned_crossrange_error_m", "m", "the same", kSquares, "found"},
      {"miss_m", "m", "from the true to the told place along the ground, pan error included", kSum,
       "found"},
      {"course_downrange_error_m", "m", "downrange error that course.designation draws", kSquares,
       "designations"},
      {"course_crossrange_m", "m", "crossrange error that it draws, pan error included", kSum,
       "designations"},
      {"course_crossrange_error_m", "m", "the same", kSquares, "designations"},
      {"equation_1_m", "m", "random crossrange error by Matthies 1995 eq. (1)", kSum,
       "designations"},
      {"equation_2_m", "m", "random downrange error by eq. (2)", kSum, "designations"},
      {"equation_3_m", "m", "systematic crossrange error by eq. (3)", kSum, "designations"},
  };
  return kColumns;
}

}  // namespace rockyard::experiments
