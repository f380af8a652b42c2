// Counts the rocks that the terrain sensor had to see, and those that it let the rover drive onto,
// for the record of a drive. The kinds of sensors, the goal's rock and doubts about scenarios take
// its zones.
#pragma once

#include <cstdint>
#include <vector>

#include "math/pose.h"
#include "rover/rover_geometry_params.h"
#include "sensing/light_stripe_params.h"
#include "terrain/terrain.h"

namespace rockyard::trial {

// A rectangle in R, m.
struct Zone {
  double x_low_m = 0.0;
  double x_high_m = 0.0;
  double y_low_m = 0.0;
  double y_high_m = 0.0;
};

// Returns the zone from the front of the light stripe array to its farthest row, as wide as the
// outermost stripes.
Zone ArrayZone(const sensing::LightStripeParams& sensor);

// Returns whether the outline of a rock, as seen from above, reaches into a zone of a rover at
// X_WR, which is taken as level.
bool Reaches(const terrain::Rock& rock, const Zone& zone, const math::Transform& X_WR);

// A hazard is a rock of at least min_height_m. A hazard is met once its outline comes into the zone
// `view`. It is missed once the front of the rover or a row of wheels is over its outline, if no
// hazard was believed while it was in the zone: a believed hazard credits every rock in the zone at
// that pose, whichever rock raised it, so that missed() is a lower bound. Each rock counts once.
// Records depend on when it looks: after every kLook_m of motion or a turn of kLookCosine, whether
// or not the rover scans. A look costs some nanoseconds for each hazard of the field.
class HazardWatch {
 public:
  static constexpr double kLook_m = 0.05;
  static constexpr double kLookCosine = 0.99;  // 8 deg

  // `view` is what a hazard report covers (TerrainSensorKind::reported_zone).
  HazardWatch(const Zone& view, const rover::RoverGeometryParams& rover, double min_height_m,
              const terrain::Terrain& terrain);

  // Takes the pose after a control tick.
  void Observe(const math::Transform& X_WR);
  // Takes that a hazard is believed which was seen from this pose.
  void OnBelieved(const math::Transform& X_WR);

  std::int64_t met() const { return met_; }
  std::int64_t missed() const { return missed_; }

 private:
  struct Hazard {
    int rock = 0;
    bool met = false;
    bool settled = false;  // believed or missed
  };

  // Returns whether any zone could reach the rock.
  bool IsNear(const terrain::Rock& rock, const math::Transform& X_WR) const;
  void Look(const math::Transform& X_WR);

  const terrain::Terrain& terrain_;
  Zone view_;
  std::vector<Zone> front_and_wheels_;
  double reach_m_;  // of all zones about R's origin
  std::vector<Hazard> hazards_;
  math::Transform looked_from_X_WR_ = math::Transform::Identity();
  bool looked_ = false;
  std::int64_t met_ = 0;
  std::int64_t missed_ = 0;
};

}  // namespace rockyard::trial
