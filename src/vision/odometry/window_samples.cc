// SampleWindow (window_samples.h), for every instruction set.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/window_samples.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/odometry/window_samples.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Vectors hold at most a window's row.
constexpr hn::CappedTag<float, kTemplateLanes> kFloats;
constexpr hn::Rebind<std::int32_t, decltype(kFloats)> kInts;
constexpr hn::Rebind<std::uint8_t, decltype(kFloats)> kGreys;
using Floats = hn::Vec<decltype(kFloats)>;
using Ints = hn::Vec<decltype(kInts)>;

// Interpolates. Must not use MulAdd, which rounds once on some instruction sets and twice on
// others.
HWY_INLINE Floats Between(Floats from, Floats to, Floats share) {
  return hn::Add(from, hn::Mul(share, hn::Sub(to, from)));
}

// Returns byte kWhich of every lane.
template <int kWhich>
HWY_INLINE Floats Byte(Ints words) {
  return hn::ConvertTo(kFloats, hn::And(hn::ShiftRight<8 * kWhich>(words), hn::Set(kInts, 255)));
}

HWY_INLINE Floats Greys(const std::uint8_t* pixels) {
  return hn::ConvertTo(kFloats, hn::PromoteTo(kInts, hn::LoadU(kGreys, pixels)));
}

// Samples without a change of view: `first` is the upper left pixel; 18 columns and rows are read.
void SampleShifted(const std::uint8_t* first, std::size_t stride, float u, float v, float* wide) {
  const auto across = hn::Set(kFloats, u);
  const auto down = hn::Set(kFloats, v);
  for (std::size_t row = 0; row < kWideSide; ++row) {
    const std::uint8_t* const above = first + row * stride;
    const std::uint8_t* const below = above + stride;
    // The last vector of a row ends with it.
    const std::size_t lanes = hn::Lanes(kFloats);
    for (std::size_t x = 0; x < kWideSide; x += lanes) {
      const std::size_t column = std::min(x, kWideSide - lanes);
      const auto upper = Between(Greys(above + column), Greys(above + column + 1), across);
      const auto lower = Between(Greys(below + column), Greys(below + column + 1), across);
      hn::StoreU(Between(upper, lower, down), kFloats, wide + row * kWideSide + column);
    }
  }
}

// Samples with a change of view, where all places, three pixels to their right and a row below lie
// inside: a word of four pixels is read at each place, the first in its lowest bits (little
// endian). `middle` is the pixel that view.x and view.y are counted from. SampleAnywhere must give
// the same bits.
void SampleMapped(const std::uint8_t* middle, std::int32_t stride, const WindowView& view,
                  float* wide) {
  const auto* const words = reinterpret_cast<const std::int32_t*>(middle);
  const auto one = hn::Set(kFloats, 1.0F);
  for (std::size_t i = 0; i < kWidePixels; i += hn::Lanes(kFloats)) {
    const auto across = hn::LoadU(kFloats, kWideOffsets.across.data() + i);
    const auto down = hn::LoadU(kFloats, kWideOffsets.down.data() + i);
    const auto sum = [&](float by_column, float by_row) HWY_ATTR {
      return hn::Add(hn::Mul(hn::Set(kFloats, by_column), across),
                     hn::Mul(hn::Set(kFloats, by_row), down));
    };
    const auto distance =
        hn::Max(hn::Add(one, sum(view.near_by_column, view.near_by_row)), hn::Set(kFloats, 0.5F));
    const auto x =
        hn::Add(hn::Set(kFloats, view.x), hn::Div(sum(view.x_by_column, view.x_by_row), distance));
    const auto y =
        hn::Add(hn::Set(kFloats, view.y), hn::Div(sum(view.y_by_column, view.y_by_row), distance));
    const auto left = hn::Floor(x);
    const auto top = hn::Floor(y);
    const auto offset = hn::Add(hn::Mul(hn::ConvertTo(kInts, top), hn::Set(kInts, stride)),
                                hn::ConvertTo(kInts, left));
    const auto above = hn::GatherOffset(kInts, words, offset);
    const auto below = hn::GatherOffset(kInts, words, hn::Add(offset, hn::Set(kInts, stride)));
    const auto u = hn::Sub(x, left);
    const auto grey = Between(Between(Byte<0>(above), Byte<1>(above), u),
                              Between(Byte<0>(below), Byte<1>(below), u), hn::Sub(y, top));
    hn::StoreU(grey, kFloats, wide + i);
  }
}

