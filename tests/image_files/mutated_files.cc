#include "image_files/mutated_files.h"

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>
#include <string_view>

#include "core/error.h"
#include "core/random.h"
#include "image_files/jpeg_bytes.h"
#include "image_files/luminance.h"
#include "image_files/pds_bytes.h"
#include "image_files/pfm_file.h"
#include "image_files/planetary.h"
#include "image_files/png_bytes.h"
#include "image_files/png_file.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"

namespace rockyard::image_files {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 19;
constexpr int kHeight = 13;

int Pattern(int x, int y, int channel) { return (37 * x + 11 * y + 90 * channel) % 256; }

std::string Png(PngColour colour, int bits, bool interlaced) {
  PngText png{kWidth, kHeight, bits, colour, interlaced, {}, ""};
  const std::size_t count = std::size_t{kWidth} * kHeight * ChannelsOf(colour);
  for (std::size_t i = 0; i < count; ++i) {
    png.samples.push_back(static_cast<unsigned>(i * 40503) & ((1U << bits) - 1));
  }
  if (colour == PngColour::kPalette) {
    std::string colours;
    for (int i = 0; i < 3 << bits; ++i) colours += static_cast<char>(5 * i);
    png.before_data = PngChunk("PLTE", colours) + PngChunk("tRNS", std::string(2, '\x40'));
  } else {
    png.before_data = PngChunk("gAMA", BigEndian(45455)) + PngChunk("tEXt", "Title\1no title");
  }
  return PngBytes(png);
}

// Compressed, unlike those that are put together by hand.
std::string DeflatedPng() {
  SamplePlane plane(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) plane.At(x, y) = static_cast<std::uint16_t>(99 * x * y);
  }
  return EncodePng(plane);
}

std::string Samples(int count, int bytes) {
  std::string text;
  for (int i = 0; i < count * bytes; ++i)
    text += static_cast<char>(i * 7 % (bytes == 2 ? 16 : 200));
  return text;
}

PdsText Planetary() {
  return {.width = kWidth, .height = kHeight, .data = Samples(kWidth * kHeight, 2)};
}

std::size_t Below(core::RandomStream& stream, std::size_t bound) {
  return static_cast<std::size_t>(stream.NextU64() % bound);
}

// A number of a header, of 2 or 4 bytes in either order, or of digits.
std::string OddNumber(core::RandomStream& stream) {
  constexpr std::array<std::uint32_t, 10> kValues{
      0, 1, 0x7f, 0x7fff, 0xffff, 0x7fffffff, 16384U, 0x80000000, 0xffffffff, 65500};
  constexpr std::array<std::string_view, 9> kTexts{
      "0", "-1", "99999999999999999999", "16385", "65536", "1e9", "nan", "2#1#", "8000 8000"};
  const std::string bytes = BigEndian(kValues[Below(stream, kValues.size())]);
  switch (Below(stream, 4)) {
    case 0:
      return bytes;
    case 1:
      return {bytes.rbegin(), bytes.rend()};
    case 2:
      return bytes.substr(2);
    default:
      return std::string(kTexts[Below(stream, kTexts.size())]);
  }
}

void Edit(const std::vector<SeedFile>& files, core::RandomStream& stream, std::string& bytes) {
  if (bytes.empty()) return;
  const std::size_t at = Below(stream, bytes.size());
  const std::size_t length = 1 + Below(stream, 40);
  const std::string& other = files[Below(stream, files.size())].bytes;
  switch (Below(stream, 10)) {
    case 0:
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ 1 << Below(stream, 8));
      break;
    case 2:
      bytes[at] = static_cast<char>(stream.NextU32() & 0xffU);
      break;
    case 3:
    case 4: {
      const std::string number = OddNumber(stream);
      bytes.replace(Below(stream, std::min<std::size_t>(bytes.size(), 1100)), number.size(),
                    number);
      break;
    }
    case 5:
      bytes.erase(at, length);
      break;
    case 6:
      bytes.insert(at, bytes.substr(Below(stream, bytes.size()), 10 * length));
      break;
    case 7:
      bytes.replace(at, length, other.substr(Below(stream, other.size()), length));
      break;
    case 8:
      for (std::size_t i = 0; i < length; ++i) {
        bytes.insert(at, 1, static_cast<char>(stream.NextU32() & 0xffU));
      }
      break;
    default:
      bytes.resize(at);
  }
}

