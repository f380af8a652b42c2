#include "report/trace_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "math/angles.h"
#include "report/line_text.h"
#include "report/result_table.h"
#include "statistics/drive_summary.h"

namespace rockyard::report {
namespace {

bool SameBits(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

constexpr const char* kHeader =
    "row,time_s,kind,true_x_m,true_y_m,true_heading_rad,tilt_rad,believed_x_m,believed_y_m,"
    "believed_heading_rad,odometer_m,detail\n";

// `sample` gives what is neither time nor true pose; null leaves it empty.
std::string Line(const char* row, double time_s, const std::string& kind, const math::Pose2& pose,
                 const truth::TraceSample* sample, const std::string& detail) {
  CsvRow fields(row, time_s, kind, pose.x_m, pose.y_m, pose.heading_rad);
  if (sample == nullptr) {
    fields.AddEmpty(5);
  } else {
    const messages::PoseEstimate& e = sample->estimate;
    fields.Add(sample->tilt_rad, e.x_m, e.y_m, e.heading_rad, e.distance_m);
  }
  return fields.Add(detail).Line();
}

}  // namespace

const truth::TraceSample* SampleAt(std::span<const truth::TraceSample> samples, double time_s) {
  const auto after = std::upper_bound(
      samples.begin(), samples.end(), time_s,
      [](double t, const truth::TraceSample& sample) { return t < sample.time_s; });
  return after == samples.begin() ? nullptr : &*(after - 1);
}

std::vector<std::string> RecordDifferences(const truth::RecordSchema& schema,
                                           const truth::Record& stored, const truth::Record& now) {
  std::vector<std::string> differences;
  if (stored.outcome != now.outcome) {
    differences.push_back(fmt::format("outcome: stored {}, now {}", truth::Name(stored.outcome),
                                      truth::Name(now.outcome)));
  }
  if (stored.detail != now.detail) {
    differences.push_back(
        fmt::format("detail: stored \"{}\", now \"{}\"", stored.detail, now.detail));
  }
  // A scenario that is read without its plugins knows no columns of navigators that did not drive.
  const std::size_t known = std::min(now.values.size(), stored.values.size());
  bool none = true;
  for (std::size_t i = known; i < stored.values.size(); ++i) {
    none = none && std::isnan(stored.values[i]);
  }
  if (now.values.size() > known || !none) {
    differences.push_back(
        fmt::format("values: stored {}, now {}", stored.values.size(), now.values.size()));
    return differences;
  }
  for (std::size_t i = 0; i < now.values.size(); ++i) {
    if (SameBits(stored.values[i], now.values[i])) continue;
    const std::string name = i < schema.size() ? schema[i].name : fmt::format("value {}", i);
    differences.push_back(
        fmt::format("{}: stored {}, now {}", name, stored.values[i], now.values[i]));
  }
  return differences;
}

std::string TraceCsv(const truth::Trace& trace) {
  std::string csv = kHeader;
  std::size_t next = 0;
  const truth::TraceSample* last = nullptr;
  const auto events_before = [&](double time_s) {
    for (; next < trace.events.size() && trace.events[next].time_s < time_s; ++next) {
      const truth::TraceEvent& event = trace.events[next];
      csv += Line("event", event.time_s, event.kind, event.pose, last, event.detail);
    }
  };
  for (const truth::TraceSample& sample : trace.samples) {
    events_before(sample.time_s);
    csv += Line("sample", sample.time_s, sample.activity, sample.pose, &sample, "");
    last = &sample;
  }
  for (; next < trace.events.size(); ++next) {
    const truth::TraceEvent& event = trace.events[next];
    csv += Line("event", event.time_s, event.kind, event.pose, last, event.detail);
  }
  return csv;
}

namespace {

using math::RadToDeg;
using truth::Trace;
using truth::TraceEvent;
using truth::TraceSample;

// Path length counts chords of this size: jitter is no travel. Must agree with that of records
// (DriveMonitor::kChord_m), so that the lines of a story add up to about its distance.
constexpr double kChord_m = 0.01;
constexpr double kToldTurn_deg = 1.0;
constexpr double kToldDrive_m = 0.05;
constexpr int kKeyLines = 8;

// Events fold with the one before if the rover drove at most this in between. Reflections fold at
// the last step only, the end never.
constexpr std::array kFoldDistances_m = {0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 1e9};

// What the rover did in a stretch of time.
struct Motion {
  double left_deg = 0.0;  // turning in place, true
  double right_deg = 0.0;
  double driven_m = 0.0;
  double odometer_m = 0.0;
};

Motion MotionBetween(const Trace& trace, double from_s, double to_s) {
  Motion motion;
  const TraceSample* last = SampleAt(trace.samples, from_s);
  const TraceSample* sample = last == nullptr ? trace.samples.data() : last + 1;
  const TraceSample* const end = trace.samples.data() + trace.samples.size();
  const TraceSample* chord = last;
  for (; sample != end && sample->time_s <= to_s; last = sample++) {
    if (last == nullptr) {
      chord = sample;
      continue;
    }
    const double turn_deg =
        RadToDeg(math::WrapAngle(sample->pose.heading_rad - last->pose.heading_rad));
    if (sample->activity == "turn") {
      (turn_deg > 0.0 ? motion.left_deg : motion.right_deg) += std::abs(turn_deg);
    }
    motion.odometer_m += sample->estimate.distance_m - last->estimate.distance_m;
    const double chord_m =
        std::hypot(sample->pose.x_m - chord->pose.x_m, sample->pose.y_m - chord->pose.y_m);
    if (chord_m < kChord_m) continue;
    motion.driven_m += chord_m;
    chord = sample;
  }
  return motion;
}

std::string Text(const Motion& motion) {
  std::string text;
  if (motion.left_deg > kToldTurn_deg && motion.left_deg > 0.1 * motion.right_deg) {
    text += fmt::format(", turned left {:.0f} deg", motion.left_deg);
  }
  if (motion.right_deg > kToldTurn_deg && motion.right_deg > 0.1 * motion.left_deg) {
    text += fmt::format(", turned right {:.0f} deg", motion.right_deg);
  }
  if (std::max(motion.driven_m, motion.odometer_m) < kToldDrive_m) return text;
  text += fmt::format(", drove {:.2f} m", motion.driven_m);
  const double slip_m = std::abs(motion.odometer_m - motion.driven_m);
  if (slip_m > 0.1 && slip_m > 0.2 * motion.driven_m) {
    text += fmt::format(" (odometer {:.2f} m)", motion.odometer_m);
  }
  return text;
}

// Events that share a line.
using Fold = std::span<const TraceEvent>;

// What ends a part of a drive shares a line only where lines are short.
bool Foldable(const TraceEvent& event, bool parts_too) {
  const bool ends_part = event.kind == "reflection" || event.kind == "waypoint";
  return event.kind != "end" && (parts_too || !ends_part);
}

std::vector<Fold> FoldEvents(const Trace& trace, double distance_m) {
  const std::span<const TraceEvent> events = trace.events;
  const bool all = distance_m >= kFoldDistances_m.back();
  std::vector<Fold> folds;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= events.size(); ++i) {
    const bool joins =
        i < events.size() && Foldable(events[i - 1], all) && Foldable(events[i], all) &&
        MotionBetween(trace, events[i - 1].time_s, events[i].time_s).driven_m <= distance_m;
    if (joins) continue;
    folds.push_back(events.subspan(begin, i - begin));
    begin = i;
  }
  return folds;
}

std::vector<Fold> FoldsOf(const Trace& trace, StoryLength length) {
  std::vector<Fold> folds;
  if (length == StoryLength::kAll) {
    for (const TraceEvent& event : trace.events) folds.emplace_back(&event, 1);
    return folds;
  }
  for (const double distance_m : kFoldDistances_m) {
    folds = FoldEvents(trace, distance_m);
    if (folds.size() + kKeyLines + 2 <= kMaxStoryLines) break;
  }
  return folds;
}

struct EventKind {
  std::string_view name;
  std::string_view singular;
  std::string_view plural;
};

// In the order in which a folded line names them. Looks are told where nothing else happened, and
// motions that visual odometry saw where nothing was looked at either.
constexpr EventKind kLook{"look", "look", "looks"};
constexpr EventKind kVision{"vision", "motion seen", "motions seen"};
constexpr std::array<EventKind, 8> kEventKinds{{{"waypoint", "waypoint", "waypoints"},
                                                {"tracker", "tracker change", "tracker changes"},
                                                {"chosen", "choice", "choices"},
                                                {"hazard", "hazard scan", "hazard scans"},
                                                {"felt", "felt hazard", "felt hazards"},
                                                {"slip", "slip alarm", "slip alarms"},
                                                {"scrape", "scrape", "scrapes"},
                                                {"reflection", "reflection", "reflections"}}};

// What a folded line keeps of an event: of a choice the motion, without its votes.
std::string Short(const TraceEvent& event) {
  return event.detail.substr(0, event.detail.find(':'));
}

// "12 hazard scans ..#.. to .#...", of the events of one kind; empty where there are none.
std::string Told(Fold fold, const EventKind& kind) {
  const TraceEvent* first = nullptr;
  const TraceEvent* last = nullptr;
  int count = 0;
  for (const TraceEvent& event : fold) {
    if (event.kind != kind.name) continue;
    if (first == nullptr) first = &event;
    last = &event;
    ++count;
  }
  if (count == 0) return "";
  std::string text = fmt::format("{} {}", count, count == 1 ? kind.singular : kind.plural);
  if (!last->detail.empty()) text += fmt::format(" {}", Short(*first));
  if (Short(*first) != Short(*last)) text += fmt::format(" to {}", Short(*last));
  return text;
}

// "12 hazard scans ..#.. to .#..., 2 scrapes".
std::string What(Fold fold) {
  if (fold.size() == 1) {
    const std::string& detail = fold.front().detail;
    return fold.front().kind + (detail.empty() ? "" : " ") + detail;
  }
  std::string text;
  for (const EventKind& kind : kEventKinds) {
    const std::string told = Told(fold, kind);
    if (!told.empty()) text += fmt::format("{}{}", text.empty() ? "" : ", ", told);
  }
  if (text.empty()) text = Told(fold, kLook);
  return text.empty() ? Told(fold, kVision) : text;
}

// Rounded to a multiple of `unit`, without a negative zero.
double Rounded(double value, double unit) { return std::round(value / unit) * unit + 0.0; }

std::string PoseText(double x_m, double y_m, double heading_rad) {
  return fmt::format("{:6.2f} {:6.2f} {:5.0f}", Rounded(x_m, 0.01), Rounded(y_m, 0.01),
                     Rounded(RadToDeg(heading_rad), 1.0));
}

std::string Line(const truth::TracedTrial& trial, double time_s, const math::Pose2& pose,
                 const TraceSample* sample, const std::string& what) {
  std::string believed(20, ' ');
  std::string to_goal(6, ' ');
  if (sample != nullptr) {
    const messages::PoseEstimate& e = sample->estimate;
    believed = PoseText(e.x_m, e.y_m, e.heading_rad);
    to_goal = fmt::format("{:6.2f}", std::hypot(trial.goal.x_m - e.x_m, trial.goal.y_m - e.y_m));
  }
  return fmt::format("{:8.0f}  {}  {}  {}  {}\n", time_s,
                     PoseText(pose.x_m, pose.y_m, pose.heading_rad), believed, to_goal, what);
}

std::string EventLines(const truth::TracedTrial& trial, StoryLength length) {
  const Trace& trace = trial.trace;
  const std::vector<Fold> folds = FoldsOf(trace, length);
  std::string text = fmt::format(
      "{:>8}  {:^19}  {:^19}  {:>6}\n{:>8}  {:>6} {:>6} {:>5}  {:>6} {:>6} {:>5}  {:>6}\n", "time",
      "true", "believed", "goal", "s", "x m", "y m", "deg", "x m", "y m", "deg", "m");
  if (!trace.samples.empty()) {
    const TraceSample& start = trace.samples.front();
    const double until_s =
        folds.empty() ? trace.samples.back().time_s : folds.front().front().time_s;
    text += Line(trial, start.time_s, start.pose, &start,
                 "start" + Text(MotionBetween(trace, start.time_s, until_s)));
  }
  for (std::size_t i = 0; i < folds.size(); ++i) {
    const TraceEvent& first = folds[i].front();
    std::string what = What(folds[i]);
    if (i + 1 < folds.size()) {
      what += Text(MotionBetween(trace, first.time_s, folds[i + 1].front().time_s));
    }
    text += Line(trial, first.time_s, first.pose, SampleAt(trace.samples, first.time_s), what);
  }
  return text;
}

std::string KeyFigures(const truth::TracedTrial& trial) {
  const auto value = [&trial](std::string_view name) {
    const auto column = statistics::ColumnIndex(trial.schema, name);
    return column && *column < trial.record.values.size() ? trial.record.values[*column]
                                                          : std::nan("");
  };
  std::string text =
      fmt::format("  drove {:.2f} m (odometer {:.2f} m) in {:.0f} s of simulated time, {:.2f} Wh\n",
                  value("true_distance_m"), value("dead_reckoned_distance_m"), value("sim_time_s"),
                  value("energy_wh"));
  text += fmt::format(
      "  ended at ({:.2f}, {:.2f}) m heading {:.0f} deg, believed ({:.2f}, {:.2f}) m heading "
      "{:.0f} "
      "deg:\n  off by {:.2f} m and {:.1f} deg\n",
      value("final_x_m"), value("final_y_m"), RadToDeg(value("final_heading_rad")),
      value("believed_x_m"), value("believed_y_m"), RadToDeg(value("believed_heading_rad")),
      value("position_error_m"), value("heading_error_deg"));
  text += fmt::format(
      "  {:.2f} m from the goal at ({:.2f}, {:.2f}) m; believed {:.2f} m\n",
      value("true_goal_distance_m"), trial.goal.x_m, trial.goal.y_m,
      std::hypot(trial.goal.x_m - value("believed_x_m"), trial.goal.y_m - value("believed_y_m")));
  if (value("image_sets") > 0.0) {
    text += fmt::format(
        "  {:.0f} moves ({:.0f} turns in place), {:.0f} image sets ({:.0f} behind), {:.0f} stops "
        "by "
        "safeguards\n",
        value("moves"), value("point_turns"), value("image_sets"), value("rear_image_sets"),
        value("safeguard_stops"));
  }
  text += fmt::format(
      "  {:.0f} scans ({:.0f} repeated), {:.0f} hazards believed, {:.0f} turns in place ({:.0f} "
      "deg "
      "in all), {:.0f} scrapes, {:.0f} reflections\n",
      value("scans"), value("rescans"), value("hazards_believed"), value("turns_in_place"),
      RadToDeg(value("turned_in_place_rad")), value("scrapes"), value("reflections"));
  return text + fmt::format("  largest tilt {:.1f} deg, smallest belly clearance {:.3f} m\n",
                            value("max_tilt_deg"), value("min_clearance_m"));
}

}  // namespace

std::string TraceStory(const truth::TracedTrial& trial, StoryLength length) {
  std::string text =
      fmt::format("{}, seed {}, trial {}: {} ({})\n", Printable(trial.scenario), trial.seed,
                  trial.record.trial, truth::Name(trial.record.outcome), trial.record.detail);
  if (!trial.record.values.empty()) text += KeyFigures(trial);
  return text + EventLines(trial, length);
}

}  // namespace rockyard::report
