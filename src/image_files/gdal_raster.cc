#include "image_files/gdal_raster.h"

#ifdef ROCKYARD_GDAL
#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal.h>
#include <gdal_frmts.h>

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>

#include "image_files/image_errors.h"
#endif

namespace rockyard::image_files {

#ifdef ROCKYARD_GDAL
namespace {

// No other driver of GDAL is made known: a label can name further files, and what reads them.
void RegisterDrivers() {
  static std::once_flag once;
  std::call_once(once, [] {
    GDALRegister_PDS();
    GDALRegister_PDS4();
    GDALRegister_VICAR();
  });
}

// While it lives, GDAL prints nothing in this thread; its first failure is kept.
class KeptErrors {
 public:
  KeptErrors() { CPLPushErrorHandlerEx(Keep, this); }
  ~KeptErrors() { CPLPopErrorHandler(); }
  KeptErrors(const KeptErrors&) = delete;
  KeptErrors& operator=(const KeptErrors&) = delete;

  std::string first() const { return first_.empty() ? "GDAL does not say why" : first_; }
  bool any() const { return !first_.empty(); }

 private:
  static void CPL_STDCALL Keep(CPLErr level, CPLErrorNum, const char* message) {
    auto& self = *static_cast<KeptErrors*>(CPLGetErrorHandlerUserData());
    if (level >= CE_Failure && self.first_.empty()) self.first_ = message;
  }

  std::string first_;
};

// A setting of GDAL in this thread, while it lives.
class GdalSetting {
 public:
  GdalSetting(const char* key, const char* value) : key_(key) {
    CPLSetThreadLocalConfigOption(key, value);
  }
  ~GdalSetting() { CPLSetThreadLocalConfigOption(key_, nullptr); }
  GdalSetting(const GdalSetting&) = delete;
  GdalSetting& operator=(const GdalSetting&) = delete;

 private:
  const char* key_;
};

struct CloseDataset {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<std::remove_pointer_t<GDALDatasetH>, CloseDataset>;

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

void CheckBands(GDALDatasetH dataset, const std::string& name) {
  const int bands = GDALGetRasterCount(dataset);
  if (bands != 1 && bands != 3) {
    FailUnsupported(name, fmt::format("has {} bands", bands), "name an image of one or three");
  }
  const GDALDataType type = GDALGetRasterDataType(GDALGetRasterBand(dataset, 1));
  for (int band = 1; band <= bands; ++band) {
    if (BitsOf(type) == 0 || GDALGetRasterDataType(GDALGetRasterBand(dataset, band)) != type) {
      FailUnsupported(
          name, fmt::format("has samples of type {}", GDALGetDataTypeName(type)),
          "scale it to integers first: gdal_translate -ot UInt16 -scale MIN MAX 0 65535");
    }
  }
}

// Returns how many of the samples are negative.
std::int64_t ReadBand(GDALRasterBandH band, const std::string& name, const KeptErrors& errors,
                      SamplePlane& plane) {
  std::int64_t negative = 0;
  std::vector<std::int32_t> row(static_cast<std::size_t>(plane.width()));
  for (int y = 0; y < plane.height(); ++y) {
    const CPLErr failure = GDALRasterIO(band, GF_Read, 0, y, plane.width(), 1, row.data(),
                                        plane.width(), 1, GDT_Int32, 0, 0);
    if (failure != CE_None || errors.any()) FailDamaged(name, errors.first());
    for (int x = 0; x < plane.width(); ++x) {
      const std::int32_t sample = row[static_cast<std::size_t>(x)];
      negative += sample < 0 ? 1 : 0;
      plane.At(x, y) = static_cast<std::uint16_t>(sample < 0 ? 0 : sample);
    }
  }
  return negative;
}

Raster ReadRaster(const std::filesystem::path& path, const char* driver,
                  const ImageLimits& limits) {
  RegisterDrivers();
  const std::string name = path.string();
  const KeptErrors errors;
  const GdalSetting no_files_beside("GDAL_PAM_ENABLED", "NO");
  const GdalSetting no_network("CPL_VSIL_CURL_ALLOWED_EXTENSIONS", "{none}");
  const std::array<const char*, 2> drivers{driver, nullptr};
  const std::array<const char*, 1> none{nullptr};
  const Dataset dataset(GDALOpenEx(name.c_str(),
                                   GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                   drivers.data(), none.data(), none.data()));
  if (!dataset) FailDamaged(name, errors.first());
  CheckBands(dataset.get(), name);
  const int width = GDALGetRasterXSize(dataset.get());
  const int height = GDALGetRasterYSize(dataset.get());
  CheckSize(name, width, height, limits);
  Raster raster;
  raster.bits = BitsOf(GDALGetRasterDataType(GDALGetRasterBand(dataset.get(), 1)));
  for (int band = 1; band <= GDALGetRasterCount(dataset.get()); ++band) {
    SamplePlane& plane = raster.planes.emplace_back(width, height);
    raster.negative += ReadBand(GDALGetRasterBand(dataset.get(), band), name, errors, plane);
  }
  return raster;
}

}  // namespace

RasterReader GdalRasterReader() { return ReadRaster; }
#else
RasterReader GdalRasterReader() { return nullptr; }
#endif

}  // namespace rockyard::image_files
