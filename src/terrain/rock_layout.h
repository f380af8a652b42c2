// The random layout of rocks on the layout area, before mirroring: what BuildField makes its field
// of. Records of all drives depend on its draws: streams and substreams (field.h), the order of
// draws of one rock, and which tries draw again.
#pragma once

#include <optional>
#include <vector>

#include "core/random.h"
#include "terrain/arena.h"
#include "terrain/course.h"
#include "terrain/rock.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// The rocks of a layout, and what became of those that were drawn.
struct RockLayout {
  // The z of their centres is measured from the ground: the ground's own height is not added yet.
  std::vector<Rock> rocks;
  int drawn = 0;
  int dropped_in_clear_zones = 0;
  int dropped_for_overlap = 0;
  int relocated = 0;
};

// Returns a rock that is given rather than drawn: round, without yaw, of the field's mean burial
// and its pointedness. The z of its centre is measured from the ground.
Rock GivenRock(const RockFieldParams& params, const CoursePoint& place, double diameter_m,
               double height_m);

// Returns the rocks in the order in which they were placed: as marked_field.h says for
// laws, by number for uniform_count, by place in the list for listed. A rock's fate must depend on
// earlier rocks only: then a field of smaller k or cover is a prefix of one of a larger one under
// every overlap rule.
RockLayout LayOutRocks(const TerrainParams& params, core::TrialKey key, const Course& course);

// A rock's outline for the purpose of placement: the circle around its longest horizontal axis, so
// that rocks which do not overlap here do not overlap at any yaw.
struct Disc {
  double x_m = 0.0;
  double y_m = 0.0;
  double radius_m = 0.0;
};

// The discs that are placed so far, and where the next disc may go beside them and the clear zones.
class Placement {
 public:
  // Where discs keep off the mirror lines y = +-h, |y| + radius of each stays below h, and none
  // overlaps its own image. Images of other discs need not be looked at under either rule: with
  // distances d1 and d2 of two centres from a line, both on the same side, the squared distance of
  // a disc is dx^2 + (d1 + d2)^2 from the other's image and dx^2 + (d1 - d2)^2 from the other
  // itself, which is less.
  Placement(const Rectangle& layout, const Course& course, double clear_radius_m,
            std::optional<double> line_to_keep_off_m);

  // Returns whether the disc reaches into no clear zone around start, waypoints or goal.
  bool ClearOfCourse(const Disc& disc) const;
  // Returns whether the disc overlaps no placed one and crosses no line that discs keep off.
  bool Free(const Disc& disc) const;
  void Add(const Disc& disc);

  // Returns the placed discs by cells. Memory grows with the number of cells, the work of Free with
  // the discs of a cell.
  const std::vector<std::vector<Disc>>& cells() const { return cells_; }

 private:
  struct Cells {
    int first_x, last_x, first_y, last_y;
  };
  Cells CellsOf(const Disc& disc) const;

  Rectangle layout_;
  std::vector<CoursePoint> points_;  // of the course
  double clear_radius_m_;
  std::optional<double> line_to_keep_off_m_;
  double cell_m_;
  int nx_;
  int ny_;
  std::vector<std::vector<Disc>> cells_;  // each disc in every cell that its bounding box meets
};

}  // namespace rockyard::terrain
