/// @file
/// What a map-based navigator shows of a decision: the diagnostic image of Goldberg 2002, figure 3,
/// as data. Figures, replays and traces show it. Nothing on board decides by a NavigationView;
/// GESTALT chooses among its own splines and votes in these structs. Of a drive's record one column
/// depends on whether a navigator has a view (height_error_m), none on what it shows; the study
/// stereo_sensing judges the cells of its map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "messages/commands.h"
#include "messages/estimates.h"

namespace rockyard::messages {

/// A spline of two clothoids (Howard 2012, section 3), by its curvature at the start and at two
/// knots, positive turns left. Between them the curvature is linear in the length.
struct Spline {
  double start_per_m = 0.0;        ///< curvature at the start
  double first_knot_per_m = 0.0;   ///< at the first knot, after half of the length
  double second_knot_per_m = 0.0;  ///< at the second knot, at the end, and beyond
  double length_m = 0.0;           ///< from the start to the second knot

  bool operator==(const Spline&) const = default;
};

/// One cell of a map.
struct MapCellView {
  bool has_data = false;       ///< whether the cell holds range points
  double elevation_m = 0.0;    ///< mean of its points, in the map's frame
  bool known = false;          ///< whether the cell was evaluated
  std::uint8_t goodness = 0;   ///< 0 (impassable) to 255
  std::uint8_t certainty = 0;  ///< of the goodness, 0 to 255
};

/// Cells of the map around the rover, unwrapped: [iy][ix], row-major, x ascending with ix.
struct MapView {
  double x0_m = 0.0;  ///< lower corner of cell (0, 0), in the estimated world frame
  double y0_m = 0.0;
  double xstep_m = 0.2;  ///< sides of a cell
  double ystep_m = 0.2;
  int nx = 0;  ///< cells along x
  int ny = 0;  ///< cells along y
  std::vector<MapCellView> cells;

  /// Requires 0 <= ix < nx and 0 <= iy < ny.
  const MapCellView& Cell(int ix, int iy) const {
    return cells[static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) +
                 static_cast<std::size_t>(ix)];
  }
};

/// A candidate motion and its votes. Votes run from 0 to 255.
struct MotionVote {
  MotionCommand motion;
  double turn_rad = 0.0;  ///< of a turn in place, left positive
  double hazard = 0.0;
  double hazard_certainty = 0.0;
  double waypoint = 0.0;
  double merged = 0.0;
  bool vetoed = false;  ///< a hazard was felt on this motion, so that it is not driven again
  bool best = false;    ///< shares the highest merged vote
  bool chosen = false;  ///< the motion that is driven
};

/// A spline among which a rover that steers while it drives chooses, and its votes, from 0 to 255.
struct SplineVote {
  Spline spline;
  double hazard = 0.0;
  double hazard_certainty = 0.0;
  double waypoint = 0.0;
  /// Bearing of the goal from the heading, at the place on the spline where the waypoint vote is
  /// taken.
  double waypoint_error_rad = 0.0;
  double merged = 0.0;
  bool feasible = false;  ///< the steering motors keep up with it
  bool chosen = false;    ///< the spline that is driven
};

/// All that a map-based navigator shows of one decision.
struct NavigationView {
  std::int64_t step = 0;  ///< counts decisions from 0
  PoseEstimate estimate;
  /// How the rover believes to stand. Elevations of the map count from the same zero as its z_m.
  AttitudeEstimate attitude;
  Goal goal;
  bool looked_behind = false;
  MapView map;
  /// Curvatures from right (most negative) to left (most positive).
  std::vector<MotionVote> forward;
  std::vector<MotionVote> backward;
  std::vector<MotionVote> point_turns;
  /// Splines in the order of the first knot from right (most negative) to left, then of the second
  /// knot; empty where the rover chooses among the motions above.
  std::vector<SplineVote> splines;
  PoseEstimate spline_start;  ///< where all splines begin
};

/// A way or an outline that a navigator shows on the map of a replay.
struct OverlayLine {
  std::string name;          ///< what it stands for: "path", "wall followed"; lines may share one
  std::vector<Goal> points;  ///< in the frame in which goals are told
};

/// A map that a navigator shows: values on a grid, row-major, x ascending fastest.
struct OverlayGrid {
  std::string name;   ///< what the values are: "cost"
  double x0_m = 0.0;  ///< lower corner of the first cell, in the frame in which goals are told
  double y0_m = 0.0;
  double step_m = 0.0;  ///< side of a cell, above 0
  int nx = 0;           ///< cells along x
  int ny = 0;
  std::vector<double> values;  ///< nx * ny; 0 (free) to 1 (blocked), NaN where nothing is known
};

/// What a navigator of any kind shows of a decision, beside or in place of a NavigationView.
struct Overlay {
  std::vector<OverlayLine> lines;
  std::vector<OverlayGrid> grids;
};

/// What a plugin or process took for a drive, by the clocks of the machine. No record holds it.
struct NavigatorUse {
  std::int64_t questions = 0;  ///< how often it was asked to decide
  double cpu_s = 0.0;          ///< of all answers
  double wall_s = 0.0;
  double longest_s = 0.0;  ///< of the slowest answer, by the clock on the wall
};

/// A number that a navigator or an estimator counts or measures for itself, as it declares it once.
/// It is a column of every record of a drive that could choose it.
struct OwnValue {
  std::string name;     ///< lower case, digits, underscores: "replans"
  std::string unit;     ///< "1" for counts
  std::string meaning;  ///< one sentence
};

}  // namespace rockyard::messages
