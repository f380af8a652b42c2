#include "rendering/picture/picture_params.h"

namespace rockyard::rendering {
namespace {

using core::Origin;

}  // namespace

// 600 to 800 nm and signal to noise above 200 (Lakdawalla 2018, table 7.1; Schwochert and Maki
// 2005) are at hand; all else is what such a camera may have.
ImagerParams PictureCameraParams::EngineeringImager() {
  ImagerParams imager;
  imager.f_number = 12.0;
  imager.filter_width_m = 200e-9;
  imager.blur_px = 0.0;
  imager.black_level = 0.02;
  imager.ccd.quantum_efficiency = 0.4;
  imager.ccd.fill_factor = 1.0;
  imager.ccd.full_well_e = 170000.0;
  imager.ccd.read_noise_e = 25.0;
  imager.ccd.dark_current_e_s = 20.0;
  imager.ccd.adc_bits = 8;
  imager.ccd.response_nonuniformity = 0.01;
  imager.ccd.offset_nonuniformity_e = 25.0;
  imager.exposure.shortest_s = 0.005;
  imager.exposure.longest_s = 10.0;
  imager.exposure.target_fill = 0.8;
  imager.exposure.brightest_share = 0.01;
  return imager;
}

void LookParams::Visit(core::FieldVisitor& v) {
  v.Real("soil_graininess", soil_graininess,
         {.doc = "texture of the soil: 0 is drift, 1 is gravel, between them each value is mixed",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kSetting});
  v.Group("drift", drift, "the smooth end of the family of soils");
  v.Group("gravel", gravel, "the rough end of the family of soils");
  v.Group("rock", rock, "surface of rocks");
  v.Real("rock_albedo_spread", rock_albedo_spread,
         {.doc = "standard deviation of the albedos of rocks over their mean",
          .min = 0.0,
          .max = 0.3,
          .origin = Origin::kAssumed,
          .source = "dusty and bare rocks side by side",
          .study_low = 0.0,
          .study_high = 0.3});
  v.Real("lommel_seeliger_share", lommel_seeliger_share,
         {.doc = "share of the law of Lommel and Seeliger in the light that surfaces send back; "
                 "the rest is Lambert's: the lunar-Lambert law",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "McEwen 1991 (Icarus 92, 298) has the law; 0: as in the light stripe images",
          .study_low = 0.0,
          .study_high = 0.8});
  v.Angle("sun_diameter_deg", sun_diameter_rad,
          {.doc = "of the sun's disc, which makes the edges of shadows soft; 0 for a point",
           .min = 0.0,
           .max = 5.0,
           .origin = Origin::kPublished,
           .source = "0.533 deg at 1 AU, seen from 1.52 AU"});
  v.Integer("edge_samples", edge_samples,
            {.doc = "pixels in which a surface or the sunlight ends are split in this many parts "
                    "each way; 1 leaves edges jagged",
             .min = 1,
             .max = 16,
             .origin = Origin::kSetting});
  v.Integer("texture_taps", texture_taps,
            {.doc = "most places along what a pixel covers of a surface at which its texture is "
                    "looked up; longer footprints are blurred across",
             .min = 1,
             .max = 16,
             .origin = Origin::kSetting});
}

void PictureCameraParams::Visit(core::FieldVisitor& v) {
  imager.VisitOptics(v);
  v.Real(
      "pixel_pitch_m", pixel_pitch_m,
      {.doc = "side of a pixel",
       .min = 1e-6,
       .max = 1e-4,
       .origin = Origin::kAssumed,
       .source = "1024 x 1024 pixels of 0.82 mrad (Maki et al. 2003, abstract) through a lens of "
                 "14.6 mm, which is not at hand",
       .study_low = 7e-6,
       .study_high = 15e-6});
  v.Real("wavelength_m", wavelength_m,
         {.doc = "in the middle of the passband",
          .min = 3e-7,
          .max = 1.1e-6,
          .origin = Origin::kAssumed,
          .source = "Navcams see 600 to 800 nm (Lakdawalla 2018, table 7.1), or are centred at 650 "
                    "nm (Maki et al. 2012, abstract)",
          .study_low = 650e-9,
          .study_high = 700e-9});
  v.Real("spread_px", blur_px,
         {.doc = "standard deviation of the image of a point, in pixels both ways: lens, and "
                 "charge that strays; pixels integrate over their area besides",
          .min = 0.0,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "a sharp lens, matched to its pixels",
          .study_low = 0.0,
          .study_high = 1.5});
  v.Choice("vignetting", vignetting,
           {.doc = "how light falls off from the axis outwards", .origin = Origin::kSetting});
  v.Real("vignetting_c2", vignetting_c2,
         {.doc = "of polynomial vignetting, 1 + c2 x^2 + c4 x^4 with x = 1 in the corners",
          .min = -1.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "small lenses that are stopped down",
          .study_low = -0.5,
          .study_high = 0.0});
  v.Real("vignetting_c4", vignetting_c4,
         {.doc = "see vignetting_c2",
          .min = -1.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "small lenses that are stopped down",
          .study_low = -0.3,
          .study_high = 0.0});
  v.Require("vignetting_c2", 1.0 + vignetting_c2 + vignetting_c4 > 0.0,
            "leaves the corners of the image without light", "use c2 + c4 above -1");
  v.Choice("flat_field", flat_field,
           {.doc = "whether vignetting and the pixels' responses are divided out on board",
            .origin = Origin::kSetting});
  v.Real("stuck_share", stuck_share,
         {.doc = "share of pixels that always show the least or the largest count",
          .min = 0.0,
          .max = 0.1,
          .origin = Origin::kAssumed,
          .source = "some pixels of a megapixel after years of radiation",
          .study_low = 0.0,
          .study_high = 1e-3});
  imager.VisitDetectors(v);
}

void PictureParams::Visit(core::FieldVisitor& v) {
  v.Group("look", look, "textures, reflection, sun's disc");
  v.Group("camera", camera, "lens, filter, imager, exposure, faults");
}

}  // namespace rockyard::rendering
