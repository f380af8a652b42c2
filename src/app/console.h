// What people see: streams, colours, errors.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "report/line_text.h"
#include "report/summary_text.h"

namespace rockyard::app {

// False in a process of mpirun, which gives a terminal of its own making to rank 0 wherever its own
// output goes.
bool IsTerminal(std::FILE* stream);

// Columns of the terminal on `stream`; 100 where it is none or does not tell.
int TerminalWidth(std::FILE* stream);

// Colours on a terminal that is not "dumb", or anywhere where CLICOLOR_FORCE is set to something
// else than 0; none where NO_COLOR is set (no-color.org), whatever else is.
report::TextStyle StyleFor(std::FILE* stream);

void Print(std::string_view text);  // to standard output

// To standard error, all at once: "error: PATH: reason" and "  try: suggestion". Control characters
// in what the user typed are shown as '?'.
void PrintProblems(const std::vector<core::Problem>& problems);

// To standard error, in lines of at most 100 columns as far as its words allow, the first of them
// not indented. Control characters as above.
void PrintNote(std::string_view text);

using report::Wrapped;

}  // namespace rockyard::app
