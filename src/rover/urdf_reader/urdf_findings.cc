#include "rover/urdf_reader/urdf_findings.h"

#include <fmt/format.h>

#include <utility>

#include "core/json_text.h"

namespace rockyard::rover {
namespace {

constexpr std::size_t kMostFindings = 100;

}  // namespace

std::string ShownName(std::string_view name) { return core::Abbreviate(core::JsonValue(name)); }

void UrdfFindings::Fail(std::string_view place, std::string reason, std::string suggestion) {
  ++failure_count_;
  if (failures_.size() == kMostFindings) return;
  std::string path = place.empty() ? source_name_ : fmt::format("{}: {}", source_name_, place);
  failures_.push_back({std::move(path), std::move(reason), std::move(suggestion)});
}

void UrdfFindings::ThrowIfFailed() const {
  if (failures_.empty()) return;
  std::vector<core::Problem> all = failures_;
  if (failure_count_ > all.size()) {
    all.push_back({source_name_, fmt::format("has {} more problems", failure_count_ - all.size()),
                   "correct these first"});
  }
  throw core::UserError(std::move(all));
}

void UrdfFindings::NotTaken(std::string_view place, std::string reason) {
  ++not_taken_count_;
  if (not_taken_.size() == kMostFindings) return;
  not_taken_.push_back({std::string(place), std::move(reason), ""});
}

std::vector<core::Problem> UrdfFindings::not_taken() const {
  std::vector<core::Problem> all = not_taken_;
  if (not_taken_count_ > all.size()) {
    all.push_back(
        {"(more)", fmt::format("{} more are not taken", not_taken_count_ - all.size()), ""});
  }
  return all;
}

}  // namespace rockyard::rover
