#include "vision/calibration/corner_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "math/functions.h"

namespace rockyard::vision {
namespace {

std::vector<float> GaussianWeights(double sigma_px) {
  const int half = static_cast<int>(std::ceil(3.0 * sigma_px));
  std::vector<float> weights;
  float sum = 0.0F;
  for (int i = -half; i <= half; ++i) {
    weights.push_back(static_cast<float>(math::Exp(-0.5 * i * i / (sigma_px * sigma_px))));
    sum += weights.back();
  }
  for (float& weight : weights) weight /= sum;
  return weights;
}

// The numbers of CornerCandidates, and kFarthest_px of RefineCorner, as the header describes them.
constexpr int kApart_px = 3;
constexpr double kLeastShare = 0.02;
constexpr double kCircle_px = 5.0;
constexpr double kLeastContrast = 12.0;
constexpr std::size_t kCirclePoints = 32;
constexpr double kFarthest_px = 3.0;

Image<float> Saddles(const Image<float>& smooth) {
  Image<float> saddles(smooth.width(), smooth.height(), 0.0F);
  for (int y = 1; y + 1 < smooth.height(); ++y) {
    for (int x = 1; x + 1 < smooth.width(); ++x) {
      const float middle = smooth.At(x, y);
      const float xx = smooth.At(x - 1, y) - 2.0F * middle + smooth.At(x + 1, y);
      const float yy = smooth.At(x, y - 1) - 2.0F * middle + smooth.At(x, y + 1);
      const float xy = 0.25F * (smooth.At(x + 1, y + 1) - smooth.At(x - 1, y + 1) -
                                smooth.At(x + 1, y - 1) + smooth.At(x - 1, y - 1));
      saddles.At(x, y) = std::max(0.0F, xy * xy - xx * yy);
    }
  }
  return saddles;
}

// Returns whether no pixel within kApart_px is larger; of equal ones the first in reading order is
// the peak.
bool IsPeak(const Image<float>& saddles, int x, int y) {
  const float value = saddles.At(x, y);
  for (int dy = -kApart_px; dy <= kApart_px; ++dy) {
    for (int dx = -kApart_px; dx <= kApart_px; ++dx) {
      const float other = saddles.At(x + dx, y + dy);
      const bool before = dy < 0 || (dy == 0 && dx < 0);
      if (other > value || (before && other == value)) return false;
    }
  }
  return true;
}

bool HasFourSectors(const Image<float>& smooth, const Pixel& at) {
  std::array<double, kCirclePoints> values{};
  for (std::size_t i = 0; i < kCirclePoints; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * static_cast<double>(i) / kCirclePoints;
    values[i] =
        ValueAt(smooth, at + kCircle_px * Pixel(math::Cos(angle_rad), math::Sin(angle_rad)));
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*most - *least < kLeastContrast) return false;
  const double middle = 0.5 * (*most + *least);
  int changes = 0;
  for (std::size_t i = 0; i < kCirclePoints; ++i) {
    if ((values[i] > middle) != (values[(i + 1) % kCirclePoints] > middle)) ++changes;
  }
  return changes == 4;
}

bool Contains(const GrayImage& image, int x, int y) {
  return x >= 1 && y >= 1 && x + 1 < image.width() && y + 1 < image.height();
}

// Returns the q of sum w g g^T q = sum w g g^T p with the window about `at`: one step of
// RefineCorner.
std::optional<Pixel> MeetOfEdges(const GrayImage& image, const Pixel& at, double radius_px) {
  const double falloff = 0.5 / (0.25 * radius_px * radius_px);
  const int reach = static_cast<int>(std::ceil(radius_px));
  const int x0 = static_cast<int>(std::lround(at.x()));
  const int y0 = static_cast<int>(std::lround(at.y()));
  Eigen::Matrix2d tensor = Eigen::Matrix2d::Zero();
  Pixel moment = Pixel::Zero();
  for (int y = y0 - reach; y <= y0 + reach; ++y) {
    for (int x = x0 - reach; x <= x0 + reach; ++x) {
      if (!Contains(image, x, y)) continue;
      const Pixel apart = Pixel(x, y) - at;
      const double squared = apart.squaredNorm();
      if (squared > radius_px * radius_px) continue;
      const Pixel gradient(0.5 * (image.At(x + 1, y) - image.At(x - 1, y)),
                           0.5 * (image.At(x, y + 1) - image.At(x, y - 1)));
      const Eigen::Matrix2d part = math::Exp(-falloff * squared) * gradient * gradient.transpose();
      tensor += part;
      moment += part * apart;
    }
  }
  constexpr double kLeastAcross = 0.02;  // det / trace^2 of edges at some 8 deg to each other
  const double trace = tensor.trace();
  if (!(tensor.determinant() > kLeastAcross * trace * trace)) return std::nullopt;
  return Pixel(at + tensor.inverse() * moment);
}

}  // namespace

Image<float> Smoothed(const GrayImage& image, double sigma_px) {
  const std::vector<float> weights = GaussianWeights(sigma_px);
  const int half = static_cast<int>(weights.size() / 2);
  const float* middle = weights.data() + half;
  const int width = image.width();
  const int height = image.height();
  const auto sum_over = [&](int at, int end, const auto& value) {
    float sum = 0.0F;
    for (int i = -half; i <= half; ++i) {
      sum += middle[i] * value(std::clamp(at + i, 0, end - 1));
    }
    return sum;
  };
  Image<float> along(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      along.At(x, y) =
          sum_over(x, width, [&](int column) { return static_cast<float>(image.At(column, y)); });
    }
  }
  Image<float> smooth(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      smooth.At(x, y) = sum_over(y, height, [&](int row) { return along.At(x, row); });
    }
  }
  return smooth;
}

