#include "vision/odometry/harris.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/check.h"

namespace rockyard::vision {
namespace {

constexpr int kLimit = 63;

std::int16_t Gradient(int sobel) {
  return static_cast<std::int16_t>(std::clamp((sobel + 1) >> 1, -kLimit, kLimit));
}

// Products of the gradients of one row; 0 in the first and last column.
struct ProductRow {
  explicit ProductRow(std::size_t width) : xx(width), xy(width), yy(width) {}

  std::vector<std::int16_t> xx;
  std::vector<std::int16_t> xy;
  std::vector<std::int16_t> yy;
};

void FindProducts(const GrayImage& image, int row, ProductRow& products) {
  const auto above = image.Row(row - 1);
  const auto here = image.Row(row);
  const auto below = image.Row(row + 1);
  for (std::size_t x = 1; x + 1 < here.size(); ++x) {
    const auto smooth = [&](std::size_t i) { return above[i] + 2 * here[i] + below[i]; };
    const auto step = [&](std::size_t i) { return below[i] - above[i]; };
    const int gx = Gradient(smooth(x + 1) - smooth(x - 1));
    const int gy = Gradient(step(x - 1) + 2 * step(x) + step(x + 1));
    products.xx[x] = static_cast<std::int16_t>(gx * gx);
    products.xy[x] = static_cast<std::int16_t>(gx * gy);
    products.yy[x] = static_cast<std::int16_t>(gy * gy);
  }
}

}  // namespace

std::int32_t HarrisWeight(double weight) {
  EXPECT(weight >= 0.0 && weight <= 0.25);
  return static_cast<std::int32_t>(std::lround(1024.0 * weight));
}

GradientSums GradientSumsOf(const GrayImage& image) {
  const int width = image.width();
  const int height = image.height();
  GradientSums sums{Image<std::int16_t>(width, height), Image<std::int16_t>(width, height),
                    Image<std::int16_t>(width, height)};
  if (width <= 2 * kHarrisMargin_px || height <= 2 * kHarrisMargin_px) return sums;
  std::vector<ProductRow> rows(5, ProductRow(static_cast<std::size_t>(width)));
  const auto slot = [](int row) { return static_cast<std::size_t>(row % 5); };
  for (int row = 1; row < 5; ++row) FindProducts(image, row, rows[slot(row)]);
  std::vector<std::int16_t> columns(static_cast<std::size_t>(width));
  for (int row = kHarrisMargin_px; row < height - kHarrisMargin_px; ++row) {
    FindProducts(image, row + 2, rows[slot(row + 2)]);
    const auto add_up = [&](std::vector<std::int16_t> ProductRow::*product,
                            std::span<std::int16_t> sum) {
      const std::int16_t* const r0 = (rows[0].*product).data();
      const std::int16_t* const r1 = (rows[1].*product).data();
      const std::int16_t* const r2 = (rows[2].*product).data();
      const std::int16_t* const r3 = (rows[3].*product).data();
      const std::int16_t* const r4 = (rows[4].*product).data();
      for (std::size_t x = 0; x < columns.size(); ++x) {
        columns[x] = static_cast<std::int16_t>((r0[x] + r1[x] + r2[x] + r3[x] + r4[x]) >> 2);
      }
      for (std::size_t x = kHarrisMargin_px; x + kHarrisMargin_px < columns.size(); ++x) {
        sum[x] = static_cast<std::int16_t>(columns[x - 2] + columns[x - 1] + columns[x] +
                                           columns[x + 1] + columns[x + 2]);
      }
    };
    add_up(&ProductRow::xx, sums.xx.Row(row));
    add_up(&ProductRow::xy, sums.xy.Row(row));
    add_up(&ProductRow::yy, sums.yy.Row(row));
  }
  return sums;
}

void HarrisResponse(const GradientSums& sums, std::int32_t weight, int first_column, int first_row,
                    Image<std::int32_t>& response) {
  EXPECT(first_column >= 0 && first_column + response.width() <= sums.xx.width());
  EXPECT(first_row >= 0 && first_row + response.height() <= sums.xx.height());
  for (int row = 0; row < response.height(); ++row) {
    const auto from = static_cast<std::size_t>(first_column);
    const std::int16_t* const xx = sums.xx.Row(first_row + row).data() + from;
    const std::int16_t* const xy = sums.xy.Row(first_row + row).data() + from;
    const std::int16_t* const yy = sums.yy.Row(first_row + row).data() + from;
    const auto values = response.Row(row);
    for (std::size_t x = 0; x < values.size(); ++x) {
      const std::int32_t half_trace = (xx[x] + yy[x]) >> 1;
      values[x] = xx[x] * yy[x] - xy[x] * xy[x] - ((half_trace * half_trace) >> 8) * weight;
    }
  }
}

}  // namespace rockyard::vision
