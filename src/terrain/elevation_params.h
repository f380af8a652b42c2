// Parameters of an elevation model (scenario group terrain.ground.elevation): the heights of a real
// or made place at the nodes of a square lattice. Scenarios hold the heights themselves, so that a
// stored run, its resumption on another machine and its replay need no further file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/fields.h"

namespace rockyard::terrain {

class ReliefSpline;
struct ElevationParams;

// The surface of a model, worked out when the first trial asks for it and shared by the others.
class SharedSurface {
 public:
  // Returns the surface of the parameters, which must be sound; another one where they are not
  // those of the call before. May be called from any thread. Cost: that of comparing all heights.
  std::shared_ptr<const ReliefSpline> Of(const ElevationParams& params);

 private:
  std::mutex mutex_;
  std::shared_ptr<const ReliefSpline> surface_;
};

// A lattice of nodes; without columns there is no model. x of the world goes along a row, y from
// row to row; where a place is meant these are east and north.
struct ElevationParams {
  double cell_m = 1.0;             // between neighbouring nodes, along both axes
  std::int64_t columns = 0;        // nodes of a row
  std::int64_t origin_column = 0;  // of the node at the world's origin
  std::int64_t origin_row = 0;
  std::vector<double> heights_m;  // row by row, from the smallest y on, x ascending in each row
  std::string source;

  // A model narrower than this has no cubic spline without a condition of its own at the ends.
  static constexpr std::int64_t kFewestNodes = 4;
  static constexpr std::size_t kMostNodes = 1'000'000;

  bool IsGiven() const { return columns > 0; }
  std::int64_t rows() const {
    return columns > 0 ? static_cast<std::int64_t>(heights_m.size()) / columns : 0;
  }
  // Returns whether the heights fill rows of that many columns, at least four by four.
  bool IsSound() const {
    return columns >= kFewestNodes && heights_m.size() % static_cast<std::size_t>(columns) == 0 &&
           rows() >= kFewestNodes;
  }
  // Returns whether the model has nodes around the rectangle, m in the world.
  bool Holds(double x_min_m, double x_max_m, double y_min_m, double y_max_m) const;

  void Visit(core::FieldVisitor& v);

  // Copies of the parameters share it.
  std::shared_ptr<SharedSurface> surface = std::make_shared<SharedSurface>();
};

}  // namespace rockyard::terrain
