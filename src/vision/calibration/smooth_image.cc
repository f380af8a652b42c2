#include "vision/calibration/smooth_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rockyard::vision {
namespace {

std::vector<float> GaussianWeights(double sigma_px) {
  const int half = static_cast<int>(std::ceil(3.0 * sigma_px));
  std::vector<float> weights;
  float sum = 0.0F;
  for (int i = -half; i <= half; ++i) {
    weights.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma_px * sigma_px))));
    sum += weights.back();
  }
  for (float& weight : weights) weight /= sum;
  return weights;
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

}  // namespace rockyard::vision
