// Which pairs of cameras need no rectification.
#include "vision/cameras/aligned_pair.h"

#include <gtest/gtest.h>

#include <functional>

namespace rockyard::vision {
namespace {

constexpr ImageSize kSize{64, 48};

// Looks along x, y to the left; pixels 1.25 times as wide as they are high.
Cahv LinearAt(double y_m) {
  const math::Vector3 axis(1.0, 0.0, 0.0);
  return {{0.1, y_m, 0.5},
          axis,
          math::Vector3(0.0, -40.0, 0.0) + 31.5 * axis,
          math::Vector3(0.0, 0.0, -50.0) + 23.5 * axis};
}

TEST(AlignedPairTest, AlignedLinearCamerasStayAsTheyAre) {
  const auto pair = AlignedPair({LinearAt(0.06), kSize}, {LinearAt(-0.06), kSize});
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->left, LinearAt(0.06));
  EXPECT_EQ(pair->right, LinearAt(-0.06));
  EXPECT_EQ(pair->size, kSize);
  EXPECT_DOUBLE_EQ(pair->focal_px, 40.0);
  EXPECT_DOUBLE_EQ(pair->baseline_m, 0.12);
  // A point 2 m away has the disparity f b / Z = 40 * 0.12 / 2, in the same row.
  const math::Vector3 p(2.1, 0.3, 0.2);
  const Pixel left = *Project(pair->left, p);
  const Pixel right = *Project(pair->right, p);
  EXPECT_NEAR(left.x() - right.x(), pair->focal_px * pair->baseline_m / 2.0, 1e-12);
  EXPECT_NEAR(left.y(), right.y(), 1e-12);
}

TEST(AlignedPairTest, WhateverBreaksTheRowsIsNotAligned) {
  const CameraModel left{LinearAt(0.06), kSize};
  const std::function<void(Cahv&)> faults[] = {
      [](Cahv& c) { c.A = math::Vector3(1.0, 1e-6, 0.0).normalized(); },
      [](Cahv& c) { c.H.y() -= 1e-6; },
      [](Cahv& c) { c.V.x() += 1e-6; },
      [](Cahv& c) { c.C.z() += 1e-8; },  // baseline up the columns
      [](Cahv& c) { c.C.x() += 1e-8; },  // along the axis
      [](Cahv& c) { c.C.y() = 0.06; },   // no baseline
      [](Cahv& c) { c.C.y() = 0.18; },   // eyes swapped
  };
  for (const auto& fault : faults) {
    Cahv right = LinearAt(-0.06);
    fault(right);
    EXPECT_FALSE(AlignedPair(left, {right, kSize}));
  }
  EXPECT_FALSE(AlignedPair(left, {LinearAt(-0.06), {64, 50}}));
  EXPECT_FALSE(AlignedPair(left, {BrownPinhole{}, kSize}));
  EXPECT_FALSE(AlignedPair({BrownPinhole{}, kSize}, {LinearAt(-0.06), kSize}));
}

}  // namespace
}  // namespace rockyard::vision
