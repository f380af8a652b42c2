// Text files of numbers, line by line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rockyard::campaign {

struct NumberLine {
  int line = 1;                 // from 1
  std::vector<double> numbers;  // finite
};

// The words of a line, which blanks, tabs, carriage returns or commas part.
std::vector<std::string_view> WordsOf(std::string_view line);

// The finite number that all of a word is; nothing otherwise.
bool ParseNumber(std::string_view word, double& number);

// A text file of at most 64 MB whose lines are numbers; those that are empty or begin with # are
// left out. Throws core::UserError with the line: a word that is no finite number; no line with
// numbers at all; a file that cannot be read. `kind` says what to give instead: "a file of poses".
std::vector<NumberLine> ReadNumberLines(const std::filesystem::path& path, std::string_view kind);

// The lines of a text, without their ends.
std::vector<std::string_view> LinesOf(std::string_view text);

// Of files of text.
inline constexpr std::size_t kLargestText = std::size_t{64} << 20;

}  // namespace rockyard::campaign
