#include <algorithm>
#include <cmath>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vision/stereo/dog.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/check.h"
#include "vision/stereo/aligned_buffer.h"
#include "vision/stereo/dog.h"

HWY_BEFORE_NAMESPACE();
namespace rockyard::vision::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::uint16_t> kSums;
constexpr hn::RepartitionToWide<decltype(kSums)> kWideSums;
constexpr hn::RebindToSigned<decltype(kWideSums)> kProducts;
constexpr hn::RebindToSigned<decltype(kSums)> kValues;
constexpr hn::Rebind<std::uint8_t, decltype(kSums)> kBytes;

// Slides the sums over a square's columns down by a row: adds the row `in`, takes off the row
// `out`. The arrays have room for whole vectors behind `width`.
void SlideSums(const std::uint8_t* in, const std::uint8_t* out, std::size_t width,
               std::uint16_t* sums) {
  const std::size_t lanes = hn::Lanes(kSums);
  std::size_t x = 0;
  for (; x + lanes <= width; x += lanes) {
    const auto more = hn::PromoteTo(kSums, hn::LoadU(kBytes, in + x));
    const auto less = hn::PromoteTo(kSums, hn::LoadU(kBytes, out + x));
    hn::StoreU(hn::Sub(hn::Add(hn::LoadU(kSums, sums + x), more), less), kSums, sums + x);
  }
  for (; x < width; ++x) sums[x] = static_cast<std::uint16_t>(sums[x] + in[x] - out[x]);
}

// Writes the sums of three rows that count 1, 2 and 1. `sums` has room for whole vectors behind
// `width`.
void WeighColumns(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                  std::size_t width, std::uint16_t* sums) {
  const std::size_t lanes = hn::Lanes(kSums);
  std::size_t x = 0;
  for (; x + lanes <= width; x += lanes) {
    const auto outer = hn::Add(hn::PromoteTo(kSums, hn::LoadU(kBytes, above + x)),
                               hn::PromoteTo(kSums, hn::LoadU(kBytes, below + x)));
    const auto inner = hn::PromoteTo(kSums, hn::LoadU(kBytes, here + x));
    hn::StoreU(hn::Add(outer, hn::Add(inner, inner)), kSums, sums + x);
  }
  for (; x < width; ++x) sums[x] = static_cast<std::uint16_t>(above[x] + 2 * here[x] + below[x]);
}

// Returns the sum of `side` neighbours from `sums` on.
HWY_INLINE hn::Vec<decltype(kSums)> RowSum(const std::uint16_t* sums, int side) {
  auto sum = hn::LoadU(kSums, sums);
  for (int i = 1; i < side; ++i) sum = hn::Add(sum, hn::LoadU(kSums, sums + i));
  return sum;
}

// Returns (s a - w b + 2^19) >> 20 of half a vector.
HWY_INLINE hn::Vec<decltype(kProducts)> Weigh(hn::Vec<decltype(kWideSums)> first,
                                              hn::Vec<decltype(kWideSums)> second,
                                              const DogWeights& weights) {
  const auto s = hn::BitCast(kProducts, first);
  const auto w = hn::BitCast(kProducts, second);
  const auto difference = hn::Sub(hn::Mul(s, hn::Set(kProducts, weights.first)),
                                  hn::Mul(w, hn::Set(kProducts, weights.second)));
  return hn::ShiftRight<kDogShift>(hn::Add(difference, hn::Set(kProducts, 1 << (kDogShift - 1))));
}

// Writes a row of values. Value x comes from entries x to x + first_side - 1 of `first`
// and x to x + second_side - 1 of `second`. Both arrays and `row` have room for whole
// vectors.
void WeighRow(const std::uint16_t* first, int first_side, const std::uint16_t* second,
              int second_side, const DogWeights& weights, int limit, std::size_t width,
              std::uint8_t* row) {
  const hn::Half<decltype(kSums)> half_sums;
  const auto high = hn::Set(kValues, static_cast<std::int16_t>(limit));
  const auto low = hn::Neg(high);
  for (std::size_t x = 0; x < width; x += hn::Lanes(kSums)) {
    const auto s = RowSum(first + x, first_side);
    const auto w = RowSum(second + x, second_side);
    const auto lower = Weigh(hn::PromoteTo(kWideSums, hn::LowerHalf(half_sums, s)),
                             hn::PromoteTo(kWideSums, hn::LowerHalf(half_sums, w)), weights);
    const auto upper = Weigh(hn::PromoteTo(kWideSums, hn::UpperHalf(half_sums, s)),
                             hn::PromoteTo(kWideSums, hn::UpperHalf(half_sums, w)), weights);
    const auto value = hn::Combine(kValues, hn::DemoteTo(hn::Half<decltype(kValues)>(), upper),
                                   hn::DemoteTo(hn::Half<decltype(kValues)>(), lower));
    const auto clamped = hn::Add(hn::Min(hn::Max(value, low), high), high);
    hn::StoreU(hn::DemoteTo(kBytes, clamped), kBytes, row + x);
  }
}

}  // namespace rockyard::vision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rockyard::vision {

HWY_EXPORT(SlideSums);
HWY_EXPORT(WeighColumns);
HWY_EXPORT(WeighRow);

namespace {

// Column sums of one square along a row of an image, with its outermost columns repeated on either
// side.
class ColumnSums {
 public:
  // Makes the sums around row y - 1 of an image, so that Slide(y) gives those around y.
  ColumnSums(const GrayImage& image, int side, int y)
      : image_(&image),
        half_(side / 2),
        sums_(static_cast<std::size_t>(image.width() + side) + kMostLanes<std::uint16_t>),
        nothing_(static_cast<std::size_t>(image.width())) {
    for (int k = -half_; k <= half_; ++k) Update(RowAt(y - 1 + k), nothing_.data());
  }

