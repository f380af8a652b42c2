// Numbers that are gathered row by row for an array of an .npz file.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "math/pose.h"
#include "replay/npz_file.h"

namespace rockyard::replay {

// Rows of equally many numbers.
class NpzTable {
 public:
  explicit NpzTable(std::size_t columns) : columns_(columns) {}

  template <typename Values>
  void Add(const Values& values) {
    for (const double value : values) numbers_.push_back(value);
  }
  void Add(const math::Pose2& pose) { Add(std::array{pose.x_m, pose.y_m, pose.heading_rad}); }

  void Write(std::string_view name, NpzFile& file) const {
    file.AddReals(name, numbers_, {numbers_.size() / columns_, columns_});
  }

 private:
  std::size_t columns_;
  std::vector<double> numbers_;
};

// One number for each item.
template <typename Items, typename Value>
void AddColumn(std::string_view name, const Items& items, const Value& value, NpzFile& file) {
  std::vector<double> numbers;
  numbers.reserve(items.size());
  for (const auto& item : items) numbers.push_back(value(item));
  file.AddReals(name, numbers, {numbers.size()});
}

}  // namespace rockyard::replay
