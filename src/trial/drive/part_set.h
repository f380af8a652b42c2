// The parts of one side of a drive, told alike of what happens to the rover as a whole.
#pragma once

#include <tuple>
#include <utility>

namespace rockyard::trial {

// Holds one part of each type. A part that does not say what it does when operators put the rover
// down elsewhere does not compile here, so that none is forgotten.
template <typename... Parts>
class PartSet {
 public:
  explicit PartSet(Parts... parts) : parts_(std::move(parts)...) {}

  template <typename Part>
  Part& get() {
    return std::get<Part>(parts_);
  }
  template <typename Part>
  const Part& get() const {
    return std::get<Part>(parts_);
  }

  // The rover has been put down, at the start or later; `where` is what this side knows of that.
  template <typename... Where>
  void OnPlaced(const Where&... where) {
    (std::get<Parts>(parts_).OnPlaced(where...), ...);
  }

 private:
  std::tuple<Parts...> parts_;
};

}  // namespace rockyard::trial
