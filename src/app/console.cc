#include "app/console.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace rockyard::app {
namespace {

constexpr int kDefaultWidth = 100;

std::string Printable(std::string_view text) {
  std::string safe(text);
  for (char& c : safe) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = c == '\n' ? ' ' : '?';
  }
  return safe;
}

}  // namespace

bool IsTerminal(std::FILE* stream) { return isatty(fileno(stream)) == 1; }

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
  const std::string line = Printable(text) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace rockyard::app
