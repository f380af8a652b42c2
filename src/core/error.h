/// @file
/// User errors: everything wrong with an input, reported at once.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace rockyard::core {

/// One thing wrong with an input.
struct Problem {
  std::string path;        ///< JSON path or file, e.g. "terrain.rocks.min_diameter_m"
  std::string reason;      ///< what is wrong, e.g. "is -1, below the smallest allowed value 0.02"
  std::string suggestion;  ///< what would be right, e.g. "use a value from 0.02 to 2"
};

/// Thrown when an input cannot be used. The command line turns it into exit code 2.
class UserError : public std::runtime_error {
 public:
  /// Requires at least one problem. what() is all of them as text, one a line.
  explicit UserError(std::vector<Problem> problems);
  /// One problem alone.
  UserError(std::string path, std::string reason, std::string suggestion);

  /// Returns everything that is wrong, in the order in which it was found.
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace rockyard::core
