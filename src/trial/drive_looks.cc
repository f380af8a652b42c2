// How a drive looks at the terrain: at rest, or on the move.
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "trial/drive.h"
#include "trial/look_time.h"

namespace rockyard::trial {

bool Drive::LooksOnTheMove(const navigation::NavigatorDecision& decision) const {
  const OverlapParams& overlap = parts_.params.clock.overlap;
  return decision.looks_on_the_move && parts_.terrain_sensing.LooksOnTheMove() &&
         (overlap.imaging || overlap.computing);
}

std::optional<Verdict> Drive::Look(messages::LookDirection direction) {
  // What is under way was seen from farther back.
  parts_.timeline.Drop();
  observer_.OnLook();
  if (auto verdict = Move({}, parts_.stop)) return verdict;
  parts_.terrain_sensing.Begin();
  do {
    seen_ = See(direction);
    const LookTime& time = seen_->percept.time;
    Rest(Activity::kScanning, time.scanning_s);
    Rest(Activity::kImaging, time.imaging_s);
    Rest(Activity::kComputing, time.computing_s);
    UpdateEstimateAtRest(time.total_s());
  } while (seen_->percept.look_again);
  tracer_.Look(direction, seen_->percept);
  const messages::HazardReport* report = seen_->report();
  const bool hazard = report != nullptr && report->any();
  observer_.OnReport(hazard, seen_->X_WR);
  if (hazard && parts_.goal_rock) parts_.goal_rock->OnBelieved(seen_->X_WR);
  return AskReferee(Activity::kScanning, 0, seen_->percept.time.total_s());
}

std::optional<Verdict> Drive::LookOnTheMove(messages::LookDirection direction) {
  if (!parts_.timeline.TakesLook()) return std::nullopt;
  if (rolling_ && !parts_.params.clock.overlap.imaging) {
    if (auto verdict = Move({}, parts_.stop)) return verdict;
  }
  parts_.terrain_sensing.Begin();
  std::unique_ptr<SeenLook> seen = See(direction);
  tracer_.Look(direction, seen->percept);
  parts_.timeline.Begin(std::move(seen));
  return std::nullopt;
}

std::unique_ptr<SeenLook> Drive::See(messages::LookDirection direction) {
  const messages::LocalizationEstimate& believed = parts_.estimate();
  const std::int64_t number = parts_.terrain_sensing.looks();
  auto seen = std::make_unique<SeenLook>();
  seen->percept = parts_.terrain_sensing.Look(direction, parts_.field.terrain, parts_.state().X_WR,
                                              believed.attitude);
  seen->moment = {number, parts_.ledger.time_s(), believed.pose, believed.odometry,
                  believed.attitude};
  seen->X_WR = parts_.state().X_WR;
  return seen;
}

std::optional<Verdict> Drive::RestFor(const Timeline::Rest& rest) {
  if (rolling_) Move({}, parts_.stop);
  Rest(rest.activity, rest.duration_s);
  UpdateEstimateAtRest(rest.duration_s);
  return AskReferee(rest.activity, 0, rest.duration_s);
}

std::optional<Verdict> Drive::SeeMotion() {
  const OverlapParams& overlap = parts_.params.clock.overlap;
  const bool rests = !overlap.imaging || !overlap.computing;
  if (rests && rolling_) {
    if (auto verdict = Move({}, parts_.stop)) return verdict;
  }
  const double imaging_s = parts_.vision.imaging_s();
  const double computing_s = parts_.vision.computing_s();
  const double now_s = parts_.ledger.time_s();
  const bool compares = parts_.vision.Look(parts_.state().X_WR, now_s,
                                           now_s + imaging_s + computing_s, *parts_.estimator);
  if (compares) tracer_.Vision(*parts_.vision.last());
  double rest_s = SpendOnVision(Activity::kImaging, imaging_s, overlap.imaging);
  // The first images have none to be compared with.
  if (compares) rest_s += SpendOnVision(Activity::kComputing, computing_s, overlap.computing);
  if (rest_s <= 0.0) return std::nullopt;
  UpdateEstimateAtRest(rest_s);
  UseAids();
  return AskReferee(Activity::kComputing, 0, rest_s);
}

double Drive::SpendOnVision(Activity activity, double duration_s, bool beside) {
  if (!beside) {
    Rest(activity, duration_s);
    return duration_s;
  }
  parts_.ledger.SpendBeside(activity, duration_s);
  return 0.0;
}

void Drive::ShowStep() {
  const messages::NavigationView* view = parts_.navigator.view();
  if (!seen_ || seen_->cloud() == nullptr || view == nullptr) return;
  if (step_watcher_) {
    step_watcher_({parts_.params, parts_.field.terrain, seen_->X_WR, parts_.key, *view,
                   *seen_->cloud(), seen_->moment});
  }
  tracer_.Votes(*view);
}

}  // namespace rockyard::trial
