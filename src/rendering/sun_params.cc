#include "rendering/sun_params.h"

namespace rockyard::rendering {
namespace {

using core::Origin;

void VisitAlbedo(SunParams& p, core::FieldVisitor& v) {
  const auto albedo = [&v](std::string_view name, double& value, std::string_view doc,
                           std::string_view source, double low, double high) {
    v.Real(name, value,
           {.doc = doc,
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kAssumed,
            .source = source,
            .study_low = low,
            .study_high = high});
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
          {.doc = "sun (or lamp) above the horizon",
           .min = 0.0,
           .max = 90.0,
           .origin = Origin::kSetting,
           .source = "Matthies 1995 sec. 2.1.2: four hours a day around noon"});
  v.Angle("azimuth_deg", azimuth_rad,
          {.doc = "direction towards the sun, from the world's x axis to the left",
           .min = -360.0,
           .max = 360.0,
           .origin = Origin::kSetting});
  v.Real(
      "irradiance_w_m2_nm", irradiance_w_m2_nm,
      {.doc = "of a surface that faces the sun outside the atmosphere at 1 AU, near 850 nm; that "
              "of a lamp with distance_au 1 and optical_depth 0; 0 in the dark",
       .min = 0.0,
       .max = 100.0,
       .origin = Origin::kPublished,
       .source =
           "ASTM G173-03, extraterrestrial: mean over 850 to 870 nm, taken for the whole passband, "
           "830 to 870 nm by default"});
  v.Real("distance_au", distance_au,
         {.doc = "from the sun; irradiance falls with its square",
          .min = 0.1,
          .max = 40.0,
          .origin = Origin::kPublished,
          .source = "Mars: 1.38 to 1.67, mean 1.524; Earth: 1"});
  v.Real("optical_depth", optical_depth,
         {.doc = "of the atmosphere towards the zenith",
          .min = 0.0,
          .max = 20.0,
          .origin = Origin::kPublished,
          .source = "Smith et al. 1997 (Science 278, 1758): about 0.5 at the Pathfinder site"});
  v.Real("diffuse_share", diffuse_share,
         {.doc = "of the light that the atmosphere takes from the direct beam, what reaches the "
                 "ground from the whole sky",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "dust scatters nearly all of it, mostly forwards",
          .study_low = 0.5,
          .study_high = 0.9});
  VisitAlbedo(*this, v);
}

}  // namespace rockyard::rendering
