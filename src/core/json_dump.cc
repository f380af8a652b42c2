// Writes JSON values as text (core/json_text.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/check.h"
#include "core/json_text.h"

namespace rockyard::core {
namespace {

using Type = JsonValue::Type;

// Most texts need no escapes, and so no library.
bool StandsAsItIs(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; });
}

// Reals keep a point or an exponent, so that they read back as reals.
std::string RealText(double value) {
  EXPECT(std::isfinite(value));
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string PlainText(const JsonValue& value) {
  switch (value.type()) {
    case Type::kBoolean:
      return value.boolean() ? "true" : "false";
    case Type::kInteger:
      return fmt::format("{}", value.integer());
    case Type::kReal:
      return RealText(value.number());
    case Type::kText:
      return QuoteJson(value.text());
    default:
      return "null";
  }
}

bool IsPlain(const JsonValue& value) { return !value.Is(Type::kList) && !value.Is(Type::kObject); }

// What stands between the values of a list or an object.
enum class Gap { kNothing, kBlank, kLine };

// One list or object: its brackets and gaps.
class Level {
 public:
  Level(char open, char close, int depth, Gap gap, std::string& out)
      : close_(close), depth_(depth), gap_(gap), out_(out) {
    out_ += open;
  }

  void BeginValue() {
    if (!empty_) out_ += gap_ == Gap::kBlank ? ", " : ",";
    empty_ = false;
    if (gap_ == Gap::kLine) BreakLine(depth_ + 1);
  }

  void End() {
    if (gap_ == Gap::kLine && !empty_) BreakLine(depth_);
    out_ += close_;
  }

 private:
  void BreakLine(int depth) {
    out_ += '\n';
    out_.append(2 * static_cast<std::size_t>(depth), ' ');
  }

  char close_;
  int depth_;
  Gap gap_;
  std::string& out_;
  bool empty_ = true;
};

// What a text is for, which decides on plain lists and on the digits of reals. Must stay: both
// layouts. Fingerprints of stored runs hash texts of kReading, and files of kResults are compared
// as text.
enum class TextUse { kReading, kResults };

class TextWriter {
 public:
  TextWriter(TextUse use, int levels, std::string& out) : use_(use), levels_(levels), out_(out) {}

  void Append(const JsonValue& value, int depth = 0) {
    if (value.Is(Type::kList)) {
      AppendList(value.list(), depth);
    } else if (value.Is(Type::kObject)) {
      AppendObject(value.members(), depth);
    } else if (value.Is(Type::kReal) && use_ == TextUse::kResults) {
      out_ += nlohmann::json(value.number()).dump();
    } else {
      out_ += PlainText(value);
    }
  }

 private:
  Gap GapAt(int depth) const { return depth < levels_ ? Gap::kLine : Gap::kNothing; }

  void AppendList(const JsonValue::List& list, int depth) {
    const bool one_line =
        use_ == TextUse::kReading && std::all_of(list.begin(), list.end(), IsPlain);
    Level level('[', ']', depth, one_line ? Gap::kBlank : GapAt(depth), out_);
    for (const JsonValue& value : list) {
      level.BeginValue();
      Append(value, depth + 1);
    }
    level.End();
  }

  void AppendObject(const JsonValue::Members& members, int depth) {
    Level level('{', '}', depth, GapAt(depth), out_);
    for (const JsonMember& member : members) {
      level.BeginValue();
      out_ += QuoteJson(member.key);
      out_ += GapAt(depth) == Gap::kLine ? ": " : ":";
      Append(member.value, depth + 1);
    }
    level.End();
  }

  TextUse use_;
  int levels_;
  std::string& out_;
};

}  // namespace

std::string QuoteJson(std::string_view text) {
  if (StandsAsItIs(text)) return fmt::format("\"{}\"", text);
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string SpreadJson(const JsonValue& value, int levels) {
  std::string out;
  TextWriter(TextUse::kResults, levels, out).Append(value);
  return out;
}

std::string DumpJson(const JsonValue& value) {
  std::string out;
  TextWriter(TextUse::kReading, kAllLevels, out).Append(value);
  out += '\n';
  return out;
}

std::string Abbreviate(const JsonValue& value) {
  constexpr std::size_t kLongest = 60;
  if (!IsPlain(value)) return std::string(Describe(value.type()));
  if (value.Is(Type::kText) && value.text().size() > kLongest) {
    return QuoteJson(value.text().substr(0, kLongest) + "...");
  }
  return PlainText(value);
}

}  // namespace rockyard::core
