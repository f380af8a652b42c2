#include "experiments/three_rock_run/three_rock_run.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/random.h"
#include "math/functions.h"
#include "trial/run_trial.h"

namespace rockyard::experiments {

const truth::RecordSchema& ThreeRockColumns() {
  static const truth::RecordSchema kColumns = ColumnsOf<ThreeRockRecord>();
  return kColumns;
}

namespace {

// How far from the goal a rover may truly be that counts as having passed B; one that spins its
// wheels at a rock believes to arrive without having passed it. Twice the position error that the
// published run ended with; the meaning of the column b_passed tells it.
constexpr double kLostGoal_m = 2.0 * kPublishedPositionError_m;

RoverZone ArrayOf(const sensing::LightStripeParams& sensor) {
  return {sensor.front_x_m, sensor.front_x_m + sensor.row_ahead_m.back(), sensor.outer_stripe_y_m};
}

RoverZone BodyOf(const rover::RoverGeometryParams& rover) {
  return {-0.5 * rover.length_m, 0.5 * rover.length_m, 0.5 * rover.width_m};
}

}  // namespace

struct ThreeRockRunExperiment::Driven {
  RunHistory history;
  trial::DriveResult result;

  bool Arrived() const { return truth::DeclaredSuccess(result.outcome); }
  bool Passed() const { return Arrived() && result.record.true_goal_distance_m < kLostGoal_m; }
};

struct ThreeRockRunExperiment::Course {
  core::TrialKey key;
  double goal_m;
  std::vector<PlacedRock> rocks;
};

ThreeRockRunExperiment::ThreeRockRunExperiment(const ThreeRockRunParams& params,
                                               trial::DriveParams drive)
    : CellExperiment({}, ThreeRockColumns()),
      params_(params),
      drive_(std::move(drive)),
      array_(ArrayOf(drive_.sensors.light_stripe)),
      body_(BodyOf(drive_.rover.geometry)) {}

std::vector<double> ThreeRockRunExperiment::Measure(std::size_t /*cell*/,
                                                    core::TrialKey key) const {
  return ValuesOf(RecordUnder(key));
}

ThreeRockRunExperiment::Driven ThreeRockRunExperiment::DriveAmong(const Course& course) const {
  trial::DriveParams drive = drive_;
  drive.course.goal_x_m = course.goal_m;
  drive.terrain.rocks.kind = terrain::RockFieldKind::kListed;
  terrain::ListedRocksParams& listed = drive.terrain.rocks.listed;
  for (const PlacedRock& rock : course.rocks) {
    listed.x_m.push_back(rock.x_m);
    listed.y_m.push_back(rock.y_m);
    listed.diameter_m.push_back(rock.diameter_m);
    listed.height_m.push_back(rock.height_m);
  }
  truth::Trace trace;
  trial::DriveResult result = trial::RunTrial(drive, course.key, &trace);
  return {RunHistory(trace, course.rocks, array_, body_), std::move(result)};
}

ThreeRockRecord ThreeRockRunExperiment::RecordUnder(core::TrialKey key) const {
  core::RandomStream stream = StreamOf(DrawnPart::kStart, 0, key);
  ThreeRockRecord record;
  record.goal_m = DrawUniform(params_.prior.goal_m, stream);
  record.a =
      PlaceFirstRock(DrawRock(params_.prior.a, stream), params_.told.a_path_m, array_.rear_x_m);
  Course course{key, record.goal_m, {record.a}};
  const RunHistory with_a = DriveAmong(course).history;
  record.a_story = TellFirstRock(with_a, params_.told);
  record.a_as_told = record.a_story.AsTold(params_.told);
  if (!record.a_as_told || !TrySecondRock(with_a, course, record)) return record;
  const RunHistory with_b = DriveAmong(course).history;
  record.accepted = TryThirdRock(with_b, course, record);
  return record;
}

bool ThreeRockRunExperiment::TrySecondRock(const RunHistory& with_a, Course& course,
                                           ThreeRockRecord& record) const {
  course.rocks.emplace_back();
  for (std::int64_t number = 0; number < params_.prior.tries; ++number) {
    core::RandomStream stream = StreamOf(DrawnPart::kSecondRock, number, course.key);
    const DrawnRock rock = DrawRock(params_.prior.b, stream);
    const std::optional<PlacedRock> placed = PlaceOnPath(rock, rock.along_m, with_a);
    ++record.b_tries;
    if (!placed) continue;
    course.rocks.back() = record.b = *placed;
    record.b_path_m = rock.along_m;
    const Driven driven = DriveAmong(course);
    const SecondRockStory story = TellSecondRock(driven.history, params_.told, driven.Passed());
    record.b_unseen += story.unseen ? 1 : 0;
    record.b_scraped += story.scraped ? 1 : 0;
    record.b_passed += story.passed ? 1 : 0;
    record.b_as_told =
        story.AsTold() && TellFirstRock(driven.history, params_.told).AsTold(params_.told);
    if (record.b_as_told) return true;
  }
  return false;
}

bool ThreeRockRunExperiment::TryThirdRock(const RunHistory& with_b, Course& course,
                                          ThreeRockRecord& record) const {
  course.rocks.emplace_back();
  for (std::int64_t number = 0; number < params_.prior.tries; ++number) {
    core::RandomStream stream = StreamOf(DrawnPart::kThirdRock, number, course.key);
    const DrawnRock rock = DrawRock(params_.prior.c, stream);
    const std::optional<PlacedRock> placed =
        PlaceOnPath(rock, record.b_path_m + rock.along_m, with_b);
    ++record.c_tries;
    if (!placed) continue;
    course.rocks.back() = record.c = *placed;
    const Driven driven = DriveAmong(course);
    const ThirdRockStory story = TellThirdRock(driven.history, params_.told, driven.Arrived(),
                                               driven.result.record.true_distance_m);
    record.c_counts.Add(story);
    // Rock C may change what was told of the others.
    const bool others = TellFirstRock(driven.history, params_.told).AsTold(params_.told) &&
                        TellSecondRock(driven.history, params_.told, driven.Passed()).AsTold();
    if (!others || !story.AsTold()) continue;
    record.SetEnd(driven.history, driven.result.record);
    return true;
  }
  return false;
}

core::RandomStream StreamOf(DrawnPart part, std::int64_t number, core::TrialKey key) {
  // Must stay: 0; 1, 3, 5, ... of B; 2, 4, 6, ... of C, so that more tries of one rock move no try
  // of the other.
  const std::int64_t substream =
      part == DrawnPart::kStart ? 0 : 2 * number + (part == DrawnPart::kSecondRock ? 1 : 2);
  return {key, core::Purpose::kExperiment, static_cast<std::uint32_t>(substream)};
}

double DrawUniform(const UniformRange& range, core::RandomStream& stream) {
  return core::SampleUniform(stream, range[0], range[1]);
}

DrawnRock DrawRock(const RockPrior& prior, core::RandomStream& stream) {
  DrawnRock rock;
  rock.along_m = DrawUniform(prior.along_m, stream);
  rock.offset_m = DrawUniform(prior.offset_m, stream);
  rock.diameter_m = DrawUniform(prior.diameter_m, stream);
  rock.height_m = DrawUniform(prior.height_m, stream);
  return rock;
}

PlacedRock PlaceFirstRock(const DrawnRock& rock, double path_m, double front_x_m) {
  return {path_m + front_x_m + rock.along_m + 0.5 * rock.diameter_m, rock.offset_m, rock.diameter_m,
          rock.height_m};
}

std::optional<PlacedRock> PlaceOnPath(const DrawnRock& rock, double path_m,
                                      const RunHistory& history) {
  const Moment* at = history.At(path_m);
  if (at == nullptr) return std::nullopt;
  return PlacedRock{at->pose.x_m - rock.offset_m * math::Sin(at->pose.heading_rad),
                    at->pose.y_m + rock.offset_m * math::Cos(at->pose.heading_rad), rock.diameter_m,
                    rock.height_m};
}

}  // namespace rockyard::experiments