  void Slide(int y) {
    Update(RowAt(y + half_), RowAt(y - 1 - half_));
    std::uint16_t* const inside = Inside();
    std::fill_n(sums_.data(), half_, inside[0]);
    std::fill_n(inside + image_->width(), half_, inside[image_->width() - 1]);
  }

  const std::uint16_t* data() const { return sums_.data(); }

 private:
  std::uint16_t* Inside() { return sums_.data() + half_; }
  const std::uint8_t* RowAt(int y) const {
    return image_->Row(std::clamp(y, 0, image_->height() - 1)).data();
  }
  void Update(const std::uint8_t* in, const std::uint8_t* out) {
    HWY_DYNAMIC_DISPATCH(SlideSums)(in, out, static_cast<std::size_t>(image_->width()), Inside());
  }

  const GrayImage* image_;
  int half_;
  AlignedBuffer<std::uint16_t> sums_;
  AlignedBuffer<std::uint8_t> nothing_;
};

// Column sums of a row gradient along a row of an image, with its outermost columns repeated on
// either side.
class BinomialSums {
 public:
  explicit BinomialSums(const GrayImage& image)
      : image_(&image),
        sums_(static_cast<std::size_t>(image.width()) + 2 + kMostLanes<std::uint16_t>) {}

  void MoveTo(int y) {
    const auto row = [&](int at) { return image_->Row(std::clamp(at, 0, image_->height() - 1)); };
    const auto width = static_cast<std::size_t>(image_->width());
    std::uint16_t* const inside = sums_.data() + 1;
    HWY_DYNAMIC_DISPATCH(WeighColumns)
    (row(y - 1).data(), row(y).data(), row(y + 1).data(), width, inside);
    sums_.data()[0] = inside[0];
    inside[width] = inside[width - 1];
  }

  // The sums of the columns from the one before pixel 0 on, and from the one behind pixel 0 on.
  const std::uint16_t* left() const { return sums_.data(); }
  const std::uint16_t* right() const { return sums_.data() + 2; }

 private:
  const GrayImage* image_;
  AlignedBuffer<std::uint16_t> sums_;
};

// Writes rows of the filtered image, for both kinds of filters.
class RowWriter {
 public:
  RowWriter(const DogParams& params, GrayImage& out)
      : weights_(MakeDogWeights(params)),
        limit_(static_cast<int>(params.limit)),
        out_(&out),
        row_(static_cast<std::size_t>(out.width()) + kMostLanes<std::uint16_t>) {}

  void Write(const std::uint16_t* first, int first_side, const std::uint16_t* second,
             int second_side, int y) {
    const auto width = static_cast<std::size_t>(out_->width());
    HWY_DYNAMIC_DISPATCH(WeighRow)
    (first, first_side, second, second_side, weights_, limit_, width, row_.data());
    std::copy_n(row_.data(), width, out_->Row(y).data());
  }

 private:
  DogWeights weights_;
  int limit_;
  GrayImage* out_;
  AlignedBuffer<std::uint8_t> row_;
};

void LaplacianRows(const GrayImage& image, const DogParams& params, int first_row, int end_row,
                   RowWriter& writer) {
  const auto narrow_side = static_cast<int>(params.narrow_side_px);
  const auto wide_side = static_cast<int>(params.wide_side_px);
  ColumnSums narrow(image, narrow_side, first_row);
  ColumnSums wide(image, wide_side, first_row);
  for (int y = first_row; y < end_row; ++y) {
    narrow.Slide(y);
    wide.Slide(y);
    writer.Write(narrow.data(), narrow_side, wide.data(), wide_side, y);
  }
}

void RowGradientRows(const GrayImage& image, int first_row, int end_row, RowWriter& writer) {
  BinomialSums sums(image);
  for (int y = first_row; y < end_row; ++y) {
    sums.MoveTo(y);
    writer.Write(sums.right(), 1, sums.left(), 1, y);
  }
}

}  // namespace

DogWeights MakeDogWeights(const DogParams& params) {
  const auto factor = [&](std::int64_t pixels) {
    return std::llround(std::ldexp(params.gain, kDogShift) / static_cast<double>(pixels));
  };
  if (params.kind == DogKind::kRowGradient) {
    const auto q = static_cast<std::int32_t>(factor(4));
    return {q, q};
  }
  const std::int64_t narrow = params.narrow_side_px * params.narrow_side_px;
  const std::int64_t wide = params.wide_side_px * params.wide_side_px;
  const std::int64_t q = factor(narrow * wide);
  return {static_cast<std::int32_t>(q * wide), static_cast<std::int32_t>(q * narrow)};
}

void DifferenceOfGaussiansRows(const GrayImage& image, const DogParams& params, int first_row,
                               int end_row, GrayImage& out) {
  EXPECT(out.width() == image.width() && out.height() == image.height());
  EXPECT(0 <= first_row && end_row <= image.height());
  if (first_row >= end_row || image.width() == 0) return;
  RowWriter writer(params, out);
  if (params.kind == DogKind::kRowGradient) {
    RowGradientRows(image, first_row, end_row, writer);
  } else {
    LaplacianRows(image, params, first_row, end_row, writer);
  }
}

GrayImage DifferenceOfGaussians(const GrayImage& image, const DogParams& params) {
  GrayImage out(image.width(), image.height());
  DifferenceOfGaussiansRows(image, params, 0, image.height(), out);
  return out;
}

}  // namespace rockyard::vision
#endif  // HWY_ONCE
