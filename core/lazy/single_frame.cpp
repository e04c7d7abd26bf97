#include "core/lazy/single_frame.h"

#include <algorithm>

#include "core/deform/mapping.h"
#include "core/lazy/frame_scale.h"
#include "core/types/local_origin.h"

namespace contactcheck {
namespace {

// By how much vertices mapped in floats are off the exact image of their local coordinates. Those
// are rounded first, by at most 2^-25 each, and along each axis the image changes by at most 2
// reach over the cell: 3 * 2^-24 reach for the three.
double error_of_mapping(double reach) {
  return static_cast<double>(mapping_error_bound(static_cast<float>(reach))) +
         3.0 * 0x1p-24 * reach;
}

// Slacks: derivation in bounds-inl.h.
void place_one(const Vec3& origin, double scale, double reach, LazyState& state) {
  constexpr double kFloatUnit = 0x1p-24;
  state.origin = origin;
  state.scale = scale;
  state.reach = reach;
  const double common = 1.01 * error_of_mapping(reach) + 1e-37;
  state.slack = round_up(256.0 * kFloatUnit * reach + common);
  state.slab_slack = round_up(2048.0 * kFloatUnit * reach + 2.0 * common);
}

// Mapped vertices leave the hull of their nodes by rounding, no more.
void set_box(LazyState& state) {
  AabbOf<float> box;
  for (const Vec3f& node : state.single.nodes) box.extend(node);
  const double error = state.shape->lattice ? 2.0 * error_of_mapping(state.reach) : 0.0;
  state.box = {box.lo.cast<double>().array() - error, box.hi.cast<double>().array() + error};
}

}  // namespace

void begin_frame_in_single(LazyState& state, std::span<const Vec3> nodes, const Vec3& origin) {
  forget_frame(state);
  state.nodes = {};
  state.vertices = {};
  state.single.vertices = {};
  state.single.nodes.resize(nodes.size());
  round_to_local(nodes, origin, state.single.nodes);
  float largest = 0.0f;
  for (const Vec3f& node : state.single.nodes)
    largest = std::max(largest, node.cwiseAbs().maxCoeff());
  state.largest = static_cast<double>(largest);
}

void place_in_single(std::span<LazyState> states, const Vec3& origin) {
  double largest = 0.0;
  for (const LazyState& state : states) largest = std::max(largest, state.largest);
  const double scale = scale_to_one(largest);
  for (LazyState& state : states) {
    // By doubles: the scale of a tiny scene is no float.
    for (Vec3f& node : state.single.nodes) node = (node.cast<double>() * scale).cast<float>();
    place_one(origin, scale, largest * scale, state);
    set_box(state);
  }
}

std::vector<Vec3f> single_vertices(const LazyState& state) {
  const BodyShape& shape = *state.shape;
  if (!shape.lattice) return state.single.nodes;
  std::vector<Vec3f> out;
  for (std::size_t v = 0; v < shape.mesh.vertices.size(); ++v) {
    const CornerIds& ids = shape.lattice->cell_nodes[shape.embedding.home_cell[v]];
    CornersOf<float> corners;
    for (std::size_t c = 0; c < corners.size(); ++c) corners[c] = state.single.nodes[ids[c]];
    out.push_back(map_point(corners, Vec3f(shape.embedding.local[v].cast<float>())));
  }
  return out;
}

}  // namespace contactcheck
