#include "core/json_value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

namespace rockyard::core {

// The variant's own copy must not be used: in libstdc++ 12 it destroys what was never made where a
// text or a list finds no memory.
JsonValue::JsonValue(const JsonValue& other) {
  const auto copy = [this](const auto& value) {
    data_.emplace<std::remove_cvref_t<decltype(value)>>(value);
  };
  std::visit(copy, other.data_);
}

JsonValue& JsonValue::operator=(const JsonValue& other) { return *this = JsonValue(other); }

JsonValue::JsonValue(bool value) : data_(value) {}
JsonValue::JsonValue(std::int64_t value) : data_(value) {}
JsonValue::JsonValue(double value) : data_(value) {}
JsonValue::JsonValue(std::string value) : data_(std::move(value)) {}
JsonValue::JsonValue(std::string_view value) : data_(std::string(value)) {}
JsonValue::JsonValue(const char* value) : data_(std::string(value)) {}
JsonValue::JsonValue(List values) : data_(std::move(values)) {}

JsonValue JsonValue::Object() {
  JsonValue value;
  value.data_ = Members();
  return value;
}

JsonValue JsonValue::Object(std::initializer_list<JsonMember> members) {
  JsonValue value;
  value.data_ = Members(members);
  return value;
}

double JsonValue::number() const {
  if (Is(Type::kInteger)) return static_cast<double>(integer());
  return std::get<double>(data_);
}

const JsonValue* JsonValue::Find(std::string_view key) const {
  const auto* members = std::get_if<Members>(&data_);
  if (members == nullptr) return nullptr;
  const auto found = std::find_if(members->begin(), members->end(),
                                  [key](const JsonMember& member) { return member.key == key; });
  return found == members->end() ? nullptr : &found->value;
}

JsonValue* JsonValue::Find(std::string_view key) {
  return const_cast<JsonValue*>(std::as_const(*this).Find(key));
}

JsonValue& JsonValue::Set(std::string_view key, JsonValue value) {
  if (JsonValue* member = Find(key)) {
    *member = std::move(value);
    return *member;
  }
  if (!Is(Type::kObject)) data_ = Members();
  auto& members = std::get<Members>(data_);
  members.emplace_back(std::string(key), std::move(value));
  return members.back().value;
}

void JsonValue::Append(std::string key, JsonValue value) {
  std::get<Members>(data_).emplace_back(std::move(key), std::move(value));
}

void JsonValue::Update(JsonValue object) {
  for (JsonMember& member : object.members()) Set(member.key, std::move(member.value));
}

void JsonValue::Erase(std::string_view key) {
  if (auto* members = std::get_if<Members>(&data_)) {
    std::erase_if(*members, [key](const JsonMember& member) { return member.key == key; });
  }
}

void JsonValue::Merge(const JsonValue& over) {
  if (!Is(Type::kObject) || !over.Is(Type::kObject)) {
    *this = over;
    return;
  }
  for (const JsonMember& member : over.members()) {
    if (JsonValue* mine = Find(member.key)) {
      mine->Merge(member.value);
    } else {
      Set(member.key, member.value);
    }
  }
}

JsonValue NumberOrNull(double value) {
  return std::isfinite(value) ? JsonValue(value) : JsonValue();
}

std::optional<std::vector<std::string>> TextsIn(const JsonValue& list) {
  if (!list.Is(JsonValue::Type::kList)) return std::nullopt;
  std::vector<std::string> texts;
  for (const JsonValue& value : list.list()) {
    if (!value.Is(JsonValue::Type::kText)) return std::nullopt;
    texts.push_back(value.text());
  }
  return texts;
}

std::string_view Describe(JsonValue::Type type) {
  constexpr std::array<std::string_view, 7> kNames = {
      "null", "true or false", "an integer", "a number", "a text", "a list", "an object"};
  return kNames[static_cast<std::size_t>(type)];
}

}  // namespace rockyard::core
