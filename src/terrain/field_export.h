// A field as text for other tools and for people. Lengths in m, angles in degrees, world frame.
#pragma once

#include <string>

#include "terrain/arena.h"
#include "terrain/course.h"
#include "terrain/field.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// Returns one line per rock: index, mirror image or not, centre, semi-axes, yaw, diameter, height,
// growth of a cap. Numbers read back to the same bits.
std::string ToCsv(const Field& field);

// Returns rocks, arena, course and audit as one JSON object. The ground is not part of it. Studies
// of rocks (scripts/studies) read it by its keys.
std::string ToJson(const Field& field, const TerrainParams& params, const Course& course);

// Returns a Wavefront OBJ file with one group for the ground (a 0.1 m grid where rough, else one
// quadrilateral) over the drivable bounds, and one group per rock, tessellated whole, buried part
// included.
std::string ToObj(const Field& field, const TerrainParams& params);

// SVG elements to draw on top of a plan view, in its coordinates (x, minus y), and the area in
// world coordinates that the view then has to show.
struct SvgOverlay {
  std::string elements;
  Rectangle area;
};

// Returns a plan view, x to the right and y up, 1 unit = 1 m: rocks as octagons of their outlines
// (like Matthies 1995 fig. 16), darker the higher; start and goal as crosses; arena and mirror
// lines. The view shows the drivable bounds and what the overlay asks for.
std::string ToSvg(const Field& field, const TerrainParams& params, const Course& course,
                  const SvgOverlay& overlay = {});

}  // namespace rockyard::terrain
