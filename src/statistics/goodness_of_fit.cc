#include "statistics/goodness_of_fit.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <vector>

#include "core/check.h"

namespace rockyard::statistics {
namespace {

struct Bin {
  double observed = 0.0;
  double expected = 0.0;
};

// Neighbouring bins together until they expect enough; what is left at the end joins the last.
std::vector<Bin> Pool(std::span<const double> observed, std::span<const double> expected,
                      double min_expected) {
  std::vector<Bin> bins;
  Bin open;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    open.observed += observed[i];
    open.expected += expected[i];
    if (open.expected >= min_expected) {
      bins.push_back(open);
      open = {};
    }
  }
  if (bins.empty()) return {open};
  bins.back().observed += open.observed;
  bins.back().expected += open.expected;
  return bins;
}

}  // namespace

double ChiSquareTail(double statistic, int degrees_of_freedom) {
  EXPECT(degrees_of_freedom > 0 && statistic >= 0.0);
  return boost::math::cdf(boost::math::complement(
      boost::math::chi_squared(static_cast<double>(degrees_of_freedom)), statistic));
}

ChiSquareResult ChiSquareGoodnessOfFit(std::span<const double> observed,
                                       std::span<const double> expected, int fitted,
                                       double min_expected) {
  EXPECT(observed.size() == expected.size() && !observed.empty());
  EXPECT(min_expected > 0.0);
  const std::vector<Bin> bins = Pool(observed, expected, min_expected);
  ChiSquareResult result;
  for (const Bin& bin : bins) {
    const double difference = bin.observed - bin.expected;
    // Pearson: sum (O - E)^2 / E. A bin that expects and holds nothing adds nothing.
    if (difference != 0.0) result.statistic += difference * difference / bin.expected;
  }
  // Bins less one for the common total, less one for each fitted parameter.
  result.degrees_of_freedom = static_cast<int>(bins.size()) - 1 - fitted;
  if (result.degrees_of_freedom >= 1) {
    result.p_value = ChiSquareTail(result.statistic, result.degrees_of_freedom);
  }
  return result;
}

}  // namespace rockyard::statistics
