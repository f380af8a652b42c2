#include "trial/course/site_map_params.h"

namespace rockyard::trial {

using core::Assumed;
using core::Setting;

void SiteMapParams::Visit(core::FieldVisitor& v) {
  v.Choice(
      "kind", kind,
      Setting("what a map made before the drive tells the navigator of the site: nothing, mean "
              "heights, the share that rocks cover, or both; rockyard's own navigators read "
              "none"));
  v.Real("cell_m", cell_m,
         Assumed("side of its cells", "elevation models from orbit have posts 1 to 2 m apart",
                 {0.1, 100.0}, {0.5, 2.0}));
  v.Real("height_sd_m", height_sd_m,
         Assumed("random error of each height, one standard deviation",
                 "stereo from orbit tells heights to some tenths of a metre", {0.0, 10.0},
                 {0.1, 0.5}));
  v.Real(
      "shift_sd_m", shift_sd_m,
      Assumed("error of the place of the whole map along x and along y, one standard deviation",
              "a lander is found in images from orbit to about a cell", {0.0, 100.0}, {0.0, 2.0}));
  v.Real("margin_m", margin_m,
         Setting("how far the map reaches beyond start, waypoints and goal", {0.0, 1000.0}));
  v.Real("min_rock_m", min_rock_m,
         Setting("diameter of the smallest rocks that it tells apart; images from orbit resolve "
                 "rocks of 1.5 m (Golombek et al. 2008)",
                 {0.0, 100.0}));
}

}  // namespace rockyard::trial
