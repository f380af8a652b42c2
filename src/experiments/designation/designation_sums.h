// What a block of designations at one range adds up to.
#pragma once

#include <array>
#include <cstddef>

namespace rockyard::experiments {

// The columns after the range, by their place in DesignationColumns.
enum class DesignationColumn : std::size_t {
  kDesignations,
  kBeyond,
  kFound,
  kNearEnough,
  kDoubled,
  kDownrange,
  kDownrangeSquares,
  kDownrangeCubes,
  kDownrangeSpread,
  kCrossrange,
  kCrossrangeSquares,
  kCrossrangeSpread,
  kHeight,
  kHeightSquares,
  kPannedDownrange,
  kPannedDownrangeSquares,
  kPannedCrossrange,
  kPannedCrossrangeSquares,
  kMiss,
  kCourseDownrangeSquares,
  kCourseCrossrange,
  kCourseCrossrangeSquares,
  kEquation1,
  kEquation2,
  kEquation3,
  kColumns
};

class DesignationSums {
 public:
  static constexpr std::size_t kSize = static_cast<std::size_t>(DesignationColumn::kColumns);

  void Add(DesignationColumn column, double value) {
    values_[static_cast<std::size_t>(column)] += value;
  }
  const std::array<double, kSize>& values() const { return values_; }

 private:
  std::array<double, kSize> values_{};
};

}  // namespace rockyard::experiments
