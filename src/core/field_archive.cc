#include "core/field_archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "core/check.h"
#include "core/json_text.h"
#include "core/text.h"
#include "core/units.h"
#include "math/angles.h"

namespace rockyard::core {

namespace {

using Type = JsonValue::Type;

constexpr std::size_t kMaxProblems = 100;
constexpr std::size_t kLongestText = 10000;
// Whole reals up to here are exact integers.
constexpr double kLargestExactInteger = 9007199254740992.0;

std::string_view LastKey(std::string_view path) {
  const std::size_t bracket = path.find('[');
  path = path.substr(0, bracket);
  return path.substr(path.rfind('.') + 1);
}

std::string BoundsText(const FieldInfo& info, std::string_view path) {
  const std::string unit = UnitOf(LastKey(path));
  const std::string suffix = unit == "1" ? "" : " " + unit;
  if (std::isinf(info.min)) return fmt::format("use at most {}{}", info.max, suffix);
  if (std::isinf(info.max)) return fmt::format("use at least {}{}", info.min, suffix);
  return fmt::format("use a value from {} to {}{}", info.min, info.max, suffix);
}

}  // namespace

FieldReader::FieldReader(const JsonValue& root, std::initializer_list<std::string_view> others) {
  levels_.push_back({&root, "", others, 0});
  if (!root.Is(Type::kObject)) {
    AddWrongType("(root)", "an object", root);
    levels_.back().object = nullptr;
  }
}

void FieldReader::Finish() {
  CheckUnknownKeys();
  if (problems_.empty()) return;
  if (problem_count_ > problems_.size()) {
    problems_.push_back({"(more)",
                         fmt::format("{} more problems", problem_count_ - problems_.size()),
                         "correct these first"});
  }
  throw UserError(std::move(problems_));
}

const JsonValue* FieldReader::Take(std::string_view name) {
  Level& level = levels_.back();
  level.keys.push_back(name);
  return level.object == nullptr ? nullptr : level.object->Find(name);
}

std::string FieldReader::Path(std::string_view name) const {
  return levels_.back().path + std::string(name);
}

void FieldReader::Add(std::string path, std::string reason, std::string suggestion) {
  ++problem_count_;
  if (problems_.size() < kMaxProblems) {
    problems_.push_back({std::move(path), std::move(reason), std::move(suggestion)});
  }
}

void FieldReader::AddWrongType(const std::string& path, std::string_view wanted,
                               const JsonValue& value) {
  const std::string content = Abbreviate(value);
  const std::string_view type = Describe(value.type());
  Add(path,
      content == type ? fmt::format("is {}, not {}", type, wanted)
                      : fmt::format("is {} ({}), not {}", content, type, wanted),
      fmt::format("write {}", wanted));
}

void FieldReader::CheckUnknownKeys() {
  const Level& level = levels_.back();
  if (level.object == nullptr) return;
  for (const JsonMember& member : level.object->members()) {
    if (std::find(level.keys.begin(), level.keys.end(), member.key) != level.keys.end()) continue;
    Add(Path(ShownKey(member.key).substr(0, 60)), "is not a known key",
        Suggest(member.key, level.keys));
  }
}

bool FieldReader::CheckBounds(const std::string& path, const JsonValue& value,
                              const FieldInfo& info) {
  const double number = value.number();
  if (number >= info.min && number <= info.max) return true;
  const bool below = number < info.min;
  Add(path,
      fmt::format("is {}, {} the {} allowed value {}", Abbreviate(value), below ? "below" : "above",
                  below ? "smallest" : "largest", below ? info.min : info.max),
      BoundsText(info, path));
  return false;
}

bool FieldReader::ReadReal(const std::string& path, const JsonValue& value, const FieldInfo& info,
                           double& out) {
  if (!value.IsNumber()) {
    AddWrongType(path, "a number", value);
    return false;
  }
  if (!CheckBounds(path, value, info)) return false;
  out = value.number();
  return true;
}

bool FieldReader::ReadInteger(const std::string& path, const JsonValue& value,
                              const FieldInfo& info, std::int64_t& out) {
  const bool whole = value.Is(Type::kReal) && std::trunc(value.number()) == value.number();
  if (!value.Is(Type::kInteger) && !whole) {
    AddWrongType(path, "an integer", value);
    return false;
  }
  if (!CheckBounds(path, value, info)) return false;
  if (value.Is(Type::kReal) && std::fabs(value.number()) > kLargestExactInteger) {
    Add(path, fmt::format("is {}, too large for an exact integer", Abbreviate(value)),
        "write an integer below 9223372036854775808");
    return false;
  }
  out = value.Is(Type::kInteger) ? value.integer() : static_cast<std::int64_t>(value.number());
  return true;
}

void FieldReader::Real(std::string_view name, double& value, const FieldInfo& info) {
  if (const JsonValue* input = Take(name)) ReadReal(Path(name), *input, info, value);
}

void FieldReader::Angle(std::string_view name, double& value_rad, const FieldInfo& info) {
  double degrees = 0.0;
  const JsonValue* input = Take(name);
  if (input != nullptr && ReadReal(Path(name), *input, info, degrees)) {
    value_rad = math::DegToRad(degrees);
  }
}

void FieldReader::Integer(std::string_view name, std::int64_t& value, const FieldInfo& info) {
  if (const JsonValue* input = Take(name)) ReadInteger(Path(name), *input, info, value);
}

void FieldReader::Boolean(std::string_view name, bool& value, const FieldInfo&) {
  const JsonValue* input = Take(name);
  if (input == nullptr) return;
  if (input->Is(Type::kBoolean)) {
    value = input->boolean();
  } else {
    AddWrongType(Path(name), "true or false", *input);
  }
}

void FieldReader::Text(std::string_view name, std::string& value, const FieldInfo&) {
  const JsonValue* input = Take(name);
  if (input == nullptr) return;
  if (!input->Is(Type::kText)) {
    AddWrongType(Path(name), "a text", *input);
  } else if (input->text().size() > kLongestText) {
    Add(Path(name), fmt::format("has {} bytes", input->text().size()),
        fmt::format("use at most {}", kLongestText));
  } else {
    value = input->text();
  }
}

template <typename Element>
std::optional<std::vector<Element>> FieldReader::ReadElements(std::string_view name,
                                                              const FieldInfo& info) {
  const JsonValue* input = Take(name);
  if (input == nullptr) return std::nullopt;
  const std::string path = Path(name);
  if (!input->Is(Type::kList)) {
    AddWrongType(path, "a list of numbers", *input);
    return std::nullopt;
  }
  const JsonValue::List& list = input->list();
  if (list.size() > info.max_entries) {
    Add(path, fmt::format("has {} elements", list.size()),
        fmt::format("use at most {}", info.max_entries));
    return std::nullopt;
  }
  std::vector<Element> read(list.size());
  bool good = true;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const std::string element_path = fmt::format("{}[{}]", path, i);
    if constexpr (std::is_same_v<Element, double>) {
      good &= ReadReal(element_path, list[i], info, read[i]);
    } else {
      good &= ReadInteger(element_path, list[i], info, read[i]);
    }
  }
  return good ? std::optional(std::move(read)) : std::nullopt;
}

