// What a drive tells of its course where somebody asks for a trace: Drive calls the tracer at every
// tick, rest and event. Must stay: the texts of activities and events, which truth/trace.h lists.
// No record depends on it.
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
#include "trial/sight/terrain_sensing.h"
#include "truth/trace.h"

namespace rockyard::trial {

// Writes the trace of one drive; without a trace it does nothing.
class DriveTracer {
 public:
  // All references outlive it. `told`: the waypoints, then the goal, as the rover is told.
  DriveTracer(const World& world, const Onboard& onboard, const Ledger& ledger,
              std::vector<messages::Goal> told, truth::Trace* trace);

  void Event(std::string kind, std::string detail);
  // Tells of a report that names a hazard, and of a look that shows points.
  void Look(messages::LookDirection direction, const Percept& percept);
  // Tells that the rover declared to be at a place, and how far it truly is from there.
  void Waypoint(std::size_t index);
  // Tells what came of a pair of images for visual odometry.
  void Vision(const VisualStep& step);
  // Tells which of the motions that were voted for was chosen.
  void Votes(const messages::NavigationView& view);

  // Adds a control tick.
  void Sample(Activity activity);
  // Adds a moment between control ticks. `activity`: of the rest that ends here, if one does.
  void Rest(std::optional<Activity> activity, bool set_back = false);

 private:
  void Rocks();
  truth::TraceSample Now(std::string activity) const;

  const World& world_;
  const Onboard& onboard_;
  const Ledger& ledger_;
  std::vector<messages::Goal> told_places_;
  truth::Trace* trace_;
  std::vector<math::Vector3> rock_centers_;  // of rocks that can move, as last told
};

}  // namespace rockyard::trial
