#include "reference/scene/read_ahead.h"

namespace contactcheck::scene {

ReadAhead::Nodes ReadAhead::operator()(std::size_t frame) {
  for (const auto& [number, nodes] : held_)
    if (number == frame) return nodes;
  // A reader takes one call at a time.
  if (next_.valid() && coming_ != frame) next_.wait();
  Nodes nodes = next_.valid() && coming_ == frame ? next_.get() : reader_(frame);
  next_ = {};
  const bool in_order = !held_[0].first || frame == *held_[0].first + 1;
  std::swap(held_[0], held_[1]);
  held_[0] = {frame, std::move(nodes)};
  // Out of order the next one is as likely as any other.
  if (frame + 1 < frames_ && in_order && held_[1].first != frame + 1) {
    coming_ = frame + 1;
    next_ = std::async(std::launch::async, [this, frame] { return reader_(frame + 1); });
  }
  return held_[0].second;
}

}  // namespace contactcheck::scene
