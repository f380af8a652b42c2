// Images of different names share no noise. The seed is fixed; the bound is the two-sided quantile
// of a correlation at alpha = 1e-4.
#include "sensing/stripe_image_name.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "image_kit.h"
#include "rendering/image_readout.h"

namespace rockyard::sensing {
namespace {

constexpr core::TrialKey kKey{11, 5};
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
    readout.Read(row, readout.Pattern(name.camera, row.row, kFirst, kColumns, kKey), kFirst, 1.0,
                 kKey, name.number(), {}, counts);
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

}  // namespace
}  // namespace rockyard::sensing
