// Errors that the fast light stripe sensor adds: persistence of outliers and noise of columns, each
// with a wrong model that its test rejects. Misses and shares of outliers: light_stripe_noise_test.
#include <gtest/gtest.h>

#include <cmath>

#include "noise_laws.h"
#include "sensing/light_stripe.h"
#include "stripe_scene.h"

namespace rockyard::sensing {
namespace {

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
  messages::StripeScan scan;
  scan.number = number;
  StripeErrors(params).Disturb(key, Searched(), scan);
  return scan;
}

// What they make of one in which every point is seen at column 10.
messages::StripeScan Disturbed(const LightStripeParams& params, core::TrialKey key,
                               std::int64_t number) {
  messages::StripeScan scan;
  scan.number = number;
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
  constexpr int kScans = 5000;
  for (std::int64_t number = 0; number < kScans; ++number) {
    const auto scan = Disturbed(params, {20260407, 0}, number);
    for (std::size_t point = 0; point < 20; ++point) {
      missed.points()[point] += !scan.pixels.points()[point].detected;
    }
  }
  EXPECT_EQ(missed.points()[0], 0.0);
  for (std::size_t point = 1; point < 20; ++point) {
    const double count = missed.points()[point];
    EXPECT_GT(CountP(count, kScans, params.missed_at[point]), kAlpha / 19) << point;
  }
  EXPECT_LT(CountP(missed.points()[10], kScans, params.missed_at[10] + 0.05), kAlpha / 19);
}

TEST(StripeErrorsTest, NowhereToSearchIsNowhereToMisplace) {
  LightStripeParams params{.wrong_place_probability = 1.0};
  messages::StripeScan scan;
  StripeErrors(params).Disturb({1, 0}, StripeErrors::Searched{}, scan);
  for (const auto& pixel : scan.pixels.points()) EXPECT_FALSE(pixel.detected);
}

}  // namespace
}  // namespace rockyard::sensing
