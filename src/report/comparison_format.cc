#include "report/comparison_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/reference_fields.h"

namespace rockyard::report {
namespace {

// Whether dependence through the layout alone could have made the difference: the p-value under it
// may lie above the level that the row was judged at.
bool DiffersByLayoutsAlone(const statistics::ComparedValue& value) {
  return value.verdict == statistics::Verdict::kDiffers && value.one_layout &&
         value.one_layout->p_value.high > value.level;
}

std::string OneLayoutRemark(const statistics::OneLayout& layout) {
  const std::string low = PValue(layout.p_value.low);
  const std::string high = PValue(layout.p_value.high);
  const std::string_view basis = layout.measured ? "from repeated layouts" : "bounds";
  return low == high ? fmt::format("one rock layout for all runs of the set: p {} ({})", low, basis)
                     : fmt::format("one rock layout for all runs of the set: p from {} to {} ({})",
                                   low, high, basis);
}

}  // namespace

using statistics::ComparedValue;
using statistics::ComparisonResult;
using statistics::Interval;
using statistics::PublishedValue;
using statistics::StatisticKind;
using statistics::ValueRole;
using statistics::Verdict;

std::string Number(double value) {
  if (!std::isfinite(value)) return "-";
  if (value == 0.0) return "0";
  const double magnitude = std::abs(value);
  if (magnitude >= 100.0) return fmt::format("{:.0f}", value);
  if (magnitude >= 10.0) return fmt::format("{:.1f}", value);
  return fmt::format("{:.2f}", value);
}

std::string PValue(double p) {
  if (!std::isfinite(p)) return "-";
  if (p >= 0.9995) return "1";
  return p >= 0.001 ? fmt::format("{:.3f}", p) : fmt::format("{:.0e}", p);
}

std::string Power(double power) {
  return std::isfinite(power) ? fmt::format("{:.2f}", power) : "-";
}

bool IsCount(const PublishedValue& value) {
  return value.statistic == StatisticKind::kOutcomeCount ||
         value.statistic == StatisticKind::kNegativeCount;
}

std::string Published(const PublishedValue& value) {
  if (IsCount(value)) return fmt::format("{:.0f}/{}", value.value, value.sample_size);
  if (value.statistic == StatisticKind::kFailureKinds)
    return fmt::format("of {}", value.sample_size);
  if (value.statistic == StatisticKind::kExponentialTail) return "yes";
  if (!std::isfinite(value.value)) return "stated";
  if (statistics::HasTolerance(value.statistic)) return fmt::format("{:.4g}", value.value);
  const double step = value.rounding > 0.0 ? value.rounding : 0.01;
  const int digits = std::clamp(static_cast<int>(std::lround(-std::log10(step))), 0, 6);
  const std::string number = fmt::format("{:.{}f}", value.value, digits);
  return value.statistic == StatisticKind::kLowerBound ? ">= " + number : number;
}

std::string Prediction(double median, const Interval& interval, bool count) {
  if (!std::isfinite(median)) return "-";
  if (count) return fmt::format("{:.0f} ({:.0f} .. {:.0f})", median, interval.low, interval.high);
  return fmt::format("{} ({} .. {})", Number(median), Number(interval.low), Number(interval.high));
}

std::string Prediction(const ComparedValue& value) {
  if (!statistics::HasTolerance(value.published.statistic)) {
    return Prediction(value.median, value.interval, IsCount(value.published));
  }
  if (!std::isfinite(value.pool_value)) return "-";
  if (value.interval.low == value.interval.high) return fmt::format("{:.4g}", value.pool_value);
  return fmt::format("{:.3g} ({:.3g} .. {:.3g})", value.pool_value, value.interval.low,
                     value.interval.high);
}

std::string Prediction(const ComparedValue& value, const statistics::SideStatistic& beside) {
  if (!statistics::HasTolerance(value.published.statistic)) {
    return Prediction(beside.median, beside.interval, IsCount(value.published));
  }
  return fmt::format("{:.3g} ({:.3g} .. {:.3g})", beside.median, beside.interval.low,
                     beside.interval.high);
}

std::vector<std::string> Remarks(const ComparedValue& value) {
  std::vector<std::string> remarks;
  for (const statistics::KindPrediction& kind : value.kinds) {
    remarks.push_back(fmt::format("{}: {} published, {} of {} simulated failures", kind.name,
                                  kind.published, kind.simulated, value.pool));
  }
  if (value.one_layout) remarks.push_back(OneLayoutRemark(*value.one_layout));
  if (DiffersByLayoutsAlone(value)) {
    remarks.emplace_back(
        "differs if the runs of the set met layouts of their own; if they all met one, this says "
        "nothing against the simulation");
  }
  if (!value.remark.empty()) remarks.push_back(value.remark);
  return remarks;
}

std::string_view RoleName(ValueRole role) {
  return core::EnumNames<ValueRole>::kNames[static_cast<std::size_t>(role)];
}

std::size_t CountOf(const ComparisonResult& result, Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(result.values.begin(), result.values.end(),
                    [&](const ComparedValue& value) { return value.verdict == verdict; }));
}

}  // namespace rockyard::report
