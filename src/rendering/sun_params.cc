#include "rendering/sun_params.h"

namespace rockyard::rendering {
namespace {

using core::Assumed;
using core::Published;
using core::Setting;

void VisitAlbedo(SunParams& p, core::FieldVisitor& v) {
  const auto albedo = [&v](std::string_view name, double& value, std::string_view doc,
                           std::string_view source, double low, double high) {
    v.Real(name, value, Assumed(doc, source, {0.0, 1.0}, {low, high}));
  };
  albedo("ground_albedo", p.ground_albedo, "Lambert albedo of the ground at 850 nm",
         "between the dark and bright soils of the Pathfinder site; dry sand", 0.2, 0.45);
  albedo("rock_albedo", p.rock_albedo, "Lambert albedo of rocks and walls at 850 nm",
         "grey rocks of the Pathfinder site, more where dusty", 0.12, 0.4);
  albedo("rover_albedo", p.rover_albedo, "Lambert albedo of the rover's own parts at 850 nm",
         "bare and anodized metal", 0.1, 0.6);
}

}  // namespace

void SunParams::Visit(core::FieldVisitor& v) {
  v.Angle("elevation_deg", elevation_rad,
          Setting("sun (or lamp) above the horizon", {0.0, 90.0},
                  "Matthies 1995 sec. 2.1.2: four hours a day around noon"));
  v.Angle(
      "azimuth_deg", azimuth_rad,
      Setting("direction towards the sun, from the world's x axis to the left", {-360.0, 360.0}));
  v.Real("irradiance_w_m2_nm", irradiance_w_m2_nm,
         Published("of a surface that faces the sun outside the atmosphere at 1 AU, near 850 nm; "
                   "that of a lamp with distance_au 1 and optical_depth 0; 0 in the dark",
                   "ASTM G173-03, extraterrestrial: mean over 850 to 870 nm, taken for the whole "
                   "passband, 830 to 870 nm by default",
                   {0.0, 100.0}));
  v.Real("distance_au", distance_au,
         Published("from the sun; irradiance falls with its square",
                   "Mars: 1.38 to 1.67, mean 1.524; Earth: 1", {0.1, 40.0}));
  v.Real("optical_depth", optical_depth,
         Published("of the atmosphere towards the zenith",
                   "Smith et al. 1997 (Science 278, 1758): about 0.5 at the Pathfinder site",
                   {0.0, 20.0}));
  v.Real("diffuse_share", diffuse_share,
         Assumed("of the light that the atmosphere takes from the direct beam, what reaches the "
                 "ground from the whole sky",
                 "dust scatters nearly all of it, mostly forwards", {0.0, 1.0}, {0.5, 0.9}));
  VisitAlbedo(*this, v);
}

}  // namespace rockyard::rendering