void FieldReader::Reals(std::string_view name, std::vector<double>& values, const FieldInfo& info) {
  if (auto read = ReadElements<double>(name, info)) values = *std::move(read);
}

void FieldReader::FixedReals(std::string_view name, std::span<double> values,
                             const FieldInfo& info) {
  const auto read = ReadElements<double>(name, info);
  if (!read) return;
  if (read->size() != values.size()) {
    Add(Path(name), fmt::format("has {} elements, not {}", read->size(), values.size()),
        fmt::format("write {} numbers", values.size()));
    return;
  }
  std::copy(read->begin(), read->end(), values.begin());
}

void FieldReader::Integers(std::string_view name, std::vector<std::int64_t>& values,
                           const FieldInfo& info) {
  if (auto read = ReadElements<std::int64_t>(name, info)) values = *std::move(read);
}

void FieldReader::ChoiceIndex(std::string_view name, int& index,
                              std::span<const std::string_view> names, const FieldInfo&) {
  const JsonValue* input = Take(name);
  if (input == nullptr) return;
  if (!input->Is(Type::kText)) {
    AddWrongType(Path(name), "a name", *input);
    return;
  }
  const auto found = std::find(names.begin(), names.end(), input->text());
  if (found == names.end()) {
    Add(Path(name), fmt::format("is {}, which is not a known name", Abbreviate(*input)),
        Suggest(input->text(), names));
    return;
  }
  index = static_cast<int>(found - names.begin());
}