void FindGradients(const float* wide, std::size_t side, WindowGradients gradients,
                   WindowSamples& samples) {
  const auto half = hn::Set(kFloats, 0.5F);
  const std::size_t reach = side / 2;
  const float* const corner = wide + (kWideReach - reach) * (kWideSide + 1);
  for (std::size_t first = 0; first < kTemplateLanes; first += hn::Lanes(kFloats)) {
    const auto inside = hn::FirstN(kFloats, side - std::min(side, first));
    auto sum = hn::Zero(kFloats);
    auto across_sum = sum, down_sum = sum, xx = sum, xy = sum, yy = sum;
    for (std::size_t row = 0; row < side; ++row) {
      const float* const at = corner + row * kWideSide + first;
      const auto step = [&](std::ptrdiff_t by) HWY_ATTR {
        const auto difference = hn::Sub(hn::LoadU(kFloats, at + by), hn::LoadU(kFloats, at - by));
        return hn::IfThenElseZero(inside, hn::Mul(half, difference));
      };
      const auto value = hn::IfThenElseZero(inside, hn::LoadU(kFloats, at));
      const auto across = step(1);
      const auto down = gradients == WindowGradients::kBoth
                            ? step(static_cast<std::ptrdiff_t>(kWideSide))
                            : hn::Mul(across, hn::Set(kFloats, static_cast<float>(row) -
                                                                   static_cast<float>(reach)));
      const std::size_t to = row * kTemplateLanes + first;
      hn::StoreU(value, kFloats, samples.values.data() + to);
      hn::StoreU(across, kFloats, samples.across.data() + to);
      hn::StoreU(down, kFloats, samples.down.data() + to);
      sum = hn::Add(sum, value);
      across_sum = hn::Add(across_sum, across);
      down_sum = hn::Add(down_sum, down);
      xx = hn::Add(xx, hn::Mul(across, across));
      xy = hn::Add(xy, hn::Mul(across, down));
      yy = hn::Add(yy, hn::Mul(down, down));
    }
    hn::StoreU(sum, kFloats, samples.sum.data() + first);
    hn::StoreU(across_sum, kFloats, samples.across_sum.data() + first);
    hn::StoreU(down_sum, kFloats, samples.down_sum.data() + first);
    hn::StoreU(xx, kFloats, samples.across_across.data() + first);
    hn::StoreU(xy, kFloats, samples.across_down.data() + first);
    hn::StoreU(yy, kFloats, samples.down_down.data() + first);
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(SampleShifted);
HWY_EXPORT(SampleMapped);
HWY_EXPORT(FindGradients);

namespace {

// Returns whether an image has all pixels from the first to the last place, `more` to the right of
// it and one below.
bool HasAll(const GrayImage& image, const Pixel& first, const Pixel& last, int more) {
  return first.minCoeff() >= 0.0 && last.x() + more < image.width() &&
         last.y() + 1 < image.height();
}

WindowView ViewOf(const Pixel& middle, const Pixel& pixel, const ViewChange& view) {
  const auto of = [](double number) { return static_cast<float>(number); };
  return {of(middle.x() - pixel.x()), of(middle.y() - pixel.y()), of(view.by_offset(0, 0)),
          of(view.by_offset(0, 1)),   of(view.by_offset(1, 0)),   of(view.by_offset(1, 1)),
          of(view.by_distance.x()),   of(view.by_distance.y())};
}

// Returns the half sides of a box that holds all places: by_offset o of the corners over the least
// divisor. Rounding to 32 bits moves places by less than the margin.
Pixel ReachOf(const ViewChange& view) {
  const Pixel corner(kWideReach, kWideReach);
  const double nearest = std::max(0.5, 1.0 - view.by_distance.cwiseAbs().dot(corner));
  constexpr double kMargin_px = 0.01;
  return view.by_offset.cwiseAbs() * corner / nearest + Pixel(kMargin_px, kMargin_px);
}

// Samples places that need not lie inside, to the same bits as SampleMapped.
void SampleAnywhere(const GrayImage& image, int column, int row, const WindowView& view,
                    float* wide) {
  const auto grey = [&](float x, float y) {
    return static_cast<float>(
        image.At(std::clamp(column + static_cast<int>(x), 0, image.width() - 1),
                 std::clamp(row + static_cast<int>(y), 0, image.height() - 1)));
  };
  const auto between = [](float from, float to, float share) { return from + share * (to - from); };
  for (std::size_t i = 0; i < kWideSide * kWideSide; ++i) {
    const float across = kWideOffsets.across[i];
    const float down = kWideOffsets.down[i];
    const float distance =
        std::max(1.0F + (view.near_by_column * across + view.near_by_row * down), 0.5F);
    const float x = view.x + (view.x_by_column * across + view.x_by_row * down) / distance;
    const float y = view.y + (view.y_by_column * across + view.y_by_row * down) / distance;
    const float left = std::floor(x);
    const float top = std::floor(y);
    wide[i] = between(between(grey(left, top), grey(left + 1, top), x - left),
                      between(grey(left, top + 1), grey(left + 1, top + 1), x - left), y - top);
  }
}

}  // namespace

WindowSamples SampleWindow(const GrayImage& image, const Pixel& middle, const ViewChange& view,
                           std::size_t side, WindowGradients gradients) {
  EXPECT(side % 2 == 1 && side <= kTemplateRows);
  const auto column = static_cast<int>(middle.x());
  const auto row = static_cast<int>(middle.y());
  EXPECT(middle.minCoeff() >= 0.0 && column < image.width() && row < image.height());
  const bool same = view.by_offset.isIdentity(0.0) && view.by_distance.isZero(0.0);
  const WindowView places = ViewOf(middle, Pixel(column, row), view);
  const Pixel reach = same ? Pixel(kWideReach, kWideReach) : ReachOf(view);
  const auto stride = static_cast<std::size_t>(image.width());
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): written before it is read
  std::array<float, kWidePixels> wide;
  if (!HasAll(image, middle - reach, middle + reach, 3)) {
    SampleAnywhere(image, column, row, places, wide.data());
  } else if (same) {
    HWY_DYNAMIC_DISPATCH(SampleShifted)
    (&image.At(column - kWideReach, row - kWideReach), stride, places.x, places.y, wide.data());
  } else {
    HWY_DYNAMIC_DISPATCH(SampleMapped)
    (&image.At(column, row), image.width(), places, wide.data());
  }
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): every number is written
  WindowSamples samples;
  HWY_DYNAMIC_DISPATCH(FindGradients)(wide.data(), side, gradients, samples);
  const std::size_t used = side * kTemplateLanes;
  for (WindowSamples::Rows* const rows : {&samples.values, &samples.across, &samples.down}) {
    std::fill(rows->begin() + static_cast<std::ptrdiff_t>(used), rows->end(), 0.0F);
  }
  return samples;
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE
