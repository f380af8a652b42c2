#include <bit>
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sensing/stereo_lanes.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sensing/stereo_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::sensing::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<double> kNumbers;
using Numbers = hn::Vec<decltype(kNumbers)>;

HWY_INLINE Numbers All(double value) { return hn::Set(kNumbers, value); }

// Returns the columns from `first` on.
HWY_INLINE Numbers ColumnsFrom(std::size_t first) {
  return hn::Iota(kNumbers, static_cast<double>(first));
}

HWY_INLINE Numbers Approach(const RockRow& rock, Numbers column) {
  return hn::Add(All(rock.approach_0), hn::Mul(All(rock.approach_1), column));
}

HWY_INLINE Numbers Discriminant(const RockRow& rock, Numbers column) {
  const auto slope = hn::Add(hn::Mul(All(rock.quadratic), column), All(2.0 * rock.linear));
  return hn::Add(hn::Mul(slope, column), All(rock.constant));
}

void Raise(const RockRow& rock, std::size_t first, std::size_t count, double* row) {
  const std::size_t lanes = hn::Lanes(kNumbers);
  const auto raised = [&](std::size_t column, Numbers pixels) {
    const auto c = ColumnsFrom(column);
    const auto root = hn::Sqrt(hn::Max(Discriminant(rock, c), hn::Zero(kNumbers)));
    return hn::Max(pixels, hn::Mul(hn::Add(Approach(rock, c), root), All(rock.inverse_outside_1)));
  };
  std::size_t column = first;
  const std::size_t end = first + count;
  for (; column + lanes <= end; column += lanes) {
    hn::StoreU(raised(column, hn::LoadU(kNumbers, row + column)), kNumbers, row + column);
  }
  if (column == end) return;
  HWY_ALIGN double rest[hn::MaxLanes(kNumbers)] = {};
  for (std::size_t i = 0; column + i < end; ++i) rest[i] = row[column + i];
  hn::Store(raised(column, hn::Load(kNumbers, rest)), kNumbers, rest);
  for (std::size_t i = 0; column + i < end; ++i) row[column + i] = rest[i];
}

std::size_t FindBehind(const RockRow& rock, double scale_px_m, double slack_m, std::size_t first,
                       std::size_t count, const double* row, int* columns) {
  const std::size_t lanes = hn::Lanes(kNumbers);
  const auto zero = hn::Zero(kNumbers);
  std::size_t found = 0;
  const auto find = [&](std::size_t at, Numbers pixels) {
    const auto c = hn::Sub(ColumnsFrom(at), hn::Mul(All(scale_px_m), pixels));
    const auto discriminant = Discriminant(rock, c);
    const auto approach = Approach(rock, c);
    const auto meets = hn::And(hn::Ge(discriminant, zero), hn::Gt(approach, zero));
    const auto inverse =
        hn::Mul(hn::Add(approach, hn::Sqrt(discriminant)), All(rock.inverse_outside_1));
    const auto least = hn::Add(pixels, hn::Mul(hn::Mul(pixels, pixels), All(slack_m)));
    const auto behind = hn::And(hn::And(meets, hn::Gt(pixels, zero)), hn::Ge(inverse, least));
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(kNumbers, behind, bytes);
    for (unsigned bits = bytes[0]; bits != 0; bits &= bits - 1) {
      columns[found++] = static_cast<int>(at) + std::countr_zero(bits);
    }
  };
  std::size_t column = first;
  const std::size_t end = first + count;
  for (; column + lanes <= end; column += lanes) find(column, hn::LoadU(kNumbers, row + column));
  if (column == end) return found;
  // Pixels of 0 fill up the last vector.
  HWY_ALIGN double rest[hn::MaxLanes(kNumbers)] = {};
  for (std::size_t i = 0; column + i < end; ++i) rest[i] = row[column + i];
  find(column, hn::Load(kNumbers, rest));
  return found;
}

void Place(const RowRays& rays, const double* inverse_depths, std::size_t count,
           double* coordinates) {
  const std::size_t lanes = hn::Lanes(kNumbers);
  const auto placed = [&](std::size_t column, Numbers inverse) {
    const auto along = hn::Add(All(rays.start), hn::Mul(ColumnsFrom(column), All(rays.step)));
    return hn::Add(All(rays.eye), hn::Div(hn::Add(along, All(rays.down)), inverse));
  };
  std::size_t column = 0;
  for (; column + lanes <= count; column += lanes) {
    hn::StoreU(placed(column, hn::LoadU(kNumbers, inverse_depths + column)), kNumbers,
               coordinates + column);
  }
  if (column == count) return;
  HWY_ALIGN double rest[hn::MaxLanes(kNumbers)] = {};
  for (std::size_t i = 0; column + i < count; ++i) rest[i] = inverse_depths[column + i];
  hn::StoreU(placed(column, hn::Load(kNumbers, rest)), kNumbers, coordinates + column);
}

}  // namespace rockyard::sensing::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rockyard::sensing {

HWY_EXPORT(Raise);
HWY_EXPORT(FindBehind);
HWY_EXPORT(Place);

void RaiseToRock(const RockRow& rock, std::size_t first, std::size_t count, double* row) {
  HWY_DYNAMIC_DISPATCH(Raise)(rock, first, count, row);
}

std::size_t FindBehindRock(const RockRow& rock, double scale_px_m, double slack_m,
                           std::size_t first, std::size_t count, const double* row, int* columns) {
  return HWY_DYNAMIC_DISPATCH(FindBehind)(rock, scale_px_m, slack_m, first, count, row, columns);
}

void PlacePoints(const RowRays& rays, const double* inverse_depths, std::size_t count,
                 double* coordinates) {
  HWY_DYNAMIC_DISPATCH(Place)(rays, inverse_depths, count, coordinates);
}

}  // namespace rockyard::sensing

#endif  // HWY_ONCE
