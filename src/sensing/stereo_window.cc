#include "sensing/stereo_window.h"

#include <cmath>

namespace rockyard::sensing {

bool IsWanted(const StereoParams& params, const math::Vector3& p_RoP_R,
              messages::LookDirection direction) {
  if (params.field_of_view == StereoFieldOfView::kFull) return true;
  const StripeWindowParams& window = params.stripe_window;
  const double ahead_m = direction == messages::LookDirection::kAhead ? p_RoP_R.x() : -p_RoP_R.x();
  return ahead_m >= window.near_m && ahead_m <= window.far_m &&
         std::abs(p_RoP_R.y()) <= window.half_width_m;
}

}  // namespace rockyard::sensing
