// WarpWindow (window.h), for every instruction set.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/warp_window.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/odometry/window.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Vectors hold at most a window's row.
constexpr hn::CappedTag<std::int32_t, kWindowStride> kPlaces;
constexpr hn::Rebind<std::uint8_t, decltype(kPlaces)> kWarpedBytes;
using Places = hn::Vec<decltype(kPlaces)>;

// Returns g (256 - t) + h t, where g and h are the two lowest bytes of each lane.
HWY_INLINE Places BetweenColumns(Places words, Places t) {
  const auto byte = hn::Set(kPlaces, 255);
  const auto left = hn::And(words, byte);
  const auto right = hn::And(hn::ShiftRight<8>(words), byte);
  return hn::Add(hn::ShiftLeft<8>(left), hn::Mul(hn::Sub(right, left), t));
}

// Warps a window whose places, and three pixels to their right, lie inside the image, as words of 4
// bytes are read. `middle` is the feature's pixel, rows are `stride` apart. WarpAnywhere must give
// the same bits.
void WarpInside(const std::uint8_t* middle, std::int32_t stride, const Warp& warp, int side,
                std::uint8_t* window) {
  const auto* const words = reinterpret_cast<const std::int32_t*>(middle);
  const auto fraction = hn::Set(kPlaces, 255);
  const int reach = side / 2;
  for (int row = 0; row < side; ++row) {
    std::uint8_t* const to = window + static_cast<std::size_t>(row) * kWindowStride;
    for (int first = 0; first < static_cast<int>(kWindowStride);
         first += static_cast<int>(hn::Lanes(kPlaces))) {
      const auto column = hn::Iota(kPlaces, first);
      const auto is_used = hn::Lt(column, hn::Set(kPlaces, side));
      const auto across = hn::Sub(column, hn::Set(kPlaces, reach));
      const auto place = [&](std::int32_t by_column, std::int32_t by_row) HWY_ATTR {
        const auto start = hn::Set(kPlaces, by_row * (row - reach) + Warp::kHalf);
        return hn::ShiftRight<Warp::kShift>(
            hn::Add(hn::Mul(across, hn::Set(kPlaces, by_column)), start));
      };
      const auto x = place(warp.x_by_column, warp.x_by_row);
      const auto y = place(warp.y_by_column, warp.y_by_row);
      const auto offset = hn::IfThenElseZero(
          is_used,
          hn::Add(hn::Mul(hn::ShiftRight<8>(y), hn::Set(kPlaces, stride)), hn::ShiftRight<8>(x)));
      const auto below_offset =
          hn::IfThenElseZero(is_used, hn::Add(offset, hn::Set(kPlaces, stride)));
      const auto u = hn::And(x, fraction);
      const auto v = hn::And(y, fraction);
      const auto above = BetweenColumns(hn::GatherOffset(kPlaces, words, offset), u);
      const auto below = BetweenColumns(hn::GatherOffset(kPlaces, words, below_offset), u);
      const auto sum = hn::Add(hn::ShiftLeft<8>(above), hn::Mul(hn::Sub(below, above), v));
      const auto grey = hn::ShiftRight<16>(hn::Add(sum, hn::Set(kPlaces, 1 << 15)));
      hn::StoreU(hn::DemoteTo(kWarpedBytes, hn::IfThenElseZero(is_used, grey)), kWarpedBytes,
                 to + first);
    }
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(WarpInside);

namespace {

std::int32_t Fixed(double value) {
  return static_cast<std::int32_t>(
      std::floor(std::clamp(value, -Warp::kMost, Warp::kMost) * Warp::kOne + 0.5));
}

// The range, relative to the feature, of the upper left pixels of the four that are interpolated.
struct WarpedBox {
  int left, right, top, bottom;
};

WarpedBox BoxOf(const Warp& warp, int reach) {
  const auto reach_of = [reach](std::int32_t by_column, std::int32_t by_row) {
    return reach * (std::abs(by_column) + std::abs(by_row));
  };
  const int x = reach_of(warp.x_by_column, warp.x_by_row);
  const int y = reach_of(warp.y_by_column, warp.y_by_row);
  const auto whole = [](int place) { return (place + Warp::kHalf) >> (Warp::kShift + 8); };
  return {whole(-x), whole(x), whole(-y), whole(y)};
}

// Returns the grey level at one place, whose pixels need not lie inside, to the same whole number
// as WarpInside.
std::uint8_t GreyAt(const GrayImage& image, int x, int y) {
  const auto at = [&](int column, int row) {
    return static_cast<int>(
        image.At(std::clamp(column, 0, image.width() - 1), std::clamp(row, 0, image.height() - 1)));
  };
  const int left = x >> 8;
  const int top = y >> 8;
  const int u = x & 255;
  const int v = y & 255;
  const int above = at(left, top) * (256 - u) + at(left + 1, top) * u;
  const int below = at(left, top + 1) * (256 - u) + at(left + 1, top + 1) * u;
  return static_cast<std::uint8_t>((above * (256 - v) + below * v + (1 << 15)) >> 16);
}

void WarpAnywhere(const GrayImage& image, const Feature& feature, const Warp& warp, int side,
                  std::uint8_t* window) {
  const int reach = side / 2;
  for (int row = -reach; row <= reach; ++row, window += kWindowStride) {
    std::fill_n(window, kWindowStride, std::uint8_t{0});
    for (int column = -reach; column <= reach; ++column) {
      const auto place = [&](std::int32_t by_column, std::int32_t by_row) {
        return (by_column * column + by_row * row + Warp::kHalf) >> Warp::kShift;
      };
      window[column + reach] =
          GreyAt(image, 256 * feature.column + place(warp.x_by_column, warp.x_by_row),
                 256 * feature.row + place(warp.y_by_column, warp.y_by_row));
    }
  }
}

}  // namespace

void WarpWindow(const GrayImage& image, const Feature& feature, const Eigen::Matrix2d& by_offset,
                int side, std::uint8_t* window) {
  EXPECT(side > 0 && side % 2 == 1 && side < static_cast<int>(kWindowStride));
  EXPECT(by_offset.allFinite());
  const Warp warp{Fixed(by_offset(0, 0)), Fixed(by_offset(0, 1)), Fixed(by_offset(1, 0)),
                  Fixed(by_offset(1, 1))};
  const WarpedBox box = BoxOf(warp, side / 2);
  const bool inside = feature.column + box.left >= 0 &&
                      feature.column + box.right + 3 < image.width() &&
                      feature.row + box.top >= 0 && feature.row + box.bottom + 1 < image.height();
  if (inside) {
    HWY_DYNAMIC_DISPATCH(WarpInside)
    (&image.At(feature.column, feature.row), image.width(), warp, side, window);
  } else {
    WarpAnywhere(image, feature, warp, side, window);
  }
  std::fill(window + static_cast<std::size_t>(side) * kWindowStride, window + kWindowBytes,
            std::uint8_t{0});
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE
