#include "navigation/navigator_set_params.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/error.h"

namespace rockyard::navigation {
namespace {

// The other keys of "navigation", and the one that every object may have.
constexpr std::array<std::string_view, 4> kTakenKeys{"navigator", "on_board_stuck", "wheel_driver",
                                                     "extends"};

bool IsKey(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

}  // namespace

NavigatorSet::NavigatorSet(const NavigatorSet& other)
    : names_(other.names_), chosen_(other.chosen_) {
  kinds_.reserve(other.kinds_.size());
  for (const auto& kind : other.kinds_) kinds_.push_back(kind->Clone());
}

NavigatorSet& NavigatorSet::operator=(const NavigatorSet& other) {
  *this = NavigatorSet(other);
  return *this;
}

void NavigatorSet::AddKind(std::unique_ptr<NavigatorKind> kind) {
  const std::string_view name = kind->name();
  const std::string path = "navigation." + std::string(name);
  if (!IsKey(name)) {
    throw core::UserError(path, "cannot be the name of a navigator",
                          "use lower-case letters, digits and underscores");
  }
  if (std::ranges::count(kTakenKeys, name) > 0 || std::ranges::count(names_, name) > 0) {
    throw core::UserError(path, "is taken", "give the navigator another name");
  }
  names_.push_back(name);
  kinds_.push_back(std::move(kind));
}

void NavigatorSet::Choose(std::string_view name) {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) {
    throw core::UserError("navigation.navigator",
                          "is " + std::string(name) + ", which is not there",
                          "use a name of the set");
  }
  chosen_ = static_cast<int>(found - names_.begin());
}

const NavigatorKind& NavigatorSet::chosen() const {
  return *kinds_.at(static_cast<std::size_t>(chosen_));
}

void NavigatorSet::Visit(core::FieldVisitor& v) {
  v.ChoiceOf("navigator", chosen_, names_,
             {.doc = "what decides the motions; the groups of other navigators do nothing",
              .origin = core::Origin::kSetting});
  for (const auto& kind : kinds_) v.Group(kind->name(), *kind, kind->doc());
}

}  // namespace rockyard::navigation
