// What the parser says of a value that an option may not have, in the words of this program.
#pragma once

#include <optional>

#include "core/error.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace rockyard::app {

// The option, what is wrong with its value, and what would be right: the words that it takes where
// it takes one of a few, with the nearest of them first. Nothing for other errors of the parser.
std::optional<core::Problem> RefusedValue(const CLI::App& command, const CLI::ParseError& error);

}  // namespace rockyard::app
