#include "vision/odometry/harris.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/odometry/harris.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::int16_t> kValues;
constexpr hn::Rebind<std::uint8_t, decltype(kValues)> kGreyBytes;
constexpr hn::RepartitionToWide<decltype(kValues)> kWide;
constexpr hn::Half<decltype(kValues)> kHalf;
using Values = hn::Vec<decltype(kValues)>;
using Wide = hn::Vec<decltype(kWide)>;

// Writes, for each column of three rows, their sum weighed 1, 2, 1, and the last less the first.
void SmoothColumns(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                   std::size_t width, std::int16_t* smooth, std::int16_t* step) {
  for (std::size_t x = 0; x < width; x += hn::Lanes(kValues)) {
    const auto a = hn::PromoteTo(kValues, hn::LoadU(kGreyBytes, above + x));
    const auto h = hn::PromoteTo(kValues, hn::LoadU(kGreyBytes, here + x));
    const auto b = hn::PromoteTo(kValues, hn::LoadU(kGreyBytes, below + x));
    hn::Store(hn::Add(hn::Add(a, b), hn::Add(h, h)), kValues, smooth + x);
    hn::Store(hn::Sub(b, a), kValues, step + x);
  }
}

// Returns (sobel + 1) >> 1, clamped.
HWY_INLINE Values Gradient(Values sobel) {
  constexpr std::int16_t kLimit = 63;  // the largest of 6 bits: sums over 5 x 5 fit (harris.h)
  const auto half = hn::ShiftRight<1>(hn::Add(sobel, hn::Set(kValues, 1)));
  return hn::Min(hn::Max(half, hn::Set(kValues, -kLimit)), hn::Set(kValues, kLimit));
}

// Writes the products of the gradients of a row, from what SmoothColumns wrote; it reads one column
// more to either side.
void Products(const std::int16_t* smooth, const std::int16_t* step, std::size_t width,
              std::int16_t* xx, std::int16_t* xy, std::int16_t* yy) {
  for (std::size_t x = 0; x < width; x += hn::Lanes(kValues)) {
    const auto gx =
        Gradient(hn::Sub(hn::LoadU(kValues, smooth + x + 1), hn::LoadU(kValues, smooth + x - 1)));
    const auto middle = hn::Load(kValues, step + x);
    const auto sides = hn::Add(hn::LoadU(kValues, step + x - 1), hn::LoadU(kValues, step + x + 1));
    const auto gy = Gradient(hn::Add(sides, hn::Add(middle, middle)));
    hn::Store(hn::Mul(gx, gx), kValues, xx + x);
    hn::Store(hn::Mul(gx, gy), kValues, xy + x);
    hn::Store(hn::Mul(gy, gy), kValues, yy + x);
  }
}

// Writes the sums of five rows >> 2. `row` is a copy of `rows`, as the compiler would assume that
// stores change `rows`.
void SumRows(const std::int16_t* const* rows, std::size_t width, std::int16_t* sums) {
  const std::array<const std::int16_t*, 5> row{rows[0], rows[1], rows[2], rows[3], rows[4]};
  for (std::size_t x = 0; x < width; x += hn::Lanes(kValues)) {
    const auto outer = hn::Add(hn::Load(kValues, row[0] + x), hn::Load(kValues, row[4] + x));
    const auto inner = hn::Add(hn::Load(kValues, row[1] + x), hn::Load(kValues, row[3] + x));
    const auto sum = hn::Add(hn::Add(outer, inner), hn::Load(kValues, row[2] + x));
    hn::Store(hn::ShiftRight<2>(sum), kValues, sums + x);
  }
}

// Writes, at x, the sum of the five columns of `sums` from x - 2 on.
void SumColumns(const std::int16_t* sums, std::size_t width, std::int16_t* out) {
  for (std::size_t x = 0; x < width; x += hn::Lanes(kValues)) {
    const auto outer = hn::Add(hn::LoadU(kValues, sums + x - 2), hn::LoadU(kValues, sums + x + 2));
    const auto inner = hn::Add(hn::LoadU(kValues, sums + x - 1), hn::LoadU(kValues, sums + x + 1));
    hn::Store(hn::Add(hn::Add(outer, inner), hn::LoadU(kValues, sums + x)), kValues, out + x);
  }
}

