#include "report/summary_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "report/line_text.h"
#include "report/run_description.h"
#include "report/summary_json.h"

namespace rockyard::report {
namespace {

using statistics::ColumnSummary;
using statistics::DriveSummary;
using truth::TrialOutcome;

constexpr std::string_view kBold = "1";
constexpr std::string_view kGreen = "32";
constexpr std::string_view kYellow = "33";
constexpr std::string_view kRed = "31";
constexpr int kBarWidth = 30;
constexpr double kHuge = 1e7;  // what has more digits would not fit its column

std::string Coloured(TextStyle style, std::string_view colour, const std::string& text) {
  return style == TextStyle::kPlain ? text : fmt::format("\x1b[{}m{}\x1b[0m", colour, text);
}

// Returns the line of the ablations in force. Two are told elsewhere: localization in the line
// above, and designation is perfect by default.
std::string AblationLine(const RunDescription& run) {
  std::string names;
  for (const std::string& name : run.ablations) {
    if (name == "perfect_designation" || name == "perfect_localization") continue;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  }
  return names.empty() ? "" : fmt::format("  ablations: {}\n", Cut(names, kTextWidth - 13));
}

// Returns the localization, which stands beside the name, or below it where both are long.
std::string LocalizationText(const RunDescription& run, const DriveSummary& summary) {
  const std::size_t beside = fmt::formatted_size("{}{}{}{}", Cut(run.scenario, 40), run.seed,
                                                 summary.completed, run.planned);
  return beside <= 50 ? ", perfect localization" : "\n  perfect localization";
}

std::string Head(const RunDescription& run, const DriveSummary& summary, TextStyle style) {
  std::string text =
      Coloured(style, kBold, Cut(Printable(run.scenario), 40)) +
      fmt::format(", seed {}: {} of {} trials", run.seed, summary.completed, run.planned);
  if (run.localization == "oracle") text += LocalizationText(run, summary);
  text += '\n';
  for (const std::string& line : run.setup)
    text += fmt::format("  {}\n", Cut(line, kTextWidth - 2));
  text += SettingsText(run) + AblationLine(run);
  if (run.stored > summary.completed) {
    text += fmt::format("  {} more finished trials count once those before them are finished\n",
                        run.stored - summary.completed);
  }
  text += AccountingText(run);
  if (summary.shared_layouts) {
    text += "  trials share layouts of rocks: intervals allow for it\n";
  }
  if (summary.faults > 0) {
    text +=
        "  " +
        Coloured(style, kRed,
                 fmt::format("{} simulator faults, in none of the numbers below", summary.faults)) +
        "\n";
  }
  return text;
}

std::string RateLine(std::string_view name, const statistics::Proportion& rate) {
  if (rate.trials == 0) return fmt::format("  {:<18} no trials\n", name);
  return fmt::format("  {:<18} {:>6} of {:<6} {:6.1f} %   95 % interval {:.1f} .. {:.1f} %\n", name,
                     rate.count, rate.trials, 100.0 * rate.rate, 100.0 * rate.interval.low,
                     100.0 * rate.interval.high);
}

// How much of the rates above hangs on how long drives were allowed to go on.
std::string LimitLines(const DriveSummary& summary) {
  if (summary.ended_by_limit.count == 0) return "";
  const statistics::Interval success = summary.SuccessWithoutLimits();
  return RateLine("ended by a limit", summary.ended_by_limit) +
         fmt::format(
             "    without patience and time limit {:.1f} .. {:.1f} % of these declare success\n",
             100.0 * success.low, 100.0 * success.high);
}

std::string_view ColourOf(TrialOutcome outcome) {
  if (outcome == TrialOutcome::kGoalReached) return kGreen;
  return outcome == TrialOutcome::kFalseGoal ? kYellow : kRed;
}

std::int64_t Count(const DriveSummary& summary, TrialOutcome outcome) {
  return summary.outcomes[static_cast<std::size_t>(outcome)];
}

// Whether the cause is what the outcome's own name says.
bool IsPlain(truth::EndCause cause) {
  return cause == truth::EndCause::kArrived || cause == truth::EndCause::kBelievedOnly;
}

// Returns the lines below an outcome that has several causes: how often each, and the setting that
// decided.
std::string CauseLines(const DriveSummary& summary, TrialOutcome outcome) {
  if (!truth::HasSeveralCauses(outcome)) return "";
  std::string text;
  const double total = static_cast<double>(std::max<std::int64_t>(summary.completed, 1));
  for (std::size_t i = 0; i < truth::kEndCauses.size(); ++i) {
    const truth::EndCauseInfo& cause = truth::kEndCauses[i];
    const std::int64_t count = summary.causes[i];
    if (cause.outcome != outcome || count == 0) continue;
    if (IsPlain(static_cast<truth::EndCause>(i)) && count == Count(summary, outcome)) return "";
    const double percent = 100.0 * static_cast<double>(count) / total;
    text += fmt::format("    {:<22}{:>6}     {:6.1f} %{}{}\n", cause.label, count, percent,
                        cause.setting.empty() ? "" : "   ", cause.setting);
  }
  return text;
}

// Returns the line of what a navigator said as it failed, of the first that did.
std::string FaultLine(const DriveSummary& summary) {
  const auto& first = summary.first_navigator_fault;
  if (!first) return "";
  return Wrapped(fmt::format("    trial {}: {}", first->trial, Printable(first->detail))) + "\n";
}

std::string OutcomeLines(const DriveSummary& summary, TextStyle style) {
  std::string text;
  const double total = static_cast<double>(std::max<std::int64_t>(summary.completed, 1));
  for (std::size_t i = 0; i < summary.outcomes.size(); ++i) {
    const std::int64_t count = summary.outcomes[i];
    if (count == 0) continue;
    const double share = static_cast<double>(count) / total;
    const int length = std::max(1, static_cast<int>(std::lround(kBarWidth * share)));
    text += fmt::format("  {:<18} {:>6}           {:6.1f} %   {}\n", truth::kTrialOutcomeNames[i],
                        count, 100.0 * share,
                        Coloured(style, ColourOf(static_cast<TrialOutcome>(i)),
                                 std::string(static_cast<std::size_t>(length), '#')));
    text += CauseLines(summary, static_cast<TrialOutcome>(i));
    if (static_cast<TrialOutcome>(i) == TrialOutcome::kNavigatorFault) text += FaultLine(summary);
  }
  return text;
}

std::string Value(double value) {
  if (!std::isfinite(value)) return "-";
  if (std::abs(value) >= kHuge) return fmt::format("{:.2e}", value);
  const std::string text = fmt::format("{:.{}f}", value, std::abs(value) >= 100.0 ? 1 : 2);
  return text == "-0.00" ? "0.00" : text;
}

// One row of the table: a column in the unit that suits its size.
struct TableRow {
  std::string_view column;
  std::string_view label;
  double scale = 1.0;
};

std::string ColumnLine(const TableRow& row, const ColumnSummary& c) {
  const auto value = [&](double x) { return Value(row.scale * x); };
  return fmt::format("  {:<24} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", row.label,
                     value(c.min), value(c.p05), value(c.median), value(c.mean), value(c.mode),
                     value(c.p95), value(c.max));
}

std::string ColumnTable(const DriveSummary& summary, TextStyle style) {
  const TableRow rows[] = {{"true_distance_m", "distance [m]"},
                           {"path_ratio", "path ratio (arrived)"},
                           {"distance_error_percent", "distance error [%]"},
                           {"heading_error_deg", "heading error [deg]"},
                           {"position_error_m", "position error [m]"},
                           {"sim_time_s", "simulated time [s]"},
                           {"net_rate_m_s", "net rate [mm/s]", 1000.0},
                           {"single_scan_rate_m_s", "without rescans [mm/s]", 1000.0},
                           {"energy_wh", "energy [Wh]"}};
  std::string text;
  for (const TableRow& row : rows) {
    const ColumnSummary* column = summary.Find(row.column);
    if (column != nullptr && column->count > 0) text += ColumnLine(row, *column);
  }
  if (text.empty()) return text;
  return Coloured(style, kBold,
                  fmt::format("  {:<24} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}", "", "min",
                              "5 %", "median", "mean", "mode*", "95 %", "max")) +
         "\n" + text +
         "  * half-sample mode: unsteady, no coverage claimed (its range by subsampling: "
         "summary.json)\n";
}

// Returns the line below that of a metric, where its mean has no interval or most trials have the
// same value.
std::string ApartLine(const statistics::MetricSummary& metric) {
  const statistics::MeanEstimate& estimate = metric.estimate;
  std::string text = ReasonOf(estimate);
  if (!text.empty()) text = fmt::format("    no interval of the mean: {}\n", text);
  if (2 * estimate.apart.count >= estimate.apart.trials) return text;
  return text + fmt::format("    {} of {} trials differ from {}, {:.1f} .. {:.1f} % (exact)\n",
                            estimate.apart.count, estimate.apart.trials, FourDigits(estimate.usual),
                            100.0 * estimate.apart.interval.low,
                            100.0 * estimate.apart.interval.high);
}

std::string Ends(const statistics::Interval& interval, double scale) {
  if (!std::isfinite(interval.low)) return fmt::format("{:>22}", "-");
  return fmt::format("{:>9} .. {:<9}", Value(scale * interval.low), Value(scale * interval.high));
}

std::string MetricLine(const TableRow& row, const statistics::MetricSummary& metric) {
  std::string line =
      fmt::format("  {:<24} {:>9} {} {:>9} {}", row.label, Value(row.scale * metric.mean),
                  Ends(metric.interval, row.scale), Value(row.scale * metric.median),
                  Ends(metric.median_interval, row.scale));
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n" + ApartLine(metric);
}

// The metrics of what navigators count for themselves of which drives have values.
std::string OwnLines(const DriveSummary& summary) {
  constexpr std::size_t kMostOwn = 12;
  constexpr std::size_t kLabel = 24;
  std::string text;
  std::size_t shown = 0;
  std::size_t all = 0;
  std::vector<std::string> few;
  for (const statistics::MetricSummary& metric : summary.metrics) {
    if (!truth::IsOwnColumn(metric.metric.name)) continue;
    if (metric.count < 2) {
      few.push_back(metric.metric.name);
      continue;
    }
    if (++all > kMostOwn) continue;
    ++shown;
    const std::string& unit = metric.metric.unit;
    const std::string label =
        unit == "1" ? metric.metric.name : fmt::format("{} [{}]", metric.metric.name, unit);
    const std::string cut = Cut(Printable(label), kLabel);
    text += MetricLine({.column = metric.metric.name, .label = cut}, metric);
  }
  if (all > shown) text += fmt::format("  and {} more: summary.json\n", all - shown);
  // Of a navigator that did not drive all are empty.
  std::erase_if(few, [&](const std::string& name) {
    const std::string navigator = name.substr(0, name.find('.') + 1);
    return std::ranges::none_of(summary.metrics, [&](const statistics::MetricSummary& metric) {
      return metric.count >= 2 && metric.metric.name.starts_with(navigator);
    });
  });
  if (!few.empty()) {
    text +=
        Wrapped("  in one trial at most: " + Printable(fmt::format("{}", fmt::join(few, ", ")))) +
        "\n";
  }
  return text;
}

// Means and medians with their intervals, of what the table above has not.
std::string MetricLines(const DriveSummary& summary) {
  const TableRow rows[] = {{"time_to_goal_s", "time to goal [s]"},
                           {"energy_to_goal_wh", "energy to goal [Wh]"},
                           {"min_clearance_m", "least clearance [mm]", 1000.0},
                           {"scrapes", "scrapes"},
                           {"max_tilt_deg", "largest tilt [deg]"},
                           {"turns_in_place", "turns in place"},
                           {"stops", "stops"}};
  std::string text;
  for (const TableRow& row : rows) {
    const auto found = std::find_if(summary.metrics.begin(), summary.metrics.end(),
                                    [&](const auto& m) { return m.metric.name == row.column; });
    if (found == summary.metrics.end() || found->count < 2) continue;
    text += MetricLine(row, *found);
  }
  text += OwnLines(summary);
  if (text.empty()) return text;
  return fmt::format("  {:<24} {:>9} {:>22} {:>9} {:>22}\n", "", "mean", "95 % interval", "median",
                     "95 % interval") +
         text;
}

// What a reader of the numbers above must know of the soil.
std::string SoilLine(const DriveSummary& summary) {
  const auto found = std::find_if(summary.metrics.begin(), summary.metrics.end(),
                                  [](const auto& m) { return m.metric.name == "beyond_soil_law"; });
  if (found == summary.metrics.end() || found->count == 0 || found->mean == 0.0) return "";
  return fmt::format(
      "  note: in {:.1f} % of the trials a wheel sank deeper than a sixth of its diameter, to "
      "where "
      "the law of sinkage holds\n",
      100.0 * found->mean);
}

}  // namespace

std::string SummaryText(const RunDescription& run, const DriveSummary& summary, TextStyle style) {
  return Head(run, summary, style) + RateLine("declared success", summary.declared_success) +
         RateLine("true success", summary.true_success) + LimitLines(summary) +
         OutcomeLines(summary, style) + ColumnTable(summary, style) + MetricLines(summary) +
         SoilLine(summary) + fmt::format("  trial hash {}\n", run.trial_hash);
}

}  // namespace rockyard::report
