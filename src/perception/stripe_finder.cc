#include "perception/stripe_finder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/check.h"
#include "perception/triangulation.h"

namespace rockyard::perception {

namespace {

// Elevation grows or falls with the column all along the curve in which a scanline meets a light
// plane, so that the searched columns lie around the column nearest to the datum plane.
StripeSearch SearchAlong(const messages::StripeCalibration& calibration,
                         const Triangulator& triangulator, int camera, std::size_t row,
                         std::size_t stripe) {
  const int half = calibration.cameras[static_cast<std::size_t>(camera)].columns / 2;
  const auto elevation = [&](int column) {
    return triangulator.Elevation(row, stripe, static_cast<double>(column));
  };
  const auto searched = [&](int column) {
    const messages::ElevationPoint point = elevation(column);
    return point.detected && point.elevation_m >= calibration.search_low_m &&
           point.elevation_m <= calibration.search_high_m;
  };

  // Every column is tried: a lens may see the light plane behind the camera in some of them.
  int nearest = 0;
  double nearest_m = HUGE_VAL;
  for (int column = -half; column <= half; ++column) {
    const messages::ElevationPoint point = elevation(column);
    if (!point.detected || std::abs(point.elevation_m) >= nearest_m) continue;
    nearest_m = std::abs(point.elevation_m);
    nearest = column;
  }
  StripeSearch search;
  search.datum_column = nearest;
  // No column sees the light plane, or none within the searched elevations.
  if (nearest_m == HUGE_VAL || !searched(nearest)) return search;
  search.columns = {nearest, nearest};
  while (search.columns.first > -half && searched(search.columns.first - 1)) {
    --search.columns.first;
  }
  while (search.columns.last < half && searched(search.columns.last + 1)) ++search.columns.last;
  return search;
}

}  // namespace

StripeSearches::StripeSearches(const messages::StripeCalibration& calibration)
    : size_(calibration.size()) {
  for (int camera = 0; camera < static_cast<int>(calibration.cameras.size()); ++camera) {
    messages::StripeCalibration seen_by = calibration;
    // The calibration as if this camera measured all lasers.
    for (messages::StripeLaser& laser : seen_by.lasers) laser.camera = camera;
    const Triangulator triangulator(seen_by);
    for (std::size_t row = 0; row < size_.rows; ++row) {
      for (std::size_t stripe = 0; stripe < size_.stripes; ++stripe) {
        searches_.push_back(SearchAlong(seen_by, triangulator, camera, row, stripe));
      }
    }
  }
}

namespace {

using messages::ImageBand;

// Returns the lit less the dark image, summed over rows [first, last] of each column.
std::vector<std::int64_t> ColumnSums(const ImageBand& lit, const ImageBand& dark, int first_row,
                                     int last_row) {
  const auto columns = static_cast<std::size_t>(lit.columns);
  std::vector<std::int64_t> sums(columns, 0);
  for (int row = first_row; row <= last_row; ++row) {
    const std::size_t start = static_cast<std::size_t>(row - lit.first_row) * columns;
    for (std::size_t i = 0; i < columns; ++i) {
      sums[i] += static_cast<std::int64_t>(lit.counts[start + i]) - dark.counts[start + i];
    }
  }
  return sums;
}

StripePeak MakePeak(const ScanlineProfile& profile, std::size_t first, std::size_t last,
                    PeakColumn precision) {
  StripePeak peak;
  double weight = 0.0;
  double moment = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    peak.height_counts = std::max(peak.height_counts, profile.difference[i]);
    weight += profile.difference[i];
    moment += profile.difference[i] * static_cast<double>(i);
  }
  // Centre of brightness: sum d_i i / sum d_i over the run, in columns of the camera.
  const double centroid_px = profile.first_column + moment / weight;
  peak.column_px = precision == PeakColumn::kCentroid ? centroid_px : std::round(centroid_px);
  return peak;
}

// How good an assignment is: first by `main`, then by nearness to the datum columns. Must stay in
// this order: records depend on it.
struct Score {
  double main = 0.0;
  double distance_px = 0.0;