double ValueAt(const Image<float>& image, const Pixel& at) {
  const double x = std::clamp(at.x(), 0.0, image.width() - 1.0);
  const double y = std::clamp(at.y(), 0.0, image.height() - 1.0);
  const int left = std::min(static_cast<int>(x), std::max(image.width() - 2, 0));
  const int top = std::min(static_cast<int>(y), std::max(image.height() - 2, 0));
  const int right = std::min(left + 1, image.width() - 1);
  const int below = std::min(top + 1, image.height() - 1);
  const double share_x = x - left;
  const double share_y = y - top;
  const auto mix = [](double from, double to, double share) { return from + share * (to - from); };
  return mix(mix(static_cast<double>(image.At(left, top)),
                 static_cast<double>(image.At(right, top)), share_x),
             mix(static_cast<double>(image.At(left, below)),
                 static_cast<double>(image.At(right, below)), share_x),
             share_y);
}

std::vector<Pixel> CornerCandidates(const Image<float>& smooth) {
  std::vector<Pixel> candidates;
  if (smooth.empty()) return candidates;
  const Image<float> saddles = Saddles(smooth);
  const float largest = *std::max_element(saddles.values().begin(), saddles.values().end());
  const auto least = static_cast<float>(kLeastShare) * largest;
  for (int y = kApart_px; y + kApart_px < smooth.height(); ++y) {
    for (int x = kApart_px; x + kApart_px < smooth.width(); ++x) {
      if (saddles.At(x, y) <= least || !IsPeak(saddles, x, y)) continue;
      if (HasFourSectors(smooth, Pixel(x, y))) candidates.emplace_back(x, y);
    }
  }
  return candidates;
}

std::optional<Pixel> RefineCorner(const GrayImage& image, const Pixel& start, double radius_px) {
  constexpr int kMostSteps = 30;
  constexpr double kAtRest_px = 1e-4;
  Pixel at = start;
  for (int step = 0; step < kMostSteps; ++step) {
    const std::optional<Pixel> next = MeetOfEdges(image, at, radius_px);
    if (!next || (*next - start).norm() > kFarthest_px) return std::nullopt;
    const double moved_px = (*next - at).norm();
    at = *next;
    if (moved_px < kAtRest_px) break;
  }
  if (!Contains(image, static_cast<int>(std::lround(at.x())),
                static_cast<int>(std::lround(at.y())))) {
    return std::nullopt;
  }
  return at;
}

}  // namespace rockyard::vision
