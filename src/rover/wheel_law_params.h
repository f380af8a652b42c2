// What the soil does to a wheel of the rover, by the law that terrain.ground.soil.law names: both
// fidelities take it, checks of a drive and the command `mobility`, too.
//
// Every law is brought into one form. Under the load N a wheel that has dug in for the slip d sinks
// by z(N, d) and meets the motion resistance R(N, d); over its slip i, the speed of its contact
// over the soil in whatever direction over that of the rim, it finds the traction
//   T = T_max(N) tau(u i),   tau(u) = 1 - (1 - e^-u) / u,   u = u(N),
// and across, while it slides, B(N, d). Bekker's law is of this form (wheel_rut_params.h,
// wheel_soil.h). Of a law of stresses (rim_stress_params.h) T_max and u are such that T is the
// torque over the radius at slips of 0.1 and 1, and R such that T - R is its pull at every slip
// i = d. So pull and sinkage of steady motion are those of the law, its torque nearly. Laws of
// stresses are tabulated: within 1 % of the law between a thousandth of and the largest load.
#pragma once

#include <array>
#include <memory>

#include "rover/rim_stress_params.h"
#include "rover/rover_geometry_params.h"
#include "rover/shear_share_params.h"
#include "rover/wheel_rut_params.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// What the soil answers to a wheel under a load.
struct SoilAnswer {
  double sinkage_m = 0.0;
  double stiffness_N_m = 0.0;  // slope dN / dz of the load over the sinkage
  double traction_N = 0.0;     // T_max
  double resistance_N = 0.0;   // R
  double shear_ratio = 0.0;    // u of a slip of 1; infinite where soil shears without deformation
  double side_N = 0.0;         // B
};

// Returns the answer that lies between two, at the share s in [0, 1] from a to b.
SoilAnswer Mix(const SoilAnswer& a, const SoilAnswer& b, double s);

// Returns the wheel as the soil meets it.
RimShape RimShapeOf(const RoverGeometryParams& params);

// A law of stresses over loads and slips. Immutable; a table takes 0.2 ms to make.
class RimStressTable {
 public:
  // Loads beyond max_N are taken as max_N.
  RimStressTable(const RimStress& stress, const RimShape& wheel, double max_N);

  SoilAnswer At(double load_N, double dug_slip) const;

  static constexpr int kLoads = 64;   // intervals, even in the root of the load
  static constexpr int kLevels = 10;  // intervals, even in the root of the slip

 private:
  // Answers whose resistance is still minus the pull: that is smoother in the slip.
  using Level = std::array<SoilAnswer, kLoads + 1>;
  double max_N_;
  ShareTable shares_;
  std::array<Level, kLevels + 1> levels_{};
};

// One kind of wheel on one soil. Copies share the table.
class WheelOnSoil {
 public:
  // What it is made of.
  struct Case {
    terrain::SoilParams soil;
    RimShape wheel;
    double gravity_m_s2;
    double max_N;  // the largest load that matters to a law of stresses, as the rover's weight

    bool operator==(const Case&) const = default;
  };
  explicit WheelOnSoil(const Case& of);
  WheelOnSoil(const terrain::SoilParams& soil, const RimShape& wheel, double gravity_m_s2,
              double max_N)
      : WheelOnSoil(Case{soil, wheel, gravity_m_s2, max_N}) {}
  const Case& of() const { return of_; }

  // Returns the answer to a load > 0 of a wheel that has dug in for a slip in [0, 1].
  SoilAnswer Under(double load_N, double dug_slip) const;
  // Whether the answers are interpolated already.
  bool IsTable() const { return stress_ != nullptr; }
  // Whether wheels dig in by slipping.
  bool digs() const { return digs_; }

 private:
  Case of_;
  WheelRut rut_;
  bool digs_;
  std::shared_ptr<const RimStressTable> stress_;  // null: Bekker's law
};

}  // namespace rockyard::rover
