// The rover's hazard detection at one pose: scans, triangulation, criteria and two-scan rule, as in
// the closed loop; and scenes with one rock. The studies of rocks, fields and false alarms look
// with it.
//
// Scenes with one rock lie on flat sand before a rover that drives straight on. World: the course
// runs along x, and the circle around the rock (its largest diameter) begins at x = 0. The rover's
// front is sensors.light_stripe.front_x_m ahead of its centre.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "experiments/hazard_detection/hazard_detection_params.h"
#include "math/pose.h"
#include "messages/estimates.h"
#include "perception/hazard_detector.h"
#include "perception/hazard_params.h"
#include "perception/triangulation.h"
#include "terrain/rock.h"
#include "terrain/rock_params.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"
#include "trial/eyes/hazard_scanner.h"
#include "trial/watchers.h"

namespace rockyard::experiments {

// What the rover makes of one pose.
struct Percept {
  explicit Percept(std::size_t stripes) : first(stripes), believed(stripes) {}

  std::int64_t scans = 0;
  perception::HazardFindings first;    // by the first scan alone
  messages::PerStripe<bool> believed;  // stripes charged under the rule of the scenario
};

// The sensor and the on-board software of one scenario. `watcher` is shown each scan.
class HazardJudge {
 public:
  explicit HazardJudge(const trial::DriveParams& drive, trial::ScanWatcher watcher = {});

  std::size_t stripes() const { return stripes_; }

  // Returns the elevations of one scan at X_WR. Draws the sensor's noise of that scan number.
  messages::ElevationScan Scan(const terrain::Terrain& terrain, const math::Transform& X_WR,
                               core::TrialKey key, std::int64_t scan_number) const;

  // Returns what the rover makes of one pose by scans numbered from `first_scan`, as many as the
  // rule needs. Draws the sensor's noise for these numbers only: the same noise on every terrain.
  Percept Look(const terrain::Terrain& terrain, const math::Transform& X_WR, core::TrialKey key,
               std::int64_t first_scan) const;

  const perception::HazardParams& hazard() const { return hazard_; }

 private:
  perception::HazardParams hazard_;
  trial::HazardScanner scanner_;
  perception::Triangulator triangulator_;
  std::size_t stripes_;
};

// Returns the stripes that are charged in `a` and not in `b`.
inline messages::PerStripe<bool> ChargedOnlyIn(const messages::PerStripe<bool>& a,
                                               const messages::PerStripe<bool>& b) {
  messages::PerStripe<bool> only(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) only[i] = a[i] && !b[i];
  return only;
}

inline bool Any(const messages::PerStripe<bool>& flags) {
  for (const bool flag : flags) {
    if (flag) return true;
  }
  return false;
}

// The rocks of a cell; diameter_m is not read where proportions are natural.
struct RockCell {
  double height_m = 0.0;
  double diameter_m = 0.0;
  double lateral_offset_m = 0.0;
};

// Returns a rock of the cell's height above the ground, its nearest end at x = 0. Width, burial,
// yaw and profile follow the laws of the terrain's rocks; half its full height is c = h / (2 (1 -
// burial)), and for natural proportions its diameter is 2 c / height ratio. Records depend on the
// draws: four numbers, in the order width, height ratio, burial, yaw, whatever the proportions.
terrain::Rock DrawSceneRock(const RockCell& cell, RockProportions proportions,
                            const terrain::RockFieldParams& law, double lateral_m,
                            core::RandomStream& stream);

// Returns flat sand with the rock, or without one where the height is 0.
terrain::Terrain SceneTerrain(const terrain::Rock& rock);

// Returns the pose of the rover on flat ground, its front `gap_m` before x = 0, on a straight line
// that meets x = 0 at y = 0 under its heading.
math::Transform PoseBefore(double gap_m, double heading_rad, double front_x_m);

}  // namespace rockyard::experiments
