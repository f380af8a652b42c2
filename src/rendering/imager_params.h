// Parameters of what turns light into numbers: lens, filter, imager, exposure control. The light
// stripe sensor and the stereo cameras hold them among their parameters; the power of the former
// depends on the kind of imager, too. Defaults are those of the light stripe sensor's camera; a
// camera of another kind starts from values of its own (picture/picture_params.h). Images depend on
// them; error models do not.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"

namespace rockyard::rendering {

enum class ImagerKind {
  kCcd,   // interline CCD, Kodak KAI-0370 class
  kCmos,  // active pixel sensor, the improvement that Matthies 1995 section 6 lists
};

// The detector of one imager. Electrons are per pixel.
struct DetectorParams {
  double quantum_efficiency = 0.15;
  double fill_factor = 0.4;
  double full_well_e = 60000.0;
  double read_noise_e = 50.0;
  double dark_current_e_s = 1000.0;
  std::int64_t adc_bits = 8;
  double response_nonuniformity = 0.01;
  double offset_nonuniformity_e = 20.0;

  void Visit(core::FieldVisitor& v);
};

DetectorParams CmosDetector();

struct ExposureParams {
  double shortest_s = 1e-4;
  double longest_s = 0.2;
  double target_fill = 0.4;
  double brightest_share = 0.01;
  double repeatability = 0.001;

  void Visit(core::FieldVisitor& v);
};

// What a camera has beside its geometry (messages::Camera).
struct ImagerParams {
  ImagerKind kind = ImagerKind::kCcd;
  double f_number = 4.0;
  double lens_transmission = 0.8;
  double filter_width_m = 40e-9;
  double filter_transmission = 0.7;
  double blur_px = 0.0;
  double black_level = 0.02;
  DetectorParams ccd;
  DetectorParams cmos = CmosDetector();
  ExposureParams exposure;

  const DetectorParams& detector() const { return kind == ImagerKind::kCcd ? ccd : cmos; }

  // A sensor calls VisitOptics and then VisitDetectors, with fields of its own in between.
  void VisitOptics(core::FieldVisitor& v);     // kind, lens, filter, blur, black level
  void VisitDetectors(core::FieldVisitor& v);  // ccd, cmos, exposure
};

}  // namespace rockyard::rendering

template <>
struct rockyard::core::EnumNames<rockyard::rendering::ImagerKind> {
  static constexpr std::array<std::string_view, 2> kNames{"ccd", "cmos"};
};
