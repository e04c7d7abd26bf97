// Reads the next frame of a recording while the last one is worked on.
#pragma once

#include <array>
#include <cstddef>
#include <future>
#include <optional>
#include <utility>
#include <vector>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

/// In place of a scene's reader, for frames that are asked for in order. A thread reads the one
/// after the last that was asked for; that and the one before it are held, so that whoever works on
/// steps and whoever works on frames read each file once.
class ReadAhead {
 public:
  using Nodes = std::vector<std::vector<Vec3>>;

  ReadAhead(FrameReader reader, std::size_t frames) : reader_(std::move(reader)), frames_(frames) {}

  /// @pre frame < frames. @throws what the reader throws for this frame
  Nodes operator()(std::size_t frame);

 private:
  FrameReader reader_;
  std::size_t frames_;
  std::array<std::pair<std::optional<std::size_t>, Nodes>, 2> held_;  ///< the last one first
  std::optional<std::size_t> coming_;                                 ///< what `next_` reads
  std::future<Nodes> next_;
};

}  // namespace contactcheck::scene
