// The logistic fit against known answers, and where there is no finite fit.
#include "statistics/logistic_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/json_file.h"
#include "statistics/oracles.h"

namespace rockyard::statistics {
namespace {

const core::JsonValue::List& Cases() {
  static const core::JsonValue document =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/logistic_oracles.json");
  return At(document, "cases").list();
}

std::vector<DosePoint> PointsOf(const core::JsonValue& known) {
  const std::vector<double> x = Numbers(At(known, "x"));
  const core::JsonValue::List& counts = At(known, "count").list();
  const core::JsonValue::List& trials = At(known, "trials").list();
  std::vector<DosePoint> points;
  for (std::size_t i = 0; i < x.size(); ++i) {
    points.push_back({x[i], counts[i].integer(), trials[i].integer()});
  }
  return points;
}

LogisticFit FitOf(const core::JsonValue& known) {
  const bool log = At(known, "scale").text() == "log";
  return FitLogistic(PointsOf(known), log ? FitScale::kLog : FitScale::kLinear);
}

void ExpectNear(double found, double known, double relative = 1e-7) {
  EXPECT_NEAR(found, known, relative * std::max(1e-3, std::fabs(known)));
}

TEST(LogisticFitTest, AgreesWithScipy) {
  for (const core::JsonValue& known : Cases()) {
    SCOPED_TRACE(At(known, "name").text());
    const LogisticFit fit = FitOf(known);
    ASSERT_EQ(fit.status, FitStatus::kFitted);
    for (const auto& [key, value] : {std::pair("intercept", fit.intercept),
                                     {"slope", fit.slope},
                                     {"log_likelihood", fit.log_likelihood},
                                     {"deviance", fit.deviance},
                                     {"p_value", fit.p_value},
                                     {"slope_p_value", fit.slope_p_value}}) {
      SCOPED_TRACE(key);
      ExpectNear(value, At(known, key).number());
    }
    const std::vector<double> covariance = Numbers(At(known, "covariance"));
    for (std::size_t i = 0; i < 3; ++i) ExpectNear(fit.covariance[i], covariance[i]);
    for (const core::JsonValue& point : At(known, "band").list()) {
      const double x = At(point, "x").number();
      ExpectNear(fit.Rate(x), At(point, "rate").number());
      ExpectNear(fit.Band(x).low, At(point, "low").number());
      ExpectNear(fit.Band(x).high, At(point, "high").number());
    }
  }
}

TEST(LogisticFitTest, CrossingsAgreeWithScipy) {
  for (const core::JsonValue& known : Cases()) {
    SCOPED_TRACE(At(known, "name").text());
    const LogisticFit fit = FitOf(known);
    for (const core::JsonValue& expected : At(known, "crossings").list()) {
      const FitCrossing crossing =
          FindCrossing(fit, PointsOf(known), At(expected, "rate").number());
      ExpectNear(crossing.x, At(expected, "x").number(), 1e-6);
      EXPECT_EQ(crossing.extrapolated, crossing.x < fit.lowest_x || crossing.x > fit.highest_x);
      if (const core::JsonValue* ends = expected.Find("ends")) {
        ExpectNear(crossing.interval.low, Numbers(*ends)[0], 1e-6);
        ExpectNear(crossing.interval.high, Numbers(*ends)[1], 1e-6);
      } else {
        EXPECT_EQ(crossing.interval.low, fit.scale == FitScale::kLog ? 0.0 : -INFINITY);
        EXPECT_EQ(crossing.interval.high, INFINITY);
      }
    }
  }
}

TEST(LogisticFitTest, TheBandAtACrossingHoldsItsRate) {
  const core::JsonValue& known = Cases().front();
  const LogisticFit fit = FitOf(known);
  const FitCrossing half = FindCrossing(fit, PointsOf(known), 0.5);
  EXPECT_NEAR(fit.Rate(half.x), 0.5, 1e-9);
  EXPECT_LT(fit.Band(half.x).low, 0.5);
  EXPECT_GT(fit.Band(half.x).high, 0.5);
  const FitCrossing surer = FindCrossing(fit, PointsOf(known), 0.5, 0.99);
  EXPECT_LT(surer.interval.low, half.interval.low);
  EXPECT_GT(surer.interval.high, half.interval.high);
}

TEST(LogisticFitTest, EqualSettingsArePooled) {
  const std::vector<DosePoint> split{{1.0, 9, 10}, {2.0, 3, 5},  {1.0, 7, 10},
                                     {2.0, 2, 5},  {3.0, 1, 10}, {4.0, 0, 0}};
  const std::vector<DosePoint> pooled{{1.0, 16, 20}, {2.0, 5, 10}, {3.0, 1, 10}};
  const LogisticFit a = FitLogistic(split, FitScale::kLinear);
  const LogisticFit b = FitLogistic(pooled, FitScale::kLinear);
  EXPECT_EQ(a.intercept, b.intercept);
  EXPECT_EQ(a.deviance, b.deviance);
  EXPECT_EQ(a.degrees_of_freedom, 1);
  EXPECT_EQ(a.highest_x, 3.0);
}

TEST(LogisticFitTest, SwappingSuccessAndFailureTurnsTheCurve) {
  const core::JsonValue& known = Cases().front();
  std::vector<DosePoint> points = PointsOf(known);
  const LogisticFit fit = FitOf(known);
  for (DosePoint& point : points) point.count = point.trials - point.count;
  const LogisticFit turned = FitLogistic(points, FitScale::kLog);
  EXPECT_NEAR(turned.intercept, -fit.intercept, 1e-8);
  EXPECT_NEAR(turned.slope, -fit.slope, 1e-8);
  EXPECT_NEAR(turned.deviance, fit.deviance, 1e-8);
}

TEST(LogisticFitTest, SaysWhyThereIsNoFiniteFit) {
  const auto status = [](const std::vector<DosePoint>& points) {
    const LogisticFit fit = FitLogistic(points, FitScale::kLinear);
    EXPECT_TRUE(std::isnan(fit.slope)) << "no number where there is no fit";
    EXPECT_TRUE(std::isnan(fit.Rate(1.0)));
    return fit.status;
  };
  EXPECT_EQ(status({}), FitStatus::kTooFewPoints);
  EXPECT_EQ(status({{1.0, 3, 10}, {1.0, 4, 10}}), FitStatus::kTooFewPoints);
  EXPECT_EQ(status({{1.0, 3, 10}, {2.0, 0, 0}}), FitStatus::kTooFewPoints);
  EXPECT_EQ(status({{1.0, 10, 10}, {2.0, 20, 20}}), FitStatus::kNoContrast);
  EXPECT_EQ(status({{1.0, 0, 10}, {2.0, 0, 20}}), FitStatus::kNoContrast);
  EXPECT_EQ(status({{1.0, 10, 10}, {2.0, 0, 10}}), FitStatus::kSeparated);
  EXPECT_EQ(status({{1.0, 0, 10}, {2.0, 10, 10}}), FitStatus::kSeparated);
  // One setting with both outcomes, beside which everything is decided: the curve has no slope yet
  // that is steep enough.
  EXPECT_EQ(status({{1.0, 10, 10}, {2.0, 5, 10}, {3.0, 0, 10}}), FitStatus::kSeparated);
}

TEST(LogisticFitTest, ACurveThroughEveryRateHasNoDeviance) {
  for (const std::int64_t count : {3, 5, 6, 9}) {
    const std::vector<DosePoint> points{{1.0, count, 39}, {2.0, count, 39}, {3.0, count, 39}};
    const LogisticFit fit = FitLogistic(points, FitScale::kLog);
    EXPECT_GE(fit.deviance, 0.0);
    EXPECT_NEAR(fit.deviance, 0.0, 1e-9);
    EXPECT_NEAR(fit.p_value, 1.0, 1e-6);
    EXPECT_NEAR(fit.slope, 0.0, 1e-9);
  }
}

TEST(LogisticFitTest, ALevelCurveCrossesNothing) {
  const std::vector<DosePoint> points{{1.0, 5, 10}, {2.0, 5, 10}};
  const LogisticFit fit = FitLogistic(points, FitScale::kLinear);
  ASSERT_EQ(fit.slope, 0.0);
  for (const double rate : {0.5, 0.9}) {
    const FitCrossing crossing = FindCrossing(fit, points, rate);
    EXPECT_TRUE(std::isnan(crossing.x)) << rate;
    EXPECT_TRUE(crossing.extrapolated);
    EXPECT_EQ(crossing.interval.low, -INFINITY);
    EXPECT_EQ(crossing.interval.high, INFINITY);
  }
}

// Every trial in each setting c times over: c copies say no more than one.
TEST(LogisticFitTest, CopiesWithinAClusterAddNothing) {
  constexpr std::int64_t kTrials = 200;
  const auto happens = [](std::int64_t trial, std::size_t setting) {
    return trial * 7919 % kTrials < kTrials * static_cast<std::int64_t>(4 - setting) / 5;
  };
  const std::array<double, 3> settings{1.0, 2.0, 4.0};
  const auto fit_of = [&](std::int64_t copies, std::vector<DosePoint>& points) {
    for (std::size_t i = 0; i < settings.size(); ++i) {
      points.push_back({settings[i], 0, copies * kTrials});
      for (std::int64_t t = 0; t < kTrials; ++t) points[i].count += happens(t, i) ? copies : 0;
    }
    const LogisticFit fit = FitLogistic(points, FitScale::kLog);
    ClusterScores scores(fit);
    for (std::size_t i = 0; i < settings.size(); ++i) {
      for (std::int64_t t = 0; t < kTrials; ++t) {
        for (std::int64_t c = 0; c < copies; ++c) {
          scores.Add(static_cast<std::size_t>(t), settings[i], happens(t, i));
        }
      }
    }
    return scores.Fit(copies > 1);
  };
  std::vector<DosePoint> single;
  std::vector<DosePoint> fivefold;
  const LogisticFit a = fit_of(1, single);
  const LogisticFit b = fit_of(5, fivefold);
  EXPECT_EQ(a.clusters, kTrials);
  for (std::size_t i = 0; i < 3; ++i) ExpectNear(b.covariance[i], a.covariance[i], 1e-9);
  ExpectNear(b.slope_p_value, a.slope_p_value, 1e-6);
  const FitCrossing first = FindCrossing(a, single, 0.5);
  const FitCrossing second = FindCrossing(b, fivefold, 0.5);
  ExpectNear(second.interval.low, first.interval.low, 1e-6);
  ExpectNear(second.interval.high, first.interval.high, 1e-6);
  EXPECT_LT(b.model_covariance[2], 0.21 * a.model_covariance[2]) << "what the model would say";
  EXPECT_TRUE(std::isfinite(a.p_value));
  EXPECT_TRUE(std::isnan(b.p_value));
}

// The same trials in every cell: a level curve, whose slope has no scatter either.
TEST(LogisticFitTest, EqualCellsOfClustersHaveNoCrossing) {
  std::vector<DosePoint> points;
  for (const double x : {1.0, 2.0, 3.0}) points.push_back({x, 13, 39});
  const LogisticFit fit = FitLogistic(points, FitScale::kLog);
  ClusterScores scores(fit);
  for (const DosePoint& point : points) {
    for (std::size_t t = 0; t < 39; ++t) scores.Add(t, point.x, t < 13);
  }
  const LogisticFit clustered = scores.Fit(false);
  EXPECT_EQ(clustered.slope_p_value, 1.0);
  const FitCrossing crossing = FindCrossing(clustered, points, 0.5);
  EXPECT_EQ(crossing.interval.low, 0.0);
  EXPECT_EQ(crossing.interval.high, INFINITY);
  EXPECT_LT(fit.Band(1.5).low, 0.3);
  EXPECT_LT(clustered.Band(1.5).low, fit.Band(1.5).low) << "39 trials, not 117";
}

TEST(LogisticFitTest, TwoClustersSayNothing) {
  const std::vector<DosePoint> points{{1.0, 15, 20}, {2.0, 10, 20}, {3.0, 4, 20}};
  const LogisticFit fit = FitLogistic(points, FitScale::kLinear);
  ClusterScores scores(fit);
  for (const DosePoint& point : points) {
    for (std::int64_t t = 0; t < 20; ++t) {
      scores.Add(static_cast<std::size_t>(t / 10), point.x, t < point.count);
    }
  }
  const LogisticFit clustered = scores.Fit(true);
  EXPECT_EQ(clustered.Band(2.0).low, 0.0);
  EXPECT_EQ(clustered.Band(2.0).high, 1.0);
  EXPECT_EQ(FindCrossing(clustered, points, 0.5).interval.high, INFINITY);
}

TEST(LogisticFitTest, ANearlySeparatedCurveConverges) {
  const std::vector<DosePoint> points{
      {1.0, 100000, 100000}, {2.0, 99999, 100000}, {3.0, 1, 100000}, {4.0, 0, 100000}};
  const LogisticFit fit = FitLogistic(points, FitScale::kLinear);
  ASSERT_EQ(fit.status, FitStatus::kFitted);
  EXPECT_NEAR(FindCrossing(fit, points, 0.5).x, 2.5, 1e-6);
  EXPECT_LT(fit.slope, -20.0);
}

}  // namespace
}  // namespace rockyard::statistics
