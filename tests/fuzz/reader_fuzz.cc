// libFuzzer's entry: ROCKYARD_READER names the reader (readers.cc).
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "fuzz/readers.h"

namespace {

const rockyard::Reader& Chosen() {
  const char* name = std::getenv("ROCKYARD_READER");
  for (const rockyard::Reader& reader : rockyard::Readers()) {
    if (name != nullptr && reader.name == name) return reader;
  }
  std::fputs("ROCKYARD_READER has to be one of", stderr);
  for (const rockyard::Reader& reader : rockyard::Readers()) {
    std::fprintf(stderr, " %s", std::string(reader.name).c_str());
  }
  std::fputs("\n", stderr);
  std::exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const rockyard::Reader& reader = Chosen();
  rockyard::Accepts(reader, {reinterpret_cast<const char*>(data), size});
  return 0;
}
