#include "experiments/stereo_sensing/pixel_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "experiments/stereo_sensing/stereo_sensing.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

using sensing::DepthImage;

// A view of one row along x, whose pixels all look along the axis but for their column: f = 10 px,
// B = 0.1 m, so that d = 1 / Z.
sensing::StereoView OneRow(int columns) {
  sensing::StereoView view;
  view.columns = columns;
  view.rows = 1;
  view.focal_px = 10.0;
  view.baseline_m = 0.1;
  view.along_row = {0.0, -0.1, 0.0};
  return view;
}

// All of it seen by both, lit, far from margins and jumps.
sensing::StereoTruth TruthOf(const std::vector<double>& disparities_px) {
  const auto columns = static_cast<Eigen::Index>(disparities_px.size());
  sensing::StereoTruth truth;
  truth.left_px = Eigen::Map<const DepthImage>(disparities_px.data(), 1, columns);
  truth.both_px = truth.left_px;
  truth.jumps = sensing::PixelNumbers::Constant(1, columns, 1000);
  truth.behind = sensing::PixelFlags::Constant(1, columns, false);
  truth.rocks = sensing::PixelNumbers::Constant(1, columns, -1);
  truth.shaded = sensing::PixelFlags::Constant(1, columns, false);
  truth.margin = sensing::PixelFlags::Constant(1, columns, false);
  return truth;
}

DepthImage Matched(const std::vector<double>& disparities_px) {
  return Eigen::Map<const DepthImage>(disparities_px.data(), 1,
                                      static_cast<Eigen::Index>(disparities_px.size()));
}

constexpr PixelLimits kEverything{0.0, 100.0, 0.5, 16.0, 3};

TEST(PixelErrorsTest, PerfectMatchesHaveNoErrors) {
  const std::vector<double> row(20, 4.0);
  StereoSums sums;
  AddPixels(TruthOf(row), Matched(row), OneRow(20), kEverything, sums);
  EXPECT_EQ(sums.all.pixels, 20.0);
  EXPECT_EQ(sums.all.good, 20.0);
  EXPECT_EQ(sums.all.error2_px2, 0.0);
  EXPECT_EQ(sums.range_error2_m2, 0.0);
  EXPECT_EQ(sums.kinds[0].good, 20.0);
  EXPECT_EQ(sums.pairs[0], 19.0);
  EXPECT_EQ(sums.pairs[6], 13.0);
  EXPECT_EQ(sums.products_px2[0], 0.0);
}

TEST(PixelErrorsTest, AddsErrorsAndTheirSquares) {
  // Errors +0.5, -0.25, none, wrong by 1, not matched.
  StereoSums sums;
  AddPixels(TruthOf({4, 4, 4, 4, 4}), Matched({4.5, 3.75, 4, 5, 0}), OneRow(5), kEverything, sums);
  EXPECT_EQ(sums.all.pixels, 5.0);
  EXPECT_EQ(sums.all.good, 3.0);
  EXPECT_EQ(sums.all.wrong, 1.0);
  EXPECT_DOUBLE_EQ(sums.all.bias_px, 0.25);
  EXPECT_DOUBLE_EQ(sums.all.error2_px2, 0.25 + 0.0625);
  // Neighbours: (0.5)(-0.25) and (-0.25)(0); two apart (0.5)(0).
  EXPECT_EQ(sums.pairs[0], 2.0);
  EXPECT_DOUBLE_EQ(sums.products_px2[0], -0.125);
  EXPECT_EQ(sums.pairs[1], 1.0);
  EXPECT_EQ(sums.pairs[2], 0.0);
}

TEST(PixelErrorsTest, RangesFollowFromDisparitiesAlongTheRay) {
  // Pixel 3 looks along (1, -0.3, 0): |e| = sqrt(1.09). Z = 1 / d = 0.25 m, and 0.2 m as matched.
  sensing::StereoTruth truth = TruthOf({0, 0, 0, 4});
  StereoSums sums;
  AddPixels(truth, Matched({0, 0, 0, 4.8}), OneRow(4), kEverything, sums);
  const double ray = std::sqrt(1.09);
  const double error_m = ray * (1.0 / 4.8 - 0.25);
  EXPECT_DOUBLE_EQ(sums.range_m, 0.25 * ray);
  EXPECT_NEAR(sums.range_bias_m, error_m, 1e-15);
  EXPECT_NEAR(sums.range_error2_m2, error_m * error_m, 1e-15);
  // dr/dd = -|e| / d^2, here by a difference quotient; on the axis r^2 / (f B).
  const double h = 1e-5;
  const double slope = ray * (1.0 / (4.0 - h) - 1.0 / (4.0 + h)) / (2.0 * h);
  EXPECT_NEAR(std::sqrt(sums.range_step2_m2), slope, 1e-9);
  EXPECT_DOUBLE_EQ(std::sqrt(sums.axis_step2_m2), 0.25 * 0.25 * 1.09);
}

