#include "sensing/stereo_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/random.h"
#include "sensing/stereo_depth.h"
#include "stereo_scene.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;

// The loops over columns against one column after the other, to the last bit.

constexpr std::size_t kColumns = 61;

// A row of inverse depths as of ground and rocks, some of them 0.
std::vector<double> RandomRow(core::RandomStream& stream) {
  std::vector<double> row(kColumns);
  for (double& pixel : row) {
    pixel = core::SampleBernoulli(stream, 0.2) ? 0.0 : core::SampleUniform(stream, 0.25, 2.5);
  }
  return row;
}

// Calls use(cut, row, stream) for rows of the image that a rock before the cameras is in.
template <typename Use>
void ForCuts(Use use) {
  core::RandomStream stream({5, 0}, core::Purpose::kTest, 31);
  const StereoView view = MakeStereoView(StereoParams(), messages::LookDirection::kAhead);
  for (int rock = 0; rock < 40; ++rock) {
    const auto shape =
        EllipsoidRock(core::SampleUniform(stream, 0.6, 2.5), core::SampleUniform(stream, -0.8, 0.8),
                      0.05, 0.3, 0.2, 0.25, core::SampleUniform(stream, 0.0, 3.0));
    const RockOutline outline(terrain::RockShape(shape), shape.center_W, view, view.eye);
    for (int row = outline.first_row(); row <= outline.last_row(); row += 3) {
      use(outline.Row(row), RandomRow(stream), stream);
    }
  }
}

TEST(StereoLanesTest, RocksRaisePixelsAsOneByOne) {
  int raised = 0;
  ForCuts([&](const RowCut& cut, std::vector<double> row, core::RandomStream& stream) {
    if (!cut.exact || cut.span.first > cut.span.last) return;
    const auto first = static_cast<std::size_t>(core::SampleUniform(stream, 0.0, 30.0));
    const auto count = static_cast<std::size_t>(core::SampleUniform(stream, 0.0, 31.0));
    std::vector<double> expected = row;
    for (std::size_t column = first; column < first + count; ++column) {
      const auto c = static_cast<double>(column);
      const double root = std::sqrt(std::max(cut.Discriminant(c), 0.0));
      const double rock = (cut.Approach(c) + root) * cut.inverse_outside_1;
      raised += rock > expected[column] ? 1 : 0;
      expected[column] = std::max(expected[column], rock);
    }
    RaiseToRock(cut, first, count, row.data());
    ASSERT_EQ(row, expected);
  });
  EXPECT_GT(raised, 500);
}

TEST(StereoLanesTest, WhatRocksCouldHideIsFoundAsOneByOne) {
  std::size_t all = 0;
  ForCuts([&](const RowCut& cut, const std::vector<double>& row, core::RandomStream& stream) {
    const auto first = static_cast<std::size_t>(core::SampleUniform(stream, 0.0, 30.0));
    const auto count = static_cast<std::size_t>(core::SampleUniform(stream, 0.0, 31.0));
    const double scale_px_m = core::SampleUniform(stream, 0.0, 8.0);
    const double slack_m = core::SampleUniform(stream, 0.0, 0.3);
    std::vector<int> expected;
    for (std::size_t column = first; column < first + count; ++column) {
      const double pixel = row[column];
      const double rock = cut.InverseDepth(static_cast<double>(column) - scale_px_m * pixel);
      if (pixel > 0.0 && rock > 0.0 && rock >= pixel + pixel * pixel * slack_m) {
        expected.push_back(static_cast<int>(column));
      }
    }
    std::vector<int> columns(count + 8);
    columns.resize(
        FindBehindRock(cut, scale_px_m, slack_m, first, count, row.data(), columns.data()));
    ASSERT_EQ(columns, expected);
    all += columns.size();
  });
  EXPECT_GT(all, 200U);
}

TEST(StereoLanesTest, PointsArePlacedAsOneByOne) {
  core::RandomStream stream({5, 0}, core::Purpose::kTest, 32);
  const StereoView view = MakeStereoView(StereoParams(), messages::LookDirection::kAhead);
  for (std::size_t count = 0; count <= kColumns; ++count) {
    const std::vector<double> row = RandomRow(stream);
    for (const Eigen::Index i : {0, 1, 2}) {
      std::vector<double> found(count + 8);
      PlacePoints({view.eye[i], view.first[i], view.along_row[i], 17 * view.along_column[i]},
                  row.data(), count, found.data());
      for (std::size_t column = 0; column < count; ++column) {
        if (row[column] == 0.0) continue;
        const Vector3 point = view.eye + view.Ray(static_cast<double>(column), 17) / row[column];
        ASSERT_EQ(found[column], point[i]);
      }
    }
  }
}

}  // namespace
}  // namespace rockyard::sensing
