// The second part of figure 3 of Goldberg 2002: the rover's view ahead with its grid superimposed.
#pragma once

#include <string>

#include "messages/navigation_view.h"
#include "report/step_scene.h"
#include "report/svg_elements.h"

namespace rockyard::report {

// SVG elements: what the camera looks at as a line drawing, ground below the horizon, silhouettes
// of rocks (none that would be a dot), and the cells of the map that hold points, at their
// elevations, filled with the colour of their goodness (RampColour) where they have one. What is
// nearer covers what is farther. Rocks stand where they truly are; the grid lies where the rover
// believes it, from its own pose and attitude. Says so where the rover has no camera.
std::string CameraPanel(const StepScene& scene, const messages::NavigationView& view,
                        const SvgFrame& frame);

}  // namespace rockyard::report
