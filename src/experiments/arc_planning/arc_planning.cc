#include "experiments/arc_planning/arc_planning.h"

#include "experiments/arc_planning/arc_search.h"
#include "experiments/look_factors.h"
#include "math/functions.h"
#include "navigation/enav/ace.h"
#include "navigation/enav/enav_params.h"
#include "trial/sight/onboard_calibration.h"

namespace rockyard::experiments {
namespace {

// Heights of the ground in the middles of cells, in a frame whose origin is the map's middle.
navigation::HeightMap MapOf(const ArcPlanningParams& params, const terrain::Terrain& terrain,
                            const math::Pose2& middle) {
  navigation::HeightMap map(params.map_cell_m, params.map_side_m);
  map.ForEach([&](const navigation::LatticeCell& at, navigation::HeightCell& cell) {
    cell.Add(terrain.Height(middle.x_m + map.MiddleX_m(at), middle.y_m + map.MiddleY_m(at)));
  });
  return map;
}

// Start and goal as seen from the middle between them, headed from one to the other.
struct CourseEnds {
  math::Pose2 middle;  // in W
  math::Pose2 start;
  math::Pose2 goal;
};

CourseEnds EndsOf(const trial::DriveParams& drive) {
  const double half_x_m = 0.5 * (drive.course.goal_x_m - drive.course.start_x_m);
  const double half_y_m = 0.5 * (drive.course.goal_y_m - drive.course.start_y_m);
  const double heading_rad = math::Atan2(half_y_m, half_x_m);
  return {{drive.course.start_x_m + half_x_m, drive.course.start_y_m + half_y_m, 0.0},
          {-half_x_m, -half_y_m, heading_rad},
          {half_x_m, half_y_m, heading_rad}};
}

}  // namespace

const truth::RecordSchema& ArcPlanningColumns() {
  using enum truth::ColumnRole;
  static const truth::RecordSchema kColumns = ColumnsOf<ArcPlanningSums>({
      {"cover", "1", "share of the ground that rocks cover, by the law", kFactor},
      {"risk", "1", "that a pose may have; 0: ACE", kFactor},
  });
  return kColumns;
}

ArcPlanningExperiment::ArcPlanningExperiment(const ArcPlanningParams& params,
                                             const trial::DriveParams& drive)
    : CellExperiment(params.Factors(), ArcPlanningColumns()),
      params_(params),
      drive_(drive),
      rover_(trial::OnboardRoverBelief(drive.rover, drive.perception.calibration.drive,
                                       drive.perception.vehicle_hazard)) {}

std::vector<double> ArcPlanningExperiment::Measure(std::size_t cell, core::TrialKey key) const {
  const std::vector<double> values = table().Values(cell);
  trial::DriveParams drive = drive_;
  drive.terrain.rocks.kind = terrain::RockFieldKind::kGolombek;
  drive.terrain.rocks.cover = values[0];
  navigation::AceParams limits = drive.navigation.navigators.params<navigation::EnavParams>().ace;
  const auto ace_of = [&](double risk) {
    limits.risk = risk;
    return navigation::Ace(limits, rover_);
  };
  const navigation::Ace checker = ace_of(values[1]);
  const navigation::Ace ace = ace_of(0.0);
  // Tells the risk of every pose that ACE refuses.
  const navigation::Ace risk_of = ace_of(1.0);
  const CourseEnds ends = EndsOf(drive);
  const double room_m = 0.5 * params_.map_side_m - 0.5 * rover_.length_m;

  ArcPlanningSums sums;
  for (std::int64_t i = 0; i < params_.maps_per_run; ++i) {
    const core::TrialKey scene = SceneKey(key, params_.maps_per_run, i);
    const navigation::HeightMap map = MapOf(params_, SceneTerrainOf(drive, scene), ends.middle);
    sums.maps += 1.0;
    const auto may_stand = [&](const math::Pose2& pose) { return checker.Check(map, pose).safe(); };
    if (may_stand(ends.start) && may_stand(ends.goal)) {
      sums.open_maps += 1.0;
      const ArcSearch search =
          SearchArcs(params_, ends.start, {ends.goal.x_m, ends.goal.y_m}, may_stand);
      sums.found += search.found ? 1.0 : 0.0;
      sums.path_m += search.path_m;
      sums.nodes += static_cast<double>(search.nodes);
      sums.checks += static_cast<double>(search.checks);
    }
    core::RandomStream places(scene, core::Purpose::kExperiment);
    for (std::int64_t p = 0; p < params_.poses_per_map; ++p) {
      const double x_m = room_m * (2.0 * places.Uniform() - 1.0);
      const double y_m = room_m * (2.0 * places.Uniform() - 1.0);
      const math::Pose2 pose{x_m, y_m, 0.0};
      sums.poses += 1.0;
      if (ace.Check(map, pose).safe()) continue;
      sums.refused += 1.0;
      const navigation::AceVerdict verdict = risk_of.Check(map, pose);
      const bool judged = verdict.safe() || verdict.failure == navigation::AceFailure::kRisk;
      sums.unlikely += judged && verdict.risk <= 0.01 ? 1.0 : 0.0;
      sums.likely += !judged || verdict.risk > 0.9 ? 1.0 : 0.0;
    }
  }
  return ValuesOf(sums);
}

}  // namespace rockyard::experiments
