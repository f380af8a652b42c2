// A JSON value in memory, of which files are read and results and answers are written. Fingerprints
// and result files depend on the order of members: one that Set or Merge replaces keeps its place.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rockyard::core {

struct JsonMember;

// A null, boolean, number, text, list or object. Objects keep the order of their members, and their
// keys are unique.
class JsonValue {
 public:
  using List = std::vector<JsonValue>;
  using Members = std::vector<JsonMember>;
  // Must have the order of Type: type() is the index.
  using Data = std::variant<std::monostate, bool, std::int64_t, double, std::string, List, Members>;
  enum class Type { kNull, kBoolean, kInteger, kReal, kText, kList, kObject };

  JsonValue() = default;
  // Where memory ends, std::bad_alloc leaves the value as it was.
  JsonValue(const JsonValue& other);
  JsonValue(JsonValue&& other) noexcept = default;
  JsonValue& operator=(const JsonValue& other);
  JsonValue& operator=(JsonValue&& other) noexcept = default;
  ~JsonValue() = default;
  explicit JsonValue(bool value);
  explicit JsonValue(std::int64_t value);
  explicit JsonValue(double value);
  explicit JsonValue(std::string value);
  explicit JsonValue(std::string_view value);
  explicit JsonValue(const char* value);
  explicit JsonValue(List values);
  // `value` must not exceed the largest std::int64_t.
  template <std::integral Integer>
  requires(!std::same_as<Integer, bool>) explicit JsonValue(Integer value);

  static JsonValue Object();
  // Returns an object of these members in their order; no two may have the same key. They are
  // copied: large values are better moved in with Set.
  static JsonValue Object(std::initializer_list<JsonMember> members);

  Type type() const { return static_cast<Type>(data_.index()); }
  bool Is(Type wanted) const { return type() == wanted; }
  bool IsNumber() const { return Is(Type::kInteger) || Is(Type::kReal); }

  // The content; each throws std::bad_variant_access where the type differs.
  bool boolean() const { return std::get<bool>(data_); }
  std::int64_t integer() const { return std::get<std::int64_t>(data_); }
  const std::string& text() const { return std::get<std::string>(data_); }
  const List& list() const { return std::get<List>(data_); }
  List& list() { return std::get<List>(data_); }
  const Members& members() const { return std::get<Members>(data_); }
  Members& members() { return std::get<Members>(data_); }  // keys must stay unique
  // Returns an integer or a real, as a real.
  double number() const;

  // Returns a member of an object; nullptr where there is none or where this value is no object.
  const JsonValue* Find(std::string_view key) const;
  JsonValue* Find(std::string_view key);

  // Replaces or appends a member; a value that is no object becomes one. Returns the member.
  JsonValue& Set(std::string_view key, JsonValue value);

  // Appends a member to an object, whose key is known to be new.
  void Append(std::string key, JsonValue value);

  // Sets every member of another object.
  void Update(JsonValue object);

  // Removes a member if it is there.
  void Erase(std::string_view key);

  // Lays `over` upon this value: objects merge member by member, anything else replaces.
  void Merge(const JsonValue& over);

 private:
  Data data_;
};

struct JsonMember {
  template <typename Value>
  requires std::constructible_from<JsonValue, Value> JsonMember(std::string name, Value&& content)
      : key(std::move(name)), value(std::forward<Value>(content)) {}

  std::string key;
  JsonValue value;
};

template <std::integral Integer>
requires(!std::same_as<Integer, bool>) JsonValue::JsonValue(Integer value)
    : JsonValue(static_cast<std::int64_t>(value)) {}

// Returns a list of plain values.
template <typename Values>
JsonValue ListOf(const Values& values) {
  JsonValue::List list;
  list.reserve(values.size());
  for (const auto& value : values) list.emplace_back(value);
  return JsonValue(std::move(list));
}

// Returns a list of to_json(value) of each value.
template <typename Values, typename ToJson>
JsonValue ListOf(const Values& values, const ToJson& to_json) {
  JsonValue::List list;
  list.reserve(values.size());
  for (const auto& value : values) list.push_back(to_json(value));
  return JsonValue(std::move(list));
}

// Returns null where `value` is not finite, which JSON has no number for.
JsonValue NumberOrNull(double value);

// Returns the texts of a list; nothing where `list` is no list of texts.
std::optional<std::vector<std::string>> TextsIn(const JsonValue& list);

// Returns "a list", "a number", ... for messages.
std::string_view Describe(JsonValue::Type type);

}  // namespace rockyard::core
