// JSON text written piece by piece, on one line, for pages of reports and replays: a page of ten
// thousand trials holds a million numbers, for which a tree of JsonValue would be many times the
// text. Answers to --json hold such text, too; no record, store or fingerprint does.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rockyard::core {

// Returns the shortest decimal that reads back to the same bits, whole numbers without a point;
// null where `value` is not finite.
std::string JsonNumber(double value);

// Returns the number with at most six significant digits; null where it is not finite.
std::string JsonSixDigits(double value);

// Returns [first,second,...] of values that are JSON already.
std::string JsonList(std::span<const std::string> values);

// Returns the list of text(item) of each item, which must be JSON.
template <typename Items, typename Text>
std::string JsonList(const Items& items, const Text& text) {
  std::string list(1, '[');
  for (const auto& item : items) {
    if (list.size() > 1) list += ',';
    list += text(item);
  }
  return list + ']';
}

// Returns the list of these texts, each quoted.
std::string JsonTexts(std::span<const std::string> texts);

// An object, member by member.
class JsonObject {
 public:
  // `json` must be JSON, and the key new.
  JsonObject& Add(std::string_view key, std::string_view json);
  JsonObject& AddText(std::string_view key, std::string_view text);
  JsonObject& AddNumber(std::string_view key, double value);
  JsonObject& AddInteger(std::string_view key, std::int64_t value);
  JsonObject& AddFlag(std::string_view key, bool value);

  std::string Text() const { return text_ + "}"; }

 private:
  std::string text_ = "{";
};

}  // namespace rockyard::core
