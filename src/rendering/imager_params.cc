#include "rendering/imager_params.h"

namespace rockyard::rendering {
namespace {

using core::Origin;

// The KAI-0370's data sheet is not at hand: every value stands for interline CCDs of its pixel size
// (11.6 x 13.6 um) and time, or for the active pixel sensors that followed.
constexpr std::string_view kImagerClass =
    "interline CCDs of about 12 um pixels and early active pixel sensors; no data sheet at hand";

void VisitNonuniformity(DetectorParams& p, core::FieldVisitor& v) {
  v.Real("response_nonuniformity", p.response_nonuniformity,
         {.doc = "standard deviation of the pixels' sensitivities over their mean; fixed",
          .min = 0.0,
          .max = 0.5,
          .origin = Origin::kAssumed,
          .source = kImagerClass,
          .study_low = 0.005,
          .study_high = 0.05});
  v.Real("offset_nonuniformity_e", p.offset_nonuniformity_e,
         {.doc = "standard deviation of the pixels' offsets; fixed",
          .min = 0.0,
          .max = 1e5,
          .origin = Origin::kAssumed,
          .source = kImagerClass,
          .study_low = 0.0,
          .study_high = 1000.0});
}

void VisitLens(ImagerParams& p, core::FieldVisitor& v) {
  v.Real("f_number", p.f_number,
         {.doc = "focal length over diameter of the entrance pupil",
          .min = 0.5,
          .max = 64.0,
          .origin = Origin::kAssumed,
          .source = "small fixed-focus wide-angle lenses",
          .study_low = 2.0,
          .study_high = 16.0});
  v.Real("lens_transmission", p.lens_transmission,
         {.doc = "of the lens without the filter",
          .min = 1e-3,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "about ten coated surfaces",
          .study_low = 0.6,
          .study_high = 0.95});
  v.Real(
      "filter_width_m", p.filter_width_m,
      {.doc = "equivalent width of the optical bandpass around the wavelength of the lasers. The "
              "filter sits behind the lens: in front of one that sees 2 rad, angles would shift "
              "a narrow passband by more than its width",
       .min = 1e-10,
       .max = 5e-7,
       .origin = Origin::kAssumed,
       .source = "a laser diode drifts by 0.3 nm/K, which is 24 nm over 80 K; published: narrow",
       .study_low = 10e-9,
       .study_high = 250e-9});
  v.Real("filter_transmission", p.filter_transmission,
         {.doc = "of the bandpass at the wavelength of the lasers",
          .min = 1e-3,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "interference filters",
          .study_low = 0.4,
          .study_high = 0.9});
}

void VisitBlur(ImagerParams& p, core::FieldVisitor& v) {
  v.Real("blur_px", p.blur_px,
         {.doc = "standard deviation of the blur along an image line, in pixels: focus, and charge "
                 "that 850 nm light sets free deep in the silicon; 0 is sharp",
          .min = 0.0,
          .max = 20.0,
          .origin = Origin::kAssumed,
          .source = "the beam alone is as wide as a pixel; a fixed-focus lens may add as much",
          .study_low = 0.0,
          .study_high = 1.5});
}

void VisitBlackLevel(ImagerParams& p, core::FieldVisitor& v) {
  v.Real("black_level", p.black_level,
         {.doc = "count without light over the largest count, so that noise is not cut off",
          .min = 0.0,
          .max = 0.5,
          .origin = Origin::kAssumed,
          .source = "usual setting",
          .study_low = 0.0,
          .study_high = 0.1});
}

}  // namespace

DetectorParams CmosDetector() {
  DetectorParams cmos;
  cmos.quantum_efficiency = 0.25;
  cmos.fill_factor = 0.3;
  cmos.full_well_e = 80000.0;
  cmos.read_noise_e = 80.0;
  cmos.dark_current_e_s = 5000.0;
  cmos.adc_bits = 8;
  cmos.response_nonuniformity = 0.02;
  cmos.offset_nonuniformity_e = 400.0;
  return cmos;
}

void DetectorParams::Visit(core::FieldVisitor& v) {
  const auto field = [&](std::string_view name, double& value, core::FieldInfo info) {
    info.origin = Origin::kAssumed;
    info.source = kImagerClass;
    v.Real(name, value, info);
  };
  field("quantum_efficiency", quantum_efficiency,
        {.doc = "electrons per photon on the sensitive part of a pixel, at 850 nm",
         .min = 1e-4,
         .max = 1.0,
         .study_low = 0.05,
         .study_high = 0.4});
  field("fill_factor", fill_factor,
        {.doc = "sensitive part of a pixel's area",
         .min = 0.01,
         .max = 1.0,
         .study_low = 0.2,
         .study_high = 1.0});
  field("full_well_e", full_well_e,
        {.doc = "electrons at which a pixel saturates; the largest count stands for it",
         .min = 100.0,
         .max = 1e7,
         .study_low = 2e4,
         .study_high = 2e5});
  field("read_noise_e", read_noise_e,
        {.doc = "standard deviation of one read-out, in electrons",
         .min = 0.0,
         .max = 1e5,
         .study_low = 10.0,
         .study_high = 150.0});
  field("dark_current_e_s", dark_current_e_s,
        {.doc = "electrons per second without light, near 0 C; doubles every 8 K or so",
         .min = 0.0,
         .max = 1e9,
         .study_low = 10.0,
         .study_high = 2e4});
  v.Integer("adc_bits", adc_bits,
            {.doc = "bits of a count",
             .min = 1,
             .max = 16,
             .origin = Origin::kAssumed,
             .source = "an 8-bit computer reads them",
             .study_low = 8,
             .study_high = 12});
  VisitNonuniformity(*this, v);
}

void ExposureParams::Visit(core::FieldVisitor& v) {
  v.Real("shortest_s", shortest_s,
         {.doc = "shortest exposure",
          .min = 1e-7,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "electronic shutter of an interline CCD",
          .study_low = 1e-5,
          .study_high = 0.01});
  v.Real("longest_s", longest_s,
         {.doc = "longest exposure",
          .min = 1e-7,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "dark current must not fill the well",
          .study_low = 0.03,
          .study_high = 20.0});
  v.Require("longest_s", longest_s >= shortest_s, "is shorter than shortest_s",
            "use a value of shortest_s or more");
  v.Real("target_fill", target_fill,
         {.doc = "share of the full well to which the bright part of the image without lasers is "
                 "exposed; the rest is for the lasers' light",
          .min = 0.01,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "published: the computer controls the exposure, not how",
          .study_low = 0.2,
          .study_high = 0.9});
  v.Real("brightest_share", brightest_share,
         {.doc = "share of the metered pixels that may be brighter than that",
          .min = 0.0,
          .max = 0.9,
          .origin = Origin::kAssumed,
          .source = "a few glints must not darken the image",
          .study_low = 0.0,
          .study_high = 0.1});
  v.Real("repeatability", repeatability,
         {.doc = "standard deviation of the exposure time without lasers over that with lasers, "
                 "less 1: what the difference of two sunlit images keeps of the sun",
          .min = 0.0,
          .max = 0.5,
          .origin = Origin::kAssumed,
          .source = "an 8085 clocks the imager by software: microseconds of some milliseconds",
          .study_low = 0.0,
          .study_high = 0.02});
}

void ImagerParams::VisitOptics(core::FieldVisitor& v) {
  v.Choice("kind", kind,
           {.doc = "which of the two imagers below is fitted",
            .origin = Origin::kPublished,
            .source = "Matthies 1995 table 3: CCD; sec. 6: CMOS as an improvement"});
  VisitLens(*this, v);
  VisitBlur(*this, v);
  VisitBlackLevel(*this, v);
}

void ImagerParams::VisitDetectors(core::FieldVisitor& v) {
  v.Group("ccd", ccd, "interline CCD");
  v.Group("cmos", cmos, "CMOS active pixel sensor");
  v.Group("exposure", exposure, "exposure control");
}

}  // namespace rockyard::rendering
