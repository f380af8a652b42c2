// What a drive tells of its course, where somebody asks for a trace.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "math/pose.h"
#include "messages/commands.h"
#include "messages/navigation_view.h"
#include "trial/clock/power.h"
#include "trial/drive/onboard.h"
#include "trial/drive/world.h"
#include "trial/eyes/terrain_sensing.h"
#include "truth/trace.h"

namespace rockyard::trial {

class DriveTracer {
 public:
  // Without a trace it does nothing. All outlive it; `told` as the observer's.
  DriveTracer(const World& world, const Onboard& onboard, const Ledger& ledger,
              std::vector<messages::Goal> told, truth::Trace* trace);

  void Event(std::string kind, std::string detail);
  // Reports of hazards that are believed, and every look that shows points.
  void Look(messages::LookDirection direction, const Percept& percept);
  // What was declared, and how far the rover truly is from there.
  void Waypoint(std::size_t index);
  // What came of a pair of images for visual odometry.
  void Vision(const VisualStep& step);
  // What was chosen among the motions that were voted for.
  void Votes(const messages::NavigationView& view);

  // A control tick.
  void Sample(Activity activity);
  // A moment between control ticks; `activity`: of the rest that ends here.
  void Rest(std::optional<Activity> activity, bool set_back = false);

 private:
  void Rocks();
  truth::TraceSample Now(std::string activity) const;

  const World& world_;
  const Onboard& onboard_;
  const Ledger& ledger_;
  std::vector<messages::Goal> told_places_;
  truth::Trace* trace_;
  std::vector<math::Vector3> rock_centers_;  // where the trace knows rocks that can move
};

}  // namespace rockyard::trial
