#include "reference/scene/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "core/types/check.h"
#include "reference/scene/circle.h"

namespace contactcheck {
namespace {

using GridPoint = std::array<std::size_t, 3>;

// Numbers the points of a box's surface grid as they are asked for.
class BoxGrid {
 public:
  BoxGrid(const Vec3& sides, std::size_t divisions) : sides_(sides), divisions_(divisions) {}

  std::uint32_t vertex(const GridPoint& at) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [it, is_new] = index_.try_emplace(at, next);
    if (is_new) {
      Vec3 p;
      for (int k = 0; k < 3; ++k) {
        const double fraction = static_cast<double>(at[k]) / static_cast<double>(divisions_);
        p[k] = sides_[k] * (fraction - 0.5);
      }
      mesh.vertices.push_back(p);
    }
    return it->second;
  }

  TriangleMesh mesh;

 private:
  Vec3 sides_;
  std::size_t divisions_;
  std::map<GridPoint, std::uint32_t> index_;
};

// One face across `axis`, at its low or high end. The two other axes run so that the face's
// counter-clockwise side looks outwards.
void add_face(BoxGrid& grid, int axis, bool high, std::size_t divisions) {
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (!high) std::swap(u, v);
  const auto at = [&](std::size_t i, std::size_t j) {
    GridPoint p;
    p[axis] = high ? divisions : 0;
    p[u] = i;
    p[v] = j;
    return grid.vertex(p);
  };
  for (std::size_t i = 0; i < divisions; ++i) {
    for (std::size_t j = 0; j < divisions; ++j) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      grid.mesh.triangles.push_back({a, b, c});
      grid.mesh.triangles.push_back({a, c, d});
    }
  }
}

TriangleMesh icosahedron() {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  for (const double s : {-1.0, 1.0}) {
    for (const double g : {-golden, golden}) {
      mesh.vertices.emplace_back(0.0, s, g);  // 0, 3, 6, 9
      mesh.vertices.emplace_back(s, g, 0.0);  // 1, 4, 7, 10
      mesh.vertices.emplace_back(g, 0.0, s);  // 2, 5, 8, 11
    }
  }
  // The faces are the vertex triples at edge length 2, turned outwards.
  const auto edge = [&](std::uint32_t a, std::uint32_t b) {
    return std::abs((mesh.vertices[a] - mesh.vertices[b]).squaredNorm() - 4.0) < 1e-6;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!edge(a, b) || !edge(b, c) || !edge(c, a)) continue;
        const Vec3 normal =
            (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
        const bool outward = normal.dot(mesh.vertices[a]) > 0.0;
        mesh.triangles.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
      }
    }
  }
  return mesh;
}

TriangleMesh split_in_four(const TriangleMesh& in) {
  TriangleMesh out;
  out.vertices = in.vertices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(out.vertices.size());
    const auto [it, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, next);
    if (is_new) out.vertices.push_back((out.vertices[a] + out.vertices[b]).normalized());
    return it->second;
  };
  for (const Triangle& t : in.triangles) {
    const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    out.triangles.insert(out.triangles.end(),
                         {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
  }
  return out;
}

}  // namespace

TriangleMesh make_box(const Vec3& sides, std::size_t divisions) {
  CONTACTCHECK_INVARIANT(divisions > 0 && (sides.array() > 0.0).all(), "a box has a size");
  BoxGrid grid(sides, divisions);
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) add_face(grid, axis, high, divisions);
  }
  return std::move(grid.mesh);
}

TriangleMesh make_sphere(std::size_t divisions) {
  TriangleMesh mesh = icosahedron();
  for (Vec3& v : mesh.vertices) v.normalize();
  for (std::size_t i = 0; i < divisions; ++i) mesh = split_in_four(mesh);
  for (Vec3& v : mesh.vertices) v *= 0.5;
  return mesh;
}

TriangleMesh make_torus(double tube, std::size_t divisions) {
  CONTACTCHECK_INVARIANT(divisions >= 3 && tube > 0.0 && tube < 1.0, "a torus has a hole");
  const std::size_t ring_steps = 2 * divisions, tube_steps = divisions;
  const double ring_radius = 0.5 / (1.0 + tube), tube_radius = tube * ring_radius;
  TriangleMesh mesh;
  for (std::size_t i = 0; i < ring_steps; ++i) {
    const CirclePoint along = circle_point(i, ring_steps);
    for (std::size_t j = 0; j < tube_steps; ++j) {
      const CirclePoint across = circle_point(j, tube_steps);
      const double radius = ring_radius + tube_radius * across.cosine;
      mesh.vertices.emplace_back(radius * along.cosine, radius * along.sine,
                                 tube_radius * across.sine);
    }
  }
  const auto at = [&](std::size_t i, std::size_t j) {
    return static_cast<std::uint32_t>(i % ring_steps * tube_steps + j % tube_steps);
  };
  for (std::size_t i = 0; i < ring_steps; ++i) {
    for (std::size_t j = 0; j < tube_steps; ++j) {
      const Triangle lower = {at(i, j), at(i + 1, j), at(i + 1, j + 1)};
      mesh.triangles.push_back(lower);
      mesh.triangles.push_back({lower[0], lower[2], at(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace contactcheck
