#include <gtest/gtest.h>

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numeric>

#include "image_kit.h"
#include "noise_laws.h"
#include "perception/hazard_detector.h"
#include "rendering/image_readout.h"
#include "sensing/light_stripe.h"
#include "sensing/stripe_imager.h"
#include "sensing/stripe_scene.h"
#include "stripe_scene.h"

namespace rockyard::sensing {
namespace {

using messages::kStripeRows;
using messages::kStripes;

// Frequencies of misplaced and missed points, each test with a wrong model that it rejects.

constexpr int kScans = 20000;
constexpr core::TrialKey kKey{20260104, 0};

// Nothing can be seen: what is detected is misplaced.
const math::Transform kHighUp = PoseAt(0, 0, 50.0);

// p-value of 20 binomial counts, of kScans trials each, against one probability.
double BinomialP(const messages::StripeArray<int>& counts, double probability) {
  const double expected = kScans * probability;
  double chi_square = 0.0;
  for (const int count : counts.points()) {
    chi_square += (count - expected) * (count - expected) / (expected * (1.0 - probability));
  }
  return boost::math::gamma_q(0.5 * kStripeRows * kStripes, 0.5 * chi_square);
}

template <typename Counts>
messages::StripeArray<int> CountPoints(const LightStripeParams& params, const math::Transform& X_WR,
                                       Counts counts) {
  const LightStripe sensor(params);
  messages::StripeArray<int> result{};
  for (std::int64_t number = 0; number < kScans; ++number) {
    const auto scan = sensor.Scan(Flat(), X_WR, kKey, number);
    for (std::size_t i = 0; i < result.points().size(); ++i) {
      result.points()[i] += counts(scan.pixels.points()[i]);
    }
  }
  return result;
}

bool IsDetected(const messages::StripePixel& pixel) { return pixel.detected; }
bool IsMissing(const messages::StripePixel& pixel) { return !pixel.detected; }

TEST(LightStripeNoiseTest, OnePointInAHundredIsMisplaced) {
  const auto counts = CountPoints({}, kHighUp, IsDetected);
  EXPECT_GT(BinomialP(counts, 0.01), kAlpha);
  EXPECT_LT(BinomialP(counts, 0.012), kAlpha);  // negative control
}

TEST(LightStripeNoiseTest, MissedPoints) {
  LightStripeParams params = NoiselessParams();
  params.missed_probability = 0.03;
  const auto counts = CountPoints(params, PoseAt(0, 0, 0), IsMissing);
  EXPECT_GT(BinomialP(counts, 0.03), kAlpha);
  EXPECT_LT(BinomialP(counts, 0.036), kAlpha);  // negative control
}

// Number of kScans scans in which at least one of the 20 points is misplaced.
int DisturbedScans(double wrong_place_probability) {
  LightStripeParams params{.wrong_place_probability = wrong_place_probability};
  const LightStripe sensor(params);
  int disturbed = 0;
  for (std::int64_t number = 0; number < kScans; ++number) {
    const auto scan = sensor.Scan(Flat(), kHighUp, kKey, number);
    bool any = false;
    for (const auto& pixel : scan.pixels.points()) any = any || pixel.detected;
    disturbed += any;
  }
  return disturbed;
}

TEST(LightStripeNoiseTest, OneScanInFiveIsDisturbed) {
  // Section 6: one point in a hundred "gives a false alarm rate of one in every five hazard scans".
  const double expected = 1.0 - std::pow(0.99, 20);
  EXPECT_NEAR(expected, 0.182, 5e-4);
  EXPECT_GT(CountP(DisturbedScans(0.01), kScans, expected), kAlpha);
  EXPECT_LT(CountP(DisturbedScans(0.012), kScans, expected), kAlpha);  // negative control
}

// Columns at which points are misplaced, as shares of each scanline's searched part, in ten bins.
std::vector<double> ColumnBins(WrongPlace model, double& total) {
  LightStripeParams params{.wrong_place_probability = 0.2, .wrong_place = model};
  const LightStripe sensor(params);
  std::vector<double> bins(10, 0.0);
  for (std::int64_t number = 0; number < kScans; ++number) {
    const auto scan = sensor.Scan(Flat(), kHighUp, kKey, number);
    for (std::size_t row = 0; row < kStripeRows; ++row) {
      for (std::size_t stripe = 0; stripe < kStripes; ++stripe) {
        const auto& pixel = scan.pixels[row][stripe];
        if (!pixel.detected) continue;
        const auto [first, last] = sensor.searched(row, stripe);
        const double share = (pixel.column_px - first + 0.5) / (last - first + 1);
        if (share <= 0.0 || share >= 1.0) continue;
        // Bins of whole columns differ by a column: spread each column's share over its width.
        const double low = (pixel.column_px - first) / (last - first + 1) * 10.0;
        const double high = low + 10.0 / (last - first + 1);
        const auto bin = static_cast<std::size_t>(low);
        const double over = std::max(0.0, high - static_cast<double>(bin + 1));
        bins[bin] += 1.0 - over / (high - low);
        if (over > 0.0 && bin + 1 < bins.size()) bins[bin + 1] += over / (high - low);
        total += 1.0;
      }
    }
  }
  return bins;
}

TEST(LightStripeNoiseTest, MisplacedColumnsAreUniformOverTheSearchedPart) {
  double total = 0.0;
  auto bins = ColumnBins(WrongPlace::kSearchedPart, total);
  EXPECT_GT(core::ChiSquareP(bins, std::vector<double>(10, total / 10.0)), kAlpha);
  // Negative control: a tenth of the columns hit 20 % too often.
  bins[0] *= 1.2;
  EXPECT_LT(core::ChiSquareP(bins, std::vector<double>(10, (total + bins[0] / 6.0) / 10.0)),
            kAlpha);
}

TEST(LightStripeNoiseTest, WholeScanlineReachesBeyondTheSearchedPart) {
  LightStripeParams params{.wrong_place_probability = 1.0,
                           .wrong_place = WrongPlace::kWholeScanline};
  const LightStripe sensor(params);
  int outside = 0;
  for (std::int64_t number = 0; number < 200; ++number) {
    const auto scan = sensor.Scan(Flat(), kHighUp, kKey, number);
    const auto [first, last] = sensor.searched(3, 2);
    const double column = scan.pixels[3][2].column_px;
    EXPECT_LE(std::abs(column), 384.0);
    outside += column < first || column > last;
  }
  EXPECT_GT(outside, 100);
}

// A misplaced point matters only where its elevation breaks a criterion.
TEST(LightStripeNoiseTest, MostMisplacedPointsRaiseAFalseAlarmOnFlatGround) {
  const LightStripe sensor{LightStripeParams{}};
  const perception::Triangulator triangulator(sensor.calibration());
  int alarms = 0;
  for (std::int64_t number = 0; number < kScans; ++number) {
    const auto scan = sensor.Scan(Flat(), PoseAt(0, 0, 0), kKey, number);
    alarms += perception::ReportHazards(triangulator.Elevations(scan), {}).any();
  }
  const double rate = static_cast<double>(alarms) / kScans;
  EXPECT_GT(rate, 0.10);
  EXPECT_LT(rate, 0.19);  // cannot exceed the share of disturbed scans
  RecordProperty("false_alarm_rate", std::to_string(rate));
}

constexpr core::TrialKey kImageKey{11, 5};
// z for which a standard normal number exceeds it in size with probability 1e-4.
constexpr double kNormalBound = 3.8906;

// Lit and dark images of one pair, and neighbouring scans, share no temporal noise; what they share
// is the light.
TEST(StripeImageName, ImagesAreIndependent) {
  const rendering::ImageReadout readout(QuietParams().imager, 0.0);
  constexpr int kColumns = 768;
  constexpr int kFirst = -384;
  const RenderedRow row{3, std::vector<double>(kColumns, 20000.0), {}};
  const auto departures = [&](const StripeImageName& name) {
    std::vector<std::uint16_t> counts;
    readout.Read(row, readout.Pattern(name.camera, row.row, kFirst, kColumns, kImageKey), kFirst,
                 1.0, kImageKey, name.number(), {}, counts);
    std::vector<double> z;
    for (const double count : counts) {
      z.push_back(((count - 0.02 * 65535.0) * readout.electrons_per_count() - 20000.0) /
                  std::sqrt(20000.0));
    }
    return z;
  };
  const auto correlation = [&](const StripeImageName& a, const StripeImageName& b) {
    const auto za = departures(a);
    const auto zb = departures(b);
    return std::inner_product(za.begin(), za.end(), zb.begin(), 0.0) / kColumns;
  };
  const StripeImageName name{5, 0, 1, true};
  const double bound = kNormalBound / std::sqrt(double{kColumns});
  EXPECT_LT(std::abs(correlation(name, {5, 0, 1, false})), bound);
  EXPECT_LT(std::abs(correlation(name, {5, 0, 2, true})), bound);
  EXPECT_LT(std::abs(correlation(name, {5, 1, 1, true})), bound);
  EXPECT_LT(std::abs(correlation(name, {6, 0, 1, true})), bound);
  EXPECT_GT(correlation(name, name), bound);
}

// Errors that the fast light stripe sensor adds: persistence of outliers and noise of columns, each
// with a wrong model that its test rejects. Misses and shares of outliers: light_stripe_noise_test.

constexpr double kShare = 0.05;
constexpr int kColumns = 101;

StripeErrors::Searched Searched() {
  StripeErrors::Searched searched;
  for (auto& range : searched.points()) range = {-50, 50};
  return searched;
}

LightStripeParams Persisting(double persistence) {
  return LightStripeParams{.wrong_place_probability = kShare, .outlier_persistence = persistence};
}

// What the errors make of a scan in which nothing is seen.
messages::StripeScan Outliers(const LightStripeParams& params, core::TrialKey key,
                              std::int64_t number) {
  messages::StripeScan scan{.number = number, .pixels = {}};
  StripeErrors(params).Disturb(key, Searched(), scan);
  return scan;
}

// What they make of one in which every point is seen at column 10.
messages::StripeScan Disturbed(const LightStripeParams& params, core::TrialKey key,
                               std::int64_t number) {
  messages::StripeScan scan{.number = number, .pixels = {}};
  for (auto& pixel : scan.pixels.points()) pixel = {.detected = true, .column_px = 10.0};
  StripeErrors(params).Disturb(key, Searched(), scan);
  return scan;
}

struct Persistence {
  double points = 0.0;
  double misplaced = 0.0;         // in the second scan
  double before = 0.0;            // in the first scan
  double kept = 0.0;              // in both, at the same column
  double kept_three_later = 0.0;  // in the first and in the one three later, at the same column
};

Persistence Count(double persistence) {
  const LightStripeParams params = Persisting(persistence);
  Persistence counts;
  for (std::uint32_t trial = 0; trial < 4000; ++trial) {
    const core::TrialKey key{20260403, trial};
    const auto first = Outliers(params, key, 6);
    const auto second = Outliers(params, key, 7);
    const auto later = Outliers(params, key, 9);
    const auto same = [](const messages::StripePixel& a, const messages::StripePixel& b) {
      return a.detected && b.detected && a.column_px == b.column_px;
    };
    for (std::size_t point = 0; point < first.pixels.points().size(); ++point) {
      const auto& before = first.pixels.points()[point];
      counts.points += 1.0;
      counts.misplaced += second.pixels.points()[point].detected;
      counts.before += before.detected;
      counts.kept += same(before, second.pixels.points()[point]);
      counts.kept_three_later += same(before, later.pixels.points()[point]);
    }
  }
  return counts;
}

class OutlierPersistenceTest : public testing::TestWithParam<double> {};

TEST_P(OutlierPersistenceTest, ShareStaysAndOutliersLast) {
  const double r = GetParam();
  const Persistence counts = Count(r);
  EXPECT_GT(CountP(counts.misplaced, counts.points, kShare), kAlpha);
  EXPECT_LT(CountP(counts.misplaced, counts.points, 1.2 * kShare), kAlpha);  // negative control
  // Kept with r, or drawn anew at the same column; over three scans with r^3.
  const double by_chance = kShare / kColumns;
  const auto kept = [&](double share) { return share + (1.0 - share) * by_chance; };
  EXPECT_GT(CountP(counts.kept, counts.before, kept(r)), kAlpha);
  EXPECT_GT(CountP(counts.kept_three_later, counts.before, kept(r * r * r)), kAlpha);
  // Negative controls: a persistence that differs by 0.1, and one that does not fade.
  EXPECT_LT(CountP(counts.kept, counts.before, kept(r - 0.1)), kAlpha);
  EXPECT_LT(CountP(counts.kept_three_later, counts.before, kept(r)), kAlpha);
}

INSTANTIATE_TEST_SUITE_P(Persistences, OutlierPersistenceTest, testing::Values(0.3, 0.8));

TEST(OutlierPersistenceTest, EveryOutlierWasDrawnInThisScanOrABefore) {
  const LightStripeParams independent = Persisting(0.0);
  const LightStripeParams persisting = Persisting(0.7);
  int older = 0;
  for (std::int64_t number = 0; number < 60; ++number) {
    const auto scan = Outliers(persisting, {20260404, 0}, number);
    for (std::size_t point = 0; point < scan.pixels.points().size(); ++point) {
      const messages::StripePixel& pixel = scan.pixels.points()[point];
      if (!pixel.detected) continue;
      std::int64_t drawn = number;
      for (; drawn >= 0; --drawn) {
        const auto lots = Outliers(independent, {20260404, 0}, drawn);
        const messages::StripePixel& lot = lots.pixels.points()[point];
        if (lot.detected && lot.column_px == pixel.column_px) break;
      }
      EXPECT_GE(drawn, 0);
      older += drawn < number;
    }
  }
  EXPECT_GT(older, 10);
}

TEST(OutlierPersistenceTest, FirstScanIsTheSameWithAndWithout) {
  for (std::uint32_t trial = 0; trial < 50; ++trial) {
    const auto without = Outliers(Persisting(0.0), {20260405, trial}, 0);
    const auto with = Outliers(Persisting(0.9), {20260405, trial}, 0);
    for (std::size_t point = 0; point < with.pixels.points().size(); ++point) {
      EXPECT_EQ(with.pixels.points()[point].detected, without.pixels.points()[point].detected);
      EXPECT_EQ(with.pixels.points()[point].column_px, without.pixels.points()[point].column_px);
    }
  }
}

// Chance of a normal variable with deviation `sigma` to be rounded to `k`.
double RoundedNormal(int k, double sigma) {
  return NormalCdf((k + 0.5) / sigma) - NormalCdf((k - 0.5) / sigma);
}

TEST(ColumnNoiseTest, IsARoundedNormalVariable) {
  LightStripeParams params = NoiselessParams();
  params.column_noise_px = 0.6;
  std::vector<double> counts(5, 0.0);
  double total = 0.0;
  for (std::int64_t number = 0; number < 2000; ++number) {
    const auto scan = Disturbed(params, {20260406, 0}, number);
    for (const auto& pixel : scan.pixels.points()) {
      const double off = pixel.column_px - 10.0;
      if (std::abs(off) <= 2.0) counts[static_cast<std::size_t>(off + 2.0)] += 1.0;
      total += 1.0;
    }
  }
  const auto p_value = [&](double sigma) {
    std::vector<double> expected;
    for (int k = -2; k <= 2; ++k) expected.push_back(total * RoundedNormal(k, sigma));
    return core::ChiSquareP(counts, expected);
  };
  EXPECT_GT(p_value(0.6), kAlpha);
  EXPECT_LT(p_value(0.63), kAlpha);  // negative control
}

TEST(ColumnNoiseTest, StaysInTheSearchedPartAndLeavesMissingPoints) {
  LightStripeParams params = NoiselessParams();
  params.column_noise_px = 20.0;
  messages::StripeScan scan;
  for (auto& pixel : scan.pixels[0]) pixel = {.detected = true, .column_px = 50.0};
  StripeErrors(params).Disturb({1, 0}, Searched(), scan);
  for (const auto& pixel : scan.pixels[0]) EXPECT_LE(pixel.column_px, 50.0);
  for (const auto& pixel : scan.pixels[1]) EXPECT_FALSE(pixel.detected);
}

TEST(MissedAtTest, EachPointHasItsOwnProbability) {
  LightStripeParams params = NoiselessParams();
  for (int point = 0; point < 20; ++point) params.missed_at.push_back(0.05 * point);
  messages::StripeArray<double> missed;
  constexpr int kMissedScans = 5000;
  for (std::int64_t number = 0; number < kMissedScans; ++number) {
    const auto scan = Disturbed(params, {20260407, 0}, number);
    for (std::size_t point = 0; point < 20; ++point) {
      missed.points()[point] += !scan.pixels.points()[point].detected;
    }
  }
  EXPECT_EQ(missed.points()[0], 0.0);
  for (std::size_t point = 1; point < 20; ++point) {
    const double count = missed.points()[point];
    EXPECT_GT(CountP(count, kMissedScans, params.missed_at[point]), kAlpha / 19) << point;
  }
  EXPECT_LT(CountP(missed.points()[10], kMissedScans, params.missed_at[10] + 0.05), kAlpha / 19);
}

TEST(StripeErrorsTest, NowhereToSearchIsNowhereToMisplace) {
  LightStripeParams params{.wrong_place_probability = 1.0};
  messages::StripeScan scan;
  StripeErrors(params).Disturb({1, 0}, StripeErrors::Searched{}, scan);
  for (const auto& pixel : scan.pixels.points()) EXPECT_FALSE(pixel.detected);
}

}  // namespace
}  // namespace rockyard::sensing
