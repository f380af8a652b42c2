// The light stripe sensor at both levels of fidelity on the same scenes, point by point.
#pragma once

#include <array>

#include "scenario/scenario.h"
#include "sensing/light_stripe.h"
#include "terrain/terrain.h"
#include "trial/eyes/hazard_scanner.h"

namespace rockyard::trial {

// A rover that stands level somewhere on level ground, with any heading.
struct StripeScene {
  terrain::Terrain terrain;
  math::Transform X_WR;
  core::TrialKey key;
};

enum class SceneKind { kFlat, kRocks };

// Scene `index` of a family: flat ground, or a field of the scenario's rocks of its own. Rocks
// higher than 10 cm within 0.45 m of the rover's centre are where it would not have driven: the
// pose is drawn again, and another field where one rock is as large as all of it.
StripeScene MakeStripeScene(const scenario::Scenario& scenario, SceneKind kind,
                            std::uint32_t index);

// What became of the points that geometry alone (lines of percept without errors) shows or hides.
struct PointTally {
  static constexpr int kRight_px = 2;  // a column this near is right

  std::int64_t visible = 0;
  std::int64_t missed = 0;
  std::int64_t misplaced = 0;  // found more than kRight_px away
  std::int64_t hidden = 0;
  std::int64_t ghosts = 0;  // found where nothing is visible
  double offset_sum_px = 0.0;
  double offset_squares_px2 = 0.0;
  std::array<std::int64_t, 5> offsets{};  // of right ones, -2 to 2 pixels
  messages::StripeArray<std::int64_t> visible_at;
  messages::StripeArray<std::int64_t> missed_at;

  std::int64_t right() const { return visible - missed - misplaced; }
  double offset_mean_px() const { return offset_sum_px / static_cast<double>(right()); }
  double offset_deviation_px() const;

  void Add(const messages::StripeScan& truth, const messages::StripeScan& found);
};

// The sensor of the scenario at one level, and what it should see.
class LevelOfStripes {
 public:
  LevelOfStripes(scenario::Scenario scenario, sensing::Fidelity fidelity);

  messages::StripeScan Scan(const StripeScene& scene) const {
    return scanner_.Scan(scene.terrain, scene.X_WR, scene.key, 0);
  }

 private:
  HazardScanner scanner_;
};

// Points of the scenes [0, scenes) at one level against geometry without errors.
PointTally TallyPoints(const scenario::Scenario& scenario, sensing::Fidelity fidelity,
                       SceneKind kind, std::uint32_t scenes);

}  // namespace rockyard::trial
