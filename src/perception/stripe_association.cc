#include "perception/stripe_association.h"

#include <cmath>

namespace rockyard::perception {
namespace {

// How good an assignment is: first by `main`, then by nearness to the datum columns.
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

// Best assignment of the first lasers to the first peaks, for all numbers of both. Dynamic
// programming over pairs in order, as in the alignment of two sequences: an entry (l, p) is the
// best of leaving peak p unused, leaving laser l unseen, and matching both.
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

std::vector<std::optional<std::size_t>> AssociatePeaks(std::span<const StripeSearch> searches,
                                                       std::span<const StripePeak> peaks,
                                                       PeakChoice choice) {
  return BestAssignments(searches, peaks, choice).Peaks(searches.size());
}

}  // namespace rockyard::perception
