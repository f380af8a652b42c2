#include "experiments/three_rock_run/three_rock_run.h"

#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/three_rock_run/columns.h"
#include "experiments/three_rock_run/rock_layout_draw.h"
#include "trial/run_trial.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

RoverZone ArrayOf(const sensing::LightStripeParams& sensor) {
  return {sensor.front_x_m, sensor.front_x_m + sensor.row_ahead_m.back(), sensor.outer_stripe_y_m};
}

RoverZone BodyOf(const rover::RoverGeometryParams& rover) {
  return {-0.5 * rover.length_m, 0.5 * rover.length_m, 0.5 * rover.width_m};
}

truth::RecordSchema ThreeRockSchema() {
  std::vector<std::string_view> names;
  for (const truth::ValueInfo& column : ThreeRockColumns()) names.push_back(column.name);
  return truth::MeasurementSchema(ThreeRockColumns(), names);
}

}  // namespace

struct ThreeRockRunExperiment::Driven {
  RunHistory history;
  trial::DriveResult result;
};

ThreeRockRunExperiment::ThreeRockRunExperiment(const ThreeRockRunParams& params,
                                               trial::DriveParams drive)
    : params_(params),
      drive_(std::move(drive)),
      array_(ArrayOf(drive_.sensors.light_stripe)),
      body_(BodyOf(drive_.rover.geometry)),
      schema_(ThreeRockSchema()) {}

truth::Record ThreeRockRunExperiment::Run(std::uint64_t seed, std::uint64_t index) const {
  try {
    if (index > std::numeric_limits<std::uint32_t>::max()) {
      throw std::out_of_range("trial indices end at 2^32 - 1, the size of their random key");
    }
    truth::Record record{index, truth::TrialOutcome::kMeasured, "", {}};
    std::vector<double> values{0.0};
    ForEachThreeRockColumn(Measure({seed, static_cast<std::uint32_t>(index)}),
                           [&](const truth::ValueInfo&, double value) { values.push_back(value); });
    record.values = std::move(values);
    return record;
  } catch (const std::exception& error) {
    return truth::MakeFault(seed, index, error.what());
  }
}

ThreeRockRunExperiment::Driven ThreeRockRunExperiment::DriveAmong(std::span<const PlacedRock> rocks,
                                                                  double goal_m,
                                                                  core::TrialKey key) const {
  trial::DriveParams drive = drive_;
  drive.course.goal_x_m = goal_m;
  drive.terrain.rocks.kind = terrain::RockFieldKind::kListed;
  for (const PlacedRock& rock : rocks) {
    terrain::ListedRocksParams& listed = drive.terrain.rocks.listed;
    listed.x_m.push_back(rock.x_m);
    listed.y_m.push_back(rock.y_m);
    listed.diameter_m.push_back(rock.diameter_m);
    listed.height_m.push_back(rock.height_m);
  }
  truth::Trace trace;
  trial::DriveResult result = trial::RunTrial(drive, key, &trace);
  return {RunHistory(trace, rocks, array_, body_), std::move(result)};
}

ThreeRockRecord ThreeRockRunExperiment::Measure(core::TrialKey key) const {
  const DrawnLayout layout = DrawLayout(params_.prior, key);
  const ThreeRockTold& told = params_.told;
  ThreeRockRecord record;
  record.goal_m = layout.goal_m;
  std::vector<PlacedRock> rocks{record.a =
                                    PlaceFirstRock(layout.a, told.a_path_m, array_.rear_x_m)};
  const auto drive = [&] { return DriveAmong(rocks, layout.goal_m, key); };
  const RunHistory with_a = drive().history;
  record.a_story = TellFirstRock(with_a, told);
  record.a_as_told = record.a_story.AsTold(told);
  const std::optional<PlacedRock> b = PlaceOnPath(layout.b, layout.b.along_m, with_a);
  if (!record.a_as_told || !b) return record;
  rocks.push_back(record.b = *b);
  const RunHistory with_b = drive().history;
  record.b_story = TellSecondRock(with_b, told);
  record.b_as_told = record.b_story.AsTold();
  const std::optional<PlacedRock> c =
      PlaceOnPath(layout.c, layout.b.along_m + layout.c.along_m, with_b);
  if (!record.b_as_told || !c) return record;
  rocks.push_back(record.c = *c);
  const Driven all = drive();
  const truth::DriveRecord& end = all.result.record;
  // Rock C may lie where it changes what was told of the others.
  const bool others_as_told =
      TellFirstRock(all.history, told).AsTold(told) && TellSecondRock(all.history, told).AsTold();
  record.c_story = TellThirdRock(all.history, told, truth::DeclaredSuccess(all.result.outcome),
                                 end.true_distance_m);
  record.b_scrapes = all.history.Scrapes(kRockB);
  record.c_scrapes = all.history.Scrapes(kRockC);
  record.accepted = others_as_told && record.c_story.AsTold();
  if (!record.accepted) return record;
  record.stages = StagesOf(all.history);
  record.heading_error_deg = end.heading_error_deg;
  record.position_error_m = end.position_error_m;
  record.length_m = end.true_distance_m;
  return record;
}

}  // namespace rockyard::experiments
