// Counter-based random numbers, Philox 4x32-10 (Salmon et al. 2011; Random123), and samplers. All
// that is random is drawn here: terrain, sensors, experiments, resampling and designs.
//
// A stream is named by what it is for, never by when it is used, so that adding a sensor or a scan
// shifts nobody's noise. The key is the campaign seed; the counter holds the trial, the purpose,
// the substream (scan number, step number, rock number, ...) and the block within the substream.
// The navigator is part of neither: different navigators meet the same rocks and the same noise.
//
// Samplers take a RandomStream and invert the CDF: one uniform each (Poisson may take more),
// portable across standard libraries, unlike std::*_distribution. Every record depends on how many
// uniforms a sampler takes and on its last bits: both must stay.
#pragma once

#include <array>
#include <cstdint>

namespace rockyard::core {

// What a stream is for. Never renumber: the values are part of every stored result. Append only.
enum class Purpose : std::uint32_t {
  kRockCount = 1,
  kRockSize = 2,
  kRockPlacement = 3,
  kRockShape = 4,
  kRockMark = 5,
  kGroundRoughness = 6,
  kStartPose = 7,
  kGyro = 8,
  kEncoder = 9,
  kSlip = 10,
  kScrapeJump = 11,
  kStripeWrongPlace = 12,
  kStripeMissed = 13,
  kTracker = 14,
  kRansac = 15,
  kBootstrap = 16,
  kDesign = 17,
  kTest = 18,
  kImageNoise = 19,
  kPixelPattern = 20,
  kImageExposure = 21,
  kImageSpeckle = 22,
  kStripePersistence = 23,
  kStripeColumnNoise = 24,
  kArticulation = 26,
  kAccelerometer = 27,
  kMotorCurrent = 28,
  kContactSwitch = 29,
  kSceneRock = 30,
  kScenePlacement = 31,
  kScenePhase = 32,
  kStereoDisparity = 33,
  kStereoDropout = 34,
  kStereoMismatch = 35,
  kGoalDesignation = 39,
  kExperiment = 40,  // what an experiment draws for itself: it numbers its own substreams
  kFeatureTracker = 41,
  kSoilTexture = 42,
  kRockTexture = 43,
  kRockLook = 44,  // of one rock as a whole: its albedo, its piece of texture
  kPixelDefect = 45,
  kRigDrift = 46,  // of a stereo pair since its calibration
  kLanderFix = 47,
  kSunSensor = 48,
  kRadioBeacon = 49,
  kLanderMap = 50,     // of the lander's stereo pair, for planning a route
  kVisualMotion = 51,  // the error of a visual odometry step, where no images are matched
  // These three draw the scene of the coloured cylinder before the lander's cameras: what stands
  // around it, the ground's texture (substream octave, by node), noise of pixels (substream image
  // and channel).
  kCylinderScene = 55,
  kCylinderGround = 56,
  kCylinderNoise = 57,
  kNavigator = 58,  // the seed of a navigator's own generator (NavigatorSetup::random_seed)
  kSiteMap = 59,    // the error of the map of the site
  kRockCluster = 60,
  kSoil = 61,
};

// Returns the raw Philox 4x32-10 bijection of one counter under one key.
std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

// Names the streams of one trial: the seed of its campaign and its number.
struct TrialKey {
  std::uint64_t seed = 1;
  std::uint32_t trial = 0;
};

// A sequence of independent uniform numbers. Cheap to make (no state beyond the counter): make one
// per (purpose, substream) where it is needed and drop it.
class RandomStream {
 public:
  RandomStream(TrialKey key, Purpose purpose, std::uint32_t substream = 0);

  std::uint32_t NextU32();
  std::uint64_t NextU64();
  // Returns a uniform number on (0, 1): 52 random bits, centred in their cell, so 0 and 1 cannot
  // occur.
  double Uniform();

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int next_ = 4;
};

// Returns the value below which a chi-squared number of `degrees` >= 1 degrees of freedom lies with
// probability p, 0 <= p < 1. Costs microseconds.
double ChiSquaredQuantile(double p, int degrees);

// Uniform on (low, high).
double SampleUniform(RandomStream& stream, double low, double high);

// Returns the value below which a standard normal number lies with probability p, 0 < p < 1, to
// 1e-15 of itself (Wichura 1988).
double NormalQuantile(double p);

// Normal by inverse CDF to 4 units in the last place (normal_pieces.h), one uniform.
double SampleNormal(RandomStream& stream, double mean, double standard_deviation);

// Exponential with the given mean.
double SampleExponential(RandomStream& stream, double mean);

// True with the given probability.
bool SampleBernoulli(RandomStream& stream, double probability);

// Poisson count by sequential inversion; means over 200 are split into a sum of smaller ones.
std::int64_t SamplePoisson(RandomStream& stream, double mean);

}  // namespace rockyard::core