// Returns xx yy - xy^2 - (((xx + yy) >> 1)^2 >> 8) k' of half a vector.
HWY_INLINE Wide Response(Wide xx, Wide xy, Wide yy, Wide weight) {
  const auto half_trace = hn::ShiftRight<1>(hn::Add(xx, yy));
  const auto trace = hn::Mul(hn::ShiftRight<8>(hn::Mul(half_trace, half_trace)), weight);
  return hn::Sub(hn::Sub(hn::Mul(xx, yy), hn::Mul(xy, xy)), trace);
}

void Responses(const std::int16_t* xx, const std::int16_t* xy, const std::int16_t* yy,
               std::int32_t weight, std::size_t width, std::int32_t* response) {
  const auto k = hn::Set(kWide, weight);
  for (std::size_t x = 0; x < width; x += hn::Lanes(kWide)) {
    const auto load = [&](const std::int16_t* sums)
                          HWY_ATTR { return hn::PromoteTo(kWide, hn::Load(kHalf, sums + x)); };
    hn::Store(Response(load(xx), load(xy), load(yy), k), kWide, response + x);
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(SmoothColumns);
HWY_EXPORT(Products);
HWY_EXPORT(SumRows);
HWY_EXPORT(SumColumns);
HWY_EXPORT(Responses);

namespace {

// How many columns of the image the sums of an area read before it, and as many behind.
constexpr int kAround = kHarrisMargin_px;

// Returns the length of a row of sums, padded to whole vectors.
std::size_t StrideOf(int values) {
  return WholeVectors<std::int16_t>(static_cast<std::size_t>(values));
}

void WriteResponses(const std::int16_t* sums, std::size_t stride, std::int32_t weight, int width,
                    std::int32_t* response) {
  HWY_DYNAMIC_DISPATCH(Responses)
  (sums, sums + stride, sums + 2 * stride, weight, static_cast<std::size_t>(width), response);
}

}  // namespace

// The last rows of an area on their way to sums. A row has `stride_` values, and the first belongs
// to the column kAround before the area. Columns outside of the image are 0, and enter only sums
// within the image's margin.
class SlidingRows {
 public:
  SlidingRows(const GrayImage& image, const ImageArea& area)
      : image_(image),
        first_(area.left - kAround),
        stride_(StrideOf(area.width() + 2 * kAround)),
        bytes_(3 * stride_),
        smooth_(stride_),
        step_(stride_),
        products_(15 * stride_),
        columns_(stride_ + kMostLanes<std::int16_t>) {
    next_ = std::max(area.top, kHarrisMargin_px) - 2;
    copied_ = next_ - 1;
  }

  // Writes the sums of a row of the area. The row is no earlier than that of the last call and not
  // in the margin.
  void AddUp(int row, std::size_t width, std::int16_t* const* sums) {
    for (; next_ <= row + 2; ++next_) FindProducts(next_);
    for (std::size_t which = 0; which < 3; ++which) {
      std::array<const std::int16_t*, 5> rows{};
      for (int i = 0; i < 5; ++i) {
        rows[static_cast<std::size_t>(i)] = Product(which, row - 2 + i);
      }
      HWY_DYNAMIC_DISPATCH(SumRows)(rows.data(), stride_, columns_.data());
      HWY_DYNAMIC_DISPATCH(SumColumns)(columns_.data() + kAround, width, sums[which]);
    }
  }

 private:
  void FindProducts(int row) {
    for (; copied_ <= row + 1; ++copied_) CopyRow(copied_);
    HWY_DYNAMIC_DISPATCH(SmoothColumns)
    (Bytes(row - 1), Bytes(row), Bytes(row + 1), stride_, smooth_.data(), step_.data());
    HWY_DYNAMIC_DISPATCH(Products)
    (smooth_.data(), step_.data(), stride_, Product(0, row), Product(1, row), Product(2, row));
  }

  // Returns a row of product 0, 1 or 2 (xx, xy, yy).
  std::int16_t* Product(std::size_t which, int row) {
    return products_.data() + (5 * which + static_cast<std::size_t>(row % 5)) * stride_;
  }
  std::uint8_t* Bytes(int row) {
    return bytes_.data() + static_cast<std::size_t>(row % 3) * stride_;
  }
  void CopyRow(int row) {
    const int from = std::max(first_, 0);
    const int to = std::min(first_ + static_cast<int>(stride_), image_.width());
    std::memcpy(Bytes(row) + (from - first_), image_.Row(row).data() + from,
                static_cast<std::size_t>(to - from));
  }

  const GrayImage& image_;
  int first_;
  int next_ = 0;    // the next row of products
  int copied_ = 0;  // the next row of bytes
  std::size_t stride_;
  AlignedBuffer<std::uint8_t> bytes_;
  AlignedBuffer<std::int16_t> smooth_;
  AlignedBuffer<std::int16_t> step_;
  AlignedBuffer<std::int16_t> products_;
  AlignedBuffer<std::int16_t> columns_;
};

// The sums of one row after the other of an area, 0 within the margin of the image.
class AreaRows {
 public:
  AreaRows(const GrayImage& image, const ImageArea& area)
      : area_(area),
        inside_{kHarrisMargin_px, image.width() - kHarrisMargin_px, kHarrisMargin_px,
                image.height() - kHarrisMargin_px},
        left_(std::max(area.left, inside_.left) - area.left),
        right_(std::min(area.right, inside_.right) - area.left),
        rows_(image, area) {
    EXPECT(0 <= area.left && area.left <= area.right && area.right <= image.width());
    EXPECT(0 <= area.top && area.top <= area.bottom && area.bottom <= image.height());
  }

  // Writes three times `stride` sums. Rows must be asked for from the first to the last.
  void Write(int row, std::size_t stride, std::int16_t* sums) {
    if (left_ >= right_ || row < inside_.top || row >= inside_.bottom) {
      std::fill_n(sums, 3 * stride, std::int16_t{0});
      return;
    }
    const std::array<std::int16_t*, 3> each{sums, sums + stride, sums + 2 * stride};
    rows_.AddUp(row, static_cast<std::size_t>(area_.width()), each.data());
    for (std::int16_t* const sum : each) {
      std::fill_n(sum, left_, std::int16_t{0});
      std::fill(sum + right_, sum + area_.width(), std::int16_t{0});
    }
  }

 private:
  ImageArea area_;
  ImageArea inside_;
  int left_;
  int right_;
  SlidingRows rows_;
};

ImageArea Widened(const ImageArea& area, int reach, int width, int height) {
  return {std::max(area.left - reach, 0), std::min(area.right + reach, width),
          std::max(area.top - reach, 0), std::min(area.bottom + reach, height)};
}

std::int32_t HarrisWeight(double weight) {
  EXPECT(weight >= 0.0 && weight <= 0.25);
  return static_cast<std::int32_t>(std::lround(1024.0 * weight));
}

GradientSums::GradientSums(const GrayImage& image, const ImageArea& area)
    : area_(area),
      stride_(StrideOf(area.width())),
      sums_(3 * stride_ * static_cast<std::size_t>(area.height()), Filled::kAnything) {
  AreaRows rows(image, area);
  for (int row = area.top; row < area.bottom; ++row) rows.Write(row, stride_, Row(row));
}

void GradientSums::WriteResponse(int row, std::int32_t weight, std::int32_t* response) const {
  EXPECT(row >= area_.top && row < area_.bottom);
  WriteResponses(Row(row), stride_, weight, area_.width(), response);
}

HarrisRows::HarrisRows(const GrayImage& image, const ImageArea& area, std::int32_t weight)
    : area_(area),
      weight_(weight),
      stride_(StrideOf(area.width())),
      sums_(3 * stride_),
      rows_(std::make_unique<AreaRows>(image, area)) {}

HarrisRows::~HarrisRows() = default;

void HarrisRows::WriteResponse(int row, std::int32_t* response) {
  EXPECT(row >= area_.top && row < area_.bottom);
  rows_->Write(row, stride_, sums_.data());
  WriteResponses(sums_.data(), stride_, weight_, area_.width(), response);
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE
