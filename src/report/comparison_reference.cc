#include "report/comparison_reference.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/text.h"
#include "report/reference_fields.h"
#include "statistics/closed_forms.h"
#include "truth/record.h"

namespace rockyard::report {
namespace {

using core::JsonValue;
using core::Problem;
using statistics::FailureKind;
using statistics::PublishedValue;
using statistics::StatisticKind;
using Type = core::JsonValue::Type;

// Counts of runs so small that every division into kinds can be listed.
constexpr std::int64_t kMaxFailures = 50;

class Parser {
 public:
  statistics::PublishedReference Parse(const JsonValue& json) {
    statistics::PublishedReference reference;
    HeadFields head{reference};
    Read(json, head, "", {"values", "misprints", "scenarios"});
    if (json.Is(Type::kObject) && json.Find("schema_version") == nullptr) {
      Add("schema_version", "is missing", "write 1");
    }
    for (const auto& [path, item] : Items(json, "values", "")) {
      reference.values.push_back(ParseValue(*item, path));
    }
    for (const auto& [path, item] : Items(json, "misprints", "")) {
      MisprintFields fields{reference.misprints.emplace_back()};
      Read(*item, fields, path);
    }
    for (const auto& [path, item] : Items(json, "scenarios", "")) {
      ScenarioFields fields{reference.scenarios.emplace_back()};
      Read(*item, fields, path);
      Require(!fields.scenario.name.empty(), path + "name", "is missing", "name the scenario");
      Require(!fields.scenario.file.empty(), path + "file", "is missing",
              "name its file, relative to the reference");
    }
    if (reference.values.empty() && problems_.empty()) {
      Add("values", "lists no published value", "list at least one");
    }
    if (!problems_.empty()) throw core::UserError(problems_);
    return reference;
  }

 private:
  struct Item {
    std::string path;  // with a trailing dot
    const JsonValue* value;
  };

  void Add(std::string path, std::string reason, std::string suggestion) {
    problems_.push_back({std::move(path), std::move(reason), std::move(suggestion)});
  }

  template <typename Fields>
  void Read(const JsonValue& json, Fields& fields, const std::string& path,
            std::initializer_list<std::string_view> others = {}) {
    try {
      core::ReadParams(json, fields, others);
    } catch (const core::UserError& error) {
      for (const Problem& problem : error.problems()) {
        Add(path + problem.path, problem.reason, problem.suggestion);
      }
    }
  }

  // Returns the elements of a list member; none where it is missing.
  std::vector<Item> Items(const JsonValue& json, std::string_view key, const std::string& path) {
    const JsonValue* list = json.Find(key);
    if (list == nullptr) return {};
    const std::string list_path = path + std::string(key);
    if (!list->Is(Type::kList)) {
      Add(list_path, "is " + std::string(core::Describe(list->type())) + ", not a list",
          "write a list");
      return {};
    }
    std::vector<Item> items;
    for (std::size_t i = 0; i < list->list().size(); ++i) {
      items.push_back({list_path + "[" + std::to_string(i) + "].", &list->list()[i]});
    }
    return items;
  }

  std::vector<truth::TrialOutcome> ParseOutcomes(const JsonValue& json, const std::string& path) {
    std::vector<truth::TrialOutcome> outcomes;
    const auto& names = truth::kTrialOutcomeNames;
    for (const auto& [item_path, item] : Items(json, "outcomes", path)) {
      const std::string where = item_path.substr(0, item_path.size() - 1);
      if (!item->Is(Type::kText)) {
        Add(where, "is no text", "write the name of a trial outcome");
        continue;
      }
      const auto found = std::find(names.begin(), names.end(), item->text());
      if (found == names.end()) {
        Add(where, "is \"" + item->text().substr(0, 60) + "\", which is no trial outcome",
            core::Suggest(item->text(), names));
        continue;
      }
      outcomes.push_back(static_cast<truth::TrialOutcome>(found - names.begin()));
    }
    return outcomes;
  }

  PublishedValue ParseValue(const JsonValue& json, const std::string& path) {
    PublishedValue value;
    ValueFields fields{value};
    const std::size_t problems_before = problems_.size();
    Read(json, fields, path, {"outcomes", "kinds", "where", "terms"});
    value.outcomes = ParseOutcomes(json, path);
    for (const auto& [kind_path, item] : Items(json, "kinds", path)) {
      KindFields kind{value.kinds.emplace_back()};
      Read(*item, kind, kind_path, {"outcomes"});
      kind.kind.outcomes = ParseOutcomes(*item, kind_path);
      Require(!kind.kind.name.empty(), kind_path + "name", "is missing", "name the kind");
      Require(!kind.kind.outcomes.empty(), kind_path + "outcomes", "lists no outcome",
              "list the outcomes of this kind");
    }
    for (const auto& [range_path, item] : Items(json, "where", path)) {
      RangeFields range{value.where.emplace_back()};
      Read(*item, range, range_path);
      Require(!range.range.column.empty(), range_path + "column", "is missing",
              "name a column of the trial records");
    }
    for (const auto& [term_path, item] : Items(json, "terms", path)) {
      value.terms.push_back(ParseTerm(*item, term_path));
    }
    if (problems_.size() == problems_before) Check(json, value, path);
    return value;
  }

