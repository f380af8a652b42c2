#include "campaign/bench/bench_chain.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <system_error>

#include "core/digest.h"
#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/random.h"
#include "core/text.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kChainHead = "cell,trial,digest\n";

std::string Link(std::string_view before, const std::string& cell, const truth::Record& record,
                 std::string_view actions) {
  std::string text = fmt::format("{}\n{}\n{}\n{}\n{}\n", before, cell, record.trial,
                                 Name(record.outcome), core::Sha256(actions));
  for (const double value : record.values) {
    text += core::Hex(std::isnan(value)
                          ? std::bit_cast<std::uint64_t>(std::numeric_limits<double>::quiet_NaN())
                          : std::bit_cast<std::uint64_t>(value));
  }
  return core::Sha256(text);
}

}  // namespace

fs::path ActionFile(std::size_t cell, std::string_view cell_name, std::uint64_t random_seed) {
  return fs::path("actions") / scenario::CellFileName(cell, std::string(cell_name)) /
         (core::Hex(random_seed) + ".bin");
}

std::uint64_t NavigatorSeed(std::uint64_t campaign_seed, std::uint64_t trial) {
  return core::RandomStream({campaign_seed, static_cast<std::uint32_t>(trial)},
                            core::Purpose::kNavigator)
      .NextU64();
}

std::string ReadActions(const fs::path& folder, std::size_t cell,
                        const batch::CellIdentity& identity, std::uint64_t trial) {
  const fs::path file =
      folder / ActionFile(cell, identity.name, NavigatorSeed(identity.seed, trial));
  constexpr std::size_t kMaxBytes = std::size_t{1} << 28;
  std::error_code error;
  if (!fs::exists(file, error)) return "";
  return core::ReadWholeFile(file, kMaxBytes, "a file of actions");
}

std::vector<ChainLink> MakeChain(const fs::path& folder, const batch::ResultStore& store,
                                 std::string_view start) {
  std::vector<ChainLink> chain;
  std::string before(start);
  for (std::size_t cell = 0; cell < store.identity().cells.size(); ++cell) {
    const batch::CellIdentity& identity = store.identity().cells[cell];
    const std::vector<truth::Record> records = store.Load(static_cast<int>(cell));
    if (static_cast<std::int64_t>(records.size()) != store.planned(static_cast<int>(cell))) {
      throw core::UserError(folder.string(), fmt::format("lacks drives of {}", identity.name),
                            "go on with the run: --resume");
    }
    for (const truth::Record& record : records) {
      before =
          Link(before, identity.name, record, ReadActions(folder, cell, identity, record.trial));
      chain.push_back({cell, record.trial, before});
    }
  }
  return chain;
}

std::string ChainCsv(const std::vector<ChainLink>& chain) {
  std::string text(kChainHead);
  for (const ChainLink& link : chain) {
    text += fmt::format("{},{},{}\n", link.cell, link.trial, link.digest);
  }
  return text;
}

std::vector<ChainLink> ParseChain(std::string_view csv, std::string_view source_name) {
  const auto fail = [&](std::size_t line) {
    throw core::UserError(std::string(source_name), fmt::format("line {} is no link", line),
                          "take the file as `rockyard bench run` wrote it");
  };
  if (!csv.starts_with(kChainHead)) fail(1);
  csv.remove_prefix(kChainHead.size());
  std::vector<ChainLink> chain;
  while (!csv.empty()) {
    const std::string_view line = csv.substr(0, csv.find('\n'));
    csv.remove_prefix(std::min(csv.size(), line.size() + 1));
    const std::size_t first = line.find(',');
    const std::size_t second = line.find(',', first + 1);
    if (first == std::string_view::npos || second == std::string_view::npos) fail(chain.size() + 2);
    const auto cell = core::FiniteNumber(line.substr(0, first));
    const auto trial = core::FiniteNumber(line.substr(first + 1, second - first - 1));
    if (!cell || !trial || *cell < 0.0 || *trial < 0.0) fail(chain.size() + 2);
    chain.push_back({static_cast<std::size_t>(*cell), static_cast<std::uint64_t>(*trial),
                     std::string(line.substr(second + 1))});
  }
  return chain;
}

}  // namespace rockyard::campaign
