#include "image_files/gdal_raster.h"

#ifdef ROCKYARD_GDAL
#include <fmt/format.h>
#include <gdal.h>
#include <gdal_frmts.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>

#include "image_files/raw_image.h"
#endif

#include "image_files/gdal_library.h"

namespace rockyard::image_files {

#ifdef ROCKYARD_GDAL
namespace {

// The functions of the library that are used here, of the types in its headers.
struct Gdal {
  decltype(&::GDALClose) close = nullptr;
  decltype(&::GDALGetDataTypeName) type_name = nullptr;
  decltype(&::GDALGetRasterBand) band = nullptr;
  decltype(&::GDALGetRasterCount) bands = nullptr;
  decltype(&::GDALGetRasterDataType) data_type = nullptr;
  decltype(&::GDALGetRasterXSize) width = nullptr;
  decltype(&::GDALGetRasterYSize) height = nullptr;
  decltype(&::GDALOpenEx) open = nullptr;
  decltype(&::GDALRasterIO) read = nullptr;
  decltype(&::GDALRegister_PDS) register_pds = nullptr;
  decltype(&::GDALRegister_PDS4) register_pds4 = nullptr;
  decltype(&::GDALRegister_VICAR) register_vicar = nullptr;
};

// Returns the functions and makes no drivers known but those of planetary images: a label can name
// further files, and what reads them.
std::optional<Gdal> LoadGdal() {
  if (GdalLibrary() == nullptr) return std::nullopt;
  Gdal gdal;
  const bool complete = FindFunction("GDALClose", gdal.close) &&
                        FindFunction("GDALGetDataTypeName", gdal.type_name) &&
                        FindFunction("GDALGetRasterBand", gdal.band) &&
                        FindFunction("GDALGetRasterCount", gdal.bands) &&
                        FindFunction("GDALGetRasterDataType", gdal.data_type) &&
                        FindFunction("GDALGetRasterXSize", gdal.width) &&
                        FindFunction("GDALGetRasterYSize", gdal.height) &&
                        FindFunction("GDALOpenEx", gdal.open) &&
                        FindFunction("GDALRasterIO", gdal.read) &&
                        FindFunction("GDALRegister_PDS", gdal.register_pds) &&
                        FindFunction("GDALRegister_PDS4", gdal.register_pds4) &&
                        FindFunction("GDALRegister_VICAR", gdal.register_vicar);
  if (!complete) return std::nullopt;
  gdal.register_pds();
  gdal.register_pds4();
  gdal.register_vicar();
  return gdal;
}

const std::optional<Gdal>& ImageFunctions() {
  static const std::optional<Gdal> gdal = LoadGdal();
  return gdal;
}

// 0: samples that are not read.
int BitsOf(GDALDataType type) {
  switch (type) {
    case GDT_Byte:
      return 8;
    case GDT_Int16:
      return 15;
    case GDT_UInt16:
      return 16;
    default:
      return 0;
  }
}

// One file. Messages call it by its path.
class GdalFile {
 public:
  GdalFile(const Gdal& gdal, const std::filesystem::path& path, const char* driver)
      : gdal_(gdal), name_(path.string()) {
    const std::array<const char*, 2> drivers{driver, nullptr};
    const std::array<const char*, 1> none{nullptr};  // of options, and of files beside it
    dataset_ = gdal.open(name_.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                         drivers.data(), none.data(), none.data());
    if (dataset_ == nullptr) FailDamaged(name_, errors_.first());
  }
  ~GdalFile() { gdal_.close(dataset_); }
  GdalFile(const GdalFile&) = delete;
  GdalFile& operator=(const GdalFile&) = delete;

  Raster Read(const ImageLimits& limits) const {
    Raster raster;
    raster.bits = CheckBands();
    const int width = gdal_.width(dataset_);
    const int height = gdal_.height(dataset_);
    CheckSize(name_, width, height, limits);
    for (int band = 1; band <= gdal_.bands(dataset_); ++band) {
      raster.negative += ReadBand(band, raster.planes.emplace_back(width, height));
    }
    return raster;
  }

 private:
  // The bits of a sample.
  int CheckBands() const {
    const int bands = gdal_.bands(dataset_);
    if (bands != 1 && bands != 3) {
      FailUnsupported(name_, fmt::format("has {} bands", bands), "name an image of one or three");
    }
    const GDALDataType first = gdal_.data_type(gdal_.band(dataset_, 1));
    for (int band = 1; band <= bands; ++band) {
      const GDALDataType type = gdal_.data_type(gdal_.band(dataset_, band));
      if (BitsOf(type) == 0 || type != first) {
        FailUnsupported(
            name_, fmt::format("has samples of type {}", gdal_.type_name(type)),
            "scale it to integers first: gdal_translate -ot UInt16 -scale MIN MAX 0 65535");
      }
    }
    return BitsOf(first);
  }

  // Returns how many of the samples are negative.
  std::int64_t ReadBand(int band, SamplePlane& plane) const {
    const GDALRasterBandH samples = gdal_.band(dataset_, band);
    std::int64_t negative = 0;
    std::vector<std::int32_t> row(static_cast<std::size_t>(plane.width()));
    for (int y = 0; y < plane.height(); ++y) {
      const CPLErr failure = gdal_.read(samples, GF_Read, 0, y, plane.width(), 1, row.data(),
                                        plane.width(), 1, GDT_Int32, 0, 0);
      if (failure != CE_None || errors_.any()) FailDamaged(name_, errors_.first());
      for (int x = 0; x < plane.width(); ++x) {
        const std::int32_t sample = row[static_cast<std::size_t>(x)];
        negative += sample < 0 ? 1 : 0;
        plane.At(x, y) = static_cast<std::uint16_t>(sample < 0 ? 0 : sample);
      }
    }
    return negative;
  }

  const Gdal& gdal_;
  std::string name_;
  GdalErrors errors_;
  GDALDatasetH dataset_ = nullptr;
};

Raster ReadRaster(const std::filesystem::path& path, const char* driver,
                  const ImageLimits& limits) {
  return GdalFile(*ImageFunctions(), path, driver).Read(limits);
}

}  // namespace

RasterSupport FindGdal() {
  if (ImageFunctions()) return {ReadRaster, ""};
  return {nullptr, GdalRemedy()};
}
#else
RasterSupport FindGdal() { return {nullptr, GdalRemedy()}; }
#endif

}  // namespace rockyard::image_files