TEST(PixelErrorsTest, EveryPixelIsOfOneKind) {
  sensing::StereoTruth truth = TruthOf(std::vector<double>(12, 4.0));
  truth.jumps.row(0) << 5, 4, 3, 2, 1, 1, 2, 3, 4, 5, 6, 7;
  truth.behind.leftCols(5).setConstant(true);
  truth.shaded.leftCols(4).setConstant(true);
  truth.margin(0, 11) = true;
  truth.both_px(0, 10) = 0.0;
  StereoSums sums;
  AddPixels(truth, Matched(std::vector<double>(12, 4.25)), OneRow(12), kEverything, sums);
  EXPECT_EQ(sums.all.pixels, 10.0);
  EXPECT_EQ(sums.kinds[0].pixels, 2.0);  // 4 and 5 columns from the jump, lit
  EXPECT_EQ(sums.kinds[1].pixels, 3.0);  // up to 3, to the right of it
  EXPECT_EQ(sums.kinds[2].pixels, 3.0);  // and to the left, behind
  EXPECT_EQ(sums.kinds[3].pixels, 2.0);  // 5 and 4, in shadow
  EXPECT_EQ(sums.fronts[0].pixels, 1.0);
  EXPECT_EQ(sums.behinds[0].pixels, 1.0);
  EXPECT_EQ(sums.behinds[4].pixels, 1.0);
  EXPECT_EQ(sums.fronts[5].pixels, 0.0);  // what the left eye alone sees
  EXPECT_EQ(sums.margin.pixels, 1.0);
  EXPECT_EQ(sums.margin.good, 1.0);
  EXPECT_EQ(sums.hidden_pixels, 1.0);
  EXPECT_EQ(sums.hidden_matched, 1.0);
  // Pairs are of plain pixels only.
  EXPECT_EQ(sums.pairs[0], 1.0);
  EXPECT_DOUBLE_EQ(sums.products_px2[0], 0.0625);
}

TEST(PixelErrorsTest, ACellEndsBeforeItsFarthestDistance) {
  // Column 0 looks along the axis: ranges of 0.5, and in the next call 0.25 m.
  PixelLimits limits = kEverything;
  limits.nearest_m = 0.25;
  limits.farthest_m = 0.5;
  StereoSums sums;
  AddPixels(TruthOf({2}), Matched({2}), OneRow(1), limits, sums);
  EXPECT_EQ(sums.all.pixels, 0.0);
  AddPixels(TruthOf({4}), Matched({4}), OneRow(1), limits, sums);
  EXPECT_EQ(sums.all.pixels, 1.0);
  AddPixels(TruthOf({4.001}), Matched({4}), OneRow(1), limits, sums);
  EXPECT_EQ(sums.all.pixels, 1.0);
}

TEST(PixelErrorsTest, WhatIsNotSearchedDoesNotCount) {
  StereoSums sums;
  AddPixels(TruthOf({0.4, 0.5, 16, 16.1, 0}), Matched({0.5, 0.5, 16, 16, 4}), OneRow(5),
            kEverything, sums);
  EXPECT_EQ(sums.all.pixels, 2.0);
  EXPECT_EQ(sums.all.good, 2.0);
}

TEST(StereoColumnsTest, HoldEverySumAndEveryBase) {
  std::size_t known = 0;
  ForEachSum(StereoSums{}, [&](const std::string& name, double) {
    EXPECT_NE(truth::FindColumn(StereoColumns(), name), nullptr) << name;
    ++known;
  });
  std::size_t summed = 0;
  for (const truth::ValueInfo& column : StereoColumns()) {
    if (column.role == truth::ColumnRole::kFactor) continue;
    ++summed;
    const bool refers = !truth::IsBase(column.role);
    EXPECT_EQ(column.of.empty(), !refers) << column.name;
    if (refers) {
      EXPECT_NE(truth::FindColumn(StereoColumns(), column.of), nullptr) << column.name;
    }
  }
  EXPECT_EQ(summed, known);
}

}  // namespace
}  // namespace rockyard::experiments
