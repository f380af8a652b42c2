// Parses JSON text to values (core/json_text.h).
#include <fmt/format.h>

#include <cstddef>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/json_text.h"
#include "core/text.h"

namespace rockyard::core {
namespace {

// Input iterator that counts the bytes taken, so that the SAX events below know where they are.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, std::size_t* taken) : at_(at), taken_(taken) {}

  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*taken_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  std::size_t* taken_;
};

std::string Place(std::string_view text, std::size_t offset) {
  std::size_t line = 1;
  std::size_t column = 1;
  for (std::size_t i = 0; i < offset && i < text.size(); ++i) {
    column = text[i] == '\n' ? 1 : column + 1;
    line += text[i] == '\n';
  }
  return fmt::format("line {}, column {}", line, column);
}

// What the library says, without its own prefix and place.
std::string PlainReason(std::string what) {
  for (const std::string_view mark : {"while parsing ", "exception.out_of_range.406] "}) {
    const std::size_t found = what.find(mark);
    if (found != std::string::npos) return what.substr(found + (mark[0] == 'w' ? 0 : mark.size()));
  }
  return what;
}

// Builds the value from the library's events; stops at the first problem.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  Builder(std::string_view text, std::string_view source_name, const JsonLimits& limits,
          const std::size_t& taken)
      : text_(text), source_name_(source_name), limits_(limits), taken_(taken) {}

  JsonValue Take() { return std::move(root_); }

  bool null() override {
    const JsonValue value;  // named, since gcc 12 at -O2 takes a temporary for uninitialized
    return Add(value);
  }
  bool boolean(bool value) override { return Add(JsonValue(value)); }
  bool number_integer(number_integer_t value) override {
    return Add(JsonValue(std::int64_t{value}));
  }
  bool number_unsigned(number_unsigned_t value) override {
    constexpr auto kLargest = std::numeric_limits<std::int64_t>::max();
    if (value > static_cast<std::uint64_t>(kLargest)) {
      return Add(JsonValue(static_cast<double>(value)));
    }
    return Add(JsonValue(static_cast<std::int64_t>(value)));
  }
  bool number_float(number_float_t value, const string_t&) override {
    return Add(JsonValue(value));
  }
  bool string(string_t& value) override { return Add(JsonValue(std::move(value))); }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return Open(JsonValue::Object()); }
  bool start_array(std::size_t) override { return Open(JsonValue(JsonValue::List())); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    if (!level.keys.insert(name).second) {
      throw UserError(fmt::format("{}: {}", source_name_, Path() + std::string(ShownKey(name))),
                      fmt::format("the key is there twice, again at {}", Place(text_, taken_)),
                      "keep one of the two");
    }
    level.key = std::move(name);
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception& error) override {
    throw UserError(std::string(source_name_),
                    fmt::format("{}: {}", Place(text_, position == 0 ? 0 : position - 1),
                                PlainReason(error.what())),
                    "write strict JSON: double quotes, no comments, no trailing commas, finite "
                    "numbers");
  }

 private:
  // An object or a list that is still open.
  struct Level {
    JsonValue value;
    std::string key;                       // of the member to come
    std::unordered_set<std::string> keys;  // seen so far
  };

  std::string Path() const {
    std::string path;
    for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
      path += levels_[i].value.Is(JsonValue::Type::kList)
                  ? fmt::format("{}.", levels_[i].value.list().size())
                  : std::string(ShownKey(levels_[i].key)) + ".";
    }
    return path;
  }

  bool Add(JsonValue value) {
    if (levels_.empty()) {
      root_ = std::move(value);
    } else if (Level& level = levels_.back(); level.value.Is(JsonValue::Type::kList)) {
      level.value.list().push_back(std::move(value));
    } else {
      level.value.Append(std::move(level.key), std::move(value));
    }
    return true;
  }

  bool Open(JsonValue value) {
    if (static_cast<int>(levels_.size()) >= limits_.max_depth) {
      throw UserError(
          std::string(source_name_),
          fmt::format("{}: nested deeper than {} levels", Place(text_, taken_), limits_.max_depth),
          "remove brackets that nothing reads");
    }
    levels_.push_back({std::move(value), {}, {}});
    return true;
  }

  bool Close() {
    JsonValue value = std::move(levels_.back().value);
    levels_.pop_back();
    return Add(std::move(value));
  }

  std::string_view text_;
  std::string_view source_name_;
  const JsonLimits& limits_;
  const std::size_t& taken_;
  std::vector<Level> levels_;
  JsonValue root_;
};

}  // namespace

JsonValue ParseJson(std::string_view text, std::string_view source_name, const JsonLimits& limits) {
  if (text.size() > limits.max_bytes) {
    throw UserError(
        std::string(source_name),
        fmt::format("has {} bytes, more than the {} allowed", text.size(), limits.max_bytes),
        "check that this is the right file");
  }
  std::size_t taken = 0;
  Builder builder(text, source_name, limits, taken);
  nlohmann::json::sax_parse(CountingIterator(text.data(), &taken),
                            CountingIterator(text.data() + text.size(), &taken), &builder);
  return builder.Take();
}

}  // namespace rockyard::core
