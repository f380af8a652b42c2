#include <cmath>

#include "report/reference_fields.h"
#include "statistics/closed_forms.h"

namespace rockyard::report {
namespace {

using core::Problem;
using statistics::Formula;
using statistics::PublishedValue;
using statistics::StatisticKind;

class Checker {
 public:
  explicit Checker(std::string path) : path_(std::move(path)) {}

  void Require(bool holds, const char* member, const char* reason, const char* suggestion) {
    if (!holds) problems_.push_back({path_ + member, reason, suggestion});
  }
  std::vector<Problem> Take() { return std::move(problems_); }

 private:
  std::string path_;
  std::vector<Problem> problems_;
};

void CheckUnused(const PublishedValue& value, Checker& check) {
  check.Require(!std::isfinite(value.low) && !std::isfinite(value.high), "low",
                "or high is given, but the statistic has no tolerance", "leave both out");
  check.Require(value.of.empty() && value.along.empty() && value.where.empty(), "of",
                "along or where is given, but the statistic uses none of them", "leave them out");
  check.Require(value.terms.empty(), "terms", "are given, but the statistic has none",
                "leave them out");
  check.Require(value.formula == Formula::kNone && value.inputs.empty(), "formula",
                "or inputs is given, but nothing is computed", "leave both out");
}

void CheckComputed(const PublishedValue& value, Checker& check) {
  check.Require(value.formula != Formula::kNone, "formula", "is missing",
                "name a closed form, e.g. \"any_of\"");
  const std::size_t arity = statistics::FormulaArity(value.formula);
  check.Require(!value.inputs.empty() && (arity == 0 || value.inputs.size() == arity), "inputs",
                "are not as many as the formula takes",
                "any_of takes chance and number; net_rate step, speed and scan time; "
                "range_resolution pitch, range and baseline; power_law and power_law_cover k, "
                "size and exponent; drift_along and drift_across step, distance, and variances of "
                "distance and heading a metre");
  if (arity == value.inputs.size()) {
    check.Require(statistics::InDomain(value.formula, value.inputs), "inputs",
                  "are outside of what the formula holds for",
                  "power_law_cover needs a size above 0 and an exponent above 2; a drift a step "
                  "and a distance above 0, of at most 10000 steps");
  }
  check.Require(
      value.column.empty() && value.of.empty() && value.along.empty() && value.terms.empty(),
      "column", "of, along or terms is given, but nothing is simulated", "leave them out");
}

void CheckSimulated(const PublishedValue& value, Checker& check) {
  check.Require(!value.scenario.empty(), "scenario", "is missing", "name the scenario");
  const bool has_terms = value.statistic == StatisticKind::kRatioSum;
  check.Require(has_terms != value.terms.empty(), "terms", "belong to ratio_sum, and only there",
                "give at least one there, leave them out elsewhere");
  check.Require(has_terms == value.column.empty(), "column",
                "is missing, or stands beside the columns of terms",
                "name a column of the trial records; those of a ratio_sum in its terms");
  const bool needs_base = value.statistic != StatisticKind::kMean && !has_terms;
  check.Require(needs_base != value.of.empty(), "of",
                "names the base of a rate, ratio or crossing, and only there",
                "give it there, leave it out elsewhere");
  const bool crossing = value.statistic == StatisticKind::kCrossing;
  check.Require(crossing != value.along.empty(), "along",
                "names the abscissa of a crossing, and only there",
                "give it there, leave it out elsewhere");
  check.Require(value.formula == Formula::kNone && value.inputs.empty(), "formula",
                "or inputs is given, but the statistic is simulated", "leave both out");
}

}  // namespace

std::vector<Problem> ToleranceProblems(const PublishedValue& value, const std::string& path) {
  Checker check(path);
  if (!statistics::HasTolerance(value.statistic)) {
    CheckUnused(value, check);
    return check.Take();
  }
  check.Require(value.low <= value.high && (std::isfinite(value.low) || std::isfinite(value.high)),
                "low", "and high are no tolerance", "give one or both, the smaller one as low");
  check.Require(value.arrived == 0, "arrived", "is given, but the number has no sample",
                "leave it out");
  check.Require(value.sample_size == 0, "sample_size",
                "is given, but the number has a tolerance and no sample", "leave it out");
  if (value.statistic == StatisticKind::kComputed) {
    CheckComputed(value, check);
  } else {
    CheckSimulated(value, check);
  }
  return check.Take();
}

}  // namespace rockyard::report
