// The parts of one side of a drive: world and on-board code keep theirs in a PartSet, which tells
// all of them when operators put the rover down. No record depends on the order in which parts are
// told, as each changes itself alone.
#pragma once

#include <tuple>
#include <utility>

namespace rockyard::trial {

// Holds one part of each type. A part without an OnPlaced, which says what it does when the rover
// is put down, does not compile here, so that none is forgotten.
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

  // Tells all parts that the rover has been put down elsewhere; `where` is what this side of the
  // drive knows of the place.
  template <typename... Where>
  void OnPlaced(const Where&... where) {
    (std::get<Parts>(parts_).OnPlaced(where...), ...);
  }

 private:
  std::tuple<Parts...> parts_;
};

}  // namespace rockyard::trial
