// SumTemplate (window_samples.h), for every instruction set.
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/template_sums.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "vision/odometry/window_samples.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<float, kTemplateLanes> kLanes;
constexpr hn::Rebind<std::int32_t, decltype(kLanes)> kLaneInts;
constexpr hn::Rebind<std::uint8_t, decltype(kLanes)> kLaneGreys;

HWY_INLINE auto LaneGreys(const std::uint8_t* pixels) {
  return hn::ConvertTo(kLanes, hn::PromoteTo(kLaneInts, hn::LoadU(kLaneGreys, pixels)));
}

// Sums the lanes from `first` on. Must not use MulAdd: some instruction sets would round once where
// others round twice.
HWY_INLINE void SumLanes(const TemplateRows& rows, const TemplatePlace& place, std::size_t first,
                         TemplateSums& sums) {
  const auto w00 = hn::Set(kLanes, (1.0F - place.u) * (1.0F - place.v));
  const auto w01 = hn::Set(kLanes, place.u * (1.0F - place.v));
  const auto w10 = hn::Set(kLanes, (1.0F - place.u) * place.v);
  const auto w11 = hn::Set(kLanes, place.u * place.v);
  const auto mean = hn::Set(kLanes, rows.mean);
  auto d_sum = hn::Zero(kLanes);
  auto across = hn::Zero(kLanes);
  auto down = hn::Zero(kLanes);
  auto squares = hn::Zero(kLanes);
  for (std::size_t row = 0; row < rows.side; ++row) {
    const std::uint8_t* const above = place.pixels + row * place.stride + first;
    const std::uint8_t* const below = above + place.stride;
    const std::size_t at = row * kTemplateLanes + first;
    const auto upper = hn::Add(hn::Mul(w00, LaneGreys(above)), hn::Mul(w01, LaneGreys(above + 1)));
    const auto lower = hn::Add(hn::Mul(w10, LaneGreys(below)), hn::Mul(w11, LaneGreys(below + 1)));
    const auto value = hn::LoadU(kLanes, rows.values + at);
    const auto d = hn::Sub(hn::Sub(hn::Add(upper, lower), mean), value);
    d_sum = hn::Add(d_sum, d);
    across = hn::Add(across, hn::Mul(hn::LoadU(kLanes, rows.across + at), d));
    down = hn::Add(down, hn::Mul(hn::LoadU(kLanes, rows.down + at), d));
    squares = hn::Add(squares, hn::Mul(d, d));
  }
  hn::StoreU(d_sum, kLanes, sums.d.data() + first);
  hn::StoreU(across, kLanes, sums.across_d.data() + first);
  hn::StoreU(down, kLanes, sums.down_d.data() + first);
  hn::StoreU(squares, kLanes, sums.squares.data() + first);
}

void SumAllLanes(const TemplateRows& rows, const TemplatePlace& place, TemplateSums& sums) {
  for (std::size_t first = 0; first < kTemplateLanes; first += hn::Lanes(kLanes)) {
    SumLanes(rows, place, first, sums);
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(SumAllLanes);

bool HasTemplate(const GrayImage& image, const Pixel& middle, std::size_t side) {
  const int reach = static_cast<int>(side) / 2;
  const bool inside = middle.x() >= reach && middle.x() < image.width() - reach - 2 &&
                      middle.y() >= reach && middle.y() < image.height() - reach - 1;
  if (!inside) return false;
  // Lanes behind the side are read as well: from the next row, or, in the last row of the image,
  // from columns that it must have.
  const int last_row = static_cast<int>(middle.y()) + reach + 1;
  const int last_column = static_cast<int>(middle.x()) - reach + static_cast<int>(kTemplateLanes);
  return last_row + 1 < image.height() || last_column < image.width();
}

void SumTemplate(const TemplateRows& rows, const TemplatePlace& place, TemplateSums& sums) {
  HWY_DYNAMIC_DISPATCH(SumAllLanes)(rows, place, sums);
}

}  // namespace rockyard::vision
#endif
