// What people see: streams, colours, errors.
#pragma once

#include <cstdio>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "report/summary_text.h"

namespace rockyard::app {

bool IsTerminal(std::FILE* stream);

// Columns of the terminal on `stream`; 100 where it is none or does not tell.
int TerminalWidth(std::FILE* stream);

// Colours only on a terminal that is not "dumb", and not where NO_COLOR is set (no-color.org).
report::TextStyle StyleFor(std::FILE* stream);

void Print(std::string_view text);  // to standard output

// To standard error, all at once: "error: PATH: reason" and "  try: suggestion". Control characters
// in what the user typed are shown as '?'.
void PrintProblems(const std::vector<core::Problem>& problems);
void PrintNote(std::string_view text);  // to standard error, one line

}  // namespace rockyard::app
