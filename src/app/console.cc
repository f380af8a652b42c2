#include "app/console.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "batch/communicator.h"

namespace rockyard::app {
namespace {

constexpr int kDefaultWidth = 100;
constexpr std::size_t kTextWidth = 100;

std::string WrappedLine(std::string line) {
  std::size_t words = line.find_first_not_of(' ');  // where they begin
  if (words == std::string::npos) return line;
  const std::string indent(words + 4, ' ');
  std::string text;
  while (line.size() > kTextWidth) {
    std::size_t space = line.rfind(' ', kTextWidth);
    if (space < words) space = line.find(' ', kTextWidth);  // a word of that many columns
    if (space == std::string::npos) break;
    text += line.substr(0, space) + "\n";
    line.replace(0, space + 1, indent);
    words = indent.size();
  }
  return text + line;
}

std::string Printable(std::string_view text) {
  std::string safe(text);
  for (char& c : safe) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = c == '\n' ? ' ' : '?';
  }
  return safe;
}

}  // namespace

bool IsTerminal(std::FILE* stream) {
  return isatty(fileno(stream)) == 1 && !batch::FindLaunch().has_value();
}

bool IsFirstRank() {
  const std::optional<batch::Launch> launch = batch::FindLaunch();
  return !launch || launch->rank == 0;
}

int TerminalWidth(std::FILE* stream) {
  winsize size{};
  const bool known = ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kDefaultWidth;
}

report::TextStyle StyleFor(std::FILE* stream) {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  const bool refused = (no_color != nullptr && *no_color != '\0') ||
                       (term != nullptr && std::string_view(term) == "dumb");
  return IsTerminal(stream) && !refused ? report::TextStyle::kColour : report::TextStyle::kPlain;
}

std::string Wrapped(std::string_view text) {
  std::string wrapped;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    wrapped += WrappedLine(std::string(text.substr(begin, end - begin)));
    if (end < text.size()) wrapped += '\n';
    begin = end + 1;
  }
  return wrapped;
}

void Print(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

void PrintProblems(const std::vector<core::Problem>& problems) {
  std::string text;
  for (const core::Problem& problem : problems) {
    text += fmt::format("error: {}: {}\n", Printable(problem.path), Printable(problem.reason));
    if (!problem.suggestion.empty()) {
      text += fmt::format("  try: {}\n", Printable(problem.suggestion));
    }
  }
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void PrintNote(std::string_view text) {
  const std::string line = Wrapped(Printable(text)) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace rockyard::app
