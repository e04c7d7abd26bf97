#include "reference/suite/shard.h"

#include <charconv>

#include "core/types/check.h"
#include "reference/text/file_text.h"

namespace contactcheck::suite {
namespace {

constexpr std::size_t kMostShards = 100'000;

// 0 where it is no such number.
std::size_t number_of(std::string_view digits) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = error == std::errc() && end == digits.data() + digits.size();
  return whole && digits.front() != '0' && value <= kMostShards ? value : 0;
}

}  // namespace

std::string Shard::name() const { return std::to_string(index) + "/" + std::to_string(of); }

Shard parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string_view::npos) {
    const Shard shard{number_of(text.substr(0, slash)), number_of(text.substr(slash + 1))};
    if (shard.index >= 1 && shard.index <= shard.of) return shard;
  }
  throw InputError("--shard " + text::in_quotes(std::string(text), 60) +
                   ": is not K/N with 1 <= K <= N <= " + std::to_string(kMostShards) +
                   ", such as 2/3");
}

std::string without_shard_flag(const std::string& command, const Shard& shard) {
  for (const std::string& flag : {" --shard " + shard.name(), " --shard=" + shard.name()}) {
    const std::size_t at = command.find(flag);
    if (at != std::string::npos) return command.substr(0, at) + command.substr(at + flag.size());
  }
  return command;
}

}  // namespace contactcheck::suite
