// What is found wrong or strange while a URDF file is read: errors, told all at once, and what the
// file says that rockyard's rover has not. All parts of the reader collect here.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace rockyard::rover {

// Returns a name of the file as messages show it: in quotes, cut where it is long.
std::string ShownName(std::string_view name);

class UrdfFindings {
 public:
  explicit UrdfFindings(std::string_view source_name) : source_name_(source_name) {}

  // Adds what hinders the reading. `place`, such as `line 12: joint "left_rocker"`, is what is to
  // blame; empty: the file.
  void Fail(std::string_view place, std::string reason, std::string suggestion);

  // Throws core::UserError with all that hinders, if anything does; at most 100 are listed.
  void ThrowIfFailed() const;

  // Adds what the file says and rockyard's rover has not: `reason` says what of it counts
  // nonetheless. At most 100 are kept, with how many more there are.
  void NotTaken(std::string_view place, std::string reason);

  // Returns what NotTaken collected, with the places as paths.
  std::vector<core::Problem> not_taken() const;

 private:
  std::string source_name_;
  std::vector<core::Problem> failures_;
  std::size_t failure_count_ = 0;  // including those beyond the list
  std::vector<core::Problem> not_taken_;
  std::size_t not_taken_count_ = 0;
};

}  // namespace rockyard::rover
