// A part of a run's work, for a machine of its own.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace contactcheck::suite {

/// Part `index` of `of`, counted from 1. The unit is a scene with all its detectors: they run in
/// turns in one process, and a ratio of their times exists only there. Scenes are dealt like cards,
/// in the order of the run, so that every one of them is in exactly one part.
struct Shard {
  std::size_t index = 1, of = 1;  ///< 1 <= index <= of

  /// Whether scene number `scene` of the run, from 0, is in it.
  bool holds(std::size_t scene) const { return scene % of == index - 1; }
  /// "2/3"
  std::string name() const;
};

/// @throws InputError unless `text` is K/N with 1 <= K <= N <= 100000, in digits without leading
/// zeros
Shard parse_shard(std::string_view text);

/// `command` as it was without the flag --shard.
std::string without_shard_flag(const std::string& command, const Shard& shard);

}  // namespace contactcheck::suite
