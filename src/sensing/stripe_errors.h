// The measured error model of the light stripe sensor without images: points that are found off
// their column, not found, or found in the wrong place.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "messages/camera.h"
#include "messages/measurements.h"
#include "sensing/light_stripe_params.h"

namespace rockyard::sensing {

// Disturbs a scan in this order, each point on its own:
//   column    moved by a normal amount with deviation column_noise_px, rounded to whole pixels, and
//             kept inside the searched part
//   missed    not found with missed_probability, or with the point's own (missed_at)
//   misplaced at a random column with wrong_place_probability, also where nothing was visible
//
// Outliers that persist: from one scan to the next a point keeps, with outlier_persistence r, what
// happened to it (whether it is misplaced, and to which column); otherwise its lot is drawn anew.
// The share of misplaced points stays wrong_place_probability p; after a scan in which a point is
// misplaced it is so in the next with r + (1 - r) p, and both agree with r and more. Matthies 1995,
// section 6, counts on independence (r = 0, the default); figure 8's run shows a false alarm that
// two scans must have agreed on.
class StripeErrors {
 public:
  // The searched part of the scanline of each point.
  using Searched = messages::StripeArray<messages::ColumnRange>;

  explicit StripeErrors(const LightStripeParams& params) : params_(params) {}

  // Is a pure function of its arguments, whatever was scanned before: a lot that is older is looked
  // up by the number of the scan in which it was drawn. It draws from (kStripeColumnNoise,
  // kStripeMissed, kStripeWrongPlace; scan number) and, for persistence, (kStripePersistence; scan
  // number) back to the scan in which the last point's lot was drawn: 1 + log(points) / log(1 / r)
  // scans on average, of 0.5 us each. Errors of size zero draw nothing and cost nothing.
  void Disturb(core::TrialKey key, const Searched& searched, messages::StripeScan& scan) const;

 private:
  void MoveColumns(core::TrialKey key, const Searched& searched, messages::StripeScan& scan) const;
  void Miss(core::TrialKey key, messages::StripeScan& scan) const;
  void Misplace(core::TrialKey key, const Searched& searched, messages::StripeScan& scan) const;
  // Calls place(point, column) for every point that the draws of that scan misplace.
  template <typename Place>
  void DrawMisplaced(core::TrialKey key, std::int64_t number, const Searched& searched,
                     Place place) const;

  LightStripeParams params_;
};

}  // namespace rockyard::sensing
