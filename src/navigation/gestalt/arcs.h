// The arcs and turns in place among which GESTALT chooses, and the paths that they lead over. Votes
// on arcs judge them, and splines take the places of PathSampling.
#pragma once

#include <cstddef>
#include <vector>

#include "messages/commands.h"
#include "navigation/gestalt/gestalt_params.h"

namespace rockyard::navigation {

struct PathPoint {
  double x_m = 0.0;  // in the levelled rover frame R, before the motion
  double y_m = 0.0;
};

// A motion and the path that it leads over.
struct CandidateMotion {
  messages::MotionCommand motion;
  double turn_rad = 0.0;          // of a turn in place, before its straight drive; 0 for arcs
  std::vector<PathPoint> points;  // the k-th lies PathSampling::distance_m[k] along the path
};

// Where along their paths candidates are judged, arcs and splines alike: the middles of pieces of
// length h = cell / samples_per_cell from plan_min_dist on,
//   s_k = plan_min_dist + (k + 1/2) h  up to plan_max_dist; s_0 always,
// with the weight that PathWeight names. Middles are taken so that no point of a straight path
// along an axis of the map lies on an edge between cells.
struct PathSampling {
  std::vector<double> distance_m;
  std::vector<double> weight;

  // Returns the number of points up to the length; at least one.
  std::size_t CountWithin(double length_m) const;
};

// Returns where paths are judged on a map whose cells have the side cell_m.
PathSampling SamplePaths(const GestaltPlanParams& params, double cell_m);

// Candidates in rows, as figure 3 of Goldberg 2002 shows them: arcs by curvature from right (most
// negative) to left, turns in place by angle from right to left. Must stay: the order. Votes keep
// it, ties are broken by it, and waypoint votes fall with the number of arcs between two.
struct CandidateMotions {
  std::vector<CandidateMotion> forward;
  std::vector<CandidateMotion> backward;
  std::vector<CandidateMotion> point_turns;
};

// Returns the curvature of arc i of n, spaced evenly:
//   c_i = c_max (2 i / (n - 1) - 1); 0 for a single arc.
double ArcCurvature(std::size_t index, std::size_t count, double max_curvature_per_m);

// Returns the index of the arc, of `count`, whose curvature is nearest to `curvature_per_m` after
// that is limited to max_curvature. Halfway between two arcs it is the tighter one of an odd
// number, so that mirrored curvatures give mirrored arcs; of an even number and at curvature 0 it
// is the right one of the two in the middle.
std::size_t NearestArc(double curvature_per_m, std::size_t count, double max_curvature_per_m);

// Returns all candidates. A turn in place turns by point_turn_amount, or by multiples of 180 deg /
// num_point_turns, and is judged by the straight drive after it (Howard 2012, "turn-in-place of
// different angles followed by a straight drive"). Arcs are judged no further than where they have
// turned max_path_turn.
CandidateMotions MakeCandidates(const GestaltArcParams& arcs, const GestaltPlanParams& plan,
                                const PathSampling& sampling);

}  // namespace rockyard::navigation