std::string RandomBytes(core::RandomStream& stream, std::size_t count) {
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(stream.NextU32() & 0xffU);
  return bytes;
}

template <typename Value, std::size_t count>
Value OneOf(const std::array<Value, count>& values, core::RandomStream& stream) {
  return values[Below(stream, count)];
}

// A PNG file of which every checksum is right and anything else may be wrong: a header of any
// fields, a palette and transparency of any length, rows of any bytes and about the right number.
std::string RandomPng(core::RandomStream& stream) {
  PngText png;
  png.width = static_cast<int>(Below(stream, 40));
  png.height = static_cast<int>(Below(stream, 40));
  png.bits = OneOf(std::array{1, 2, 4, 8, 8, 8, 16, 16, 3}, stream);
  png.colour = static_cast<PngColour>(OneOf(std::array{0, 0, 2, 2, 3, 3, 4, 6, 1}, stream));
  png.interlaced = Below(stream, 2) == 0;
  std::string rows;
  const std::size_t pixel_bits = static_cast<std::size_t>(png.bits) * ChannelsOf(png.colour);
  const std::size_t row_bytes = (static_cast<std::size_t>(png.width) * pixel_bits + 7) / 8;
  for (int y = 0; y < png.height; ++y) {
    rows += static_cast<char>(Below(stream, Below(stream, 50) == 0 ? 7 : 5));  // filters 0 to 4
    rows += RandomBytes(stream, row_bytes);
  }
  if (png.interlaced) {
    const std::size_t pixels =
        static_cast<std::size_t>(png.width) * static_cast<std::size_t>(png.height);
    png.samples.resize(pixels * ChannelsOf(png.colour));
    for (unsigned& sample : png.samples) sample = stream.NextU32();
    rows = PngRows(png);
  }
  rows.resize(rows.size() - std::min(rows.size(), Below(stream, 8) == 0 ? Below(stream, 9) : 0));
  const std::string data = ZlibStored(rows);
  const std::size_t cut = Below(stream, data.size());
  std::string file = PngHeader(png);
  if (Below(stream, 4) != 0) file += PngChunk("PLTE", RandomBytes(stream, 3 * Below(stream, 260)));
  if (Below(stream, 4) == 0) file += PngChunk("tRNS", RandomBytes(stream, Below(stream, 9)));
  return file + PngChunk("IDAT", data.substr(0, cut)) + PngChunk("IDAT", data.substr(cut)) +
         PngChunk("IEND", "");
}

std::uint32_t BigEndianAt(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

// Gives each chunk the checksum that fits, so that the damage gets further than the checksum.
void MendChecksums(std::string& bytes) {
  std::size_t at = 8;
  while (at + 12 <= bytes.size()) {
    const std::size_t length = BigEndianAt(bytes, at);
    if (length > bytes.size() - at - 12) return;
    bytes.replace(at + 8 + length, 4, BigEndian(PngCrc(bytes.substr(at + 4, 4 + length))));
    at += 12 + length;
  }
}

std::string Fault(const RawImage& image) {
  const ImageLimits limits;
  if (image.planes.size() != 1 && image.planes.size() != 3) return "neither grey nor colour";
  const std::int64_t pixels = std::int64_t{image.width()} * image.height();
  if (pixels < 1 || pixels > limits.max_pixels) return "an image beyond the limits";
  for (const SamplePlane& plane : image.planes) {
    if (plane.width() != image.width() || plane.height() != image.height()) return "uneven planes";
    const std::uint16_t most = *std::max_element(plane.values().begin(), plane.values().end());
    const bool masked = image.format == "PDS3" || image.format == "PDS4" || image.format == "VICAR";
    if (!masked && most > image.full_scale) return "a sample above full scale";
  }
  return ToGray(image).image.width() == image.width() ? "" : "grey of another size";
}

std::string ReadFault(const SeedFile& file, const fs::path& folder) {
  if (PlanetaryKindOf(file.bytes)) {
    const fs::path path = folder / "case.img";
    std::ofstream(path, std::ios::binary | std::ios::trunc) << file.bytes;
    return Fault(ReadImage(path));
  }
  if (IsPfm(file.bytes)) return DecodePfm(file.bytes, file.name, {}).empty() ? "empty" : "";
  return Fault(DecodeImage(file.bytes, file.name));
}

}  // namespace

