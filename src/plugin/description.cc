#include "plugin/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/text.h"

namespace rockyard::plugin {
namespace {

using core::JsonValue;
using core::UserError;

constexpr std::size_t kMostFields = 1000;
constexpr int kDeepestGroup = 4;
constexpr std::size_t kMostOwnValues = 100;

// Reads members of an answer; throws UserError that names the plugin and the member.
class Answer {
 public:
  Answer(const JsonValue& value, std::string source, std::string path)
      : value_(value), source_(std::move(source)), path_(std::move(path)) {
    if (!value_.Is(JsonValue::Type::kObject)) Fail("", "is no object");
  }

  [[noreturn]] void Fail(std::string_view key, std::string_view reason) const {
    const std::string at = key.empty() ? path_ : fmt::format("{}.{}", path_, key);
    throw UserError(source_, fmt::format("says of itself: {} {}", at, reason),
                    "see docs/navigators.md for what a plugin says of itself");
  }

  std::string Text(std::string_view key, std::optional<std::string> absent = std::nullopt) const {
    const JsonValue* member = value_.Find(key);
    if (member == nullptr && absent) return *std::move(absent);
    if (member == nullptr || !member->Is(JsonValue::Type::kText)) Fail(key, "is no text");
    return member->text();
  }
  double Number(std::string_view key, std::optional<double> absent = std::nullopt) const {
    const JsonValue* member = value_.Find(key);
    if (member == nullptr && absent) return *absent;
    if (member == nullptr || !member->IsNumber()) Fail(key, "is no number");
    return member->number();
  }
  bool Flag(std::string_view key) const {
    const JsonValue* member = value_.Find(key);
    if (member == nullptr) return false;
    if (!member->Is(JsonValue::Type::kBoolean)) Fail(key, "is neither true nor false");
    return member->boolean();
  }
  // Returns a list of objects; an absent one is empty.
  std::vector<Answer> Objects(std::string_view key) const {
    std::vector<Answer> objects;
    const JsonValue* member = value_.Find(key);
    if (member == nullptr) return objects;
    if (!member->Is(JsonValue::Type::kList)) Fail(key, "is no list");
    for (std::size_t i = 0; i < member->list().size(); ++i) {
      objects.emplace_back(member->list()[i], source_, fmt::format("{}.{}[{}]", path_, key, i));
    }
    return objects;
  }
  const JsonValue* Find(std::string_view key) const { return value_.Find(key); }
  Answer Object(std::string_view key) const {
    const JsonValue* member = value_.Find(key);
    if (member == nullptr) Fail(key, "is not there");
    return {*member, source_, fmt::format("{}.{}", path_, key)};
  }

