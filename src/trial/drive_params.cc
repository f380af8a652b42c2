#include "trial/drive_params.h"

namespace rockyard::trial {

void DriveParams::Visit(core::FieldVisitor& v) {
  v.Group("terrain", terrain, "ground, rocks and arena");
  v.Group("rover", rover, "the vehicle");
  v.Group("sensors", sensors, "what the rover measures");
  v.Group("perception", perception, "what the rover makes of its measurements");
  v.Group("localization", localization, "where the rover believes to be");
  v.Group("navigation", navigation, "what the rover decides");
  v.Group("course", course, "start and goal");
  v.Group("referee", referee, "when a trial is over");
  v.Group("clock", clock, "simulated time");
  v.Group("energy", energy, "electrical power and batteries");
}

}  // namespace rockyard::trial
