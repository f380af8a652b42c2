// What stereo makes of rendered pairs, easy and hard ones, and which filter drops what: documented
// in src/vision/README.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rendering/picture/picture.h"
#include "rendering/picture/picture_kit.h"
#include "rendering/picture/picture_readout.h"
#include "terrain/placed_rocks.h"
#include "vision/stereo/stereo.h"

namespace rockyard::rendering {
namespace {

using vision::Drop;

constexpr int kColumns = 224;
constexpr int kRows = 192;
constexpr int kReach = 3;  // of the window

struct Pair {
  vision::GrayImage left, right;
  StereoTruth truth;
};

// Two eyes 0.2 m apart, 1 m above level ground with rocks, 35 deg down; `exposure` times as long as
// exposure control would have it.
Pair RenderPair(const LookParams& look, double exposure, const std::vector<terrain::Rock>& rocks) {
  const terrain::Terrain terrain = terrain::FlatWith(rocks);
  const SunParams sun;
  const PictureCameraParams camera_params;
  const double view_rad = math::DegToRad(45.0);
  const double pitch_rad = math::DegToRad(35.0);
  const auto camera = PinholeAt({0.0, 0.1, 1.0}, pitch_rad, kColumns, kRows, view_rad);
  const auto other = PinholeAt({0.0, -0.1, 1.0}, pitch_rad, kColumns, kRows, view_rad);
  const PictureKit left(terrain, sun, look, camera);
  const PictureKit right(terrain, sun, look, other);
  const Picture picture = left.Render();
  const auto bits = static_cast<int>(camera_params.imager.detector().adc_bits);
  const auto read = [&](const PictureKit& kit, const Picture& seen, int eye) {
    const PictureReadout readout(camera_params, kit.rays, eye, kit.key);
    const auto rates = readout.Rates(seen);
    return ToGray(
        readout.Read(rates, exposure * readout.Exposure(rates), static_cast<ImageNumber>(eye))
            .counts,
        bits);
  };
  return {read(left, picture, 0), read(right, right.Render(), 1),
          SeenFromOtherEye(left.scene, picture, left.rays, math::Transform::Identity(), other)};
}

std::vector<terrain::Rock> SomeRocks() {
  return {terrain::EllipsoidRock(1.4, 0.25, 0.0, 0.15, 0.15, 0.2),
          terrain::EllipsoidRock(1.9, -0.3, 0.0, 0.2, 0.15, 0.25),
          terrain::EllipsoidRock(2.6, 0.4, 0.0, 0.3, 0.25, 0.3)};
}

vision::StereoPipelineParams Params() {
  return {.correlator = {.min_disparity_px = -2, .disparities = 72}};
}

// The same with the filters of peaks and regions open.
vision::StereoPipelineParams Unfiltered() {
  vision::StereoPipelineParams params = Params();
  params.filters.min_curvature = 0.0;
  params.filters.min_curvature_ratio = 0.0;
  params.filters.blob_min_px = 0;
  return params;
}

struct Outcome {
  double density = 0.0;  // of the pixels whose windows both eyes see
  double bad = 0.0;      // more than 1 px off or of what the other eye does not see, of those found
  vision::DropCounts drops{};
};

Outcome Judge(const Pair& pair, const vision::StereoPipelineParams& params) {
  const vision::DisparityImage found = vision::MatchStereo(pair.left, pair.right, params);
  double seen = 0.0, valid = 0.0, bad = 0.0;
  for (int row = kReach; row < kRows - kReach; ++row) {
    for (int column = kReach; column < kColumns - kReach; ++column) {
      const double other = pair.truth.other_column.At(column, row);
      const bool visible = pair.truth.other.At(column, row) == OtherEye::kVisible &&
                           other >= kReach && other < kColumns - kReach;
      if (visible) ++seen;
      if (!vision::IsValid(found.At(column, row))) continue;
      ++valid;
      const double error = vision::DisparityPx(found.At(column, row)) - (column - other);
      if (!visible || std::abs(error) > 1.0) ++bad;
    }
  }
  return {valid / seen, bad / std::max(valid, 1.0), vision::CountDrops(found)};
}

double Share(const Outcome& outcome, Drop drop) {
  return static_cast<double>(outcome.drops[static_cast<std::size_t>(drop)]) / (kColumns * kRows);
}

LookParams Soil(double graininess) { return {.soil_graininess = graininess}; }

TEST(StereoOfPictures, SoilAndRocksAreMatched) {
  for (const double graininess : {0.0, 0.5, 1.0}) {
    SCOPED_TRACE(graininess);
    const Outcome o = Judge(RenderPair(Soil(graininess), 1.0, SomeRocks()), Params());
    EXPECT_GT(o.density, 0.95);
    EXPECT_LT(o.bad, 0.04);
    // A quarter of the image lies beside what the other eye sees: its matches do not look back.
    EXPECT_GT(Share(o, Drop::kLineOfSight), 0.08);
    EXPECT_LT(Share(o, Drop::kPeak) + Share(o, Drop::kContrast) + Share(o, Drop::kBlob), 0.02);
  }
}

// Why gradients along the row are compared: a Laplacian carries the nearer surface's brightness
// over the edge.
TEST(StereoOfPictures, RowGradientsAreWrongLessOftenBesideRocks) {
  vision::StereoPipelineParams laplacian = Params();
  laplacian.dog = {.kind = vision::DogKind::kLaplacian, .gain = 1.0, .limit = 36};
  for (const double graininess : {0.0, 0.5}) {
    const Pair pair = RenderPair(Soil(graininess), 1.0, SomeRocks());
    const Outcome gradient = Judge(pair, Params());
    const Outcome other = Judge(pair, laplacian);
    EXPECT_LT(gradient.bad, 0.6 * other.bad) << graininess;
    EXPECT_GT(gradient.density, other.density - 0.02) << graininess;
  }
}

// Sand without any texture shows the noise of the detectors alone: the line of sight drops most,
// the filter of regions the rest. Without it, what is left is wrong.
TEST(StereoOfPictures, SandWithoutTextureIsDropped) {
  const Pair pair = RenderPair(PlainLook(), 1.0, {});
  const Outcome filtered = Judge(pair, Params());
  EXPECT_LT(filtered.density, 0.002);
  EXPECT_GT(Share(filtered, Drop::kLineOfSight), 0.5);
  EXPECT_GT(Share(filtered, Drop::kBlob), 0.2);
  const Outcome open = Judge(pair, Unfiltered());
  EXPECT_GT(open.density, 0.2);
  EXPECT_GT(open.bad, 0.9);
}

// Overexposed, parts are white in both eyes: their scores are 0 at every disparity, the first one
// wins and has no neighbour. Edges of white parts that move with the exposure are matched wrong.
TEST(StereoOfPictures, WhatTheSunSaturatesIsDropped) {
  const Pair pair = RenderPair({}, 3.0, SomeRocks());
  const auto& grey = pair.left.values();
  const auto white = static_cast<double>(std::count(grey.begin(), grey.end(), 255)) /
                     static_cast<double>(grey.size());
  ASSERT_GT(white, 0.8);
  const Outcome o = Judge(pair, Params());
  EXPECT_GT(Share(o, Drop::kRangeEnd), 0.6 * white);
  EXPECT_LT(o.density, 1.4 * (1.0 - white) + 0.1);
  EXPECT_LT(o.bad, 0.25);
  const Outcome half = Judge(RenderPair({}, 1.6, SomeRocks()), Params());
  EXPECT_GT(half.density, 0.5);
  EXPECT_LT(half.bad, 0.06);
}

// Darkness: the less light, the less is left. Where the read-out gives a few grey levels, a part of
// what is left is wrong, as equal scores abound; in the dark nothing is.
TEST(StereoOfPictures, DarknessLeavesLittle) {
  const Pair dusk = RenderPair({}, 0.1, SomeRocks());
  const Outcome filtered = Judge(dusk, Params());
  EXPECT_GT(filtered.density, 0.5);
  EXPECT_LT(filtered.bad, 0.1);
  EXPECT_GT(Share(filtered, Drop::kPeak), 2.0 * Share(Judge(dusk, Unfiltered()), Drop::kPeak));
  EXPECT_GT(Judge(dusk, Unfiltered()).bad, 1.5 * filtered.bad);
  EXPECT_LT(Judge(RenderPair({}, 0.03, SomeRocks()), Params()).density, 0.12);
  EXPECT_LT(Judge(RenderPair({}, 0.01, SomeRocks()), Params()).density, 0.05);
  const Outcome night = Judge(RenderPair({}, 0.001, SomeRocks()), Params());
  EXPECT_EQ(Share(night, Drop::kNone), 0.0);
  EXPECT_GT(Share(night, Drop::kRangeEnd), 0.8);
}

// The same image twice is infinitely far, everywhere, and no filter doubts it.
TEST(StereoOfPictures, IdenticalImagesAreInfinitelyFar) {
  const Pair pair = RenderPair({}, 1.0, SomeRocks());
  const vision::DisparityImage found = vision::MatchStereo(pair.left, pair.left, Params());
  int far = 0;
  for (const std::int16_t value : found.values()) {
    if (!vision::IsValid(value)) continue;
    ++far;
    ASSERT_NEAR(vision::DisparityPx(value), 0.0, 0.5);
  }
  EXPECT_GT(far, 9 * kColumns * kRows / 10);
}

}  // namespace
}  // namespace rockyard::rendering
