// Numbers as bytes of a file, least significant first, on any machine.
#pragma once

#include <bit>
#include <cstdint>
#include <string>

namespace rockyard::image_files {

inline void AppendLittleEndian(float value, std::string& bytes) {
  const auto word = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>(static_cast<unsigned char>(word >> shift & 0xffU));
  }
}

}  // namespace rockyard::image_files
