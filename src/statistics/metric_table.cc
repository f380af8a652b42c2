// The table of metrics. Name, trials and columns decide what stored baselines are compared with; a
// margin only baselines that are written from now on, as each keeps its own.
#include <algorithm>
#include <string>
#include <vector>

#include "statistics/metrics.h"
#include "truth/end_cause.h"

namespace rockyard::statistics {
namespace {

using truth::EndCause;
using truth::TrialOutcome;

template <typename Enum>
constexpr std::uint32_t Bit(Enum value) {
  return std::uint32_t{1} << static_cast<unsigned>(value);
}

constexpr double kRateMargin = 0.1;

Metric OutcomeRate(std::string_view name, std::uint32_t outcomes, std::string_view definition) {
  return {.name = std::string(name),
          .unit = "1",
          .definition = std::string(definition),
          .kind = MetricKind::kRate,
          .source = MetricSource::kOutcome,
          .outcomes = outcomes,
          .margin = kRateMargin};
}

Metric CauseRate(std::string_view name, std::uint32_t causes, std::string_view definition) {
  Metric metric = OutcomeRate(name, 0, definition);
  metric.source = MetricSource::kCause;
  metric.causes = causes;
  return metric;
}

Metric Arrived(std::string_view name, std::string_view unit, std::string_view column, double margin,
               double relative_margin, std::string_view definition) {
  return {.name = std::string(name),
          .unit = std::string(unit),
          .definition = std::string(definition),
          .trials = MetricTrials::kArrived,
          .columns = {std::string(column)},
          .margin = margin,
          .relative_margin = relative_margin};
}

// A metric over all trials, of the column of its own name.
Metric All(std::string_view name, std::string_view unit, double margin, double relative_margin,
           std::string_view definition) {
  Metric metric = Arrived(name, unit, name, margin, relative_margin, definition);
  metric.trials = MetricTrials::kAll;
  return metric;
}

Metric Quotient(std::string_view name, std::string_view over, std::string_view under,
                double relative_margin, std::string_view definition) {
  Metric metric = Arrived(name, "1", over, 0.0, relative_margin, definition);
  metric.source = MetricSource::kQuotient;
  metric.columns[1] = under;
  return metric;
}

Metric ShareWith(std::string_view name, std::string_view column, std::string_view definition) {
  return {.name = std::string(name),
          .unit = "1",
          .definition = std::string(definition),
          .kind = MetricKind::kRate,
          .source = MetricSource::kPositive,
          .columns = {std::string(column)},
          .margin = kRateMargin};
}

// Sets the values from which on the mean gets an interval, where that is not 30: the least of 40,
// 100 and 300 from which on it held in both pools of scripts/studies/coverage/coverage.py, or
// kNeverForMean, for a quotient whose denominator may be nearly 0.
Metric Needing(std::int64_t values, Metric metric) {
  metric.fewest_for_mean = values;
  return metric;
}

// Must stay: names, as a baseline with a metric whose name is gone no longer passes `rockyard
// check`. Baselines keep margins too: a new margin holds for new baselines alone. The order is that
// of reports. README.md has this table, and a test compares both.
std::vector<Metric> MakeMetrics() {
  return {
      OutcomeRate("declared_success",
                  Bit(TrialOutcome::kGoalReached) | Bit(TrialOutcome::kFalseGoal),
                  "share of trials in which the rover believes that it arrived"),
      OutcomeRate("true_success", Bit(TrialOutcome::kGoalReached),
                  "share of trials that end believed and truly at the goal"),
      OutcomeRate("false_goal", Bit(TrialOutcome::kFalseGoal),
                  "share of trials that end believed, but not truly, at the goal"),
      OutcomeRate("tip_over", Bit(TrialOutcome::kTipOver), "share of trials that tip over"),
      OutcomeRate("high_centred", Bit(TrialOutcome::kHighCentred),
                  "share of trials that end with the body on a rock"),
      OutcomeRate("jammed", Bit(TrialOutcome::kJammed),
                  "share of trials that end with the rover unable to move"),
      OutcomeRate("no_path", Bit(TrialOutcome::kNoPath),
                  "share of trials that find no way on, for one of the four causes that follow"),
      CauseRate("gave_up", Bit(EndCause::kGaveUp) | Bit(EndCause::kNoticedStuck),
                "share of trials in which the navigator gives up"),
      CauseRate(
          "patience_distance", Bit(EndCause::kPatienceDistance),
          "share of trials that the operator ends, as the rover drives on and comes no nearer"),
      CauseRate("patience_turning", Bit(EndCause::kPatienceTurning),
                "share of trials that the operator ends, as the rover turns and comes no nearer"),
      CauseRate(
          "patience_time", Bit(EndCause::kPatienceTime),
          "share of trials that the operator ends, as the rover comes no nearer for too long"),
      OutcomeRate("energy_depleted", Bit(TrialOutcome::kEnergyDepleted),
                  "share of trials that end with empty batteries"),
      OutcomeRate("time_limit", Bit(TrialOutcome::kTimeLimit),
                  "share of trials that the time limit ends"),
      OutcomeRate("left_arena", Bit(TrialOutcome::kLeftArena),
                  "share of trials that leave the arena"),
      OutcomeRate("excessive_slip", Bit(TrialOutcome::kExcessiveSlip),
                  "share of trials that end as the wheels were seen to slip too much"),
      OutcomeRate("navigator_fault", Bit(TrialOutcome::kNavigatorFault),
                  "share of trials in which the plugin or process that decides fails"),
      Needing(300, Quotient("path_ratio", "true_distance_m", "displacement_m", 0.05,
                            "true path length over the straight distance from start to true end")),
      Arrived("time_to_goal_s", "s", "sim_time_s", 0.0, 0.1, "simulated time up to the goal"),
      Arrived("energy_to_goal_wh", "Wh", "energy_wh", 0.0, 0.1, "energy drawn up to the goal"),
      Arrived("true_goal_distance_m", "m", "true_goal_distance_m", 0.1, 0.1,
              "true final position to the goal"),
      Arrived("believed_goal_distance_m", "m", "believed_goal_distance_m", 0.05, 0.1,
              "believed final position to the goal as told, or as last seen where it is tracked"),
      All("true_distance_m", "m", 0.0, 0.1, "true path length"),
      Needing(40,
              All("active_time_s", "s", 0.0, 0.1,
                  "simulated time up to the verdict, whether or not a rover found stuck runs on")),
      Needing(40,
              All("active_energy_wh", "Wh", 0.0, 0.1,
                  "energy drawn up to the verdict, whether or not a rover found stuck runs on")),
      All("net_rate_m_s", "m/s", 0.0, 0.1, "true path length over simulated time"),
      All("min_clearance_m", "m", 0.02, 0.0, "smallest clearance of the belly over a rock"),
      All("scrapes", "1", 0.25, 0.25, "episodes of body contact with a rock"),
      ShareWith("scraped", "scrapes", "share of trials with at least one scrape"),
      All("max_tilt_deg", "deg", 2.0, 0.0, "largest tilt of the chassis"),
      All("max_bogie_deg", "deg", 2.0, 0.0, "largest angle of a bogie"),
      All("max_rocker_deg", "deg", 2.0, 0.0, "largest angle of a rocker"),
      All("turns_in_place", "1", 0.5, 0.15, "turns in place"),
      All("turned_in_place_rad", "rad", 0.5, 0.15, "total true rotation of turns in place"),
      Needing(40, All("scans", "1", 0.5, 0.1, "hazard scans")),
      All("image_sets", "1", 0.5, 0.1, "pairs of stereo images"),
      All("hazards_believed", "1", 0.5, 0.15, "scans whose hazard the navigator believed"),
      All("hazards_begun", "1", 0.5, 0.15,
          "of these, those after a scan without: times that the rover began to avoid"),
      Needing(300, All("stops", "1", 0.5, 0.1, "times that the rover came to rest")),
      ShareWith("beyond_soil_law", "beyond_soil_law",
                "share of trials in which a wheel sank deeper than the law of sinkage holds"),
      Needing(kNeverForMean, All("distance_error_percent", "%", 1.0, 0.0,
                                 "100 (dead-reckoned less true path length) over the true one")),
      All("heading_error_deg", "deg", 2.0, 0.15,
          "absolute error of the believed heading at the end"),
      Needing(100, All("position_error_m", "m", 0.05, 0.15,
                       "distance from the believed to the true final position")),
  };
}

// The margin of what navigators count for themselves: as of most built-in means.
constexpr double kOwnRelativeMargin = 0.1;

Metric OwnMetric(const truth::ValueInfo& column) {
  return All(column.name, column.unit, 0.0, kOwnRelativeMargin, column.meaning);
}

}  // namespace

std::span<const Metric> Metrics() {
  static const std::vector<Metric> kMetrics = MakeMetrics();
  return kMetrics;
}

std::vector<Metric> MetricsOf(const truth::RecordSchema& schema) {
  std::vector<Metric> metrics(Metrics().begin(), Metrics().end());
  for (const truth::ValueInfo& column : schema) {
    if (truth::IsOwnColumn(column.name)) metrics.push_back(OwnMetric(column));
  }
  return metrics;
}

std::optional<Metric> FindMetric(std::string_view name, const truth::RecordSchema& schema) {
  const auto named = [&](const auto& each) { return each.name == name; };
  const auto found = std::ranges::find_if(Metrics(), named);
  if (found != Metrics().end()) return *found;
  if (!truth::IsOwnColumn(name)) return std::nullopt;
  const auto column = std::ranges::find_if(schema, named);
  if (column != schema.end()) return OwnMetric(*column);
  return OwnMetric({.name = std::string(name), .unit = "", .meaning = ""});
}

}  // namespace rockyard::statistics
