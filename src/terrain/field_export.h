// A field as text for other tools and for people: the command `terrain` writes it, and plots of
// trials draw on its plan view. Lengths in m, angles in degrees, world frame. No record or store
// holds these texts.
#pragma once

#include <string>

#include "terrain/arena.h"
#include "terrain/course.h"
#include "terrain/field.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// Returns one line per rock: index, mirror image or not, centre, semi-axes, yaw, diameter, height,
// growth of a cap. Numbers read back to the same bits. Whatever follows the placed rocks counts as
// a mirror image, a goal rock too; so it does in ToJson.
std::string ToCsv(const Field& field);

// Returns rocks, arena, course and audit as one JSON object, without the ground. Must stay: its
// keys, by which studies of rocks (scripts/studies) read it.
std::string ToJson(const Field& field, const TerrainParams& params, const Course& course);

// Returns a Wavefront OBJ file with one group for the ground (a 0.1 m grid where rough, else one
// quadrilateral) over the drivable bounds, and one group per rock, tessellated whole, buried part
// included.
std::string ToObj(const Field& field, const TerrainParams& params);

// SVG elements to draw on top of a plan view, in the coordinates of the view (x, minus y), and the
// area in W that the view has to show for them.
struct SvgOverlay {
  std::string elements;
  Rectangle area;
};

// Returns a plan view, x to the right and y up, 1 unit = 1 m: rocks as octagons of their outlines
// (like Matthies 1995 fig. 16), darker the higher; contours of an elevation model; start and goal
// as crosses; arena and mirror lines. The view shows the drivable bounds and the area of the
// overlay.
std::string ToSvg(const Field& field, const TerrainParams& params, const Course& course,
                  const SvgOverlay& overlay = {});

}  // namespace rockyard::terrain