void FieldReader::Require(std::string_view name, bool holds, std::string_view reason,
                          std::string_view suggestion) {
  if (holds || problem_count_ > levels_.back().problems_before) return;
  Add(Path(name), std::string(reason), std::string(suggestion));
}

void FieldReader::BeginGroup(std::string_view name, std::string_view) {
  const std::size_t problems_before = problem_count_;
  const JsonValue* object = Take(name);
  if (object != nullptr && !object->Is(Type::kObject)) {
    AddWrongType(Path(name), "an object", *object);
    object = nullptr;
  }
  levels_.push_back({object, Path(name) + ".", {}, problems_before});
}

void FieldReader::EndGroup() {
  CheckUnknownKeys();
  levels_.pop_back();
}

FieldWriter::FieldWriter() { levels_.push_back({"", JsonValue::Object()}); }

JsonValue FieldWriter::Take() {
  EXPECT(levels_.size() == 1);
  return std::move(levels_.back().object);
}

void FieldWriter::Add(std::string_view name, JsonValue value) {
  EXPECT(levels_.back().object.Find(name) == nullptr);
  levels_.back().object.Append(std::string(name), std::move(value));
}

void FieldWriter::Real(std::string_view name, double& value, const FieldInfo&) {
  Add(name, JsonValue(value));
}

void FieldWriter::Angle(std::string_view name, double& value_rad, const FieldInfo&) {
  Add(name, JsonValue(ExactDegrees(value_rad)));
}

void FieldWriter::Integer(std::string_view name, std::int64_t& value, const FieldInfo&) {
  Add(name, JsonValue(value));
}

void FieldWriter::Boolean(std::string_view name, bool& value, const FieldInfo&) {
  Add(name, JsonValue(value));
}

void FieldWriter::Text(std::string_view name, std::string& value, const FieldInfo&) {
  Add(name, JsonValue(value));
}

void FieldWriter::Reals(std::string_view name, std::vector<double>& values, const FieldInfo&) {
  Add(name, ListOf(values));
}

void FieldWriter::FixedReals(std::string_view name, std::span<double> values, const FieldInfo&) {
  Add(name, ListOf(values));
}

void FieldWriter::Integers(std::string_view name, std::vector<std::int64_t>& values,
                           const FieldInfo&) {
  Add(name, ListOf(values));
}

void FieldWriter::Require(std::string_view, bool, std::string_view, std::string_view) {}

void FieldWriter::ChoiceIndex(std::string_view name, int& index,
                              std::span<const std::string_view> names, const FieldInfo&) {
  EXPECT(index >= 0 && static_cast<std::size_t>(index) < names.size());
  Add(name, JsonValue(names[static_cast<std::size_t>(index)]));
}

void FieldWriter::BeginGroup(std::string_view name, std::string_view) {
  levels_.push_back({name, JsonValue::Object()});
}

void FieldWriter::EndGroup() {
  Level level = std::move(levels_.back());
  levels_.pop_back();
  Add(level.name, std::move(level.object));
}

}  // namespace rockyard::core
