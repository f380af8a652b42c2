#include "app/console.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "batch/communicator.h"

namespace rockyard::app {
namespace {

using report::Printable;

constexpr int kDefaultWidth = 100;

// Empty where it is not set.
std::string_view Variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

// The stream itself remembers that it failed.
void Write(std::string_view text) {
  if (OutputFailed()) return;
  errno = 0;
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (written) return;
  const int reason = errno;
  if (reason == EPIPE) return std::clearerr(stdout);
  PrintProblems({{"standard output", fmt::format("cannot be written: {}", std::strerror(reason)),
                  "check the free space of where it goes"}});
}

}  // namespace

bool IsTerminal(std::FILE* stream) {
  return isatty(fileno(stream)) == 1 && !batch::FindLaunch().has_value();
}

int TerminalWidth(std::FILE* stream) {
  winsize size{};
  const bool known = ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kDefaultWidth;
}

report::TextStyle StyleFor(std::FILE* stream) {
  using report::TextStyle;
  if (!Variable("NO_COLOR").empty()) return TextStyle::kPlain;
  const std::string_view forced = Variable("CLICOLOR_FORCE");
  if (!forced.empty() && forced != "0") return TextStyle::kColour;
  return IsTerminal(stream) && Variable("TERM") != "dumb" ? TextStyle::kColour : TextStyle::kPlain;
}

void Print(std::string_view text) { Write(report::PrintableLines(text)); }

void PrintJson(std::string_view json) { Write(report::PrintableJson(json)); }

void PrintExact(std::string_view text) { Write(text); }

bool OutputFailed() { return std::ferror(stdout) != 0; }

ExitCode AfterFailedOutput(ExitCode outcome) {
  const bool says_more = outcome == ExitCode::kBadInput || outcome == ExitCode::kInterrupted;
  return says_more ? outcome : ExitCode::kFailed;
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
