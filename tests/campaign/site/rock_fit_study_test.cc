// How often intervals of fitted laws cover the truth, how often a true law is refuted, and from
// how many rocks on the laws are told apart. The numbers are those of src/campaign/README.md.
#include <gtest/gtest.h>

#include <cstdio>

#include "campaign/site/catalogues.h"
#include "campaign/site/rock_fit.h"
#include "campaign/site/rock_fit_laws.h"

namespace rockyard::campaign {
namespace {

constexpr int kCatalogues = 1000;

core::RandomStream Stream(std::uint32_t number) { return {{23, number}, core::Purpose::kTest}; }

std::vector<double> Catalogue(bool moore, double k, const RockWindow& window,
                              std::uint32_t number) {
  return moore ? MooreCatalogue(k, window, Stream(number))
               : GolombekCatalogue(k, window, Stream(number));
}

// The window on which a law expects so many rocks from 0.1 to 1 m.
RockWindow WindowOf(bool moore, double k, double rocks) {
  const RockWindow one{1.0, 0.1, 1.0};
  const ClassedWindow classes(one);
  const double per_m2 =
      moore ? MooreWindowLaw(classes).Expected(k) : GolombekWindowLaw(classes).Expected(k);
  return {rocks / per_m2, 0.1, 1.0};
}

// 1000 catalogues: 95 % scatter by 0.7 %, so that 93 % lie 2.9 deviations below.
TEST(RockFitStudy, IntervalsCoverTheTruth) {
  for (const bool moore : {true, false}) {
    for (const double k : moore ? std::vector{0.00415} : std::vector{0.02, 0.069, 0.176}) {
      for (const double rocks : {20.0, 100.0, 500.0}) {
        const RockWindow window = WindowOf(moore, k, rocks);
        const ClassedWindow classes(window);
        const MooreWindowLaw of_moore(classes);
        const GolombekWindowLaw of_golombek(classes);
        const WindowLaw& law = moore ? static_cast<const WindowLaw&>(of_moore) : of_golombek;
        int covered = 0;
        for (std::uint32_t i = 0; i < kCatalogues; ++i) {
          RockCounts counts(classes.classes());
          for (const double d : Catalogue(moore, k, window, i)) classes.Count(d, counts);
          const statistics::Interval interval = law.IntervalOf(law.Fit(counts), counts);
          covered += interval.low <= k && k <= interval.high ? 1 : 0;
        }
        std::printf("%s k %g, %g rocks: covered %.3f\n", moore ? "moore" : "golombek", k, rocks,
                    covered / 1000.0);
        EXPECT_GE(covered, 930);
      }
    }
  }
}

// 300 catalogues of each law and size, 199 of their own for each: a true law is refuted in about
// 5 %, never in more than 9 % (3.2 deviations), and power grows with size.
TEST(RockFitStudy, LawsAreToldApartByTheirSizes) {
  constexpr int kOfEach = 300;
  for (const bool moore : {true, false}) {
    const double k = moore ? 0.00415 : 0.069;
    int last_power = 0;
    for (const double rocks : {20.0, 50.0, 100.0, 200.0, 400.0}) {
      const RockWindow window = WindowOf(moore, k, rocks);
      int true_refuted = 0;
      int told = 0;
      int done = 0;
      for (std::uint32_t i = 0; i < kOfEach; ++i) {
        const std::vector<double> catalogue = Catalogue(moore, k, window, 5000 + i);
        if (catalogue.size() < 5) continue;
        ++done;
        const LawVerdict verdict = FitRockLaws(catalogue, window, i, 199).verdict;
        const LawVerdict truth = moore ? LawVerdict::kMoore : LawVerdict::kGolombek;
        told += verdict == truth ? 1 : 0;
        true_refuted += verdict != truth && verdict != LawVerdict::kBoth ? 1 : 0;
      }
      std::printf("%s k %g, %g rocks: told %.3f, true law refuted %.3f of %d\n",
                  moore ? "moore" : "golombek", k, rocks, 1.0 * told / done,
                  1.0 * true_refuted / done, done);
      EXPECT_LE(true_refuted, 27);
      EXPECT_GE(told, last_power - 25);
      last_power = told;
    }
    EXPECT_GT(last_power, 240);
  }
}

}  // namespace
}  // namespace rockyard::campaign
