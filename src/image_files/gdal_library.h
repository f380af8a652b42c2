// GDAL, an optional part of the build: loaded once, with its errors kept for messages. The files
// that speak to it (gdal_raster.cc, gdal_elevation.cc) take from it the functions that they need.
//
// It is loaded when the first file needs it, not linked: it brings a hundred libraries, which would
// add some 40 ms and 30 MB to every start of the program, and the Debian package works with or
// without it.
#pragma once

#include <string>

namespace rockyard::image_files {

// Returns what dlopen made of the library, or nullptr in a program that was built without it or on
// a machine on which it is missing. It stays loaded: it cannot be unloaded safely.
void* GdalLibrary();

// Returns what would bring the library, in one sentence.
std::string GdalRemedy();

// Returns the address of a function of a loaded library, or nullptr.
void* GdalFunction(const char* name);

// Sets `function` to the library's function of that name. Returns whether it has one.
template <typename Function>
bool FindFunction(const char* name, Function& function) {
  function = reinterpret_cast<Function>(GdalFunction(name));
  return function != nullptr;
}

// While an object lives, GDAL prints nothing in this thread; its first failure is kept. The library
// must be there.
class GdalErrors {
 public:
  GdalErrors();
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  // Returns the message of the first failure, on one line.
  std::string first() const { return first_.empty() ? "GDAL does not say why" : first_; }
  bool any() const { return !first_.empty(); }
  // Keeps a message of the library, unless there is one.
  void Keep(const char* message);

 private:
  std::string first_;
};

}  // namespace rockyard::image_files
