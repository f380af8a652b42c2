#include "sensing/stripe_errors.h"

#include <algorithm>
#include <cmath>

#include "core/distributions.h"

namespace rockyard::sensing {
namespace {

using messages::ColumnRange;
using messages::StripePixel;

std::uint32_t Substream(std::int64_t number) { return static_cast<std::uint32_t>(number); }

}  // namespace

void StripeErrors::Disturb(core::TrialKey key, const Searched& searched,
                           messages::StripeScan& scan) const {
  if (params_.column_noise_px > 0.0) MoveColumns(key, searched, scan);
  if (params_.missed_probability > 0.0 || !params_.missed_at.empty()) Miss(key, scan);
  if (params_.wrong_place_probability > 0.0) Misplace(key, searched, scan);
}

void StripeErrors::MoveColumns(core::TrialKey key, const Searched& searched,
                               messages::StripeScan& scan) const {
  core::RandomStream stream(key, core::Purpose::kStripeColumnNoise, Substream(scan.number));
  const auto pixels = scan.pixels.points();
  for (std::size_t point = 0; point < pixels.size(); ++point) {
    // Drawn for every point, found or not: what a scan sees shifts no other point's noise.
    const double shift = std::round(core::SampleNormal(stream, 0.0, params_.column_noise_px));
    if (!pixels[point].detected || searched.points()[point].empty()) continue;
    pixels[point].column_px = std::clamp(pixels[point].column_px + shift,
                                         static_cast<double>(searched.points()[point].first),
                                         static_cast<double>(searched.points()[point].last));
  }
}

// Found points are dropped; the draw does not depend on what was found.
void StripeErrors::Miss(core::TrialKey key, messages::StripeScan& scan) const {
  core::RandomStream missed(key, core::Purpose::kStripeMissed, Substream(scan.number));
  const auto pixels = scan.pixels.points();
  for (std::size_t point = 0; point < pixels.size(); ++point) {
    const double probability =
        params_.missed_at.empty() ? params_.missed_probability : params_.missed_at[point];
    if (core::SampleBernoulli(missed, probability)) pixels[point] = {};
  }
}

template <typename Place>
void StripeErrors::DrawMisplaced(core::TrialKey key, std::int64_t number, const Searched& searched,
                                 Place place) const {
  const int last_column = static_cast<int>(params_.columns / 2);
  core::RandomStream wrong(key, core::Purpose::kStripeWrongPlace, Substream(number));
  messages::StripeArray<bool> misplaced(searched.size());
  // All lots first, then the columns of those that are misplaced.
  for (bool& point : misplaced.points()) {
    point = core::SampleBernoulli(wrong, params_.wrong_place_probability);
  }
  for (std::size_t point = 0; point < misplaced.points().size(); ++point) {
    const ColumnRange range = params_.wrong_place == WrongPlace::kSearchedPart
                                  ? searched.points()[point]
                                  : ColumnRange{-last_column, last_column};
    if (!misplaced.points()[point] || range.empty()) continue;
    // A whole column from first to last, all equally likely.
    place(point, std::floor(core::SampleUniform(wrong, range.first, range.last + 1.0)));
  }
}

void StripeErrors::Misplace(core::TrialKey key, const Searched& searched,
                            messages::StripeScan& scan) const {
  const auto pixels = scan.pixels.points();
  if (params_.outlier_persistence <= 0.0) {
    DrawMisplaced(key, scan.number, searched, [&](std::size_t point, double column) {
      pixels[point] = {.detected = true, .column_px = column};
    });
    return;
  }
  // Points whose lot was drawn in an earlier scan than those looked at so far.
  messages::StripeArray<bool> older(searched.size());
  for (bool& point : older.points()) point = true;
  std::size_t left = pixels.size();
  for (std::int64_t number = scan.number; left > 0; --number) {
    messages::StripeArray<bool> drawn_here(searched.size());
    const std::size_t left_before = left;
    core::RandomStream kept(key, core::Purpose::kStripePersistence, Substream(number));
    for (std::size_t point = 0; point < pixels.size(); ++point) {
      // Going back in time: a point that does not keep its lot in scan `number` had it drawn there.
      // Scan 0 always draws. Every point draws in every scan, so no point shifts another one's lot.
      const bool keeps = core::SampleBernoulli(kept, params_.outlier_persistence) && number > 0;
      if (keeps || !older.points()[point]) continue;
      drawn_here.points()[point] = true;
      older.points()[point] = false;
      --left;
    }
    if (left == left_before) continue;
    DrawMisplaced(key, number, searched, [&](std::size_t point, double column) {
      if (drawn_here.points()[point]) pixels[point] = {.detected = true, .column_px = column};
    });
  }
}

}  // namespace rockyard::sensing
