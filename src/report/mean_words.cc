#include "report/mean_words.h"

#include <fmt/format.h>

#include "report/line_text.h"

namespace rockyard::report {
namespace {

using core::JsonValue;
using core::NumberOrNull;
using statistics::MeanLack;

JsonValue Apart(const statistics::Proportion& apart) {
  return JsonValue::Object({{"count", apart.count},
                            {"rate", NumberOrNull(apart.rate)},
                            {"ci95", EndsOf(apart.interval)}});
}

JsonValue MeanMethod(const statistics::MeanEstimate& estimate) {
  return estimate.lack == MeanLack::kNone ? JsonValue("skewed_t") : JsonValue();
}

}  // namespace

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
  return JsonValue::Object({{"count", rate.count},
                            {"trials", rate.trials},
                            {"rate", NumberOrNull(rate.rate)},
                            {"ci95", EndsOf(rate.interval)},
                            {"ci_method", std::string(MethodName(rate.method))}});
}

JsonValue MetricJson(const statistics::MetricSummary& summary) {
  JsonValue json = JsonValue::Object({{"count", summary.count},
                                      {"mean", NumberOrNull(summary.mean)},
                                      {"ci95", EndsOf(summary.interval)}});
  if (summary.metric->kind == statistics::MetricKind::kRate) {
    json.Set("ci_method", JsonValue(std::string(statistics::MethodName(summary.method))));
    return json;
  }
  const statistics::MeanEstimate& estimate = summary.estimate;
  json.Set("ci_method", MeanMethod(estimate));
  if (estimate.lack != MeanLack::kNone) json.Set("ci_reason", JsonValue(ReasonOf(estimate)));
  json.Set("median", NumberOrNull(summary.median));
  json.Set("median_ci95", EndsOf(summary.median_interval));
  json.Set("min", NumberOrNull(summary.min));
  json.Set("max", NumberOrNull(summary.max));
  json.Set("std", NumberOrNull(summary.deviation));
  json.Set("usual", NumberOrNull(estimate.usual));
  json.Set("share_apart", Apart(estimate.apart));
  return json;
}

}  // namespace rockyard::report
