// Counts the rocks that the hazard sensor had to see, and those that it let the rover drive onto.
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

// From the front of the light stripe array to its farthest row, as wide as the outermost stripes.
Zone ArrayZone(const sensing::LightStripeParams& sensor);

// Whether the outline of a rock, as seen from above, reaches into a zone of a rover at X_WR, which
// is taken as level.
bool Reaches(const terrain::Rock& rock, const Zone& zone, const math::Transform& X_WR);

// A hazard is a rock of at least min_height_m. It is met once its outline comes within reach of the
// array: from the front of the rover to the farthest row, as wide as the outermost stripes. It is
// missed once the front of the rover or a row of wheels is over its outline, if no hazard was
// believed while it was within reach: one that is believed credits every rock within reach at that
// pose, whichever raised it, so that missed() is a lower bound. Each rock counts once. Scenes are
// looked at every kLook_m of motion or a turn of kLookCosine, whether or not the rover scans; a
// look costs some nanoseconds for each hazard of the field.
class HazardWatch {
 public:
  static constexpr double kLook_m = 0.05;
  static constexpr double kLookCosine = 0.99;  // 8 deg

  // `view` is what the array covers.
  HazardWatch(const Zone& view, const rover::RoverGeometryParams& rover, double min_height_m,
              const terrain::Terrain& terrain);

  // Once a control tick.
  void Observe(const math::Transform& X_WR);
  // A hazard is believed at this pose.
  void OnBelieved(const math::Transform& X_WR);

  std::int64_t met() const { return met_; }
  std::int64_t missed() const { return missed_; }

 private:
  struct Hazard {
    int rock = 0;
    bool met = false;
    bool settled = false;  // believed or missed
  };

  // Whether any zone could reach the rock.
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
