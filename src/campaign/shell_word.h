// Commands that people can copy.
#pragma once

#include <string>
#include <string_view>

namespace rockyard::campaign {

// A word as a POSIX shell reads it: as it is where that is safe, else in single quotes. One that a
// terminal would not show as it is (report::Printable) is written with octal numbers of its bytes
// ($'\\342\\200\\256'), which bash, zsh and POSIX shells since 2024 read.
std::string ShellWord(std::string_view word);

// A file or folder, which no command takes for an option: "./-x" for "-x".
std::string ShellPath(std::string_view path);

}  // namespace rockyard::campaign
