// User errors: everything wrong with an input, reported at once.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace rockyard::core {

// One thing wrong with an input.
struct Problem {
  std::string path;        // JSON path or file, e.g. "terrain.rocks.min_diameter_m"
  std::string reason;      // what is wrong, e.g. "is -1, below the smallest allowed value 0.02"
  std::string suggestion;  // what would be right, e.g. "use a value from 0.02 to 2"
};

// Thrown when an input cannot be used. The command line turns it into exit code 2.
class UserError : public std::runtime_error {
 public:
  explicit UserError(std::vector<Problem> problems);
  UserError(std::string path, std::string reason, std::string suggestion);

  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace rockyard::core
