#include "campaign/odometry/number_lines.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/whole_file.h"

namespace rockyard::campaign {

std::vector<std::string_view> WordsOf(std::string_view line) {
  constexpr std::string_view kBetween = " \t\r,";
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(kBetween);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kBetween, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBetween, end);
  }
  return words;
}

bool ParseNumber(std::string_view word, double& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(number);
}

std::vector<std::string_view> LinesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<NumberLine> ReadNumberLines(const std::filesystem::path& path, std::string_view kind) {
  const std::string text = core::ReadTextFile(path, kLargestText, kind);
  std::vector<NumberLine> lines;
  int number = 0;
  for (const std::string_view line : LinesOf(text)) {
    ++number;
    const std::vector<std::string_view> words = WordsOf(line);
    if (words.empty() || words.front().starts_with('#')) continue;
    NumberLine& read = lines.emplace_back();
    read.line = number;
    for (const std::string_view word : words) {
      if (!ParseNumber(word, read.numbers.emplace_back())) {
        throw core::UserError(fmt::format("{}: line {}", path.string(), number),
                              fmt::format("\"{}\" is no finite number", word.substr(0, 40)),
                              fmt::format("give {}", kind));
      }
    }
  }
  if (lines.empty()) {
    throw core::UserError(path.string(), "holds no numbers", fmt::format("give {}", kind));
  }
  return lines;
}

}  // namespace rockyard::campaign
