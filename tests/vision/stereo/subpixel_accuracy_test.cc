// Errors of sub-pixel disparities beside what the noise of the images, their gradients, slant of
// the ground and interpolation predict, on pairs whose disparities are known exactly.
//
// Predictions are of first order and never look at what was matched: they must hold within 0.8 to
// 1.25. Some 230 windows that share no pixel and 8 realizations let a ratio of two standard
// deviations scatter by 2 %, so that a bound is crossed by chance in fewer than 1 of 10^4 pairs
// (alpha) where the ratio is 1.16 or less; seeds are fixed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "core/random.h"
#include "synthetic_pair.h"
#include "vision/stereo/dog.h"
#include "vision/stereo/stereo.h"

namespace rockyard::vision {
namespace {

constexpr int kReach = 3;         // of the window of 7 x 7
constexpr int kMargin_px = 24;    // from the image's edges, beyond the range
constexpr int kRealizations = 8;  // of the noise

StereoPipelineParams Params(Interpolation interpolation, const DogParams& dog = {}) {
  return {.dog = dog,
          .correlator = {.disparities = 20},
          .filters = {.interpolation = interpolation, .blob_min_px = 0}};
}

// Waves of 4 px and more: what a lens with a blur of half a pixel lets through. No noise.
Scene SceneOf(double contrast, std::uint32_t number, std::function<double(double, double)> d) {
  return {.width = 200,
          .height = 90,
          .disparity = std::move(d),
          .contrast = contrast,
          .shortest_wave_px = 4.0,
          .noise = 0.0,
          .number = number};
}

GrayImage WithNoise(const GrayImage& image, double noise, std::uint32_t number) {
  core::RandomStream stream({77, 0}, core::Purpose::kTest, number);
  GrayImage out = image;
  for (std::uint8_t& value : out.values()) {
    const double noisy = core::SampleNormal(stream, value, noise);
    value = static_cast<std::uint8_t>(std::lround(std::clamp(noisy, 0.0, 255.0)));
  }
  return out;
}

template <typename Work>
void ForEachInside(const SyntheticPair& pair, const Work& work) {
  for (int y = 8; y < pair.left.height() - 8; y += 2) {
    for (int x = kMargin_px; x < pair.left.width() - kMargin_px; x += 2) work(x, y);
  }
}

// How the noise of one image enters a sum over the window: a weight for each of its pixels.
class NoiseWeights {
 public:
  // The row gradient of filtered pixel (x, y), relative to the window's middle, `times`.
  void AddGradient(int x, int y, double times) {
    for (int k = -1; k <= 1; ++k) {
      At(x + 1, y + k) += times * (k == 0 ? 0.5 : 0.25);
      At(x - 1, y + k) -= times * (k == 0 ? 0.5 : 0.25);
    }
  }
  NoiseWeights& Add(const NoiseWeights& other, double times) {
    for (std::size_t i = 0; i < weights_.size(); ++i) weights_[i] += times * other.weights_[i];
    return *this;
  }
  double Squares() const {
    double sum = 0.0;
    for (const double weight : weights_) sum += weight * weight;
    return sum;
  }