  statistics::RatioTerm ParseTerm(const JsonValue& json, const std::string& path) {
    statistics::RatioTerm term;
    TermFields fields{term};
    Read(json, fields, path, {"columns"});
    for (const auto& [item_path, item] : Items(json, "columns", path)) {
      if (item->Is(Type::kText)) {
        term.columns.push_back(item->text());
      } else {
        Add(item_path.substr(0, item_path.size() - 1), "is no text",
            "name a column of the trial records");
      }
    }
    Require(!term.columns.empty(), path + "columns", "is missing",
            "name columns of the trial records");
    Require(!term.of.empty(), path + "of", "is missing", "name the column of the base");
    return term;
  }

  void Require(bool holds, const std::string& path, const char* reason, const char* suggestion) {
    if (!holds) Add(path, reason, suggestion);
  }

  // What the members say together.
  void Check(const JsonValue& json, const PublishedValue& value, const std::string& path) {
    Require(json.Find("statistic") != nullptr, path + "statistic", "is missing",
            "name what is compared, e.g. \"outcome_count\"");
    Require(!value.id.empty(), path + "id", "is missing", "give every value a name of its own");
    Require(ids_.insert(value.id).second, path + "id", "is used twice",
            "give every value a name of its own");
    for (const Problem& problem : ToleranceProblems(value, path)) problems_.push_back(problem);
    if (statistics::HasTolerance(value.statistic)) return;
    Require(!value.scenario.empty(), path + "scenario", "is missing", "name the scenario");
    Require(value.sample_size >= 1, path + "sample_size", "is missing or 0",
            "give the number of published runs");
    Require(value.arrived == 0 || (statistics::SplitsByArrival(value.statistic) &&
                                   value.arrived <= value.sample_size),
            path + "arrived", "is more than sample_size, or the statistic takes no account of it",
            "give it with negative_count, minimum, maximum, mode or exponential_tail");
    CheckNumber(value, path);
    CheckKinds(value, path);
    const bool counts_outcomes = value.statistic == StatisticKind::kOutcomeCount;
    Require(counts_outcomes != value.outcomes.empty(), path + "outcomes",
            counts_outcomes ? "is missing" : "is given, but the statistic counts no outcomes",
            counts_outcomes ? "list the outcomes that count" : "leave it out");
    const bool needs_column = !counts_outcomes && value.statistic != StatisticKind::kFailureKinds;
    Require(needs_column != value.column.empty(), path + "column",
            needs_column ? "is missing" : "is given, but the statistic uses no column",
            needs_column ? "name a column of the trial records" : "leave it out");
    const bool needs_other = value.statistic == StatisticKind::kMedianOffset;
    Require(needs_other == (!value.other_scenario.empty() && value.other_sample_size >= 1),
            path + "other_scenario",
            "and other_sample_size belong to median_offset, and only there",
            "give both there, and leave both out elsewhere");
  }

  void CheckNumber(const PublishedValue& value, const std::string& path) {
    const bool statement = value.statistic == StatisticKind::kExponentialTail ||
                           value.statistic == StatisticKind::kMedianOffset ||
                           value.statistic == StatisticKind::kFailureKinds;
    Require(statement == std::isnan(value.value), path + "value",
            statement ? "is given, but this statistic has none" : "is missing",
            statement ? "leave it out" : "give the published number");
    const bool count = value.statistic == StatisticKind::kOutcomeCount ||
                       value.statistic == StatisticKind::kNegativeCount;
    if (!count || std::isnan(value.value)) return;
    const bool whole = std::floor(value.value) == value.value && value.value >= 0.0 &&
                       value.value <= static_cast<double>(value.sample_size);
    Require(whole, path + "value", "is no count of runs",
            "use a whole number from 0 to sample_size");
  }

  void CheckKinds(const PublishedValue& value, const std::string& path) {
    const bool has_kinds = value.statistic == StatisticKind::kFailureKinds;
    Require(has_kinds != value.kinds.empty(), path + "kinds",
            has_kinds ? "is missing" : "is given, but the statistic is not failure_kinds",
            has_kinds ? "list the kinds of failure" : "leave it out");
    if (!has_kinds) return;
    std::int64_t failures = 0;
    for (const FailureKind& kind : value.kinds) failures += kind.count;
    Require(failures == value.sample_size && failures <= kMaxFailures, path + "kinds",
            "has counts that do not add up to sample_size, or more than 50 failures",
            "make the counts add up to the number of published failures");
  }

  std::vector<Problem> problems_;
  std::set<std::string> ids_;
};

}  // namespace

statistics::PublishedReference ParseReference(const core::JsonValue& json) {
  return Parser().Parse(json);
}

statistics::PublishedReference LoadReference(const std::filesystem::path& path) {
  return ParseReference(core::LoadJsonFile(path));
}

namespace {

using statistics::Formula;

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
