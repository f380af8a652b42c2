// Fits of laws to catalogues that follow them, and to some that follow none. Fixed seeds.
#include "campaign/site/rock_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "campaign/site/catalogues.h"
#include "campaign/site/rock_fit_laws.h"
#include "core/error.h"

namespace rockyard::campaign {
namespace {

constexpr double kK = 0.00415;    // Matthies 1995, nominal
constexpr double kCover = 0.069;  // Viking Lander 1
constexpr int kSamples = 99;      // the smallest p is 0.01
constexpr RockWindow kWide{800.0, 0.1, 1.0};

core::RandomStream Stream(std::uint32_t number) { return {{19, number}, core::Purpose::kTest}; }

RockCounts CountsOf(const std::vector<double>& diameters_m, const ClassedWindow& window) {
  RockCounts counts(window.classes());
  for (const double diameter_m : diameters_m) window.Count(diameter_m, counts);
  return counts;
}

// Of n rocks the most likely k expects n, and its interval is that of a Poisson number (for 20
// by tables 12.217 and 30.888).
TEST(RockFitTest, MooresKIsTheNumberOfRocks) {
  const RockWindow window{10.0, 0.1, 1.0};
  std::vector<double> diameters_m(20, 0.2);
  diameters_m.push_back(0.09);
  diameters_m.push_back(1.0);
  const RockFit fit = FitRockLaws(diameters_m, window, 1, kSamples);
  EXPECT_EQ(fit.rocks, 20);
  EXPECT_EQ(fit.left_out, 2);
  const double of_one = 10.0 * (std::pow(0.1, -2.66) - 1.0);
  EXPECT_NEAR(fit.moore.k, 20.0 / of_one, 1e-12);
  EXPECT_NEAR(fit.moore.interval.low, 12.217 / of_one, 1e-6);
  EXPECT_NEAR(fit.moore.interval.high, 30.888 / of_one, 1e-6);
  EXPECT_FALSE(fit.golombek.at_bound);
}

// ln L by sums over thin slices of the window: without the constant sum ln D^-2.
double LogLikelihoodBySlices(double cover, const std::vector<double>& diameters_m,
                             const RockWindow& window) {
  const double q = 1.79 + 0.152 / cover;
  const double factor = 4.0 / std::numbers::pi * cover * q;
  double sum = 0.0;
  for (const double d : diameters_m) sum += std::log(factor) - q * d;
  constexpr int kSlices = 20000;
  const double step = std::log(window.max_m / window.min_m) / kSlices;
  for (int i = 0; i < kSlices; ++i) {
    const double d = window.min_m * std::exp((i + 0.5) * step);
    sum -= window.area_m2 * factor * std::exp(-q * d) / d * step;
  }
  return sum;
}

TEST(RockFitTest, TheCoverIsTheMostLikelyAndItsIntervalWhatIsNearlyAsLikely) {
  const RockWindow window{60.0, 0.1, 1.0};
  const std::vector<double> rocks = GolombekCatalogue(kCover, window, Stream(1));
  const LawFit fit = FitRockLaws(rocks, window, 1, kSamples).golombek;
  const double most = LogLikelihoodBySlices(fit.k, rocks, window);
  // Half of the 95 % quantile of chi squared.
  EXPECT_NEAR(most - LogLikelihoodBySlices(fit.interval.low, rocks, window), 1.9207, 1e-3);
  EXPECT_NEAR(most - LogLikelihoodBySlices(fit.interval.high, rocks, window), 1.9207, 1e-3);
  for (double cover = 0.001; cover < 0.9; cover *= 1.1) {
    EXPECT_LT(LogLikelihoodBySlices(cover, rocks, window), most + 1e-6) << cover;
  }
}

// Golden section needs a single peak.
TEST(RockFitTest, TheLikelihoodOfACoverHasOnePeak) {
  for (const RockWindow& window : {RockWindow{60.0, 0.1, 1.0}, RockWindow{1e5, 1.5, 5.0}}) {
    const ClassedWindow classes(window);
    const GolombekWindowLaw law(classes);
    for (const double d : {1.0, 1.5, 2.5}) {
      const RockCounts counts = CountsOf(std::vector<double>(30, d * window.min_m), classes);
      int turns = 0;
      bool rose = true;
      double last = law.LogLikelihood(GolombekWindowLaw::kLeastCover, counts);
      for (double cover = 1.02 * GolombekWindowLaw::kLeastCover; cover < 1.0; cover *= 1.02) {
        const double next = law.LogLikelihood(cover, counts);
        turns += (next > last) == rose ? 0 : 1;
        rose = next > last;
        last = next;
      }
      EXPECT_LE(turns, 1) << d << " " << window.min_m;
    }
  }
}

TEST(RockFitTest, CatalogueOfALawIsTold) {
  const RockFit moore = FitRockLaws(MooreCatalogue(kK, kWide, Stream(2)), kWide, 3, kSamples);
  EXPECT_EQ(moore.verdict, LawVerdict::kMoore) << moore.sentence;
  EXPECT_NEAR(moore.moore.k / kK, 1.0, 0.08);  // three deviations of 1500 rocks
  EXPECT_NEAR(moore.moore.expected_cover, 0.0474, 0.08 * 0.0474);
  const RockFit golombek =
      FitRockLaws(GolombekCatalogue(kCover, kWide, Stream(3)), kWide, 3, kSamples);
  EXPECT_EQ(golombek.verdict, LawVerdict::kGolombek) << golombek.sentence;
  EXPECT_NEAR(golombek.golombek.k / kCover, 1.0, 0.1);
  EXPECT_EQ(golombek.moore.against_p, 0.01);  // none of the 99 speaks as much for Golombek
  EXPECT_GT(golombek.golombek.against_p, 0.05);
  EXPECT_EQ(moore.golombek.against_p, 0.01);
  EXPECT_GT(moore.moore.against_p, 0.05);
  EXPECT_GT(golombek.golombek.log_likelihood, golombek.moore.log_likelihood);
  EXPECT_GT(golombek.golombek.interval.high, kCover);
  EXPECT_LT(golombek.golombek.interval.low, kCover);
}

// Catalogues of some 11 rocks: at 20 rocks 62 % speak for both laws (rock_fit_study_test.cc).
TEST(RockFitTest, AFewRocksSeldomTellTheLaw) {
  const RockWindow window{6.0, 0.1, 1.0};
  int both = 0;
  for (std::uint32_t i = 0; i < 30; ++i) {
    const std::vector<double> rocks = MooreCatalogue(kK, window, Stream(2000 + i));
    ASSERT_GE(rocks.size(), 5u);
    both += FitRockLaws(rocks, window, 3, kSamples).verdict == LawVerdict::kBoth ? 1 : 0;
  }
  EXPECT_GT(both, 15);
}

// A law is refuted where either test refutes it, and the likelihood alone does so in some
// catalogues of 100 rocks.
TEST(RockFitTest, EitherTestRefutesALaw) {
  const RockWindow window{52.0, 0.1, 1.0};
  int by_likelihood_alone = 0;
  for (std::uint32_t i = 0; i < 15; ++i) {
    const RockFit fit =
        FitRockLaws(MooreCatalogue(kK, window, Stream(3000 + i)), window, i, kSamples);
    const bool by_classes = fit.golombek.fit_p < 0.025;
    const bool by_likelihood = fit.golombek.against_p < 0.025;
    by_likelihood_alone += by_likelihood && !by_classes ? 1 : 0;
    const bool refuted = fit.verdict == LawVerdict::kMoore || fit.verdict == LawVerdict::kNeither;
    EXPECT_EQ(refuted, by_classes || by_likelihood) << fit.sentence;
  }
  EXPECT_GT(by_likelihood_alone, 0);
}

// Two rocks in the first of two classes, none in the second: 2 (2 ln (2 / e1) - (2 - e1) + e2).
TEST(RockFitTest, DevianceIsThatOfPoissonCounts) {
  const RockWindow window{10.0, 0.1, 0.2};
  const ClassedWindow classes(window);
  ASSERT_EQ(classes.classes(), 2u);
  const MooreWindowLaw law(classes);
  const RockCounts counts = CountsOf({0.11, 0.13}, classes);
  const double bound = 0.1 * std::numbers::sqrt2;
  const double k = 0.001;
  const double first = 10.0 * k * (std::pow(0.1, -2.66) - std::pow(bound, -2.66));
  const double second = 10.0 * k * (std::pow(bound, -2.66) - std::pow(0.2, -2.66));
  EXPECT_NEAR(law.Deviance(k, counts), 2.0 * (2.0 * std::log(2.0 / first) - (2.0 - first) + second),
              1e-9);
}

// Rocks below 14 cm overlooked, and sizes of no law.
TEST(RockFitTest, OtherCataloguesFitNeither) {
  std::vector<double> overlooked;
  for (const double d : MooreCatalogue(kK, kWide, Stream(5))) {
    if (d > 0.14) overlooked.push_back(d);
  }
  EXPECT_EQ(FitRockLaws(overlooked, kWide, 3, kSamples).verdict, LawVerdict::kNeither);
  std::vector<double> uniform;
  for (int i = 0; i < 90; ++i) uniform.push_back(0.1 + 0.01 * i);
  EXPECT_EQ(FitRockLaws(uniform, kWide, 3, kSamples).verdict, LawVerdict::kNeither);
}

// 300 catalogues of some 80 rocks: at 95 % fewer than 92 % come by chance in 1.4 % of such tests.
TEST(RockFitTest, IntervalsCoverTheTruth) {
  const RockWindow window{50.0, 0.1, 1.0};
  const ClassedWindow classes(window);
  const MooreWindowLaw moore(classes);
  const GolombekWindowLaw golombek(classes);
  int moore_covers = 0;
  int golombek_covers = 0;
  int other_covers = 0;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const auto covers = [](const WindowLaw& law, const RockCounts& counts, double truth) {
      const statistics::Interval interval = law.IntervalOf(law.Fit(counts), counts);
      return interval.low <= truth && truth <= interval.high ? 1 : 0;
    };
    const RockCounts of_moore = CountsOf(MooreCatalogue(kK, window, Stream(100 + i)), classes);
    const RockCounts of_golombek =
        CountsOf(GolombekCatalogue(kCover, window, Stream(1000 + i)), classes);
    moore_covers += covers(moore, of_moore, kK);
    golombek_covers += covers(golombek, of_golombek, kCover);
    other_covers += covers(golombek, of_golombek, 1.3 * kCover);
  }
  EXPECT_GE(moore_covers, 276);
  EXPECT_GE(golombek_covers, 276);
  EXPECT_LT(other_covers, 240);  // negative control
}

TEST(RockFitTest, ClassesEndWithTheWindowAndHoldAllRocks) {
  const std::vector<double> rocks = MooreCatalogue(kK, kWide, Stream(6));
  const RockFit fit = FitRockLaws(rocks, kWide, 3, kSamples);
  std::int64_t seen = 0;
  double moore = 0.0;
  double last_m = kWide.min_m;
  for (const RockClass& c : fit.classes) {
    EXPECT_EQ(c.from_m, last_m);
    EXPECT_LE(c.interval.low, static_cast<double>(c.observed));
    EXPECT_GE(c.interval.high, static_cast<double>(c.observed));
    last_m = c.to_m;
    seen += c.observed;
    moore += c.expected_moore;
  }
  EXPECT_EQ(last_m, kWide.max_m);
  EXPECT_EQ(seen, fit.rocks);
  EXPECT_NEAR(moore, static_cast<double>(fit.rocks), 1e-6);
  EXPECT_GT(fit.classes.size(), 5u);
}

TEST(RockFitTest, TextAndTableSayTheSame) {
  const RockWindow window{20.0, 0.1, 1.0};
  const RockFit fit = FitRockLaws(MooreCatalogue(kK, window, Stream(7)), window, 3, kSamples);
  const std::string text = RockFitText(fit);
  EXPECT_THAT(text, testing::HasSubstr(fit.sentence));
  EXPECT_THAT(text, testing::HasSubstr("terrain.rocks.cover"));
  EXPECT_THAT(text, testing::HasSubstr(std::to_string(fit.rocks) + " rocks from 0.1 to 1 m"));
  const std::string csv = RockFitCsv(fit);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            fit.classes.size() + 1);
  // The same catalogues for the same seed, whatever ran before.
  EXPECT_EQ(text,
            RockFitText(FitRockLaws(MooreCatalogue(kK, window, Stream(7)), window, 3, kSamples)));
}

TEST(RockFitTest, WhatCannotBeFittedIsAUserError) {
  const std::vector<double> rocks{0.2, 0.2, 0.2, 0.2, 0.05};
  EXPECT_THROW(FitRockLaws(rocks, {10.0, 0.1, 1.0}, 1, kSamples), core::UserError);
  EXPECT_THROW(FitRockLaws(rocks, {0.0, 0.01, 1.0}, 1, kSamples), core::UserError);
  EXPECT_THROW(FitRockLaws(rocks, {10.0, 0.0, 1.0}, 1, kSamples), core::UserError);
  EXPECT_THROW(FitRockLaws(rocks, {10.0, 0.2, 0.2}, 1, kSamples), core::UserError);
  EXPECT_NO_THROW(FitRockLaws(rocks, {10.0, 0.01, 1.0}, 1, kSamples));
}

}  // namespace
}  // namespace rockyard::campaign
