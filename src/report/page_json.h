// JSON text for the pages, written piece by piece: a page of ten thousand trials holds a million
// numbers, for which a tree in memory would be many times the text.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rockyard::report {

// A quoted JSON string. What is no UTF-8 becomes U+FFFD, one for each bad byte or sequence.
std::string JsonText(std::string_view text);

// The shortest decimal that reads back to the same bits; null where it is not finite.
std::string JsonNumber(double value);

// The same with at most six significant digits.
std::string JsonSixDigits(double value);

// [first,second,...] of values that are JSON already.
std::string JsonList(std::span<const std::string> values);

std::string JsonTexts(std::span<const std::string> texts);

// The same JSON without blanks between its values.
std::string JsonCompact(std::string_view json);

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

}  // namespace rockyard::report
