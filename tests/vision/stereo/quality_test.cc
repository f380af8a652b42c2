// What the pipeline with its default parameters makes of pairs whose disparities are known exactly.
// Bounds are twice to three times what was measured; with 1e5 pixels a pair, whose errors are alike
// over a window of 49, a mean of 0.1 px of scatter is known to 0.1 / sqrt(2000) = 0.002 px.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "synthetic_pair.h"
#include "vision/stereo/stereo.h"

namespace rockyard::vision {
namespace {

constexpr int kMargin_px = 8;  // of the window, and a little

struct Quality {
  double density = 0.0;  // of the pixels that both eyes see with their windows
  double bad = 0.0;      // more than 1 px off, of those that have a disparity
  double bias_px = 0.0;  // of the others
  double rms_px = 0.0;
};

Quality Judge(const SyntheticPair& pair, const DisparityImage& found) {
  double seen = 0.0, valid = 0.0, bad = 0.0, sum = 0.0, squares = 0.0;
  for (int y = kMargin_px; y < found.height() - kMargin_px; ++y) {
    for (int x = kMargin_px; x < found.width() - kMargin_px; ++x) {
      const double match = x - pair.truth.At(x, y);
      if (match < kMargin_px || match > found.width() - kMargin_px) continue;
      if (pair.hidden.At(x, y) == 0) ++seen;
      if (!IsValid(found.At(x, y))) continue;
      ++valid;
      const double error = DisparityPx(found.At(x, y)) - pair.truth.At(x, y);
      if (std::abs(error) > 1.0) {
        ++bad;
        continue;
      }
      sum += error;
      squares += error * error;
    }
  }
  const double good = std::max(valid - bad, 1.0);
  return {valid / seen, bad / std::max(valid, 1.0), sum / good, std::sqrt(squares / good)};
}

Quality Judge(const Scene& scene, const StereoPipelineParams& params) {
  const SyntheticPair pair = MakePair(scene);
  return Judge(pair, MatchStereo(pair.left, pair.right, params));
}

Scene SceneOf(std::uint32_t number, std::function<double(double, double)> disparity) {
  return {.width = 240, .height = 120, .disparity = std::move(disparity), .number = number};
}

// The generator first: the right image shows at x - d what the left one shows at x.
TEST(SyntheticPairTest, BothEyesSeeTheSameTexture) {
  Scene scene = SceneOf(1, [](double, double y) { return y < 60.0 ? 7.0 : -3.0; });
  scene.noise = 0.0;
  const SyntheticPair pair = MakePair(scene);
  for (int y = 0; y < 120; ++y) {
    const int d = y < 60 ? 7 : -3;
    for (int x = 10; x < 230; ++x) ASSERT_EQ(pair.left.At(x, y), pair.right.At(x - d, y));
  }
}

TEST(SyntheticPairTest, AStepHidesAsManyPixelsAsItsHeight) {
  // A box 9 px nearer than the ground from x = 100 on hides 9 px of the ground on its left.
  const Scene scene =
      SceneOf(2, [](double x, double) { return x >= 100.0 && x < 160.0 ? 14.0 : 5.0; });
  const SyntheticPair pair = MakePair(scene);
  int hidden = 0;
  for (int x = 20; x < 220; ++x) hidden += pair.hidden.At(x, 50);
  EXPECT_EQ(hidden, 9);
  EXPECT_EQ(pair.hidden.At(95, 50), 1);
  EXPECT_EQ(pair.hidden.At(165, 50), 0);
}

TEST(StereoQualityTest, FlatGroundAcrossTheView) {
  const Quality q = Judge(SceneOf(3, [](double, double) { return 10.0; }), Range(0, 32));
  EXPECT_GT(q.density, 0.99);
  EXPECT_LT(q.bad, 1e-3);
  EXPECT_NEAR(q.bias_px, 0.0, 0.01);
  EXPECT_LT(q.rms_px, 0.1);
}

TEST(StereoQualityTest, GroundThatSlantsAlongColumnsOrRows) {
  for (const auto& q :
       {Judge(SceneOf(4, [](double, double y) { return 4.0 + 0.09 * y; }), Range(0, 32)),
        Judge(SceneOf(5, [](double x, double) { return 3.0 + 0.06 * x; }), Range(0, 32)),
        Judge(SceneOf(6, [](double x, double y) { return -14.0 + 0.05 * x + 0.06 * y; }),
              Range(-20, 32))}) {
    EXPECT_GT(q.density, 0.98);
    EXPECT_LT(q.bad, 2e-3);
    EXPECT_NEAR(q.bias_px, 0.0, 0.02);
    EXPECT_LT(q.rms_px, 0.15);
  }
}

// Other gain, offset and noise between the eyes: the difference of Gaussians takes the offset out.
TEST(StereoQualityTest, EyesOfDifferentGainAndOffset) {
  Scene scene = SceneOf(7, [](double, double y) { return 6.0 + 0.05 * y; });
  const Quality alike = Judge(scene, Range(0, 32));
  scene.right_gain = 0.85;
  scene.right_offset = 40.0;
  const Quality other = Judge(scene, Range(0, 32));
  EXPECT_GT(other.density, 0.98);
  EXPECT_LT(other.bad, 2e-3);
  EXPECT_LT(other.rms_px, 1.3 * alike.rms_px);
}

// The least variance that the noise n of both images can leave of a disparity (Cramer-Rao) is
//   sigma^2 = 2 n^2 / (sum over the window of the squared gradient along the row),
// and the gradient's mean square is known from the waves, (contrast 2 pi)^2 / 2 times the mean of
// 1 / length^2, (1 / short^2 - 1 / long^2) / (2 log(long / short)) of lengths uniform in their
// logarithm. The rest of the error is the texture's: what enters and leaves a window as it is
// moved. So what more noise adds is compared: with lines, which hardly draw to whole pixels, a
// quarter more.
TEST(StereoQualityTest, NoiseOfTheImagesIsNoiseOfDisparities) {
  Scene scene = SceneOf(8, [](double, double) { return 10.0; });
  const double wave2 =
      (1.0 / std::pow(scene.shortest_wave_px, 2) - 1.0 / std::pow(scene.longest_wave_px, 2)) /
      (2.0 * std::log(scene.longest_wave_px / scene.shortest_wave_px));
  const double gradient2 = 0.5 * std::pow(2.0 * std::numbers::pi * scene.contrast, 2) * wave2;
  StereoPipelineParams params = Range(0, 24);
  params.dog = {.kind = DogKind::kLaplacian, .gain = 1.0, .limit = 100};
  const auto variance = [&](double noise) {
    scene.noise = noise;
    return std::pow(Judge(scene, params).rms_px, 2);
  };
  const double bound = 2.0 * (25.0 - 9.0) / (49.0 * gradient2);
  EXPECT_NEAR(std::sqrt((variance(5.0) - variance(3.0)) / bound), 1.25, 0.25);
}

TEST(StereoQualityTest, AStepLosesWhatIsHidden) {
  const Scene scene = SceneOf(
      9, [](double x, double y) { return x >= 90.0 && x < 150.0 && y > 40.0 ? 18.3 : 8.2; });
  const SyntheticPair pair = MakePair(scene);
  StereoPipelineParams params = Range(0, 32);
  const DisparityImage found = MatchStereo(pair.left, pair.right, params);
  const auto wrong_where_hidden = [&](const DisparityImage& image) {
    int count = 0;
    for (int y = 50; y < 110; ++y) {
      for (int x = 0; x < 240; ++x) {
        if (pair.hidden.At(x, y) == 0 || !IsValid(image.At(x, y)) || x < 40) continue;
        count += std::abs(DisparityPx(image.At(x, y)) - pair.truth.At(x, y)) > 1.0 ? 1 : 0;
      }
    }
    return count;
  };
  const Quality q = Judge(pair, found);
  EXPECT_GT(q.density, 0.93);
  EXPECT_LT(q.bad, 0.04);
  const int checked = wrong_where_hidden(found);
  // Without the line-of-sight check, hidden pixels find something.
  params.filters.line_of_sight_px = 1000.0;
  EXPECT_GT(wrong_where_hidden(MatchStereo(pair.left, pair.right, params)), 2 * checked);
}

// Bias against the fraction t of the true disparity: a parabola through sums of absolute
// differences says t / (2 (1 - t)) up to a half (SubPixel); two lines say t.
TEST(StereoQualityTest, PixelLocking) {
  StereoPipelineParams params = Range(0, 24);
  std::vector<double> parabola, lines;
  for (int eighth = 0; eighth < 8; ++eighth) {
    Scene scene = SceneOf(10 + eighth, [eighth](double, double) { return 8.0 + eighth / 8.0; });
    scene.width = 200;
    scene.height = 70;
    scene.noise = 0.5;
    const SyntheticPair pair = MakePair(scene);
    params.filters.interpolation = Interpolation::kQuadratic;
    parabola.push_back(Judge(pair, MatchStereo(pair.left, pair.right, params)).bias_px);
    params.filters.interpolation = Interpolation::kEquiangular;
    lines.push_back(Judge(pair, MatchStereo(pair.left, pair.right, params)).bias_px);
  }
  for (const int eighth : {0, 1, 2, 3, 4}) {
    const double t = eighth / 8.0;
    const double locked = t / (2.0 * (1.0 - t)) - t;
    EXPECT_NEAR(parabola[eighth], locked, 0.025) << eighth;
    EXPECT_NEAR(parabola[(8 - eighth) % 8], -locked, 0.025) << eighth;
    EXPECT_NEAR(lines[eighth], 0.0, 0.025) << eighth;
    EXPECT_NEAR(lines[(8 - eighth) % 8], 0.0, 0.025) << eighth;
  }
}

TEST(StereoQualityTest, AWindowOfMorePixelsIsLessNoisy) {
  Scene scene = SceneOf(20, [](double, double) { return 10.0; });
  scene.noise = 3.0;
  StereoPipelineParams params = Range(0, 24);
  params.correlator.window_side_px = 5;
  const Quality small = Judge(scene, params);
  params.correlator.window_side_px = 13;
  const Quality large = Judge(scene, params);
  // Noise falls with the square root of the pixels, 13 to 5, once locking is zero as at 10.0 px.
  EXPECT_NEAR(small.rms_px / large.rms_px, 13.0 / 5.0, 0.7);
}

}  // namespace
}  // namespace rockyard::vision
