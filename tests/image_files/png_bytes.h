// PNG files put together by hand from the specification (W3C, PNG, second edition), without libpng:
// rows unfiltered, data in stored blocks of deflate.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rockyard::image_files {

inline std::string BigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xffU);
  return bytes;
}

// Annex D, a bit at a time.
inline std::uint32_t PngCrc(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? crc >> 1 ^ 0xedb88320U : crc >> 1;
  }
  return ~crc;
}

inline std::string PngChunk(const std::string& type, const std::string& data) {
  return BigEndian(static_cast<std::uint32_t>(data.size())) + type + data +
         BigEndian(PngCrc(type + data));
}

// RFC 1950 and 1951, with blocks that are stored as they are.
inline std::string ZlibStored(std::string_view data) {
  std::string bytes = "\x78\x01";
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char byte : data) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  constexpr std::size_t kMost = 65535;
  do {
    const std::string_view block = data.substr(0, kMost);
    data.remove_prefix(block.size());
    const auto length = static_cast<unsigned>(block.size());
    bytes += data.empty() ? '\1' : '\0';
    for (const unsigned half : {length, ~length}) {
      bytes += static_cast<char>(half & 0xffU);
      bytes += static_cast<char>(half >> 8 & 0xffU);
    }
    bytes += block;
  } while (!data.empty());
  return bytes + BigEndian(b << 16 | a);
}

// Colour types of the specification, table 11.1.
enum class PngColour { kGrey = 0, kRgb = 2, kPalette = 3, kGreyAlpha = 4, kRgba = 6 };

struct PngText {
  int width = 0;
  int height = 0;
  int bits = 8;
  PngColour colour = PngColour::kGrey;
  bool interlaced = false;
  std::vector<unsigned> samples;  // of all channels, row by row; of palettes the indices
  std::string before_data;        // further chunks: PLTE, tRNS, ...
};

inline std::size_t ChannelsOf(PngColour colour) {
  switch (colour) {
    case PngColour::kRgb:
      return 3;
    case PngColour::kGreyAlpha:
      return 2;
    case PngColour::kRgba:
      return 4;
    default:
      return 1;
  }
}

// The pixels from (x, y) on in steps, each row with its filter byte and filled to a whole byte.
inline std::string PngPass(const PngText& png, int x0, int y0, int dx, int dy) {
  std::string data;
  const std::size_t channels = ChannelsOf(png.colour);
  if (x0 >= png.width) return data;
  for (int y = y0; y < png.height; y += dy) {
    data += '\0';
    unsigned waiting = 0;
    int count = 0;
    for (int x = x0; x < png.width; x += dx) {
      for (std::size_t channel = 0; channel < channels; ++channel) {
        const unsigned sample =
            png.samples[static_cast<std::size_t>(y * png.width + x) * channels + channel];
        for (int bit = png.bits - 1; bit >= 0; --bit) {
          waiting = waiting << 1 | (sample >> bit & 1U);
          if (++count % 8 == 0) data += static_cast<char>(waiting & 0xffU);
        }
      }
    }
    if (count % 8 != 0) data += static_cast<char>(waiting << (8 - count % 8) & 0xffU);
  }
  return data;
}

// The rows as they are compressed: one pass, or the seven of Adam7 (section 8.2).
inline std::string PngRows(const PngText& png) {
  if (!png.interlaced) return PngPass(png, 0, 0, 1, 1);
  constexpr std::array<std::array<int, 4>, 7> kPasses{{{0, 0, 8, 8},
                                                       {4, 0, 8, 8},
                                                       {0, 4, 4, 8},
                                                       {2, 0, 4, 4},
                                                       {0, 2, 2, 4},
                                                       {1, 0, 2, 2},
                                                       {0, 1, 1, 2}}};
  std::string data;
  for (const auto& pass : kPasses) data += PngPass(png, pass[0], pass[1], pass[2], pass[3]);
  return data;
}

inline std::string PngHeader(const PngText& png) {
  return "\x89PNG\r\n\x1a\n" +
         PngChunk("IHDR", BigEndian(static_cast<std::uint32_t>(png.width)) +
                              BigEndian(static_cast<std::uint32_t>(png.height)) +
                              static_cast<char>(png.bits) + static_cast<char>(png.colour) +
                              std::string(2, '\0') + static_cast<char>(png.interlaced ? 1 : 0));
}

inline std::string PngBytes(const PngText& png) {
  return PngHeader(png) + png.before_data + PngChunk("IDAT", ZlibStored(PngRows(png))) +
         PngChunk("IEND", "");
}

}  // namespace rockyard::image_files
