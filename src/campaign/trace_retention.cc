#include "campaign/trace_retention.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>

#include "core/error.h"
#include "report/worst_trials.h"

namespace rockyard::campaign {
namespace {

template <typename Number>
std::optional<Number> ParseNumber(std::string_view text) {
  Number number{};
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number);
  if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
  return number;
}

// False where the rule is none.
bool AddRule(std::string_view rule, TraceRetention& retention) {
  constexpr std::string_view kWorst = "worst:";
  constexpr std::string_view kShare = "share:";
  if (rule == "all") {
    retention.all = true;
  } else if (rule == "failures") {
    retention.failures = true;
  } else if (rule.starts_with(kWorst)) {
    const auto count = ParseNumber<std::size_t>(rule.substr(kWorst.size()));
    if (!count || *count == 0) return false;
    retention.worst = std::max(retention.worst, *count);
  } else if (rule.starts_with(kShare)) {
    const auto share = ParseNumber<double>(rule.substr(kShare.size()));
    // Written so that what is not a number is refused.
    if (!share || !(*share > 0.0 && *share <= 1.0)) return false;
    retention.share = std::max(retention.share, *share);
  } else {
    return false;
  }
  return true;
}

std::uint64_t Mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

}  // namespace

TraceRetention TraceOptions::retention() const {
  TraceRetention retention;
  std::vector<core::Problem> problems;
  for (const std::string& rule : rules) {
    if (AddRule(rule, retention)) continue;
    problems.push_back({"--traces", fmt::format("\"{}\" is no rule", rule),
                        "use all, failures, worst:N with N from 1, or share:P with 0 < P <= 1, "
                        "e.g. worst:20 or share:0.01"});
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  return retention;
}

bool IsInShare(std::uint64_t seed, std::uint64_t trial, double share) {
  constexpr double kTwoToMinus53 = 0x1p-53;
  return static_cast<double>(Mix(Mix(seed) ^ trial) >> 11U) * kTwoToMinus53 < share;
}

std::vector<std::uint64_t> KeptTrials(const TraceRetention& retention,
                                      const truth::RecordSchema& schema,
                                      std::span<const truth::Record> records, std::uint64_t seed) {
  std::set<std::uint64_t> kept;
  for (const truth::Record& record : records) {
    if (truth::IsFault(record)) continue;
    if (retention.all || IsInShare(seed, record.trial, retention.share)) kept.insert(record.trial);
  }
  if (retention.failures) {
    for (const std::uint64_t trial : report::FailedTrials(records)) kept.insert(trial);
  }
  for (const std::uint64_t trial : report::WorstTrials(schema, records, retention.worst)) {
    kept.insert(trial);
  }
  return {kept.begin(), kept.end()};
}

std::string RetentionText(const TraceRetention& retention) {
  if (retention.all) return "every trial";
  std::string text;
  const auto add = [&](const std::string& what) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", what);
  };
  if (retention.failures) add("every failure");
  if (retention.worst > 0) add(fmt::format("the {} worst failures", retention.worst));
  if (retention.share > 0.0) add(fmt::format("{:.4g} % of all trials", 100.0 * retention.share));
  return text;
}

}  // namespace rockyard::campaign
