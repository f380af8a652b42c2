#include "core/field_table.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/check.h"
#include "core/units.h"

namespace rockyard::core {
namespace {

std::string_view TypeName(FieldKind kind) {
  switch (kind) {
    case FieldKind::kReal:
    case FieldKind::kAngle:
      return "number";
    case FieldKind::kInteger:
      return "integer";
    case FieldKind::kBoolean:
      return "boolean";
    case FieldKind::kText:
    case FieldKind::kChoice:
      return "string";
    case FieldKind::kReals:
    case FieldKind::kIntegers:
      return "array";
  }
  return "null";
}

void SetBounds(const ParameterInfo& parameter, JsonValue& schema) {
  if (std::isfinite(parameter.min)) schema.Set("minimum", JsonValue(parameter.min));
  if (std::isfinite(parameter.max)) schema.Set("maximum", JsonValue(parameter.max));
}

void SetItems(const ParameterInfo& parameter, JsonValue& schema) {
  JsonValue items = JsonValue::Object();
  items.Set("type", JsonValue(parameter.kind == FieldKind::kReals ? "number" : "integer"));
  SetBounds(parameter, items);
  schema.Set("items", std::move(items));
  if (parameter.fixed_length > 0) {
    const JsonValue length(static_cast<std::int64_t>(parameter.fixed_length));
    schema.Set("minItems", length);
    schema.Set("maxItems", length);
  }
}

JsonValue FieldSchema(const ParameterInfo& parameter) {
  JsonValue schema = JsonValue::Object();
  schema.Set("description", JsonValue(parameter.doc));
  schema.Set("type", JsonValue(TypeName(parameter.kind)));
  if (parameter.kind == FieldKind::kChoice) schema.Set("enum", ListOf(parameter.choices));
  if (parameter.kind == FieldKind::kReals || parameter.kind == FieldKind::kIntegers) {
    SetItems(parameter, schema);
  } else {
    SetBounds(parameter, schema);
  }
  schema.Set("default", parameter.value);
  if (parameter.unit != "1") schema.Set("x-unit", JsonValue(parameter.unit));
  schema.Set("x-origin", JsonValue(Name(parameter.origin)));
  if (!parameter.source.empty()) schema.Set("x-source", JsonValue(parameter.source));
  if (parameter.HasStudyRange()) {
    schema.Set("x-study-range", JsonValue(JsonValue::List{JsonValue(parameter.study_low),
                                                          JsonValue(parameter.study_high)}));
  }
  return schema;
}

JsonValue EmptyObjectSchema(std::string_view description) {
  JsonValue schema = JsonValue::Object();
  if (!description.empty()) schema.Set("description", JsonValue(description));
  schema.Set("type", JsonValue("object"));
  schema.Set("additionalProperties", JsonValue(false));
  schema.Set("properties", JsonValue::Object());
  return schema;
}

// Returns the "properties" of the group that holds `path` below `root`; `last_key` becomes the last
// key of the path.
JsonValue& PropertiesFor(JsonValue& root, std::string_view path, std::string_view& last_key) {
  JsonValue* schema = &root;
  while (true) {
    JsonValue* properties = schema->Find("properties");
    const std::size_t dot = path.find('.');
    if (dot == std::string_view::npos) {
      last_key = path;
      return *properties;
    }
    schema = properties->Find(path.substr(0, dot));
    path.remove_prefix(dot + 1);
  }
}

}  // namespace

std::string_view Name(Origin origin) {
  constexpr std::array<std::string_view, 4> kNames = {"published", "calibrated", "assumed",
                                                      "setting"};
  return kNames[static_cast<std::size_t>(origin)];
}

ParameterInfo& FieldTable::Add(std::string_view name, FieldKind kind, JsonValue value,
                               const FieldInfo& info) {
  ParameterInfo parameter;
  parameter.path = prefix_ + std::string(name);
  parameter.kind = kind;
  parameter.value = std::move(value);
  parameter.unit = UnitOf(name);
  parameter.min = info.min;
  parameter.max = info.max;
  parameter.origin = info.origin;
  parameter.source = info.source;
  parameter.doc = info.doc;
  parameter.study_low = info.study_low;
  parameter.study_high = info.study_high;
  parameters_.push_back(std::move(parameter));
  return parameters_.back();
}

void FieldTable::Real(std::string_view name, double& value, const FieldInfo& info) {
  Add(name, FieldKind::kReal, JsonValue(value), info);
}

void FieldTable::Angle(std::string_view name, double& value_rad, const FieldInfo& info) {
  Add(name, FieldKind::kAngle, JsonValue(ExactDegrees(value_rad)), info);
}

void FieldTable::Integer(std::string_view name, std::int64_t& value, const FieldInfo& info) {
  Add(name, FieldKind::kInteger, JsonValue(value), info);
}

void FieldTable::Boolean(std::string_view name, bool& value, const FieldInfo& info) {
  Add(name, FieldKind::kBoolean, JsonValue(value), info);
}

void FieldTable::Text(std::string_view name, std::string& value, const FieldInfo& info) {
  Add(name, FieldKind::kText, JsonValue(value), info);
}

void FieldTable::Reals(std::string_view name, std::vector<double>& values, const FieldInfo& info) {
  Add(name, FieldKind::kReals, ListOf(values), info);
}

void FieldTable::FixedReals(std::string_view name, std::span<double> values,
                            const FieldInfo& info) {
  Add(name, FieldKind::kReals, ListOf(values), info).fixed_length = values.size();
}

void FieldTable::Integers(std::string_view name, std::vector<std::int64_t>& values,
                          const FieldInfo& info) {
  Add(name, FieldKind::kIntegers, ListOf(values), info);
}

void FieldTable::Require(std::string_view, bool, std::string_view, std::string_view) {}

void FieldTable::ChoiceIndex(std::string_view name, int& index,
                             std::span<const std::string_view> names, const FieldInfo& info) {
  EXPECT(index >= 0 && static_cast<std::size_t>(index) < names.size());
  ParameterInfo& parameter =
      Add(name, FieldKind::kChoice, JsonValue(names[static_cast<std::size_t>(index)]), info);
  parameter.choices.assign(names.begin(), names.end());
}

void FieldTable::BeginGroup(std::string_view name, std::string_view doc) {
  prefix_ += name;
  groups_.push_back({prefix_, std::string(doc), parameters_.size()});
  prefix_ += '.';
}

void FieldTable::EndGroup() {
  prefix_.pop_back();
  const std::size_t dot = prefix_.rfind('.');
  prefix_.resize(dot == std::string::npos ? 0 : dot + 1);
}

JsonValue MakeSchema(const FieldTable& table, std::string_view title) {
  JsonValue root = JsonValue::Object();
  root.Set("$schema", JsonValue("https://json-schema.org/draft/2020-12/schema"));
  root.Set("title", JsonValue(title));
  const JsonValue body = EmptyObjectSchema("");
  for (const JsonMember& member : body.members()) root.Set(member.key, member.value);
  std::string_view key;
  auto group = table.groups().begin();
  for (std::size_t i = 0; i <= table.parameters().size(); ++i) {
    for (; group != table.groups().end() && group->first_parameter == i; ++group) {
      JsonValue& properties = PropertiesFor(root, group->path, key);
      properties.Set(key, EmptyObjectSchema(group->doc));
    }
    if (i == table.parameters().size()) break;
    const ParameterInfo& parameter = table.parameters()[i];
    JsonValue& properties = PropertiesFor(root, parameter.path, key);
    properties.Set(key, FieldSchema(parameter));
  }
  return root;
}

}  // namespace rockyard::core
