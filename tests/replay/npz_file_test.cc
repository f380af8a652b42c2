// Arrays as NumPy files. trace_npz_test.py reads whole traces with NumPy itself.
#include "replay/npz_file.h"

#include <gmock/gmock.h>
#include <zip.h>

#include <cstdlib>
#include <cstring>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/check.h"

namespace rockyard::replay {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// Files of a zip archive, by name.
std::vector<std::pair<std::string, std::string>> Unzip(const std::string& bytes) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* archive = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
  if (archive == nullptr) throw std::runtime_error(zip_error_strerror(&error));
  std::vector<std::pair<std::string, std::string>> files;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
    zip_stat_t stat;
    zip_stat_index(archive, static_cast<zip_uint64_t>(i), 0, &stat);
    std::string text(stat.size, '\0');
    zip_file_t* file = zip_fopen_index(archive, static_cast<zip_uint64_t>(i), 0);
    zip_fread(file, text.data(), text.size());
    zip_fclose(file);
    files.emplace_back(stat.name, text);
  }
  zip_discard(archive);
  return files;
}

NpzFile Sample() {
  NpzFile file;
  file.AddReals("reals", std::vector{1.5, -2.0, 0.0, 1e300, std::nan(""), 6.0}, {2, 3});
  file.AddIntegers("integers", std::vector<std::int64_t>{-1, 255}, {2});
  file.AddFlags("flags", std::vector<std::uint8_t>{1, 0, 1}, {3});
  file.AddTexts("texts",
                std::vector<std::string>{"plain", "", "\xc3\xa9\xe2\x82\xac\xf0\x9f\xaa\xa8",
                                         "a\xff"
                                         "b"});
  file.AddText("meta", "{\"x\": 1}");
  file.AddReals("empty", {}, {0, 3});
  return file;
}

TEST(NpzFile, HoldsOneFilePerArray) {
  std::vector<std::string> names;
  for (const auto& [name, npy] : Unzip(Sample().Bytes())) {
    names.push_back(name);
    EXPECT_THAT(npy, StartsWith("\x93NUMPY\x01"));
    const std::size_t header =
        10 + static_cast<unsigned char>(npy[8]) + 256 * static_cast<unsigned char>(npy[9]);
    EXPECT_EQ(header % 64, 0U) << name;
    EXPECT_EQ(npy[header - 1], '\n');
  }
  EXPECT_THAT(names, ElementsAre("reals.npy", "integers.npy", "flags.npy", "texts.npy", "meta.npy",
                                 "empty.npy"));
}

TEST(NpzFile, NumbersLieAsTheyAre) {
  const std::string npy = Unzip(Sample().Bytes()).front().second;
  EXPECT_THAT(npy, HasSubstr("{'descr': '<f8', 'fortran_order': False, 'shape': (2,3,), }"));
  double value = 0.0;
  std::memcpy(&value, npy.data() + npy.size() - 6 * sizeof(double), sizeof value);
  EXPECT_EQ(value, 1.5);
}

// The first and the last character of each length are kept; one before them, written too long, and
// one behind the last of all are none.
TEST(NpzFile, TextsAreCharactersOfTheirShortestForm) {
  const auto decoded = [](const std::string& text) {
    NpzFile file;
    file.AddText("text", text);
    const std::string npy = Unzip(file.Bytes()).front().second;
    const auto header = std::string::size_type{10} + static_cast<unsigned char>(npy[8]);
    std::u32string characters((npy.size() - header) / sizeof(char32_t), U'\0');
    std::memcpy(characters.data(), npy.data() + header, npy.size() - header);
    return characters;
  };
  EXPECT_EQ(decoded("\x7f\xc2\x80\xdf\xbf"), U"\x7f\x80\x7ff");
  EXPECT_EQ(decoded("\xe0\xa0\x80\xef\xbf\xbf"), U"\x800\xffff");
  EXPECT_EQ(decoded("\xf0\x90\x80\x80\xf4\x8f\xbf\xbf"), U"\U00010000\U0010ffff");
  EXPECT_EQ(decoded("\xed\x9f\xbf\xee\x80\x80"), U"\xd7ff\xe000");
  for (const char* none : {"\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80",
                           "\xed\xa0\x80", "\xed\xbf\xbf", "\xc2", "\xc2z"}) {
    EXPECT_EQ(decoded(none).front(), U'\xfffd') << testing::PrintToString(none);
  }
}

TEST(NpzFile, EqualArraysGiveEqualBytesInEveryTimeZone) {
  const std::string here = Sample().Bytes();
  EXPECT_EQ(Sample().Bytes(), here);
  const char* zone = std::getenv("TZ");
  const std::optional<std::string> former = zone != nullptr ? std::optional(zone) : std::nullopt;
  setenv("TZ", "NZST-12", 1);
  tzset();
  EXPECT_EQ(Sample().Bytes(), here);
  if (former) {
    setenv("TZ", former->c_str(), 1);
  } else {
    unsetenv("TZ");
  }
  tzset();
}

#ifdef ROCKYARD_CONTRACTS
TEST(NpzFile, AShapeThatDoesNotFitOrANameTwiceIsADefect) {
  NpzFile file;
  EXPECT_THROW(file.AddReals("a", std::vector{1.0, 2.0}, {3}), core::ContractViolation);
  file.AddReals("a", std::vector{1.0}, {1});
  EXPECT_THROW(file.AddReals("a", std::vector{1.0}, {1}), core::ContractViolation);
}
#endif

}  // namespace
}  // namespace rockyard::replay
