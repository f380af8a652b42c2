// Where the hazards lie that GESTALT felt on its way. No camera has seen them, so they live as long
// as the navigator wants to go round them, whatever happens to its map.
#pragma once

#include <vector>

#include "messages/estimates.h"
#include "navigation/gestalt/map.h"
#include "navigation/navigator.h"

namespace rockyard::navigation {

// Places in the world as estimated on board, m.
class FeltPlaces {
 public:
  // Adds what the rover, `length_m` long and `width_m` wide, feels while driving in the direction
  // (+1 forward, -1 backward): a contact at the front, any other hazard at the end that leads, both
  // half a width aside if the sensor names a side; a touch behind while driving backward at the
  // rear. It marks them in the map, as MarkObstacle does.
  void Feel(const NavigatorInput& input, int direction, const GestaltRoverParams& rover,
            double radius_m, GestaltMap& map);

  // Follows a jump of the estimate: the places keep their distance and bearing from the rover. They
  // are marked in the map, which must have its window around `after`.
  void Move(const messages::PoseEstimate& before, const messages::PoseEstimate& after,
            double radius_m, GestaltMap& map);

  void Forget() { places_.clear(); }

 private:
  struct Place {
    double x_m;
    double y_m;
  };

  std::vector<Place> places_;
};

}  // namespace rockyard::navigation
