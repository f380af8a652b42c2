// What people see: streams, colours, errors.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "campaign/work.h"
#include "core/error.h"
#include "report/line_text.h"
#include "report/summary_text.h"

namespace rockyard::app {

// What the command tells the shell: 0 done, 1 a comparison differs, 2 bad input, 3 too many
// simulator faults, 4 inconclusive, 5 failed while running, 130 interrupted.
using ExitCode = campaign::Outcome;

// False in a process of mpirun, which gives a terminal of its own making to rank 0 wherever its own
// output goes.
bool IsTerminal(std::FILE* stream);

// Columns of the terminal on `stream`; 100 where it is none or does not tell.
int TerminalWidth(std::FILE* stream);

// Colours on a terminal that is not "dumb", or anywhere where CLICOLOR_FORCE is set to something
// else than 0; none where NO_COLOR is set (no-color.org), whatever else is.
report::TextStyle StyleFor(std::FILE* stream);

// What follows goes to standard output. Where that cannot be written, PrintProblems says so once,
// the rest is dropped and OutputFailed() from then on; the caller goes on, as what it writes
// elsewhere is of use all the same. A pipe whose reader has gone is no failure: who asked for `|
// head` has it.

// Text for people: what a terminal would obey or hide is shown as '?' (report::PrintableLines), who
// ever named it.
void Print(std::string_view text);

// JSON, in which it is escaped.
void PrintJson(std::string_view json);

// CSV and scripts, which are files that happen to go to standard output: every byte as it is.
void PrintExact(std::string_view text);

// That some of the above was lost.
bool OutputFailed();

// How work ended of which nobody could read what it said: kFailed, except where its input was bad
// or somebody ended it, which say more.
ExitCode AfterFailedOutput(ExitCode outcome);

// To standard error, all at once: "error: PATH: reason" and "  try: suggestion". Control characters
// in what the user typed are shown as '?'.
void PrintProblems(const std::vector<core::Problem>& problems);

// To standard error, in lines of at most 100 columns as far as its words allow, the first of them
// not indented. Control characters as above.
void PrintNote(std::string_view text);

using report::Wrapped;

}  // namespace rockyard::app
