// Members of a reference file as fields, and what they must say together, for
// comparison_reference.cc; comparison_table.cc takes the names of roles from here.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/fields.h"
#include "statistics/published_values.h"

// Must stay in the order of the enums (statistics/published_values.h). The names, and the keys
// below, must stay as well: files in results/reference spell them.
template <>
struct rockyard::core::EnumNames<rockyard::statistics::StatisticKind> {
  static constexpr std::array<std::string_view, 15> kNames{
      "outcome_count", "failure_kinds",    "negative_count", "minimum",       "maximum",
      "mode",          "exponential_tail", "lower_bound",    "median_offset", "rate",
      "ratio",         "ratio_sum",        "mean",           "crossing",      "computed"};
};

template <>
struct rockyard::core::EnumNames<rockyard::statistics::Formula> {
  static constexpr std::array<std::string_view, 11> kNames{
      "none",        "any_of",           "sum",       "product",         "quotient",
      "net_rate",    "range_resolution", "power_law", "power_law_cover", "drift_along",
      "drift_across"};
};

template <>
struct rockyard::core::EnumNames<rockyard::statistics::ValueRole> {
  static constexpr std::array<std::string_view, 3> kNames{"prediction", "conditional",
                                                          "calibration"};
};

namespace rockyard::report {

inline constexpr core::FieldInfo kReferenceText = core::Published("text", {});
inline constexpr core::FieldInfo kReferenceCount =
    core::Published("published runs", {}, {0.0, 1e5});

struct ValueFields {
  statistics::PublishedValue& value;

  void Visit(core::FieldVisitor& v) {
    v.Text("id", value.id, kReferenceText);
    v.Text("what", value.what, kReferenceText);
    v.Text("place", value.place, kReferenceText);
    v.Text("scenario", value.scenario, kReferenceText);
    v.Choice("statistic", value.statistic, kReferenceText);
    v.Choice("role", value.role, kReferenceText);
    v.Integer("sample_size", value.sample_size, kReferenceCount);
    v.Integer("arrived", value.arrived, kReferenceCount);
    v.Real("value", value.value, kReferenceText);
    v.Real("rounding", value.rounding,
           core::Assumed("step of the last printed digit", {}, {0.0, 1e9}));
    v.Text("unit", value.unit, kReferenceText);
    v.Real("lower_limit", value.lower_limit, kReferenceText);
    v.Text("column", value.column, kReferenceText);
    v.Text("other_scenario", value.other_scenario, kReferenceText);
    v.Integer("other_sample_size", value.other_sample_size, kReferenceCount);
    v.Text("note", value.note, kReferenceText);
    v.Real("low", value.low, kReferenceText);
    v.Real("high", value.high, kReferenceText);
    v.Text("of", value.of, kReferenceText);
    v.Real("factor", value.factor, kReferenceText);
    v.Text("along", value.along, kReferenceText);
    v.Real("level", value.level, core::Assumed("rate at a crossing", {}, {0.0, 1.0}));
    v.Choice("formula", value.formula, kReferenceText);
    v.Reals("inputs", value.inputs, kReferenceText);
  }
};

struct KindFields {
  statistics::FailureKind& kind;

  void Visit(core::FieldVisitor& v) {
    v.Text("name", kind.name, kReferenceText);
    v.Integer("count", kind.count, kReferenceCount);
  }
};

struct RangeFields {
  statistics::ColumnRange& range;

  void Visit(core::FieldVisitor& v) {
    v.Text("column", range.column, kReferenceText);
    v.Real("low", range.low, kReferenceText);
    v.Real("high", range.high, kReferenceText);
  }
};

struct TermFields {
  statistics::RatioTerm& term;

  void Visit(core::FieldVisitor& v) { v.Text("of", term.of, kReferenceText); }
};

struct MisprintFields {
  statistics::Misprint& misprint;

  void Visit(core::FieldVisitor& v) {
    v.Text("place", misprint.place, kReferenceText);
    v.Text("printed", misprint.printed, kReferenceText);
    v.Text("used", misprint.used, kReferenceText);
  }
};

struct ScenarioFields {
  statistics::ReferenceScenario& scenario;

  void Visit(core::FieldVisitor& v) {
    v.Text("name", scenario.name, kReferenceText);
    v.Text("file", scenario.file, kReferenceText);
  }
};

struct HeadFields {
  statistics::PublishedReference& reference;
  std::int64_t schema_version = 0;

  void Visit(core::FieldVisitor& v) {
    v.Integer("schema_version", schema_version,
              core::Assumed("version of this schema", {}, {1.0, 1.0}));
    v.Text("title", reference.title, kReferenceText);
    v.Text("citation", reference.citation, kReferenceText);
  }
};

// Returns what is wrong with the tolerance of a value: a value that is judged by a tolerance must
// have its members, any other must not. `path` ends with a dot.
std::vector<core::Problem> ToleranceProblems(const statistics::PublishedValue& value,
                                             const std::string& path);

}  // namespace rockyard::report
