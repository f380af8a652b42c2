// The numbers behind a decision of a map-based navigator.
#include <fmt/format.h>

#include <string_view>

#include "core/numbers.h"
#include "report/csv.h"
#include "report/navigation_drawing.h"

namespace rockyard::report {
namespace {

using messages::MotionVote;

std::string VoteRows(std::string_view kind, const std::vector<MotionVote>& votes) {
  std::string csv;
  for (const MotionVote& vote : votes) {
    csv += CsvLine(kind, vote.motion.curvature_per_m, vote.motion.direction, vote.hazard,
                   vote.hazard_certainty, vote.waypoint, vote.merged, vote.best, vote.chosen);
  }
  return csv;
}

const MotionVote* Chosen(const std::vector<MotionVote>& votes) {
  for (const MotionVote& vote : votes) {
    if (vote.chosen) return &vote;
  }
  return nullptr;
}

}  // namespace

std::string MapCsv(const messages::MapView& map) {
  std::string csv = "x_m,y_m,elevation_m,goodness,certainty\n";
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      const messages::MapCellView& cell = map.Cell(ix, iy);
      CsvRow row(map.x0_m + (ix + 0.5) * map.xstep_m, map.y0_m + (iy + 0.5) * map.ystep_m,
                 cell.has_data ? cell.elevation_m : core::kNaN);
      if (cell.known) row.Add(cell.goodness, cell.certainty);
      csv += row.AddEmpty(cell.known ? 0 : 2).Line();
    }
  }
  return csv;
}

std::string VotesCsv(const messages::NavigationView& view) {
  return "kind,curvature_per_m,direction,hazard,hazard_certainty,waypoint,merged,best,chosen\n" +
         VoteRows("forward", view.forward) + VoteRows("backward", view.backward) +
         VoteRows("point_turn", view.point_turns);
}

std::string CloudCsv(const messages::PointCloud& cloud) {
  std::string csv = "x_m,y_m,z_m\n";
  for (const math::Vector3& p_R : cloud.points_R) csv += CsvLine(p_R.x(), p_R.y(), p_R.z());
  return csv;
}

std::string ChosenText(const messages::NavigationView& view) {
  for (const auto* arcs : {&view.forward, &view.backward}) {
    const MotionVote* vote = Chosen(*arcs);
    if (vote == nullptr) continue;
    return fmt::format("{} {:+.2f} /m (vote {:.0f})",
                       vote->motion.direction > 0 ? "forward" : "backward",
                       vote->motion.curvature_per_m, vote->merged);
  }
  const MotionVote* turn = Chosen(view.point_turns);
  if (turn == nullptr) return "nothing";
  return fmt::format("turn {} (vote {:.0f})", turn->motion.direction > 0 ? "left" : "right",
                     turn->merged);
}

}  // namespace rockyard::report
