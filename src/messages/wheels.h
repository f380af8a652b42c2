// The six wheels of a rocker-bogie rover, in the order used by every array over wheels.
#pragma once

#include <array>
#include <cstddef>

namespace rockyard::messages {

inline constexpr std::size_t kWheelCount = 6;

enum class Wheel : std::size_t {
  kLeftFront,
  kLeftMiddle,
  kLeftRear,
  kRightFront,
  kRightMiddle,
  kRightRear,
};

template <typename T>
using PerWheel = std::array<T, kWheelCount>;

constexpr std::size_t Index(Wheel wheel) { return static_cast<std::size_t>(wheel); }

}  // namespace rockyard::messages
