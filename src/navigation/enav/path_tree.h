// The tree of ENav (Abcouwer 2020): turns in place, from each a fan of arcs, from the end of each
// of these another. Arcs are numbered: first those of the first fan, by turn and curvature, then
// those of the second, by the arc that they follow and curvature. Paths that begin alike share
// arcs, so that what ACE says of an arc holds for all of them.
#pragma once

#include <vector>

#include "math/pose.h"
#include "navigation/enav/enav_params.h"

namespace rockyard::navigation {

// Returns the pose after `length_m` on an arc that begins at the origin along x.
math::Pose2 AlongArc(double curvature_per_m, double length_m);

// Returns the parameters with lengths of a rover of that wheelbase.
EnavParams ScaledTo(EnavParams params, double wheelbase_m);

struct TreeArc {
  int turn = 0;     // of the path
  int before = -1;  // the arc that it follows; -1: it follows the turn
  double curvature_per_m = 0.0;
  std::vector<math::Pose2>
      poses;  // every check_spacing, in the frame of the rover as it stands now
};

// A path: its last arc, of which only the first `poses` are driven.
struct TreePath {
  int arc = 0;
  std::size_t poses = 0;
  double cost_s = 0.0;
};

class PathTree {
 public:
  explicit PathTree(const EnavTreeParams& params);

  const std::vector<double>& turns_rad() const { return turns_rad_; }  // left positive
  const std::vector<TreeArc>& arcs() const { return arcs_; }
  // The last arc of every path.
  const std::vector<int>& ends() const { return ends_; }

 private:
  std::vector<double> turns_rad_;
  std::vector<TreeArc> arcs_;
  std::vector<int> ends_;
};

}  // namespace rockyard::navigation
