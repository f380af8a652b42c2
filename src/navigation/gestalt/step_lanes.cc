#include <cstddef>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "navigation/gestalt/step_lanes.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "navigation/gestalt/step_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::navigation::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void FindAll(const PatchRow& row, std::size_t count, double* steps_m) {
  constexpr hn::ScalableTag<double> kNumbers;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (std::size_t patch = 0; patch < count; patch += hn::Lanes(kNumbers)) {
    const auto rise_x = hn::LoadU(kNumbers, row.rise_x + patch);
    const auto rise_y = hn::LoadU(kNumbers, row.rise_y + patch);
    auto highest = hn::Set(kNumbers, -kNone);
    auto lowest = hn::Set(kNumbers, kNone);
    for (std::size_t i = 0; i < row.rows; ++i) {
      for (std::size_t j = 0; j < row.columns; ++j) {
        const std::size_t at = patch + i * row.stride + j;
        const auto x = hn::LoadU(kNumbers, row.means_m[0] + at);
        const auto y = hn::LoadU(kNumbers, row.means_m[1] + at);
        const auto z = hn::LoadU(kNumbers, row.means_m[2] + at);
        const auto above = hn::Sub(hn::Sub(z, hn::Mul(rise_x, x)), hn::Mul(rise_y, y));
        // What is not a number is neither higher nor lower.
        highest = hn::IfThenElse(hn::Gt(above, highest), above, highest);
        lowest = hn::IfThenElse(hn::Lt(above, lowest), above, lowest);
      }
    }
    const auto step = hn::Sub(highest, lowest);
    hn::StoreU(hn::IfThenElseZero(hn::Gt(highest, lowest), step), kNumbers, steps_m + patch);
  }
}

}  // namespace rockyard::navigation::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rockyard::navigation {

HWY_EXPORT(FindAll);

void FindSteps(const PatchRow& row, std::size_t count, double* steps_m) {
  HWY_DYNAMIC_DISPATCH(FindAll)(row, count, steps_m);
}

}  // namespace rockyard::navigation

#endif  // HWY_ONCE
