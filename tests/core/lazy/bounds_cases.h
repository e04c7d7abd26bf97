// Shapes whose bounds are tested, their promises on every instruction set, and ways to spoil them.
#pragma once

#include <string>
#include <vector>

#include "tests/core/lazy/one_body.h"

namespace contactcheck::test {

struct NamedShape {
  std::string name;
  ShapePtr shape;
};

inline const std::vector<NamedShape>& shapes() {
  static const std::vector<NamedShape> all = [] {
    const TriangleMesh ball = sphere_mesh(Vec3::Zero(), 1.0, 3);
    const TriangleMesh box = box_mesh(Vec3(-1, -0.75, -0.5), Vec3(1, 0.75, 0.5), 4);
    return std::vector<NamedShape>{
        {"ball, one cell", make_shape(ball, {1, 1, 1})},
        {"ball, coarse", make_shape(ball, {3, 4, 3})},
        {"ball, fine", make_shape(ball, {10, 10, 10})},
        {"box, fine", make_shape(box, {10, 10, 10})},
        {"box on its nodes", box_on_its_nodes(6)},
        {"sheet", make_shape(sheet(9), {5, 5, 1})},
        {"long triangles", make_shape(long_triangles(6, 60), {8, 8, 8})},
        {"bare", make_bare_shape(ball)},
    };
  }();
  return all;
}

// Promises broken on any instruction set, for bounds from nodes and from vertices.
class AllKernels {
 public:
  explicit AllKernels(const ShapePtr& shape, Precision precision = Precision::kDouble)
      : from_nodes_(shape, false, precision), refitted_(shape, true, precision) {}

  std::string broken(const std::vector<Vec3>& nodes, double company = 0.0) {
    for (OneBody* body : {&from_nodes_, &refitted_})
      for (const std::string& isa : lazy_isas()) {
        body->begin(nodes, company);
        const std::string text = body->broken(lazy_kernels(isa));
        if (!text.empty()) return isa + (body == &refitted_ ? " from vertices: " : ": ") + text;
      }
    return "";
  }

 private:
  OneBody from_nodes_, refitted_;
};

// Applies `spoil(lo, hi)` to one lane at a time; the lanes that validate() does not miss.
template <typename Spoil>
int reported_lanes(OneBody& body, Spoil&& spoil) {
  int reported = 0;
  for (std::uint32_t b = 0; b < body.tree().blocks.size(); ++b) {
    const TreeBlock& block = body.tree().blocks[b];
    for (std::uint32_t c = 0; c < block.children; ++c) {
      LaneBoxes& boxes = body.state().blocks.find(b)->box;
      const LaneBoxes before = boxes;
      for (int k = 0; k < 3; ++k) spoil(boxes.lo[k][c], boxes.hi[k][c]);
      const std::string text = body.broken();
      const std::string lane = "lane " + std::to_string(c) + " of block " + std::to_string(b);
      reported += text.find(lane) != std::string::npos;
      boxes = before;
    }
  }
  return reported;
}

inline int lanes_of(const LatticeTree& tree) {
  int lanes = 0;
  for (const TreeBlock& block : tree.blocks) lanes += static_cast<int>(block.children);
  return lanes;
}

inline void shrink(float& lo, float& hi) {
  const float step = 0.01f * (hi - lo);
  lo += step;
  hi -= step;
}
inline void move_up(float& lo, float& hi) {
  const float step = 0.01f * (hi - lo);
  lo += step;
  hi += step;
}
inline void move_down(float& lo, float& hi) {
  const float step = 0.01f * (hi - lo);
  lo -= step;
  hi -= step;
}

}  // namespace contactcheck::test