  Score operator+(const Score& other) const {
    return {main + other.main, distance_px + other.distance_px};
  }
  bool Beats(const Score& other) const {
    if (main != other.main) return main > other.main;
    return distance_px < other.distance_px;
  }
};

Score ScoreOf(const StripeSearch& search, const StripePeak& peak, PeakChoice choice) {
  // kStrongest adds brightnesses; kNearestToDatum counts peaks, so that most of them are explained.
  return {choice == PeakChoice::kStrongest ? peak.height_counts : 1.0,
          std::abs(peak.column_px - search.datum_column)};
}

// The best assignments of the first l lasers to the first p peaks, for all l and p, by dynamic
// programming as in the alignment of two sequences: an entry (l, p) is the best of leaving peak p
// unused, leaving laser l unseen, and matching both. On a tie the earlier of these three must stay:
// of two peaks that are equally good for a laser the left one is taken, and records depend on it.
class BestAssignments {
 public:
  BestAssignments(std::span<const StripeSearch> searches, std::span<const StripePeak> peaks,
                  PeakChoice choice)
      : peaks_(peaks.size()), entries_((searches.size() + 1) * (peaks.size() + 1)) {
    for (std::size_t laser = 1; laser <= searches.size(); ++laser) {
      for (std::size_t peak = 1; peak <= peaks.size(); ++peak) {
        const StripeSearch& search = searches[laser - 1];
        Entry& best = At(laser, peak);
        best = {At(laser, peak - 1).score, Last::kPeakUnused};
        if (At(laser - 1, peak).score.Beats(best.score)) {
          best = {At(laser - 1, peak).score, Last::kLaserUnseen};
        }
        // The laser's stripe cannot be there.
        if (!search.columns.Contains(peaks[peak - 1].column_px)) continue;
        const Score matched =
            At(laser - 1, peak - 1).score + ScoreOf(search, peaks[peak - 1], choice);
        if (matched.Beats(best.score)) best = {matched, Last::kMatched};
      }
    }
  }

  std::vector<std::optional<std::size_t>> Peaks(std::size_t lasers) const {
    std::vector<std::optional<std::size_t>> result(lasers);
    // Back from the last entry along the choices that made it.
    std::size_t peak = peaks_;
    for (std::size_t laser = lasers; laser > 0 && peak > 0;) {
      const Last last = entries_[laser * (peaks_ + 1) + peak].last;
      if (last == Last::kMatched) result[laser - 1] = peak - 1;
      if (last != Last::kPeakUnused) --laser;
      if (last != Last::kLaserUnseen) --peak;
    }
    return result;
  }

 private:
  enum class Last { kPeakUnused, kLaserUnseen, kMatched };
  struct Entry {
    Score score;
    Last last = Last::kPeakUnused;
  };

  Entry& At(std::size_t lasers, std::size_t peaks) {
    return entries_[lasers * (peaks_ + 1) + peaks];
  }

  std::size_t peaks_;
  std::vector<Entry> entries_;
};

}  // namespace

double ScanlineProfile::Noise() const {
  if (difference.empty()) return 0.0;
  double sum = 0.0;
  for (const double value : difference) sum += std::abs(value);
  // E|d| = sigma sqrt(2 / pi) for a normal d of mean zero.
  return std::sqrt(0.5 * std::numbers::pi) * sum / static_cast<double>(difference.size());
}

std::optional<ScanlineProfile> AverageDifference(const messages::StripeExposure& exposure, int row,
                                                 int window_px) {
  const auto holds_row = [row](const ImageBand& band) {
    return row >= band.first_row && row < band.first_row + band.rows;
  };
  const auto found = std::ranges::find_if(exposure.lit, holds_row);
  if (found == exposure.lit.end()) return std::nullopt;
  const ImageBand& lit = *found;
  const ImageBand& dark = exposure.dark[static_cast<std::size_t>(found - exposure.lit.begin())];
  EXPECT(dark.counts.size() == lit.counts.size() && dark.first_row == lit.first_row);

  const int half = window_px / 2;
  const int first_row = std::max(row - half, lit.first_row);
  const int last_row = std::min(row + half, lit.first_row + lit.rows - 1);
  const std::vector<std::int64_t> sums = ColumnSums(lit, dark, first_row, last_row);

  ScanlineProfile profile{lit.first_column, std::vector<double>(sums.size())};
  std::int64_t sum = 0;
  for (int i = 0; i < std::min(half, lit.columns); ++i) sum += sums[static_cast<std::size_t>(i)];
  for (int i = 0; i < lit.columns; ++i) {
    // Running sum over columns i - half .. i + half, cut at the borders. In whole numbers no
    // rounding accumulates.
    const int enters = i + half;
    const int leaves = i - half - 1;
    if (enters < lit.columns) sum += sums[static_cast<std::size_t>(enters)];
    if (leaves >= 0) sum -= sums[static_cast<std::size_t>(leaves)];
    const int columns = std::min(i + half, lit.columns - 1) - std::max(i - half, 0) + 1;
    profile.difference[static_cast<std::size_t>(i)] =
        static_cast<double>(sum) / (columns * (last_row - first_row + 1));
  }
  return profile;
}

