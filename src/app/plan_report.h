// The answer of rockyard plan.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/json_value.h"

namespace rockyard::app {

// Whether a number of trials is where the search for it ended, and no answer.
bool IsCutOff(std::int64_t trials);

class PlanReport {
 public:
  explicit PlanReport(std::string question) : question_(std::move(question)) {}

  // `key` for programs, `what` for people.
  void Add(std::string key, std::string what, std::int64_t trials);
  void Add(std::string key, std::string what, double probability);

  struct Line {
    std::string key;
    std::string what;
    core::JsonValue number;
    bool cut_off = false;
  };
  const std::string& question() const { return question_; }
  const std::vector<Line>& lines() const { return lines_; }

 private:
  std::string question_;
  std::vector<Line> lines_;
};

std::string PlanText(const PlanReport& report);
std::string PlanJson(const PlanReport& report);  // {"question", and a number for each key}, and
                                                 // KEY_or_more: true where its search was cut off

}  // namespace rockyard::app
