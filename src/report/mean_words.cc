#include "report/mean_words.h"

#include <fmt/format.h>

#include "report/json_members.h"
#include "report/line_text.h"

namespace rockyard::report {

using core::JsonValue;
using statistics::MeanLack;

std::string ReasonOf(const statistics::MeanEstimate& estimate) {
  switch (estimate.lack) {
    case MeanLack::kNone:
      break;
    case MeanLack::kTooFewValues:
      return fmt::format("{} trials, needs {}", estimate.apart.trials, estimate.needs);
    case MeanLack::kNothingApart:
      return fmt::format("all are {}", FourDigits(estimate.usual));
    case MeanLack::kTooFewApart:
      return fmt::format("{} trials differ from {}, needs {}", estimate.apart.count,
                         FourDigits(estimate.usual), estimate.needs);
    case MeanLack::kNoBound:
      return "too long a tail for any number of trials";
  }
  return "";
}

JsonValue RateJson(const statistics::Proportion& rate) {
  return ObjectTree("count", rate.count, "trials", rate.trials, "rate", rate.rate, "ci95",
                    rate.interval, "ci_method", MethodName(rate.method));
}

JsonValue MetricJson(const statistics::MetricSummary& summary) {
  JsonValue json =
      ObjectTree("count", summary.count, "mean", summary.mean, "ci95", summary.interval);
  if (summary.metric->kind == statistics::MetricKind::kRate) {
    SetMembers(json, "ci_method", statistics::MethodName(summary.method));
    return json;
  }
  const statistics::MeanEstimate& estimate = summary.estimate;
  const statistics::Proportion& apart = estimate.apart;
  const bool lacks = estimate.lack != MeanLack::kNone;
  json.Set("ci_method", lacks ? JsonValue() : JsonValue("skewed_t"));
  if (lacks) json.Set("ci_reason", JsonValue(ReasonOf(estimate)));
  SetMembers(json, "median", summary.median, "median_ci95", summary.median_interval, "min",
             summary.min, "max", summary.max, "std", summary.deviation, "usual", estimate.usual,
             "share_apart",
             ObjectTree("count", apart.count, "rate", apart.rate, "ci95", apart.interval));
  return json;
}

}  // namespace rockyard::report
