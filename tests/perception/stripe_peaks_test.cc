// Averaged differences, peaks and their association with lasers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "perception/stripe_finder.h"
#include "perception/stripe_images.h"

namespace rockyard::perception {
namespace {

// The mean over the window's part inside the band, pixel by pixel.
double PlainAverage(const messages::StripeExposure& exposure, int row, int column, int window) {
  const messages::ImageBand& lit = exposure.lit[0];
  double sum = 0.0;
  int pixels = 0;
  for (int r = row - window / 2; r <= row + window / 2; ++r) {
    for (int c = column - window / 2; c <= column + window / 2; ++c) {
      if (r < lit.first_row || r >= lit.first_row + lit.rows) continue;
      if (c < lit.first_column || c >= lit.first_column + lit.columns) continue;
      sum += lit.At(r, c) - exposure.dark[0].At(r, c);
      ++pixels;
    }
  }
  return sum / pixels;
}

TEST(AverageDifferenceTest, IsThePlainMean) {
  core::RandomStream stream({20260401, 0}, core::Purpose::kTest);
  messages::StripeExposure exposure{0, 0, {EvenBand(0, 7, 40)}, {EvenBand(0, 7, 40)}};
  for (auto* band : {&exposure.lit[0], &exposure.dark[0]}) {
    for (auto& pixel : band->counts) pixel = static_cast<std::uint16_t>(stream.NextU32() % 256);
  }
  for (const int window : {1, 3, 5, 9}) {
    for (const int row : {197, 198, 200, 203}) {
      const auto profile = AverageDifference(exposure, row, window);
      ASSERT_TRUE(profile);
      ASSERT_EQ(profile->difference.size(), 40u);
      for (int i = 0; i < 40; ++i) {
        EXPECT_NEAR(profile->difference[static_cast<std::size_t>(i)],
                    PlainAverage(exposure, row, profile->first_column + i, window), 1e-9)
            << window << " " << row << " " << i;
      }
    }
  }
}

TEST(AverageDifferenceTest, ImageNarrowerThanTheWindow) {
  messages::StripeExposure exposure{0, 0, {EvenBand(9, 5, 2)}, {EvenBand(4, 5, 2)}};
  const auto profile = AverageDifference(exposure, 200, 9);
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->difference, (std::vector<double>{5.0, 5.0}));
}

TEST(AverageDifferenceTest, RowsOutsideTheBands) {
  EXPECT_FALSE(AverageDifference(DarkExposure(), 197, 5));
  EXPECT_TRUE(AverageDifference(DarkExposure(), 198, 5));
  EXPECT_TRUE(AverageDifference(DarkExposure(), 202, 5));
  EXPECT_FALSE(AverageDifference(DarkExposure(), 203, 5));
}

TEST(ScanlineProfileTest, NoiseIsTheDeviationOfANormalVariable) {
  EXPECT_NEAR((ScanlineProfile{0, {2.0, -2.0, 2.0, -2.0}}).Noise(),
              2.0 * std::sqrt(0.5 * std::numbers::pi), 1e-12);
  EXPECT_EQ(ScanlineProfile{}.Noise(), 0.0);
  core::RandomStream stream({20260402, 0}, core::Purpose::kTest);
  ScanlineProfile profile;
  for (int i = 0; i < 20000; ++i) {
    profile.difference.push_back(core::SampleNormal(stream, 0.0, 3.0));
  }
  // Standard error sqrt(pi / 2 - 1) / sqrt(20000) = 0.53 %; four of them, chance 6e-5.
  EXPECT_NEAR(profile.Noise(), 3.0, 4 * 0.0053 * 3.0);
}

TEST(FindPeaksTest, RunsAboveTheThreshold) {
  const ScanlineProfile profile{-3, {0, 2, 3, 2, 0, 0, 4, 4}};
  const auto peaks = FindPeaks(profile, {.threshold_counts = 1.0, .noise_multiple = 0.0});
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_EQ(peaks[0].column_px, -1.0);
  EXPECT_EQ(peaks[0].height_counts, 3.0);
  EXPECT_EQ(peaks[1].column_px, 4.0) << "half a pixel is rounded away from the axis";
  EXPECT_EQ(peaks[1].height_counts, 4.0);
}

// Searched part around a datum column.
StripeSearch Around(int datum, int half) {
  return {{datum - half, datum + half}, static_cast<double>(datum)};
}

using Found = std::vector<std::optional<std::size_t>>;

TEST(AssociatePeaksTest, SeparateSearchesTakeTheirOwn) {
  const std::vector<StripeSearch> lasers{Around(-50, 10), Around(50, 10)};
  const std::vector<StripePeak> peaks{{-45, 5}, {0, 9}, {52, 3}};
  EXPECT_EQ(AssociatePeaks(lasers, peaks, PeakChoice::kStrongest), (Found{0, 2}));
}

TEST(AssociatePeaksTest, OverlapKeepsTheOrder) {
  const std::vector<StripeSearch> lasers{Around(-10, 40), Around(10, 40)};
  // Each alone would take the other's: the left laser's strongest peak is the right one.
  const std::vector<StripePeak> peaks{{-20, 5}, {20, 9}};
  EXPECT_EQ(AssociatePeaks(lasers, peaks, PeakChoice::kStrongest), (Found{0, 1}));
}

TEST(AssociatePeaksTest, ThreePeaksForTwoLasers) {
  const std::vector<StripeSearch> lasers{Around(-10, 40), Around(10, 40)};
  const std::vector<StripePeak> peaks{{-20, 5}, {0, 4}, {20, 9}};
  EXPECT_EQ(AssociatePeaks(lasers, peaks, PeakChoice::kStrongest), (Found{0, 2}));
  EXPECT_EQ(AssociatePeaks(lasers, {peaks.data(), 2}, PeakChoice::kStrongest), (Found{0, 1}));
}

TEST(AssociatePeaksTest, OnePeakForTwoLasersGoesToTheNearerDatum) {
  const std::vector<StripeSearch> lasers{Around(-10, 40), Around(10, 40)};
  for (const auto choice : {PeakChoice::kStrongest, PeakChoice::kNearestToDatum}) {
    EXPECT_EQ(AssociatePeaks(lasers, std::vector<StripePeak>{{-4, 5}}, choice),
              (Found{0, std::nullopt}));
    EXPECT_EQ(AssociatePeaks(lasers, std::vector<StripePeak>{{4, 5}}, choice),
              (Found{std::nullopt, 0}));
  }
}

TEST(AssociatePeaksTest, NearestPrefersMorePeaksToNearerOnes) {
  const std::vector<StripeSearch> lasers{Around(-10, 40), Around(10, 40)};
  const std::vector<StripePeak> peaks{{-45, 1}, {-30, 9}, {-9, 1}};
  // Both are seen; of the left laser's two, the one nearer to its datum column.
  EXPECT_EQ(AssociatePeaks(lasers, peaks, PeakChoice::kNearestToDatum), (Found{1, 2}));
}

TEST(AssociatePeaksTest, NoPeaksAndEmptySearches) {
  const std::vector<StripeSearch> lasers{Around(0, 10), StripeSearch{}};
  EXPECT_EQ(AssociatePeaks(lasers, {}, PeakChoice::kStrongest),
            (Found{std::nullopt, std::nullopt}));
  EXPECT_EQ(AssociatePeaks(lasers, std::vector<StripePeak>{{0, 5}, {5, 5}}, PeakChoice::kStrongest),
            (Found{0, std::nullopt}));
}

}  // namespace
}  // namespace rockyard::perception