 private:
  static constexpr int kSide = 15;
  double& At(int x, int y) {
    return weights_[static_cast<std::size_t>((y + kSide / 2) * kSide + x + kSide / 2)];
  }
  std::array<double, static_cast<std::size_t>(kSide* kSide)> weights_{};
};

// A score at one disparity: what is expected of it, and how noise enters.
struct NoisyScore {
  double expected = 0.0;
  NoiseWeights left, right;
};

// |D + n| of a difference D with noise n of standard deviation s has the mean of a folded normal
// distribution (Leone, Nelson and Nottingham 1961), s sqrt(2 / pi) exp(-D^2 / 2 s^2) + D erf(D / s
// sqrt(2)), whose derivative by D is erf(D / s sqrt(2)): a sign, softened.
NoisyScore ScoreWithNoise(const GrayImage& left, const GrayImage& right, const DogParams& dog,
                          double noise, int x, int y, int d, int shift) {
  NoisyScore score;
  const auto free = [&](int value) { return value > 0 && value < 2 * dog.limit; };
  const double filtered = dog.gain * noise * std::sqrt(2.0 * 6.0 / 16.0);
  for (int k = -kReach; k <= kReach; ++k) {
    for (int i = -kReach; i <= kReach; ++i) {
      const int l = left.At(x + i, y + k);
      const int r = right.At(x + i - d - shift, y + k);
      const double difference = l - r;
      const double s = filtered * std::sqrt((free(l) ? 1.0 : 0.0) + (free(r) ? 1.0 : 0.0));
      if (s == 0.0) {
        score.expected += std::abs(difference);
        continue;
      }
      const double sign = std::erf(difference / (s * std::numbers::sqrt2));
      score.expected += difference * sign + s * std::sqrt(2.0 / std::numbers::pi) *
                                                std::exp(-0.5 * difference * difference / (s * s));
      if (free(l)) score.left.AddGradient(i, k, dog.gain * sign);
      if (free(r)) score.right.AddGradient(i - shift, k, -dog.gain * sign);
    }
  }
  return score;
}

// Variance of delta of SubPixel by the noise, to first order: delta = (S- - S+) / (2 m) moves by
// (dS- - dS+ - 2 delta dm) / (2 m).
double PredictedVariance(const std::array<NoisyScore, 3>& s, Interpolation interpolation,
                         double noise) {
  const bool lines = interpolation == Interpolation::kEquiangular;
  const bool below = s[0].expected > s[2].expected;
  const std::array<double, 3> m_by{lines ? (below ? 1.0 : 0.0) : 1.0, lines ? -1.0 : -2.0,
                                   lines ? (below ? 0.0 : 1.0) : 1.0};
  double m = 0.0;
  for (std::size_t i = 0; i < 3; ++i) m += m_by[i] * s[i].expected;
  const double delta = (s[0].expected - s[2].expected) / (2.0 * m);
  NoiseWeights left, right;
  for (std::size_t i = 0; i < 3; ++i) {
    const double by = ((i == 0 ? 1.0 : i == 2 ? -1.0 : 0.0) - 2.0 * delta * m_by[i]) / (2.0 * m);
    left.Add(s[i].left, by);
    right.Add(s[i].right, by);
  }
  return noise * noise * (left.Squares() + right.Squares());
}

struct Noise {
  double predicted_px = 0.0;
  double measured_px = 0.0;
  double bound_px = 0.0;  // Cramer-Rao
};

// Scatter of disparities over realizations of the noise, pixel by pixel, so that what the noise
// leaves alone does not count.
Noise NoiseOf(const SyntheticPair& pair, const StereoPipelineParams& params, double noise) {
  std::vector<DisparityImage> found;
  for (std::uint32_t i = 0; i < kRealizations; ++i) {
    found.push_back(MatchStereo(WithNoise(pair.left, noise, 2 * i),
                                WithNoise(pair.right, noise, 2 * i + 1), params));
  }
  const GrayImage left = DifferenceOfGaussians(pair.left, params.dog);
  const GrayImage right = DifferenceOfGaussians(pair.right, params.dog);
  const double sigma = std::sqrt(noise * noise + 1.0 / 12.0);  // and grey levels are whole
  double predicted = 0.0, measured = 0.0, bound = 0.0;
  int count = 0;
  ForEachInside(pair, [&](int x, int y) {
    double sum = 0.0, squares = 0.0;
    for (const DisparityImage& image : found) {
      if (!IsValid(image.At(x, y))) return;
      const double error = DisparityPx(image.At(x, y)) - pair.truth.At(x, y);
      if (std::abs(error) > 1.0) return;
      sum += error;
      squares += error * error;
    }
    const int whole = static_cast<int>(std::lround(pair.truth.At(x, y)));
    const std::array<NoisyScore, 3> scores{
        ScoreWithNoise(left, right, params.dog, sigma, x, y, whole, -1),
        ScoreWithNoise(left, right, params.dog, sigma, x, y, whole, 0),
        ScoreWithNoise(left, right, params.dog, sigma, x, y, whole, 1)};
    double gradients = 0.0;
    for (int k = -kReach; k <= kReach; ++k) {
      for (int i = -kReach; i <= kReach; ++i) {
        const auto step = [&](int by) {
          return pair.left.At(x + i + by, y + k) - pair.left.At(x + i - by, y + k);
        };
        const double g = (8.0 * step(1) - step(2)) / 12.0;
        gradients += g * g;
      }
    }
    predicted += PredictedVariance(scores, params.filters.interpolation, sigma);
    measured += (squares - sum * sum / kRealizations) / (kRealizations - 1);
    bound += 2.0 * sigma * sigma / gradients;
    ++count;
  });
  return {std::sqrt(predicted / count), std::sqrt(measured / count), std::sqrt(bound / count)};
}

// Means of three rows, which count 1, 2 and 1.
Image<double> Smoothed(const GrayImage& image) {
  Image<double> out(image.width(), image.height());
  for (int y = 1; y + 1 < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      out.At(x, y) = 0.25 * (image.At(x, y - 1) + 2 * image.At(x, y) + image.At(x, y + 1));
    }
  }
  return out;
}

// A row between its pixels, by the cubic through four of them whose slopes are those of the
// neighbours (Keys 1981, a = -1/2).
double Between(const Image<double>& image, double x, int y) {
  const int left = static_cast<int>(std::floor(x));
  const double t = x - left;
  const double a = image.At(left - 1, y), b = image.At(left, y);
  const double c = image.At(left + 1, y), d = image.At(left + 2, y);
  return b +
         0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

// Offset from the whole disparity nearest to the truth that the left image alone lets expect: the
// right pixel that is tried for (x, y) at whole + k shows the left one at x - k + t, t being the
// truth there less `whole`. Where t changes over the window this is foreshortening; where it does
// not, what the interpolation does to t, and that other texture enters a window than leaves it.
double PredictedOffset(const Image<double>& smoothed, const Image<double>& truth,
                       const StereoPipelineParams& params, int x, int y) {
  const double whole = std::round(truth.At(x, y));
  const auto limit = static_cast<double>(params.dog.limit);
  const auto gradient = [&](double at, int row) {
    const double g = Between(smoothed, at + 1.0, row) - Between(smoothed, at - 1.0, row);
    return std::clamp(params.dog.gain * g, -limit, limit);
  };
  std::array<double, 3> s{};
  for (int k = -kReach; k <= kReach; ++k) {
    for (int i = -kReach; i <= kReach; ++i) {
      const double t = truth.At(x + i, y + k) - whole;
      const double here = gradient(x + i, y + k);
      for (int shift = -1; shift <= 1; ++shift) {
        s[static_cast<std::size_t>(shift + 1)] +=
            std::abs(here - gradient(x + i - shift + t, y + k));
      }
    }
  }
  const double m = params.filters.interpolation == Interpolation::kEquiangular
                       ? std::max(s[0], s[2]) - s[1]
                       : s[0] - 2.0 * s[1] + s[2];
  return m > 0.0 ? std::clamp(0.5 * (s[0] - s[2]) / m, -0.5, 0.5) : 0.0;
}

// What is wrong without any noise.
struct Systematic {
  double predicted_px = 0.0;  // rms
  double measured_px = 0.0;   // rms
  double bias_px = 0.0;
};

Systematic SystematicOf(const SyntheticPair& pair, const StereoPipelineParams& params) {
  const DisparityImage found = MatchStereo(pair.left, pair.right, params);
  const Image<double> smoothed = Smoothed(pair.left);
  double predicted = 0.0, measured = 0.0, bias = 0.0;
  int count = 0;
  ForEachInside(pair, [&](int x, int y) {
    if (!IsValid(found.At(x, y))) return;
    const double truth = pair.truth.At(x, y);
    const double error = DisparityPx(found.At(x, y)) - truth;
    if (std::abs(error) > 1.0) return;
    const double offset = PredictedOffset(smoothed, pair.truth, params, x, y);
    predicted += std::pow(std::round(truth) + offset - truth, 2);
    measured += error * error;
    bias += error;
    ++count;
  });
  return {std::sqrt(predicted / count), std::sqrt(measured / count), bias / count};
}

void ExpectMet(double measured_px, double predicted_px) {
  EXPECT_GT(measured_px, 0.8 * predicted_px);
  EXPECT_LT(measured_px, 1.25 * predicted_px);
}

TEST(SubpixelAccuracyTest, NoiseOfDisparitiesIsThatOfTheSums) {
  for (const double contrast : {8.0, 12.0, 25.0}) {
    for (const double d : {10.0, 10.25, 10.5}) {
      const SyntheticPair pair =
          MakePair(SceneOf(contrast, 300, [d](double, double) { return d; }));
      for (const double noise : {1.0, 2.0}) {
        SCOPED_TRACE(::testing::Message() << contrast << ", " << d << ", noise " << noise);
        const Noise n = NoiseOf(pair, Params(Interpolation::kEquiangular), noise);
        ExpectMet(n.measured_px, n.predicted_px);
      }
    }
  }
}

// The negative control: another noise than the images have is not met.
TEST(SubpixelAccuracyTest, AnotherNoiseIsNotMet) {
  const SyntheticPair pair = MakePair(SceneOf(12.0, 300, [](double, double) { return 10.25; }));
  const StereoPipelineParams params = Params(Interpolation::kEquiangular);
  const double of_one = NoiseOf(pair, params, 1.0).predicted_px;
  EXPECT_GT(NoiseOf(pair, params, 1.5).measured_px, 1.25 * of_one);
  EXPECT_LT(NoiseOf(pair, params, 0.6).measured_px, 0.8 * of_one);
}

// With gradients g of a normal distribution and little noise, absolute differences leave sqrt(E
// g^2) / E|g| = sqrt(pi / 2) times the bound that squares would reach (efficiency 2 / pi), where
// nothing is limited; limited pixels tell nothing, and the default limit leaves more.
TEST(SubpixelAccuracyTest, AbsoluteDifferencesLeaveMoreThanCramerAndRao) {
  Scene scene = SceneOf(25.0, 302, [](double, double) { return 10.0; });
  scene.shortest_wave_px = 8.0;
  const SyntheticPair pair = MakePair(scene);
  const Noise open =
      NoiseOf(pair, Params(Interpolation::kEquiangular, {.gain = 1.0, .limit = 110}), 2.0);
  ExpectMet(open.measured_px, std::sqrt(std::numbers::pi / 2.0) * open.bound_px);
  const Noise limited = NoiseOf(pair, Params(Interpolation::kEquiangular), 2.0);
  EXPECT_GT(limited.measured_px, 1.1 * open.measured_px);
  ExpectMet(limited.measured_px, limited.predicted_px);
}

// Ground that rises by `per_column` and `per_row` px a px, through 10.3 in the middle.
Scene Ground(double contrast, double per_column, double per_row) {
  return SceneOf(contrast, 301, [=](double x, double y) {
    return 10.3 + per_column * (x - 100.0) + per_row * (y - 45.0);
  });
}

TEST(SubpixelAccuracyTest, SlantAndTextureOfTheWindowAreMet) {
  for (const double contrast : {8.0, 25.0}) {
    for (const auto& [per_column, per_row] :
         {std::pair{0.0, 0.0}, {0.0, 0.05}, {0.03, 0.0}, {0.03, 0.05}, {-0.03, 0.03}}) {
      SCOPED_TRACE(::testing::Message() << contrast << ": " << per_column << ", " << per_row);
      const SyntheticPair pair = MakePair(Ground(contrast, per_column, per_row));
      for (const auto kind : {Interpolation::kEquiangular, Interpolation::kQuadratic}) {
        const Systematic s = SystematicOf(pair, Params(kind));
        ExpectMet(s.measured_px, s.predicted_px);
        const bool locked = kind == Interpolation::kQuadratic && per_column == per_row;
        EXPECT_NEAR(s.bias_px, locked ? 0.3 / 1.4 - 0.3 : 0.0, 0.025);
      }
    }
  }
}

// All errors together: what noise adds and what is wrong without it.
TEST(SubpixelAccuracyTest, TheWholeErrorOfGroundIsMet) {
  for (const double noise : {1.0, 2.0, 3.0}) {
    SCOPED_TRACE(noise);
    const SyntheticPair pair = MakePair(Ground(16.0, 0.01, 0.05));
    const StereoPipelineParams params = Params(Interpolation::kEquiangular);
    SyntheticPair noisy = pair;
    noisy.left = WithNoise(pair.left, noise, 400);
    noisy.right = WithNoise(pair.right, noise, 401);
    const double measured = SystematicOf(noisy, params).measured_px;
    ExpectMet(measured, std::hypot(SystematicOf(pair, params).predicted_px,
                                   NoiseOf(pair, params, noise).predicted_px));
  }
}

}  // namespace
}  // namespace rockyard::vision
