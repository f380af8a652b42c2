#include "vision/stereo/blob_links.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/stereo/blob_links.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "vision/stereo/disparity.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::int16_t> kDisparities;

// Fills the bits of RowLinks from a row and the row above, both as PaddedRow lays them out. The
// absolute difference is the larger of the two saturated ones. Both pixels must be valid, as
// invalid ones differ by little from each other.
void FindLinks(const std::int16_t* row, const std::int16_t* above, std::size_t width,
               std::int16_t max_step, std::uint8_t* valid_bits, std::uint8_t* left_bits,
               std::uint8_t* above_bits) {
  const auto invalid = hn::Set(kDisparities, kLowestValid - 1);
  const auto step = hn::Set(kDisparities, max_step);
  const std::size_t lanes = hn::Lanes(kDisparities);
  const std::size_t end = (width / 64 + 1) * 64;
  for (std::size_t x = 0; x < end; x += lanes) {
    const auto here = hn::LoadU(kDisparities, row + x);
    const auto left = hn::LoadU(kDisparities, row + x - 1);
    const auto up = hn::LoadU(kDisparities, above + x);
    const auto valid = hn::Gt(here, invalid);
    const auto joined = [&](hn::Vec<decltype(kDisparities)> other) HWY_ATTR {
      const auto difference = hn::Max(hn::SaturatedSub(here, other), hn::SaturatedSub(other, here));
      return hn::AndNot(hn::Gt(difference, step), hn::And(valid, hn::Gt(other, invalid)));
    };
    hn::StoreMaskBits(kDisparities, valid, valid_bits + x / 8);
    hn::StoreMaskBits(kDisparities, joined(left), left_bits + x / 8);
    hn::StoreMaskBits(kDisparities, joined(up), above_bits + x / 8);
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(FindLinks);

PaddedRow::PaddedRow(std::size_t width)
    : values((width / 64 + 1) * 64 + 1, Dropped(Drop::kOutside)) {}

void PaddedRow::Assign(std::span<const std::int16_t> row) {
  std::copy(row.begin(), row.end(), values.begin() + 1);
}

void FindLinks(const PaddedRow& row, const PaddedRow& above, std::size_t width,
               std::int16_t max_step, RowLinks& links) {
  static_assert(std::endian::native == std::endian::little, "bytes of bits become words");
  HWY_DYNAMIC_DISPATCH(FindLinks)
  (row.data(), above.data(), width, max_step, reinterpret_cast<std::uint8_t*>(links.valid.data()),
   reinterpret_cast<std::uint8_t*>(links.to_left.data()),
   reinterpret_cast<std::uint8_t*>(links.to_above.data()));
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE
