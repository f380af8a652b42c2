// Rocks at given places: a course as it was laid out by hand.
#pragma once

#include <vector>

#include "core/fields.h"

namespace rockyard::terrain {

// Each list has one entry for every rock. The rocks are round, the same in every trial, and share
// burial_mean of the field; overlap, clear zones and shape ratios do not touch them.
struct ListedRocksParams {
  std::vector<double> x_m;  // centres, in the world frame
  std::vector<double> y_m;
  std::vector<double> diameter_m;
  std::vector<double> height_m;  // above the ground

  // Returns whether all lists are as long as each other.
  bool IsSound() const {
    return y_m.size() == x_m.size() && diameter_m.size() == x_m.size() &&
           height_m.size() == x_m.size();
  }
  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::terrain
