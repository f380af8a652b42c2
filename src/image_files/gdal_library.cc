#include "image_files/gdal_library.h"

#ifdef ROCKYARD_GDAL
#include <cpl_error.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#endif

namespace rockyard::image_files {

#ifdef ROCKYARD_GDAL
namespace {

struct ErrorFunctions {
  decltype(&::CPLGetErrorHandlerUserData) user = nullptr;
  decltype(&::CPLPopErrorHandler) pop = nullptr;
  decltype(&::CPLPushErrorHandlerEx) push = nullptr;
};

const ErrorFunctions& ErrorsOfGdal() {
  static const ErrorFunctions functions = [] {
    ErrorFunctions found;
    FindFunction("CPLGetErrorHandlerUserData", found.user);
    FindFunction("CPLPopErrorHandler", found.pop);
    FindFunction("CPLPushErrorHandlerEx", found.push);
    return found;
  }();
  return functions;
}

void CPL_STDCALL KeepFailure(CPLErr level, CPLErrorNum, const char* message) {
  if (level >= CE_Failure) static_cast<GdalErrors*>(ErrorsOfGdal().user())->Keep(message);
}

}  // namespace

void* GdalLibrary() {
  static void* const library = dlopen(ROCKYARD_GDAL, RTLD_NOW | RTLD_LOCAL);
  return library;
}

std::string GdalRemedy() {
  return fmt::format("install the library {} (Debian's libgdal32)", ROCKYARD_GDAL);
}

void* GdalFunction(const char* name) { return dlsym(GdalLibrary(), name); }

GdalErrors::GdalErrors() { ErrorsOfGdal().push(KeepFailure, this); }

GdalErrors::~GdalErrors() { ErrorsOfGdal().pop(); }

void GdalErrors::Keep(const char* message) {
  if (!first_.empty()) return;
  first_ = message;
  std::replace(first_.begin(), first_.end(), '\n', ' ');
}
#else
void* GdalLibrary() { return nullptr; }

std::string GdalRemedy() {
  return "install Debian's libgdal-dev (scripts/install_dependencies.sh planetary) and build "
         "rockyard anew with -DROCKYARD_GDAL=ON, which is the default";
}
#endif

}  // namespace rockyard::image_files
