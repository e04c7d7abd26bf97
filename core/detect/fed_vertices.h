// The vertices that a detector gets, in its precision: the frame's own doubles, or these about the
// local origin of the frame, rounded to floats once (local_origin.h).
#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "core/types/frame.h"
#include "core/types/local_origin.h"

namespace contactcheck {

/// Rounds the nodes or the vertices (`part`) of every body to floats about `origin`. `out` keeps
/// its memory from frame to frame.
/// @throws RefusedInput when a coordinate is beyond single precision (round_to_local)
inline void round_bodies(const Frame& frame, std::span<const Vec3> BodyState::*part,
                         const Vec3& origin, std::vector<std::vector<Vec3f>>& out) {
  out.resize(frame.bodies.size());
  for (std::size_t b = 0; b < out.size(); ++b) {
    const std::span<const Vec3> points = frame.bodies[b].*part;
    out[b].resize(points.size());
    round_to_local(points, origin, out[b]);
  }
}

template <typename T>
class FedVertices {
  static_assert(std::is_same_v<T, double> || std::is_same_v<T, float>);

 public:
  /// In doubles spans() refers to the frame's vertices: the caller keeps them alive.
  /// @throws RefusedInput when a coordinate is beyond single precision (round_to_local)
  void update(const Frame& frame) {
    if constexpr (std::is_same_v<T, double>) {
      spans_.clear();
      for (const BodyState& body : frame.bodies) spans_.push_back(body.vertices);
    } else {
      round_bodies(frame, &BodyState::vertices, local_origin(frame), rounded_);
      spans_.assign(rounded_.begin(), rounded_.end());
    }
  }
  /// Per body; valid until the next update.
  const std::vector<std::span<const Vec3Of<T>>>& spans() const { return spans_; }

 private:
  std::vector<std::vector<Vec3Of<T>>> rounded_;  // empty in doubles
  std::vector<std::span<const Vec3Of<T>>> spans_;
};

}  // namespace contactcheck
