/// @file
/// The six wheels of a rocker-bogie rover, in the order of every array over wheels: of commands,
/// measurements, calibrations and the true state.
#pragma once

#include <array>
#include <cstddef>

namespace rockyard::messages {

/// How many wheels there are.
inline constexpr std::size_t kWheelCount = 6;

/// A wheel, by side and axle. Must stay: the side is the number / 3, left first, and the axle the
/// number % 3, from the front; code relies on it.
enum class Wheel : std::size_t {
  kLeftFront,
  kLeftMiddle,
  kLeftRear,
  kRightFront,
  kRightMiddle,
  kRightRear,
};

/// One value per wheel, by Index.
template <typename T>
using PerWheel = std::array<T, kWheelCount>;

/// Returns the place of a wheel in arrays over wheels.
constexpr std::size_t Index(Wheel wheel) { return static_cast<std::size_t>(wheel); }

}  // namespace rockyard::messages
