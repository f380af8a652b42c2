#include "vision/stereo/disparity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/check.h"

namespace rockyard::vision {
namespace {

// Returns, for each (x, y), how many pixels are 0 in the rectangle of columns below x and rows
// below y.
Image<std::int32_t> SumOutside(const Image<std::uint8_t>& inside) {
  Image<std::int32_t> sums(inside.width() + 1, inside.height() + 1);
  for (int y = 0; y < inside.height(); ++y) {
    std::int32_t row = 0;
    for (int x = 0; x < inside.width(); ++x) {
      row += inside.At(x, y) == 0 ? 1 : 0;
      sums.At(x + 1, y + 1) = sums.At(x + 1, y) + row;
    }
  }
  return sums;
}

class Windows {
 public:
  Windows(const Image<std::uint8_t>& inside, int side_px)
      : sums_(SumOutside(inside)), before_px_(side_px / 2), behind_px_(side_px - side_px / 2) {}

  // Returns whether the window at (x, y) has a pixel that is 0. Its part beyond the image counts
  // as inside.
  bool HasOutside(int x, int y) const {
    const auto end = [](int value, int size) { return std::clamp(value, 0, size - 1); };
    const int left = end(x - before_px_, sums_.width());
    const int right = end(x + behind_px_, sums_.width());
    const int top = end(y - before_px_, sums_.height());
    const int bottom = end(y + behind_px_, sums_.height());
    return sums_.At(right, bottom) - sums_.At(left, bottom) - sums_.At(right, top) +
               sums_.At(left, top) >
           0;
  }

 private:
  Image<std::int32_t> sums_;
  int before_px_;
  int behind_px_;
};

double Share(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

DropCounts CountDrops(const DisparityImage& disparities) {
  DropCounts counts{};
  for (const std::int16_t disparity : disparities.values()) {
    ++counts[static_cast<std::size_t>(DropOf(disparity))];
  }
  return counts;
}

void DropOutside(const Image<std::uint8_t>& left_inside, const Image<std::uint8_t>& right_inside,
                 int window_side_px, DisparityImage& disparities) {
  EXPECT(
      left_inside.width() == disparities.width() && left_inside.height() == disparities.height() &&
      right_inside.width() == disparities.width() && right_inside.height() == disparities.height());
  const Windows left(left_inside, window_side_px);
  const Windows right(right_inside, window_side_px);
  for (int y = 0; y < disparities.height(); ++y) {
    for (int x = 0; x < disparities.width(); ++x) {
      std::int16_t& disparity = disparities.At(x, y);
      if (!IsValid(disparity)) continue;
      const int match = x - static_cast<int>(std::lround(DisparityPx(disparity)));
      if (left.HasOutside(x, y) || right.HasOutside(match, y)) {
        disparity = Dropped(Drop::kOutside);
      }
    }
  }
}

double StereoScore::Density() const { return Share(matched, known); }

double StereoScore::BadShare(std::size_t i) const { return Share(bad.at(i), matched); }

StereoScore ScoreAgainst(const Image<float>& known, const DisparityImage& disparities) {
  EXPECT(known.width() == disparities.width() && known.height() == disparities.height());
  StereoScore score;
  double sum_px = 0.0;
  double sum_px2 = 0.0;
  for (int y = 0; y < known.height(); ++y) {
    for (int x = 0; x < known.width(); ++x) {
      const double truth_px = static_cast<double>(known.At(x, y));
      if (!std::isfinite(truth_px)) continue;
      ++score.known;
      if (!IsValid(disparities.At(x, y))) continue;
      ++score.matched;
      const double error_px = DisparityPx(disparities.At(x, y)) - truth_px;
      sum_px += error_px;
      sum_px2 += error_px * error_px;
      for (std::size_t i = 0; i < kBadThresholds_px.size(); ++i) {
        if (std::abs(error_px) > kBadThresholds_px[i]) ++score.bad[i];
      }
    }
  }
  if (score.matched > 0) {
    score.mean_error_px = sum_px / static_cast<double>(score.matched);
    score.rms_error_px = std::sqrt(sum_px2 / static_cast<double>(score.matched));
  }
  return score;
}

}  // namespace rockyard::vision
