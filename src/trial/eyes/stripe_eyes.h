// The light stripe sensor of a rover on the world's side: a pose in, a scan or images out. Drives
// look with it, and HazardScanner for studies.
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "sensing/light_stripe.h"
#include "sensing/stripe_imager.h"
#include "trial/drive_params.h"
#include "trial/eyes/terrain_sensor.h"

namespace rockyard::trial {

// One interface for both fidelities (sensors.light_stripe.fidelity): `geometric` is
// sensing::LightStripe, rays with a measured error model, which gives a scan; `image` is
// sensing::StripeImager, cameras and lasers down to digital numbers, which gives images.
class StripeEyes final : public TerrainSensor {
 public:
  StripeEyes(const DriveParams& drive, core::TrialKey key);

  // Nothing is measured behind. A look costs some microseconds, or some milliseconds with images.
  LookData Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                messages::LookDirection direction, std::int64_t number) const override;

  // Looks ahead as the sensor of the trial that `key` names.
  LookData Scan(const terrain::Terrain& terrain, const math::Transform& X_WR, core::TrialKey key,
                std::int64_t scan_number) const;

 private:
  core::TrialKey key_;
  // One of these two is set, by the fidelity.
  std::optional<sensing::LightStripe> geometric_;
  std::optional<sensing::StripeImager> image_;
};

}  // namespace rockyard::trial
