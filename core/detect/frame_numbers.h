// The nodes and vertices of a frame in the precision of a detector: the frame's own doubles, or
// floats about the local origin of the frame (local_origin.h), of which the vertices are mapped
// from the rounded nodes in single precision.
#pragma once

#include <span>
#include <vector>

#include "core/deform/body.h"
#include "core/types/frame.h"

namespace contactcheck {

template <typename T>
class FrameNumbers;

template <>
class FrameNumbers<double> {
 public:
  void prepare(const std::vector<Body>&, bool) {}
  /// The frame must outlive the use of its nodes and vertices.
  void update(const Frame& frame);
  Vec3 origin() const { return Vec3::Zero(); }
  std::span<const Vec3> nodes(std::size_t body) const { return nodes_[body]; }
  const std::vector<std::span<const Vec3>>& vertices() const { return vertices_; }

 private:
  std::vector<std::span<const Vec3>> nodes_, vertices_;  // per body
};

template <>
class FrameNumbers<float> {
 public:
  /// @pre every body has a lattice
  void prepare(const std::vector<Body>& bodies, bool with_vertices);
  /// @throws RefusedInput when a node is beyond single precision (round_to_local)
  void update(const Frame& frame);
  /// The local origin of the last update.
  const Vec3& origin() const { return origin_; }
  std::span<const Vec3f> nodes(std::size_t body) const { return nodes_[body]; }
  /// Valid until the next update; without vertices the spans are empty.
  const std::vector<std::span<const Vec3f>>& vertices() const { return spans_; }

 private:
  struct Source {
    const BodyShape* shape;
    SingleLocal local;  // empty without vertices
  };
  std::vector<Source> sources_;  // per body, as all
  std::vector<std::vector<Vec3f>> nodes_, vertices_;
  std::vector<std::span<const Vec3f>> spans_;
  Vec3 origin_ = Vec3::Zero();
  bool with_vertices_ = false;
};

}  // namespace contactcheck