std::vector<SeedFile> SeedFiles(const fs::path& folder) {
  std::vector<SeedFile> files{{"grey.png", Png(PngColour::kGrey, 8, false)},
                              {"deep.png", Png(PngColour::kGrey, 16, true)},
                              {"few.png", Png(PngColour::kGrey, 2, true)},
                              {"colour.png", Png(PngColour::kRgb, 8, false)},
                              {"alpha.png", Png(PngColour::kRgba, 16, true)},
                              {"palette.png", Png(PngColour::kPalette, 4, false)},
                              {"deflated.png", DeflatedPng()},
                              {"plain.pgm", "P2\n# a comment\n5 2 99\n1 2 3 4 5\n 6 7 8 9 99\n"},
                              {"plain.ppm", "P3 2 1 65535\n1 2 3 40000 50000 60000\n"},
                              {"bytes.pgm", "P5 19 13 255\n" + Samples(kWidth * kHeight, 1)},
                              {"deep.pgm", "P5 19 13 4095\n" + Samples(kWidth * kHeight, 2)},
                              {"bytes.ppm", "P6 19 13 255\n" + Samples(3 * kWidth * kHeight, 1)},
                              {"reals.pfm", EncodePfm(vision::Image<float>(kWidth, kHeight, 2.5F))},
                              {"a.img", Pds3Bytes(Planetary())},
                              {"a.vic", VicarBytes(Planetary())},
                              {"a.xml", Pds4Label(Planetary(), "pixels.img")}};
  std::ofstream(folder / "pixels.img", std::ios::binary) << Planetary().data;
  const JpegText grey{.width = kWidth, .height = kHeight, .sample = Pattern, .restart_rows = 1};
  files.push_back({"grey.jpg", JpegBytes(grey)});
  JpegText colour{
      .width = kWidth, .height = kHeight, .sample = Pattern, .colour = JCS_RGB, .components = 3};
  files.push_back({"colour.jpg", JpegBytes(colour)});
  colour.progressive = true;
  files.push_back({"progressive.jpg", JpegBytes(colour)});
  const JpegText inks{
      .width = kWidth, .height = kHeight, .sample = Pattern, .colour = JCS_CMYK, .components = 4};
  files.push_back({"inks.jpg", JpegBytes(inks)});
  return files;
}

SeedFile MutatedFile(const std::vector<SeedFile>& files, std::uint64_t seed, std::uint32_t number) {
  core::RandomStream stream({seed, number}, core::Purpose::kTest);
  SeedFile file = files[Below(stream, files.size())];
  if (file.name.ends_with(".png") && Below(stream, 3) == 0) {
    return {"random.png", RandomPng(stream)};
  }
  const std::size_t edits = 1 + Below(stream, 1 + Below(stream, 6));
  for (std::size_t i = 0; i < edits; ++i) Edit(files, stream, file.bytes);
  if (file.name.ends_with(".png") && Below(stream, 2) == 0) MendChecksums(file.bytes);
  return file;
}

Verdict JudgeFile(const SeedFile& file, const fs::path& folder) {
  try {
    const std::string fault = ReadFault(file, folder);
    return {fault.empty() ? Outcome::kRead : Outcome::kFailed, fault};
  } catch (const core::UserError& error) {
    for (const core::Problem& problem : error.problems()) {
      if (problem.path.empty() || problem.reason.empty() || problem.suggestion.empty()) {
        return {Outcome::kFailed, std::string("a refusal without words: ") + error.what()};
      }
    }
    return {Outcome::kRefused, error.problems().front().reason};
  } catch (const std::exception& error) {
    return {Outcome::kFailed, std::string("another exception: ") + error.what()};
  }
}

}  // namespace rockyard::image_files
