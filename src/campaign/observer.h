/// @file
/// What a caller is told while work goes on. Nothing here is printed by this library.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/error.h"

namespace rockyard::campaign {

/// How much a note matters.
enum class NoteKind {
  kRemark,  ///< good to know
  kWarning  ///< whoever waits for the work has to know it
};

/// A sentence for the user.
struct Note {
  NoteKind kind = NoteKind::kRemark;
  std::string text;  ///< whole sentences, one line
};

/// Everything is told when it comes up and may be left out: what work returns holds it, too. Of a
/// supervised campaign it is told in the process where it comes up, which may be a worker: what is
/// written there counts, what is kept in memory there does not come back.
struct Observer {
  std::function<void(const Note& note)> note = {};
  std::function<void(const std::vector<core::Problem>& problems)> problems = {};
};

/// Of progress.
enum class Moment { kUnderWay, kEnd };

}  // namespace rockyard::campaign
