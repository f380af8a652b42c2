#include "core/units.h"

#include <gtest/gtest.h>

#include "math/angles.h"

namespace rockyard::core {
namespace {

TEST(UnitsTest, SuffixesNameUnits) {
  EXPECT_EQ(UnitOf("wheel_radius_m"), "m");
  EXPECT_EQ(UnitOf("slope_deg"), "deg");
  EXPECT_EQ(UnitOf("speed_m_s"), "m/s");
  EXPECT_EQ(UnitOf("radio_bit_s"), "bit/s");
  EXPECT_EQ(UnitOf("image_bits"), "bit");
  EXPECT_EQ(UnitOf("latency_min"), "min");
  EXPECT_EQ(UnitOf("x_min_m"), "m");
  EXPECT_EQ(UnitOf("variance_deg2_per_m"), "deg2/m");
  EXPECT_EQ(UnitOf("rocks_per_m2"), "1/m2");
  EXPECT_EQ(UnitOf("stall_torque_Nm"), "Nm");
  EXPECT_EQ(UnitOf("damping_Ns_m"), "Ns/m");
  EXPECT_EQ(UnitOf("gravity_m_s2"), "m/s2");
  EXPECT_EQ(UnitOf("control_rate_hz"), "Hz");
  EXPECT_EQ(UnitOf("error_percent"), "%");
  EXPECT_EQ(UnitOf("input_power_w"), "W");
  EXPECT_EQ(UnitOf("irradiance_w_m2_nm"), "W/m2/nm");
  EXPECT_EQ(UnitOf("distance_au"), "au");
  EXPECT_EQ(UnitOf("read_noise_e"), "e");
  EXPECT_EQ(UnitOf("dark_current_e_s"), "e/s");
}

TEST(UnitsTest, NamesWithoutUnitsHaveUnitOne) {
  EXPECT_EQ(UnitOf("hurst_exponent"), "1");
  EXPECT_EQ(UnitOf("m"), "1");  // a name is no suffix of itself
  EXPECT_EQ(UnitOf(""), "1");
  EXPECT_EQ(UnitOf("_"), "1");
}

TEST(UnitsTest, DegreesComeBackShortAndExact) {
  for (const double degrees : {0.0, 0.1, 0.7, 5.0, -33.3, 60.0, 123.456, 359.99}) {
    EXPECT_EQ(ExactDegrees(math::DegToRad(degrees)), degrees);
  }
}

}  // namespace
}  // namespace rockyard::core
