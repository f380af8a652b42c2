#include "campaign/replay_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "batch/trial_hash.h"
#include "campaign/drive_recording.h"
#include "campaign/plan_view.h"
#include "campaign/replay_scene.h"
#include "campaign/replay_sensor.h"
#include "report/atomic_file.h"
#include "report/trace_view.h"
#include "web/page.h"

namespace rockyard::campaign {
namespace {

// The moment at which the rover was found stuck: the last one, or the one before a stall that runs
// on (referee.stuck_rover).
const truth::TraceSample& StuckMoment(const std::vector<replay::ReplayPose>& poses) {
  const bool runs_on = poses.size() > 1 && poses.back().sample.activity == "stall";
  return poses[poses.size() - (runs_on ? 2 : 1)].sample;
}

// What motion and record tell beyond the events of the trace: where turns in place begin, where the
// rover was found stuck, and a simulator fault, which the drive does not live to tell.
std::vector<truth::TraceEvent> EventsOf(const truth::TracedTrial& traced,
                                        const std::vector<replay::ReplayPose>& poses) {
  std::vector<truth::TraceEvent> events;
  if (truth::IsStuck(traced.record.outcome) && !poses.empty()) {
    const truth::TraceSample& stuck = StuckMoment(poses);
    events.push_back({stuck.time_s, stuck.pose, "stall", ""});
  }
  events.insert(events.end(), traced.trace.events.begin(), traced.trace.events.end());
  std::string before;
  double since_s = 0.0;  // the end of the stretch before
  for (const replay::ReplayPose& pose : poses) {
    const std::string& activity = pose.sample.activity;
    if (activity != before && activity == "turn") {
      events.push_back({since_s, pose.sample.pose, activity, ""});
    }
    if (!activity.empty()) before = activity;
    since_s = pose.sample.time_s;
  }
  if (truth::IsFault(traced.record) && !poses.empty()) {
    events.push_back({since_s, poses.back().sample.pose, "end", traced.record.detail});
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return events;
}

}  // namespace

ReplayedTrial ReplayTrial(const TrialSource& source, std::uint64_t trial) {
  DriveRecording recording = RecordDrive(source.scenario, source.seed, trial);
  const truth::TracedTrial& traced = recording.traced;
  ReplayedTrial replayed;
  replay::ReplayData& data = replayed.data;
  data.title = fmt::format("{}, seed {}, trial {}", source.scenario.name, source.seed, trial);
  data.scenario = source.scenario.name;
  data.cell = source.cell;
  data.seed = source.seed;
  if (source.stored) {
    data.repeats_stored =
        report::RecordDifferences(traced.schema, *source.stored, traced.record).empty();
  }
  data.record_hash = batch::TrialHash(std::span(&traced.record, 1));
  data.command = ReplayCommandLine(source, trial);
  data.provenance = core::CurrentProvenance();
  data.schema = traced.schema;
  data.record = traced.record;
  AddScene(source.scenario, traced, data);
  data.rock_moves = traced.trace.rock_moves;
  data.links = LinksOf(source.scenario);
  data.sensor = SensorOf(source.scenario);
  data.poses = PosesOf(source.scenario, traced.trace);
  data.events = EventsOf(traced, data.poses);
  data.scans = std::move(recording.scans);
  data.steps = std::move(recording.steps);
  data.looks = std::move(recording.looks);
  replayed.plan_svg = PlanView(source.scenario, traced);
  return replayed;
}

std::string ReplayPayload(const ReplayedTrial& replayed, const ReplayedTrial* beside) {
  return replay::ReplayJson(replayed.data, beside == nullptr ? nullptr : &beside->data);
}

bool WriteReplayPage(const TrialSource& source, std::uint64_t trial,
                     const std::filesystem::path& path) {
  const ReplayedTrial replayed = ReplayTrial(source, trial);
  if (!replayed.data.repeats_stored.value_or(true)) return false;
  report::WriteFileAtomically(
      path, web::MakePage(web::Page::kReplay, replayed.data.title, ReplayPayload(replayed)));
  return true;
}

}  // namespace rockyard::campaign