std::vector<StripePeak> FindPeaks(const ScanlineProfile& profile,
                                  const StripeFinderParams& params) {
  // The larger of a fixed threshold and a multiple of the noise, in counts.
  const double threshold =
      std::max(params.threshold_counts, params.noise_multiple * profile.Noise());
  std::vector<StripePeak> peaks;
  const std::size_t columns = profile.difference.size();
  for (std::size_t first = 0; first < columns; ++first) {
    // A peak runs as long as columns exceed the threshold.
    if (profile.difference[first] <= threshold) continue;
    std::size_t last = first;
    while (last + 1 < columns && profile.difference[last + 1] > threshold) ++last;
    peaks.push_back(MakePeak(profile, first, last, params.column));
    first = last;
  }
  return peaks;
}

std::vector<std::optional<std::size_t>> AssociatePeaks(std::span<const StripeSearch> searches,
                                                       std::span<const StripePeak> peaks,
                                                       PeakChoice choice) {
  return BestAssignments(searches, peaks, choice).Peaks(searches.size());
}

StripeFinder::StripeFinder(const StripeFinderParams& params,
                           const messages::StripeCalibration& calibration)
    : params_(params), calibration_(calibration), searches_(calibration) {}

messages::ColumnRange StripeFinder::searched(std::size_t row, std::size_t stripe) const {
  return searches_.At(calibration_.lasers[stripe].camera, row, stripe).columns;
}

// Finds the points of one scanline in one exposure: average, threshold, peaks, and which peak is
// which laser's.
void StripeFinder::FindIn(const messages::StripeExposure& exposure, std::size_t row,
                          messages::StripeScan& scan) const {
  const auto profile = AverageDifference(exposure, calibration_.scanline_px[row],
                                         static_cast<int>(params_.averaging_px));
  if (!profile) return;
  // Lasers that the other camera measures show in the images of this camera, too.
  std::vector<std::size_t> lit;
  std::vector<StripeSearch> searches;
  for (std::size_t stripe = 0; stripe < calibration_.lasers.size(); ++stripe) {
    if (calibration_.lasers[stripe].group != exposure.group) continue;
    lit.push_back(stripe);
    searches.push_back(searches_.At(exposure.camera, row, stripe));
  }
  // All lasers of the image take part in the association; only those that this camera measures are
  // kept.
  const std::vector<StripePeak> peaks = FindPeaks(*profile, params_);
  const auto peak_of = AssociatePeaks(searches, peaks, params_.peak);
  for (std::size_t i = 0; i < lit.size(); ++i) {
    // Peaks of lasers that the other camera measures are used up, and not kept.
    if (!peak_of[i] || calibration_.lasers[lit[i]].camera != exposure.camera) continue;
    scan.pixels[row][lit[i]] = {.detected = true, .column_px = peaks[*peak_of[i]].column_px};
  }
}

messages::StripeScan StripeFinder::Find(const messages::StripeImages& images) const {
  const messages::StripeArraySize size = calibration_.size();
  messages::StripeScan scan{images.number, messages::StripeArray<messages::StripePixel>(size)};
  for (const messages::StripeExposure& exposure : images.exposures) {
    for (std::size_t row = 0; row < size.rows; ++row) FindIn(exposure, row, scan);
  }
  return scan;
}

}  // namespace rockyard::perception
