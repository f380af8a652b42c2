#include "app/plan_report.h"

#include <fmt/format.h>

#include <utility>

#include "core/json_text.h"
#include "statistics/sample_size.h"

namespace rockyard::app {

bool IsCutOff(std::int64_t trials) { return trials >= statistics::kMaxTrials; }

void PlanReport::Add(std::string key, std::string what, std::int64_t trials) {
  const bool cut_off = IsCutOff(trials);
  if (cut_off) what += " (that many or more: the search ends there)";
  lines_.push_back({std::move(key), std::move(what), core::JsonValue(trials), cut_off});
}

void PlanReport::Add(std::string key, std::string what, double probability) {
  lines_.push_back({std::move(key), std::move(what), core::JsonValue(probability), false});
}

std::string PlanText(const PlanReport& report) {
  std::string text = report.question() + "\n";
  for (const PlanReport::Line& line : report.lines()) {
    const bool whole = line.number.Is(core::JsonValue::Type::kInteger);
    const std::string number =
        whole ? std::to_string(line.number.integer()) : fmt::format("{:.4f}", line.number.number());
    text += fmt::format("  {:>10}  {}\n", number, line.what);
  }
  return text;
}

std::string PlanJson(const PlanReport& report) {
  core::JsonValue json = core::JsonValue::Object();
  json.Set("question", core::JsonValue(report.question()));
  for (const PlanReport::Line& line : report.lines()) {
    json.Set(line.key, line.number);
    if (line.cut_off) json.Set(line.key + "_or_more", core::JsonValue(true));
  }
  return core::DumpJson(json);
}

}  // namespace rockyard::app
