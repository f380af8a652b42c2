// Images of planetary archives: PDS3, PDS4 and VICAR. ReadImage recognizes and reads them by it.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "image_files/gdal_raster.h"
#include "image_files/raw_image.h"

namespace rockyard::image_files {

enum class PlanetaryKind { kPds3, kPds4, kVicar };

// "PDS3", "PDS4" or "VICAR".
const char* NameOf(PlanetaryKind kind);

// Returns the kind by the front of the file, which is its label; nothing where it is none of the
// three.
std::optional<PlanetaryKind> PlanetaryKindOf(std::string_view bytes);

// Returns the value of the first SAMPLE_BIT_MASK in the label (PDS3 and VICAR), or sample_bit_mask
// (PDS4): 4095 of "2#0000111111111111#". Nothing where there is none, or none from 1 to 65535.
std::optional<int> SampleBitMask(std::string_view bytes);

// Returns the image of a file whose front is `bytes`. Its full scale is the sample bit mask of its
// label; where that is missing, or has more bits than the samples have, the largest sample of its
// type. Throws core::UserError: no GDAL, with what would bring it, no image of one or three bands,
// samples that are no integers of 8 or 16 bits, damaged, or beyond the limits.
RawImage ReadPlanetary(const std::filesystem::path& path, std::string_view bytes,
                       PlanetaryKind kind, const ImageLimits& limits, const RasterSupport& gdal);

}  // namespace rockyard::image_files
