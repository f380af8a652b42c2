// What people see: streams, colours, errors. Every command prints through it.
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

// What the command tells the shell. Must stay: the numbers, on which scripts rely; kFooter of
// command_line.cc tells them to people.
using ExitCode = campaign::Outcome;

// Returns whether the stream is a terminal. Returns false in a process of mpirun, which gives rank
// 0 a terminal of its own making, wherever the output of mpirun goes.
bool IsTerminal(std::FILE* stream);

// Returns the columns of the terminal on `stream`; 100 where it is none or does not tell.
int TerminalWidth(std::FILE* stream);

// Returns the style of text on `stream`. It has colours on a terminal that is not "dumb", and
// anywhere where CLICOLOR_FORCE is set to something else than 0. NO_COLOR (no-color.org) forbids
// them in any case.
report::TextStyle StyleFor(std::FILE* stream);

// Print, PrintJson and PrintExact write to standard output. Where that cannot be written,
// PrintProblems says so once, later text is dropped, and OutputFailed() returns true. The caller
// goes on, as what it writes elsewhere is of use all the same. A pipe whose reader has gone (of
// `| head`) is no failure.

// Prints text for people: what a terminal would obey or hide is shown as '?'
// (report::PrintableLines).
void Print(std::string_view text);

// Prints JSON, with such characters escaped.
void PrintJson(std::string_view json);

// Prints CSV or a script, every byte as it is.
void PrintExact(std::string_view text);

// Returns whether some of what was printed to standard output is lost.
bool OutputFailed();

// Returns the exit code of work whose output is lost: kFailed, but kBadInput and kInterrupted stay,
// as they say more.
ExitCode AfterFailedOutput(ExitCode outcome);

// Prints problems to standard error, all in one write: "error: PATH: reason", and
// "  try: suggestion" where there is one. What a terminal would obey or hide is shown as '?'.
void PrintProblems(const std::vector<core::Problem>& problems);

// Prints a sentence to standard error, wrapped (Wrapped), in which what a terminal would obey or
// hide is shown as '?'.
void PrintNote(std::string_view text);

using report::Wrapped;

}  // namespace rockyard::app