 private:
  const JsonValue& value_;
  std::string source_;
  std::string path_;
};

template <typename Enum, std::size_t kCount>
Enum OneOf(const Answer& answer, std::string_view key,
           const std::array<std::string_view, kCount>& names, std::optional<std::string> absent) {
  const std::string text = answer.Text(key, std::move(absent));
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    answer.Fail(key, fmt::format("is \"{}\"; {}", text, core::Suggest(text, names)));
  }
  return static_cast<Enum>(found - names.begin());
}

constexpr std::array<std::string_view, 10> kTypes{"real",   "angle", "integer",     "boolean",
                                                  "text",   "reals", "fixed_reals", "integers",
                                                  "choice", "group"};
constexpr std::array<std::string_view, 4> kOrigins{"published", "calibrated", "assumed", "setting"};

template <typename Number>
std::vector<Number> NumbersIn(const Answer& answer, std::string_view key) {
  const JsonValue* member = answer.Find(key);
  std::vector<Number> numbers;
  if (member == nullptr || !member->Is(JsonValue::Type::kList)) answer.Fail(key, "is no list");
  for (const JsonValue& each : member->list()) {
    if (!each.IsNumber()) answer.Fail(key, "is no list of numbers");
    if constexpr (std::is_same_v<Number, double>) {
      numbers.push_back(each.number());
    } else {
      if (!each.Is(JsonValue::Type::kInteger)) answer.Fail(key, "is no list of integers");
      numbers.push_back(each.integer());
    }
  }
  return numbers;
}

void ReadChoices(const Answer& answer, Field& field) {
  const JsonValue* choices = answer.Find("choices");
  const auto texts = choices == nullptr ? std::nullopt : core::TextsIn(*choices);
  if (!texts || texts->empty()) answer.Fail("choices", "is no list of names");
  field.choices = *texts;
  field.choice_views.assign(field.choices.begin(), field.choices.end());
  const JsonValue* chosen = answer.Find("default");
  if (chosen != nullptr && chosen->Is(JsonValue::Type::kText)) {
    const auto found = std::find(field.choices.begin(), field.choices.end(), chosen->text());
    if (found == field.choices.end()) answer.Fail("default", "is none of the choices");
    field.value.choice = static_cast<int>(found - field.choices.begin());
    return;
  }
  const double place = answer.Number("default", 0.0);
  if (place < 0.0 || place >= static_cast<double>(field.choices.size()) ||
      place != std::floor(place)) {
    answer.Fail("default", "is none of the choices");
  }
  field.value.choice = static_cast<int>(place);
}

void ReadDefault(const Answer& answer, Field& field) {
  switch (field.type) {
    case FieldType::kReal:
    case FieldType::kAngle:
      field.value.real = answer.Number("default");
      return;
    case FieldType::kInteger: {
      const JsonValue* value = answer.Find("default");
      if (value == nullptr || !value->Is(JsonValue::Type::kInteger)) {
        answer.Fail("default", "is no integer");
      }
      field.value.integer = value->integer();
      return;
    }
    case FieldType::kBoolean:
      field.value.boolean = answer.Flag("default");
      return;
    case FieldType::kText:
      field.value.text = answer.Text("default");
      return;
    case FieldType::kReals:
    case FieldType::kFixedReals:
      field.value.reals = NumbersIn<double>(answer, "default");
      return;
    case FieldType::kIntegers:
      field.value.integers = NumbersIn<std::int64_t>(answer, "default");
      return;
    case FieldType::kChoice:
      return ReadChoices(answer, field);
    case FieldType::kGroup:
      return;
  }
}

bool IsKey(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

// Reads a list of fields; `left` is how many there still may be.
class FieldsReader {
 public:
  std::vector<std::unique_ptr<Field>> Read(const Answer& answer, int depth = 0) {
    std::vector<std::unique_ptr<Field>> fields;
    for (const Answer& each : answer.Objects("parameters")) {
      if (left_-- == 0) answer.Fail("parameters", fmt::format("are more than {}", kMostFields));
      fields.push_back(ReadField(each, depth));
      for (std::size_t i = 0; i + 1 < fields.size(); ++i) {
        if (fields[i]->name == fields.back()->name) each.Fail("name", "is there twice");
      }
    }
    return fields;
  }

 private:
  std::unique_ptr<Field> ReadField(const Answer& answer, int depth) {
    auto field = std::make_unique<Field>();
    field->name = answer.Text("name");
    if (!IsKey(field->name)) answer.Fail("name", "has characters other than letters, digits and _");
    field->type = OneOf<FieldType>(answer, "type", kTypes, std::nullopt);
    field->doc = answer.Text("doc", "");
    field->source = answer.Text("source", "");
    if (field->type == FieldType::kGroup) {
      if (depth >= kDeepestGroup) answer.Fail("parameters", "stand in too many groups");
      field->fields = Read(answer, depth + 1);
      return field;
    }
    core::FieldInfo& info = field->info;
    info.doc = field->doc;
    info.source = field->source;
    info.origin = OneOf<core::Origin>(answer, "origin", kOrigins, "setting");
    info.min = answer.Number("min", -core::kUnbounded);
    info.max = answer.Number("max", core::kUnbounded);
    if (!(info.min <= info.max)) answer.Fail("min", "is above max");
    const double most = answer.Number("max_entries", 1000.0);
    info.max_entries = static_cast<std::size_t>(std::clamp(most, 0.0, 1e5));
    if (answer.Find("study") != nullptr) {
      const std::vector<double> study = NumbersIn<double>(answer, "study");
      if (study.size() != 2) answer.Fail("study", "is no pair of numbers");
      info.study_low = study[0];
      info.study_high = study[1];
    }
    ReadDefault(answer, *field);
    return field;
  }

  std::size_t left_ = kMostFields;
};

}  // namespace

std::unique_ptr<const Description> ReadDescription(const JsonValue& json,
                                                   const std::string& source) {
  const Answer answer(json, source, "description");
  auto description = std::make_unique<Description>();
  description->name = answer.Text("name");
  description->doc = answer.Text("doc", "of a plugin");
  description->version = answer.Text("version", "");
  description->fields = FieldsReader().Read(answer);
  for (const Answer& each : answer.Objects("own_values")) {
    messages::OwnValue value{each.Text("name"), each.Text("unit", "1"), each.Text("meaning", "")};
    const bool capitals =
        std::ranges::any_of(value.name, [](char c) { return c >= 'A' && c <= 'Z'; });
    if (!IsKey(value.name) || capitals) {
      each.Fail("name", "has characters other than lower-case letters, digits and _");
    }
    for (const messages::OwnValue& other : description->own_values) {
      if (other.name == value.name) each.Fail("name", "is there twice");
    }
    if (description->own_values.size() == kMostOwnValues) {
      answer.Fail("own_values", fmt::format("are more than {}", kMostOwnValues));
    }
    description->own_values.push_back(std::move(value));
  }
  description->takes_fixes = answer.Flag("takes_fixes");
  description->takes_motions = answer.Flag("takes_motions");
  return description;
}

namespace {

Problems ProblemsIn(const Answer& answer) {
  Problems problems;
  for (const Answer& each : answer.Objects("problems")) {
    problems.push_back({each.Text("parameter"), each.Text("reason"), each.Text("suggestion", "")});
  }
  return problems;
}

}  // namespace

Problems ReadProblems(const JsonValue& json, const std::string& source) {
  return ProblemsIn(Answer(json, source, "check"));
}

Traits ReadTraits(const JsonValue& json, const std::string& source) {
  const Answer answer(json, source, "traits");
  Traits traits;
  constexpr std::array<std::string_view, 3> kReads{"hazards", "points", "nothing"};
  traits.reads = OneOf<navigation::LookReading>(answer, "reads", kReads, std::nullopt);
  const Answer goal = answer.Object("goal_tolerance");
  traits.goal_parameter = goal.Text("parameter", "");
  traits.goal_tolerance_m = goal.Number("value_m");
  if (answer.Find("cost") != nullptr) {
    const Answer cost = answer.Object("cost");
    const std::string kind = cost.Text("kind");
    if (kind == "map") {
      navigation::CostOfMap map;
      map.cell_m = cost.Number("cell_m");
      map.area_m2 = cost.Number("area_m2");
      if (!(map.cell_m > 0.0 && map.area_m2 > 0.0)) cost.Fail("", "has a size that is not above 0");
      traits.cost = map;
    } else if (kind == "judgement") {
      traits.cost = navigation::CostOfJudgement{};
    } else if (kind == "look") {
      const double time_s = cost.Number("time_s", 0.0);
      if (!(time_s >= 0.0)) cost.Fail("time_s", "is below 0");
      traits.cost = navigation::CostOfLook{time_s};
    } else {
      cost.Fail("kind", "is none of look, map, judgement");
    }
  }
  traits.looks_on_the_move = answer.Flag("looks_on_the_move");
  traits.steers_on_the_move = answer.Flag("steers_on_the_move");
  traits.images = answer.Flag("images");
  traits.problems = ProblemsIn(answer);
  return traits;
}

navigation::NavigatorTraits Traits::AsNavigatorTraits() const {
  navigation::NavigatorTraits traits(reads, cost, {goal_parameter, goal_tolerance_m});
  traits.looks_on_the_move = looks_on_the_move;
  traits.steers_on_the_move = steers_on_the_move;
  traits.images = images;
  return traits;
}

namespace {

using Fields = std::vector<std::unique_ptr<Field>>;

void CollectDefaults(const Fields& fields, std::vector<FieldValue>& values) {
  for (const auto& field : fields) {
    if (field->type == FieldType::kGroup) {
      CollectDefaults(field->fields, values);
    } else {
      values.push_back(field->value);
    }
  }
}

// The fields of one group, each with its value, which `next` counts.
struct VisitedGroup {
  const Fields& fields;
  std::vector<FieldValue>& values;
  std::size_t& next;

