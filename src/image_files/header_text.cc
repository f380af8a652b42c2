#include "image_files/header_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "image_files/raw_image.h"

namespace rockyard::image_files {
namespace {

constexpr std::string_view kBlanks = " \t\n\v\f\r";

bool IsBlank(char character) { return kBlanks.find(character) != std::string_view::npos; }

}  // namespace

std::string_view HeaderText::RestWithoutBlanks() {
  while (!rest_.empty()) {
    if (rest_.front() == '#') {
      rest_.remove_prefix(std::min(rest_.find_first_of("\n\r"), rest_.size()));
    } else if (IsBlank(rest_.front())) {
      rest_.remove_prefix(1);
    } else {
      break;
    }
  }
  return rest_;
}

std::string_view HeaderText::Word() {
  RestWithoutBlanks();
  if (rest_.empty()) FailTruncated(name_);
  std::size_t length = 0;
  while (length < rest_.size() && !IsBlank(rest_[length]) && rest_[length] != '#') ++length;
  const std::string_view word = rest_.substr(0, length);
  rest_.remove_prefix(length);
  return word;
}

std::int64_t HeaderText::Number(std::string_view what, std::int64_t most) {
  const std::string_view word = Word();
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size() || number < 0 || number > most) {
    FailDamaged(name_, fmt::format("its {} is no number from 0 to {}", what, most));
  }
  return number;
}

void HeaderText::EndOfHeader() {
  if (rest_.empty()) FailTruncated(name_);
  if (!IsBlank(rest_.front())) FailDamaged(name_, "its header does not end in white space");
  rest_.remove_prefix(1);
}

}  // namespace rockyard::image_files
