// The numbers behind a decision of a map-based navigator.
#include <fmt/format.h>

#include <array>
#include <string_view>

#include "report/csv.h"
#include "report/navigation_drawing.h"

namespace rockyard::report {
namespace {

using messages::MotionVote;

std::string VoteRows(std::string_view kind, const std::vector<MotionVote>& votes) {
  std::string csv;
  for (const MotionVote& vote : votes) {
    csv += CsvLine(std::array{std::string(kind), CsvNumber(vote.motion.curvature_per_m),
                              fmt::to_string(vote.motion.direction), CsvNumber(vote.hazard),
                              CsvNumber(vote.hazard_certainty), CsvNumber(vote.waypoint),
                              CsvNumber(vote.merged), fmt::format("{:d}", vote.best),
                              fmt::format("{:d}", vote.chosen)});
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
      csv += CsvLine(std::array{CsvNumber(map.x0_m + (ix + 0.5) * map.xstep_m),
                                CsvNumber(map.y0_m + (iy + 0.5) * map.ystep_m),
                                cell.has_data ? CsvNumber(cell.elevation_m) : std::string(),
                                cell.known ? fmt::to_string(cell.goodness) : std::string(),
                                cell.known ? fmt::to_string(cell.certainty) : std::string()});
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
  for (const math::Vector3& p_R : cloud.points_R) {
    csv += CsvLine(std::array{CsvNumber(p_R.x()), CsvNumber(p_R.y()), CsvNumber(p_R.z())});
  }
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
