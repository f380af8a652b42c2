#include "plain_stereo.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "vision/each_pixel.h"

namespace rockyard::vision {
namespace {

std::int64_t SquareSum(const GrayImage& image, int x, int y, int side) {
  std::int64_t sum = 0;
  for (int k = -(side / 2); k <= side / 2; ++k) {
    for (int i = -(side / 2); i <= side / 2; ++i) {
      sum += image.At(std::clamp(x + i, 0, image.width() - 1),
                      std::clamp(y + k, 0, image.height() - 1));
    }
  }
  return sum;
}

// Rounds down also where the numerator is negative.
std::int64_t FloorDivide(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t quotient = numerator / denominator;
  return numerator % denominator < 0 ? quotient - 1 : quotient;
}

// Scores of one row of the left image: by x and disparity index.
using Scores = std::vector<std::vector<int>>;

Scores RowScores(const GrayImage& left, const GrayImage& right, const CorrelatorParams& params,
                 int y) {
  Scores scores(static_cast<std::size_t>(left.width()));
  for (int x = 0; x < left.width(); ++x) {
    for (int i = 0; i < params.disparities; ++i) {
      scores[x].push_back(PlainScore(left, right, static_cast<int>(params.window_side_px), x, y,
                                     static_cast<int>(params.min_disparity_px) + i));
    }
  }
  return scores;
}

// Index of the first smallest score, or -1 where there is none.
int Best(const std::vector<int>& scores) {
  const auto best = std::min_element(scores.begin(), scores.end());
  return *best == kNoScore ? -1 : static_cast<int>(best - scores.begin());
}

// The scores of right pixel x: S(x + d, d).
std::vector<int> RightScores(const Scores& scores, int x, int min_disparity) {
  std::vector<int> right;
  for (int i = 0; i < static_cast<int>(scores.front().size()); ++i) {
    const int left = x + min_disparity + i;
    const bool inside = 0 <= left && left < static_cast<int>(scores.size());
    right.push_back(inside ? scores[left][i] : kNoScore);
  }
  return right;
}

std::int16_t Decide(const Scores& scores, int x, const StereoPipelineParams& params) {
  const std::vector<int>& own = scores[x];
  const int min_disparity = static_cast<int>(params.correlator.min_disparity_px);
  const int best = Best(own);
  if (best < 0) return Dropped(Drop::kOutside);
  const int back = Best(RightScores(scores, x - min_disparity - best, min_disparity));
  if (std::abs(back - best) > params.filters.line_of_sight_px) return Dropped(Drop::kLineOfSight);
  if (best == 0 || best + 1 == static_cast<int>(own.size())) return Dropped(Drop::kRangeEnd);
  const int below = own[best - 1];
  const int here = own[best];
  const int above = own[best + 1];
  if (below == kNoScore || above == kNoScore) return Dropped(Drop::kRangeEnd);
  const int curvature = below - 2 * here + above;
  const auto side = static_cast<double>(params.correlator.window_side_px);
  if (below <= here || above <= here || curvature < params.filters.min_curvature * side * side) {
    return Dropped(Drop::kPeak);
  }
  const double ratio = std::ceil(256.0 * params.filters.min_curvature_ratio) / 256.0;
  if (curvature < ratio * here) return Dropped(Drop::kContrast);
  // The lowest point lies (below - above) / (2 steepness) off the middle one.
  const int steepness = params.filters.interpolation == Interpolation::kQuadratic
                            ? curvature
                            : std::max(below, above) - here;
  const std::int64_t fraction = FloorDivide(32 * (below - above) + steepness, 2 * steepness);
  return static_cast<std::int16_t>(32 * (min_disparity + best) + fraction);
}

}  // namespace

GrayImage PlainDifferenceOfGaussians(const GrayImage& image, const DogParams& params) {
  const auto grey = [&](int x, int y) {
    return std::int64_t{
        image.At(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1))};
  };
  const auto column = [&](int x, int y) {
    return grey(x, y - 1) + 2 * grey(x, y) + grey(x, y + 1);
  };
  const bool gradient = params.kind == DogKind::kRowGradient;
  const std::int64_t narrow = params.narrow_side_px * params.narrow_side_px;
  const std::int64_t wide = params.wide_side_px * params.wide_side_px;
  const std::int64_t parts = gradient ? 4 : narrow * wide;
  const std::int64_t q = std::llround(1048576.0 * params.gain / static_cast<double>(parts));
  GrayImage out(image.width(), image.height());
  ForEachPixel(image.width(), image.height(), [&](int x, int y) {
    const std::int64_t difference =
        gradient ? column(x + 1, y) - column(x - 1, y)
                 : SquareSum(image, x, y, static_cast<int>(params.narrow_side_px)) * wide -
                       SquareSum(image, x, y, static_cast<int>(params.wide_side_px)) * narrow;
    const std::int64_t value = FloorDivide(q * difference + 524288, 1048576);
    out.At(x, y) =
        static_cast<std::uint8_t>(std::clamp(value, -params.limit, params.limit) + params.limit);
  });
  return out;
}

int PlainScore(const GrayImage& left, const GrayImage& right, int side, int x, int y, int d) {
  const int before = side / 2;
  const int after = side - 1 - before;
  const bool rows_inside = y - before >= 0 && y + after < left.height();
  const bool left_inside = x - before >= 0 && x + after < left.width();
  const bool right_inside = x - d - before >= 0 && x - d + after < left.width();
  if (!rows_inside || !left_inside || !right_inside) return kNoScore;
  int score = 0;
  for (int k = -before; k <= after; ++k) {
    for (int i = -before; i <= after; ++i) {
      score += std::abs(left.At(x + i, y + k) - right.At(x + i - d, y + k));
    }
  }
  return score;
}

DisparityImage PlainCorrelate(const GrayImage& left, const GrayImage& right,
                              const StereoPipelineParams& params) {
  DisparityImage out(left.width(), left.height());
  for (int y = 0; y < left.height(); ++y) {
    const Scores scores = RowScores(left, right, params.correlator, y);
    for (int x = 0; x < left.width(); ++x) out.At(x, y) = Decide(scores, x, params);
  }
  return out;
}

void PlainFilterBlobs(const StereoFilterParams& filters, DisparityImage& disparities) {
  const DisparityImage before = disparities;
  Image<std::uint8_t> seen(before.width(), before.height());
  const double step = filters.blob_max_step_px * 32.0;
  for (int y = 0; y < before.height(); ++y) {
    for (int x = 0; x < before.width(); ++x) {
      if (seen.At(x, y) != 0 || !IsValid(before.At(x, y))) continue;
      std::vector<std::pair<int, int>> region{{x, y}};
      seen.At(x, y) = 1;
      for (std::size_t next = 0; next < region.size(); ++next) {
        const auto [u, v] = region[next];
        for (const auto& [i, k] : {std::pair{u - 1, v}, {u + 1, v}, {u, v - 1}, {u, v + 1}}) {
          if (i < 0 || k < 0 || i >= before.width() || k >= before.height()) continue;
          if (seen.At(i, k) != 0 || !IsValid(before.At(i, k))) continue;
          if (std::abs(before.At(i, k) - before.At(u, v)) > step) continue;
          seen.At(i, k) = 1;
          region.emplace_back(i, k);
        }
      }
      if (static_cast<std::int64_t>(region.size()) >= filters.blob_min_px) continue;
      for (const auto& [u, v] : region) disparities.At(u, v) = Dropped(Drop::kBlob);
    }
  }
}

}  // namespace rockyard::vision
