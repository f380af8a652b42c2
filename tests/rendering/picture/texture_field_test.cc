// The noise of textures against its definition, and its filter against means of many samples.

#include "rendering/picture/texture_field.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "rendering/image_readout.h"
#include "vision/each_pixel.h"

namespace rockyard::rendering {
namespace {

constexpr core::TrialKey kKey{11, 3};
constexpr auto kPurpose = core::Purpose::kTest;

TextureParams FewOctaves(double exponent = 2.4) { return {1.0, exponent, 0.4, 0.05, 0.1}; }

Footprint Point() { return {{1e-7, 0.0}, {0.0, 1e-7}}; }

double CubicSpline(double x) {
  const double a = std::abs(x);
  if (a < 1.0) return 2.0 / 3.0 - a * a + 0.5 * a * a * a;
  return a < 2.0 ? (2.0 - a) * (2.0 - a) * (2.0 - a) / 6.0 : 0.0;
}

// One octave by its definition: numbers, thinned out and refined node by node in double.
class PlainOctave {
 public:
  PlainOctave(std::uint32_t octave, double spacing_m)
      : noise_(kKey, kPurpose, octave), spacing_m_(spacing_m) {}

  double At(double u_m, double v_m) const {
    const double u = u_m / spacing_m_;
    const double v = v_m / spacing_m_;
    double sum = 0.0;
    for (int row = static_cast<int>(std::floor(v)) - 1; row <= std::floor(v) + 2; ++row) {
      for (int column = static_cast<int>(std::floor(u)) - 1; column <= std::floor(u) + 2;
           ++column) {
        const double node = noise_.At(row, column) - Refined(column, row);
        sum += node * CubicSpline(u - column) * CubicSpline(v - row);
      }
    }
    return sum;
  }

 private:
  // B-splines of spacing 2: the coefficient of the wide one at node 2 k of a narrow one.
  static double Share(int distance) {
    constexpr std::array<double, 3> kShares{6.0 / 8.0, 4.0 / 8.0, 1.0 / 8.0};
    const int d = std::abs(distance);
    return d < 3 ? kShares[static_cast<std::size_t>(d)] : 0.0;
  }
  double Thinned(int coarse_column, int coarse_row) const {
    constexpr std::array<double, 7> kLowPass{-1, -1, 5, 10, 5, -1, -1};
    double sum = 0.0;
    for (int i = -3; i <= 3; ++i) {
      for (int k = -3; k <= 3; ++k) {
        sum += kLowPass[static_cast<std::size_t>(i + 3)] *
               kLowPass[static_cast<std::size_t>(k + 3)] / 256.0 *
               static_cast<double>(noise_.At(2 * coarse_row + k, 2 * coarse_column + i));
      }
    }
    return sum;
  }
  double Refined(int column, int row) const {
    double sum = 0.0;
    const int c0 = static_cast<int>(std::floor(0.5 * column));
    const int r0 = static_cast<int>(std::floor(0.5 * row));
    for (int c = c0 - 2; c <= c0 + 2; ++c) {
      for (int r = r0 - 2; r <= r0 + 2; ++r) {
        const double share = Share(column - 2 * c) * Share(row - 2 * r);
        if (share != 0.0) sum += share * Thinned(c, r);
      }
    }
    return sum;
  }

