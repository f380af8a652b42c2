#include "campaign/campaign_request.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "core/error.h"

namespace rockyard::campaign {
namespace {

constexpr int kMaxShards = 1'000'000;

bool ParseWhole(std::string_view text, int& number) {
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number);
  return result.ec == std::errc{} && result.ptr == end;
}

}  // namespace

batch::Shard CampaignRequest::ParseShard() const {
  if (shard.empty()) return {};
  const std::size_t slash = shard.find('/');
  const std::string_view text = shard;
  batch::Shard parsed;
  const bool numbers = slash != std::string::npos &&
                       ParseWhole(text.substr(0, slash), parsed.index) &&
                       ParseWhole(text.substr(slash + 1), parsed.count);
  if (!numbers || parsed.index < 1 || parsed.index > parsed.count || parsed.count > kMaxShards) {
    throw core::UserError("--shard", fmt::format("\"{}\" is no part of a campaign", shard),
                          "use I/N with 1 <= I <= N, e.g. 1/4");
  }
  return parsed;
}

}  // namespace rockyard::campaign