  void Visit(core::FieldVisitor& v) {
    for (const auto& field : fields) {
      if (field->type == FieldType::kGroup) {
        VisitedGroup group{field->fields, values, next};
        v.Group(field->name, group, field->doc);
      } else {
        VisitOne(*field, values[next++], v);
      }
    }
  }

  static void VisitOne(const Field& field, FieldValue& value, core::FieldVisitor& v) {
    switch (field.type) {
      case FieldType::kReal:
        return v.Real(field.name, value.real, field.info);
      case FieldType::kAngle:
        return v.Angle(field.name, value.real, field.info);
      case FieldType::kInteger:
        return v.Integer(field.name, value.integer, field.info);
      case FieldType::kBoolean:
        return v.Boolean(field.name, value.boolean, field.info);
      case FieldType::kText:
        return v.Text(field.name, value.text, field.info);
      case FieldType::kReals:
        return v.Reals(field.name, value.reals, field.info);
      case FieldType::kFixedReals:
        return v.FixedReals(field.name, value.reals, field.info);
      case FieldType::kIntegers:
        return v.Integers(field.name, value.integers, field.info);
      case FieldType::kChoice:
        return v.ChoiceOf(field.name, value.choice, field.choice_views, field.info);
      case FieldType::kGroup:
        return;
    }
  }
};

JsonValue ValueToJson(const Field& field, const FieldValue& value) {
  switch (field.type) {
    case FieldType::kReal:
    case FieldType::kAngle:
      return JsonValue(value.real);
    case FieldType::kInteger:
      return JsonValue(value.integer);
    case FieldType::kBoolean:
      return JsonValue(value.boolean);
    case FieldType::kText:
      return JsonValue(value.text);
    case FieldType::kReals:
    case FieldType::kFixedReals:
      return core::ListOf(value.reals);
    case FieldType::kIntegers:
      return core::ListOf(value.integers);
    case FieldType::kChoice:
      return JsonValue(field.choices[static_cast<std::size_t>(value.choice)]);
    case FieldType::kGroup:
      break;
  }
  return {};
}

JsonValue GroupToJson(const Fields& fields, const std::vector<FieldValue>& values,
                      std::size_t& next) {
  JsonValue object = JsonValue::Object();
  for (const auto& field : fields) {
    object.Append(field->name, field->type == FieldType::kGroup
                                   ? GroupToJson(field->fields, values, next)
                                   : ValueToJson(*field, values[next++]));
  }
  return object;
}

}  // namespace

Parameters::Parameters(const Description& description) : description_(&description) {
  CollectDefaults(description.fields, values_);
}

void Parameters::Visit(core::FieldVisitor& v) {
  std::size_t next = 0;
  VisitedGroup{description_->fields, values_, next}.Visit(v);
}

JsonValue Parameters::ToJson() const {
  std::size_t next = 0;
  return GroupToJson(description_->fields, values_, next);
}

}  // namespace rockyard::plugin