  PixelNoise noise_;
  double spacing_m_;
};

TEST(TextureField, IsTheSumOfItsOctaves) {
  TextureField field(FewOctaves(), kKey, kPurpose);
  ASSERT_EQ(field.octaves(), 4);  // 0.4, 0.2, 0.1, 0.05 m
  EXPECT_DOUBLE_EQ(field.spacing_m(0), 0.4 / 3.0);
  std::array<double, 4> amplitudes{};
  double sum = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    // Variance in proportion to wavelength^(exponent - 2).
    amplitudes[j] = std::pow(std::pow(0.5, static_cast<double>(j)), 0.4);
    sum += amplitudes[j];
  }
  // Places in several pages, on both sides of 0 and near the edges of pages (64 nodes).
  const double page_m = 64.0 * 0.05 / 3.0;
  for (const double u : {0.013, -0.4, page_m - 1e-4, page_m + 1e-4, -7.77, 30.1}) {
    for (const double v : {0.002, -page_m + 0.003, 2.6}) {
      double expected = 0.0;
      for (std::uint32_t j = 0; j < 4; ++j) {
        const double variance = amplitudes[j] / sum / 0.10649478800382683;
        expected +=
            std::sqrt(variance) * PlainOctave(j, field.spacing_m(static_cast<int>(j))).At(u, v);
      }
      EXPECT_NEAR(field.Mean(u, v, Point()).value, expected, 2e-5) << u << ' ' << v;
    }
  }
}

TEST(TextureField, SlopesAreDerivatives) {
  TextureField field(FewOctaves(), kKey, kPurpose);
  constexpr double kStep_m = 2e-4;
  for (const double u : {0.3, -1.7, 4.41}) {
    for (const double v : {0.9, -2.3}) {
      const TextureSample here = field.Mean(u, v, Point());
      const auto at = [&](double du, double dv) {
        return field.Mean(u + du, v + dv, Point()).value;
      };
      EXPECT_NEAR(here.slope_u, (at(kStep_m, 0) - at(-kStep_m, 0)) / (2 * kStep_m), 0.1);
      EXPECT_NEAR(here.slope_v, (at(0, kStep_m) - at(0, -kStep_m)) / (2 * kStep_m), 0.1);
    }
  }
}

TEST(TextureField, DoesNotDependOnWhatWasAskedBefore) {
  TextureField one(FewOctaves(), kKey, kPurpose);
  TextureField other(FewOctaves(), kKey, kPurpose);
  std::vector<double> forwards;
  for (int i = 0; i < 50; ++i) forwards.push_back(one.Mean(0.31 * i, -0.2 * i, Point()).value);
  for (int i = 49; i >= 0; --i) {
    EXPECT_EQ(other.Mean(0.31 * i, -0.2 * i, Point()).value, forwards[static_cast<std::size_t>(i)]);
  }
  TextureField of_other_trial(FewOctaves(), {11, 4}, kPurpose);
  EXPECT_NE(of_other_trial.Mean(0.0, 0.0, Point()).value, forwards.front());
}

TEST(TextureField, TrimmingChangesNothing) {
  TextureField field(FewOctaves(), kKey, kPurpose);
  const double before = field.Mean(0.1, 0.2, Point()).value;
  // More pages than are kept: 70 x 70 of the finest octave.
  vision::ForEachPixel(70, 70, [&](int k, int i) { field.Mean(1.07 * i, 1.07 * k, Point()); });
  field.Trim();
  EXPECT_EQ(field.Mean(0.1, 0.2, Point()).value, before);
}

// What a pixel sees, by many samples without a filter.
double MeanOfSamples(TextureField& field, double u, double v, const Footprint& footprint) {
  constexpr int kSide = 24;
  double sum = 0.0;
  vision::ForEachPixel(kSide, kSide, [&](int k, int i) {
    const Eigen::Vector2d p = Eigen::Vector2d(u, v) +
                              ((i + 0.5) / kSide - 0.5) * footprint.column_m +
                              ((k + 0.5) / kSide - 0.5) * footprint.row_m;
    sum += field.Mean(p.x(), p.y(), Point()).value;
  });
  return sum / (kSide * kSide);
}

// Root mean square of the difference to the mean of many samples, over pixels side by side and
// shifted by parts of a pixel; with the filter, and without.
struct Deviations {
  double filtered = 0.0;
  double point = 0.0;
};
Deviations FilterDeviations(const Footprint& footprint, double exponent) {
  TextureField field({1.0, exponent, 0.4, 0.003125, 0.1}, kKey, kPurpose);
  Deviations sum;
  constexpr int kPixels = 150;
  for (int i = 0; i < kPixels; ++i) {
    const double u = 0.37 * i;
    const double v = 0.11 * i;
    const double truth = MeanOfSamples(field, u, v, footprint);
    const double filtered = field.Mean(u, v, footprint).value - truth;
    const double point = field.Mean(u, v, Point()).value - truth;
    sum.filtered += filtered * filtered / kPixels;
    sum.point += point * point / kPixels;
  }
  return {std::sqrt(sum.filtered), std::sqrt(sum.point)};
}

// The tolerance that README.md states: 0.16 of the texture's standard deviation for square pixels,
// 0.2 for ones eight times as long as wide, of a texture all of whose octaves vary alike.
TEST(TextureField, FilterIsTheMeanOverThePixel) {
  for (const double width_m : {0.004, 0.012, 0.03, 0.05}) {
    const Footprint square{{width_m, 0.0}, {0.0, width_m}};
    const Deviations deviations = FilterDeviations(square, 2.0);
    EXPECT_LT(deviations.filtered, 0.16) << width_m;
    // The control: without a filter.
    EXPECT_GT(deviations.point, width_m > 0.01 ? 0.35 : 0.16) << width_m;
    for (const double ratio : {3.0, 8.0}) {
      const Footprint strip{{0.6 * width_m, 0.8 * width_m},
                            {-0.8 * ratio * width_m, 0.6 * ratio * width_m}};
      EXPECT_LT(FilterDeviations(strip, 2.0).filtered, 0.2) << width_m << " x " << ratio;
    }
  }
}

TEST(TextureField, FarTooLargePixelsSeeTheMean) {
  TextureField field(FewOctaves(), kKey, kPurpose);
  EXPECT_EQ(field.Mean(0.0, 0.0, {{10.0, 0.0}, {0.0, 10.0}}).value, 0.0);
  EXPECT_EQ(field.Mean(0.0, 0.0, {{1e9, 0.0}, {0.0, 1.0}}).value, 0.0);
}

TEST(Footprint, AxesHaveTheMomentsOfTheParallelogram) {
  for (const Footprint& footprint :
       {Footprint{{3.0, 0.0}, {0.0, 2.0}}, Footprint{{0.0, 2.0}, {1.0, 0.0}},
        Footprint{{1.0, 0.5}, {-0.7, 4.0}}, Footprint{{-2.0, 1.0}, {2.0, 0.3}}}) {
    const Footprint::Ellipse axes = footprint.Axes();
    const Eigen::Vector2d across(-axes.long_axis.y(), axes.long_axis.x());
    const Eigen::Matrix2d of_axes =
        axes.length_m * axes.length_m * axes.long_axis * axes.long_axis.transpose() +
        axes.width_m * axes.width_m * across * across.transpose();
    const Eigen::Matrix2d expected = footprint.column_m * footprint.column_m.transpose() +
                                     footprint.row_m * footprint.row_m.transpose();
    EXPECT_LT((of_axes - expected).norm(), 1e-12);
    EXPECT_GE(axes.length_m, axes.width_m);
  }
}

}  // namespace
}  // namespace rockyard::rendering
