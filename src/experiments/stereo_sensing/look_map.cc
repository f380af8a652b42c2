#include "experiments/stereo_sensing/look_map.h"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "navigation/navigator.h"

namespace rockyard::experiments {
namespace {

using messages::LookDirection;

// Far enough that no map reaches it.
constexpr double kGoalAhead_m = 100.0;

messages::LookMoment FirstMoment(const messages::PointCloud& cloud) {
  messages::LookMoment moment;
  moment.number = cloud.number;
  return moment;
}

messages::PointCloud NothingBehind() {
  return {.number = 1, .direction = LookDirection::kBehind, .points_R = {}};
}

}  // namespace

messages::MapView MapOfLook(const navigation::NavigatorKind& navigator,
                            const messages::PointCloud& cloud) {
  const std::unique_ptr<navigation::Navigator> driver =
      navigator.Make({.goal = {kGoalAhead_m, 0.0}});
  navigation::NavigatorInput input;
  navigation::NavigatorDecision decision = driver->Decide(input);
  const messages::LookMoment moment = FirstMoment(cloud);
  if (decision.looks()) {
    input.cloud = &cloud;
    input.look = &moment;
    decision = driver->Decide(input);
  }
  const messages::PointCloud behind = NothingBehind();
  const messages::LookMoment later = FirstMoment(behind);
  if (decision.looks() && *decision.look == LookDirection::kBehind) {
    input.cloud = &behind;
    input.look = &later;
    driver->Decide(input);
  }
  const messages::NavigationView* view = driver->view();
  if (view == nullptr) {
    throw std::runtime_error("the navigator shows no map of its first look");
  }
  return view->map;
}

Verdict VerdictAt(const messages::MapView& map, double x_m, double y_m, double hazard_goodness) {
  const double column = std::floor((x_m - map.x0_m) / map.xstep_m);
  const double row = std::floor((y_m - map.y0_m) / map.ystep_m);
  if (!(column >= 0.0 && column < map.nx && row >= 0.0 && row < map.ny)) return Verdict::kUnknown;
  const messages::MapCellView& cell = map.Cell(static_cast<int>(column), static_cast<int>(row));
  if (!cell.known) return Verdict::kUnknown;
  return static_cast<double>(cell.goodness) <= hazard_goodness ? Verdict::kHazard : Verdict::kClear;
}

}  // namespace rockyard::experiments
