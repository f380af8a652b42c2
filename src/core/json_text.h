// JSON text to values and back, for every file and answer of the command in JSON. Documents that
// are too large for a tree of values are written with json_pieces.h.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include "core/json_value.h"

namespace rockyard::core {

// Bounds that keep hostile or mistaken inputs from exhausting memory or the stack.
struct JsonLimits {
  std::size_t max_bytes = std::size_t{32} << 20;
  int max_depth = 32;
};

// Parses strict JSON (RFC 8259: UTF-8, no comments, no NaN or infinity). Duplicate keys and numbers
// beyond the range of a double are errors. Throws UserError whose path is `source_name` (for
// duplicate keys `source_name` and the key's path) and whose reason names line and column.
JsonValue ParseJson(std::string_view text, std::string_view source_name,
                    const JsonLimits& limits = {});

// Returns pretty text: members in their order, lists of plain values on one line, doubles as the
// shortest decimal that reads back to the same bits. Numbers must be finite. Ends with a newline.
// Must stay: the layout. Fingerprints of stored runs hash this text (scenario/load.h).
std::string DumpJson(const JsonValue& value);

// Returns a text as JSON, with its quotes. What is no UTF-8 becomes U+FFFD, one for each bad byte
// or sequence.
std::string QuoteJson(std::string_view text);

inline constexpr int kAllLevels = std::numeric_limits<int>::max();

// Returns text for result files: the outer `levels` of lists and objects have a line for each
// value, deeper ones stand without blanks. Reals read back to the same bits. Must stay: their
// digits, those that result files have always had (Grisu2), of which 1 number in 2500 has one more
// than the shortest decimal. What is not finite becomes null. No newline stands at the end.
std::string SpreadJson(const JsonValue& value, int levels = kAllLevels);
inline std::string CompactJson(const JsonValue& value) { return SpreadJson(value, 0); }

// Returns one line for messages; texts are cut to 60 characters, lists and objects are only named.
std::string Abbreviate(const JsonValue& value);

}  // namespace rockyard::core
