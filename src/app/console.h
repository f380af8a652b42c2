// What people see: streams, colours, errors.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "report/summary_text.h"

namespace rockyard::app {

// False in a process of mpirun, which gives a terminal of its own making to rank 0 wherever its own
// output goes.
bool IsTerminal(std::FILE* stream);

// Whether this process is rank 0 of those that mpirun started, or was started alone.
bool IsFirstRank();

// Columns of the terminal on `stream`; 100 where it is none or does not tell.
int TerminalWidth(std::FILE* stream);

// Colours only on a terminal that is not "dumb", and not where NO_COLOR is set (no-color.org).
report::TextStyle StyleFor(std::FILE* stream);

void Print(std::string_view text);  // to standard output

// To standard error, all at once: "error: PATH: reason" and "  try: suggestion". Control characters
// in what the user typed are shown as '?'.
void PrintProblems(const std::vector<core::Problem>& problems);

// To standard error, in lines of at most 100 columns as far as its words allow, the first of them
// not indented. Control characters as above.
void PrintNote(std::string_view text);

// Text of one or more lines, each broken between words where it has more than 100 columns; what is
// broken off is indented by four more than its line.
std::string Wrapped(std::string_view text);

}  // namespace rockyard::app
