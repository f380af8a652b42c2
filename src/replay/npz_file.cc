#include "replay/npz_file.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <memory>
#include <mutex>
#include <numeric>
#include <stdexcept>

#include "core/check.h"
#include "core/text.h"

namespace rockyard::replay {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie");

// The head of a .npy file (numpy.lib.format, version 1.0): magic, version, length of the
// dictionary, and a Python dictionary that is padded so that the data begin at a multiple of 64
// bytes.
constexpr std::string_view kMagic{"\x93NUMPY\x01\x00", 8};
constexpr std::size_t kAlignment = 64;

// The time of every member is 1980-01-01, 0 h, the earliest that zip knows, as the present time
// would make equal files differ. It is given in the words of MS-DOS that zip keeps, as libzip
// writes a std::time_t in the time zone of the machine.
constexpr zip_uint16_t kNoTime = 0;
constexpr zip_uint16_t kNoDate = (1 << 5) | 1;  // years since 1980, month, day

constexpr char32_t kNoCharacter = U'\ufffd';

std::string ShapeText(const NpzFile::Shape& shape) {
  std::string text = "(";
  for (const std::size_t extent : shape) text += fmt::format("{},", extent);
  return text + ")";
}

std::string Header(std::string_view type, const NpzFile::Shape& shape) {
  std::string dictionary = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}",
                                       type, ShapeText(shape));
  const std::size_t length = kMagic.size() + 2 + dictionary.size() + 1;
  dictionary.append((kAlignment - length % kAlignment) % kAlignment, ' ');
  dictionary += '\n';
  std::string header(kMagic);
  header += static_cast<char>(dictionary.size() % 256);
  header += static_cast<char>(dictionary.size() / 256);
  return header + dictionary;
}

std::u32string Decode(std::string_view text) {
  std::u32string characters;
  while (!text.empty()) {
    const core::CodePoint front = core::FirstCodePoint(text);
    characters += front.code == core::CodePoint::kNone ? kNoCharacter : front.code;
    text.remove_prefix(front.bytes);
  }
  return characters;
}

[[noreturn]] void Fail(std::string_view what, const char* why) {
  throw std::runtime_error(fmt::format("{}: {}", what, why));
}

using Source = std::unique_ptr<zip_source_t, decltype(&zip_source_free)>;
using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

Source NewBuffer() {
  zip_error_t error;
  zip_error_init(&error);
  Source buffer(zip_source_buffer_create(nullptr, 0, 0, &error), &zip_source_free);
  if (!buffer) Fail("zip", zip_error_strerror(&error));
  return buffer;
}

// Opens archives one at a time, whichever threads ask: libzip before 1.9 looks up in unguarded
// static variables, which the first call fills, whether it may write
// (github.com/nih-at/libzip/issues/289), and a second thread could be told "Read-only archive".
Archive OpenToWrite(zip_source_t& buffer, zip_error_t& error) {
  static std::mutex opening;
  const std::lock_guard lock(opening);
  return {zip_open_from_source(&buffer, ZIP_TRUNCATE, &error), &zip_discard};
}

void AddFile(zip_t& archive, const std::string& name, const std::string& bytes) {
  zip_source_t* source = zip_source_buffer(&archive, bytes.data(), bytes.size(), 0);
  if (source == nullptr) Fail(name, zip_strerror(&archive));
  const zip_int64_t index = zip_file_add(&archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(source);
    Fail(name, zip_strerror(&archive));
  }
  if (zip_file_set_dostime(&archive, static_cast<zip_uint64_t>(index), kNoTime, kNoDate, 0) != 0) {
    Fail(name, zip_strerror(&archive));
  }
}

std::string ReadAll(zip_source_t& source) {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_source_stat(&source, &stat) != 0 || zip_source_open(&source) != 0) {
    Fail("zip", zip_error_strerror(zip_source_error(&source)));
  }
  std::string bytes(stat.size, '\0');
  const zip_int64_t read = zip_source_read(&source, bytes.data(), bytes.size());
  zip_source_close(&source);
  if (read < 0 || static_cast<std::size_t>(read) != bytes.size()) Fail("zip", "cannot be read");
  return bytes;
}

}  // namespace

void NpzFile::Add(std::string_view name, std::string_view type, const Shape& shape,
                  std::size_t values, std::span<const std::byte> data) {
  EXPECT(std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>()) ==
         values);
  EXPECT(std::none_of(entries_.begin(), entries_.end(),
                      [name](const Entry& entry) { return entry.name == name; }));
  std::string npy = Header(type, shape);
  for (const std::byte byte : data) npy += static_cast<char>(byte);
  entries_.push_back({std::string(name), std::move(npy)});
}

void NpzFile::AddReals(std::string_view name, std::span<const double> values, const Shape& shape) {
  Add(name, "<f8", shape, values.size(), std::as_bytes(values));
}

void NpzFile::AddIntegers(std::string_view name, std::span<const std::int64_t> values,
                          const Shape& shape) {
  Add(name, "<i8", shape, values.size(), std::as_bytes(values));
}

void NpzFile::AddFlags(std::string_view name, std::span<const std::uint8_t> values,
                       const Shape& shape) {
  Add(name, "|b1", shape, values.size(), std::as_bytes(values));
}

void NpzFile::AddTexts(std::string_view name, std::span<const std::string> texts) {
  std::vector<std::u32string> decoded;
  std::size_t length = 1;  // NumPy has no texts of length 0
  for (const std::string& text : texts) {
    length = std::max(length, decoded.emplace_back(Decode(text)).size());
  }
  std::u32string cells;
  for (std::u32string& text : decoded) {
    text.resize(length, U'\0');
    cells += text;
  }
  Add(name, fmt::format("<U{}", length), {texts.size()}, texts.size(),
      std::as_bytes(std::span(cells)));
}

void NpzFile::AddText(std::string_view name, const std::string& text) {
  std::u32string cell = Decode(text);
  if (cell.empty()) cell += U'\0';
  Add(name, fmt::format("<U{}", cell.size()), {}, 1, std::as_bytes(std::span(cell)));
}

std::string NpzFile::Bytes() const {
  const Source buffer = NewBuffer();
  zip_error_t error;
  zip_error_init(&error);
  // The archive releases the buffer when it is closed: hold it until it has been read.
  zip_source_keep(buffer.get());
  Archive archive = OpenToWrite(*buffer, error);
  if (!archive) {
    zip_source_free(buffer.get());
    Fail("zip", zip_error_strerror(&error));
  }
  for (const Entry& entry : entries_) AddFile(*archive, entry.name + ".npy", entry.npy);
  if (zip_close(archive.get()) != 0) Fail("zip", zip_strerror(archive.get()));
  (void)archive.release();  // closed
  return ReadAll(*buffer);
}

}  // namespace rockyard::replay
