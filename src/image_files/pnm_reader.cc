// DecodePnm (read_image.h).
#include <fmt/format.h>

#include <bit>
#include <cstddef>

#include "image_files/header_text.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"

namespace rockyard::image_files {
namespace {

// The product of two such sides does not overflow.
constexpr std::int64_t kMostOfHeader = 1'000'000'000;
constexpr std::int64_t kMostOfSample = 65535;

struct PnmHeader {
  bool plain = false;  // samples as text
  bool colour = false;
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::int64_t maximum = 0;

  std::size_t samples() const {
    return static_cast<std::size_t>(width * height) * (colour ? 3 : 1);
  }
  std::size_t bytes_a_sample() const { return maximum > 255 ? 2 : 1; }
};

PnmHeader ReadHeader(HeaderText& text, const std::string& name) {
  const std::string_view type = text.Word();
  PnmHeader header;
  header.plain = type == "P2" || type == "P3";
  header.colour = type == "P3" || type == "P6";
  if (!header.plain && type != "P5" && type != "P6") {
    FailUnsupported(name, "is a file of Netpbm that is neither PGM nor PPM (P2, P3, P5, P6)",
                    "save it as PGM or PNG");
  }
  header.width = text.Number("width", kMostOfHeader);
  header.height = text.Number("height", kMostOfHeader);
  header.maximum = text.Number("maximum", kMostOfSample);
  if (header.maximum == 0) FailDamaged(name, "its maximum is 0");
  return header;
}

// Text takes a digit and a blank a sample, but for the last.
void CheckLength(const PnmHeader& header, std::size_t bytes, const std::string& name) {
  const std::size_t least =
      header.plain ? 2 * header.samples() - 1 : header.bytes_a_sample() * header.samples();
  if (bytes < least) FailTruncated(name);
}

// Samples one after the other, as text or most significant byte first.
class SampleReader {
 public:
  SampleReader(const PnmHeader& header, HeaderText& text, const std::string& name)
      : header_(header), text_(text), bytes_(text.rest()), name_(name) {}

  std::uint16_t Next() {
    if (header_.plain) return static_cast<std::uint16_t>(text_.Number("sample", header_.maximum));
    int sample = 0;
    for (std::size_t i = 0; i < header_.bytes_a_sample(); ++i) {
      sample = sample << 8 | static_cast<unsigned char>(bytes_[i]);
    }
    bytes_.remove_prefix(header_.bytes_a_sample());
    if (sample > header_.maximum) {
      FailDamaged(name_,
                  fmt::format("a sample is {}, above its maximum {}", sample, header_.maximum));
    }
    return static_cast<std::uint16_t>(sample);
  }

  // Blanks at the end are left by editors.
  void CheckEnd() {
    HeaderText left(bytes_, name_);
    if (!(header_.plain ? text_ : left).RestWithoutBlanks().empty()) {
      FailDamaged(name_, "it goes on after the last pixel that its header speaks of");
    }
  }

 private:
  const PnmHeader& header_;
  HeaderText& text_;
  std::string_view bytes_;  // where they are no text
  const std::string& name_;
};

}  // namespace

RawImage DecodePnm(std::string_view bytes, const std::string& name, const ImageLimits& limits) {
  HeaderText text(bytes, name);
  const PnmHeader header = ReadHeader(text, name);
  CheckSize(name, header.width, header.height, limits);
  text.EndOfHeader();
  CheckLength(header, text.rest().size(), name);

  RawImage image;
  image.format = header.colour ? "PPM" : "PGM";
  image.bits = std::bit_width(static_cast<unsigned>(header.maximum));
  image.full_scale = static_cast<int>(header.maximum);
  image.full_scale_from = "the maximum of the file";
  image.planes.assign(header.colour ? 3 : 1,
                      SamplePlane(static_cast<int>(header.width), static_cast<int>(header.height)));
  SampleReader samples(header, text, name);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (SamplePlane& plane : image.planes) plane.At(x, y) = samples.Next();
    }
  }
  samples.CheckEnd();
  return image;
}

}  // namespace rockyard::image_files
