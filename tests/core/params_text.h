// Parameters read from a JSON text, and what is wrong with it, for tests of parameter structs.
#pragma once

#include <string>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"

namespace rockyard::core {

// Throws UserError.
template <typename Params>
Params ReadText(const std::string& json) {
  Params params;
  ReadParams(ParseJson(json, "test"), params);
  return params;
}

// The problems of a text in one; empty where it is accepted.
template <typename Params>
std::string ProblemsOf(const std::string& json) {
  try {
    ReadText<Params>(json);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace rockyard::core
