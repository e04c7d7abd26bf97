#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace contactcheck::test {
namespace {

using GridPoint = std::array<int, 3>;

// Adds a vertex per grid point, once.
class BoxBuilder {
 public:
  BoxBuilder(const Vec3& lo, const Vec3& hi, int n) : lo_(lo), hi_(hi), n_(n) {}

  void add_face(int axis, bool high) {
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) {
        const auto corner = [&](int u, int v) {
          GridPoint p;
          p[axis] = high ? n_ : 0;
          p[(axis + 1) % 3] = i + u;
          p[(axis + 2) % 3] = j + v;
          return vertex(p);
        };
        add_quad({corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, high);
      }
  }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t vertex(const GridPoint& p) {
    const auto [it, fresh] = ids_.emplace(p, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (fresh) {
      Vec3 at;
      for (int k = 0; k < 3; ++k) at[k] = lo_[k] + (hi_[k] - lo_[k]) * p[k] / n_;
      mesh_.vertices.push_back(at);
    }
    return it->second;
  }
  void add_quad(std::array<std::uint32_t, 4> q, bool high) {
    if (!high) std::swap(q[1], q[3]);
    mesh_.triangles.push_back({q[0], q[1], q[2]});
    mesh_.triangles.push_back({q[0], q[2], q[3]});
  }

  Vec3 lo_, hi_;
  int n_;
  TriangleMesh mesh_;
  std::map<GridPoint, std::uint32_t> ids_;
};

TriangleMesh octahedron() {
  TriangleMesh mesh;
  mesh.vertices = {Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                   -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

TriangleMesh subdivided(const TriangleMesh& in) {
  TriangleMesh out;
  out.vertices = in.vertices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [it, fresh] =
        middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(out.vertices.size()));
    if (fresh) out.vertices.push_back((in.vertices[a] + in.vertices[b]).normalized());
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

TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi, int n) {
  BoxBuilder builder(lo, hi, n);
  for (int axis = 0; axis < 3; ++axis)
    for (bool high : {false, true}) builder.add_face(axis, high);
  return builder.take();
}

TriangleMesh unit_box_mesh(int n) { return box_mesh(Vec3::Zero(), Vec3::Ones(), n); }

TriangleMesh sphere_mesh(const Vec3& center, double radius, int levels) {
  TriangleMesh mesh = octahedron();
  for (int level = 0; level < levels; ++level) mesh = subdivided(mesh);
  for (Vec3& v : mesh.vertices) v = center + radius * v;
  return mesh;
}

TriangleMesh triangle_mesh(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {{a, b, c}, {{0, 1, 2}}};
}

Frame FrameData::frame(std::size_t index) const {
  Frame out;
  out.index = index;
  for (std::size_t b = 0; b < nodes.size(); ++b) out.bodies.push_back({nodes[b], vertices[b]});
  return out;
}

FrameData make_frame(const std::vector<Body>& bodies, std::vector<std::vector<Vec3>> nodes) {
  FrameData data;
  data.nodes = std::move(nodes);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    data.vertices.emplace_back(bodies[b].shape->mesh.vertices.size());
    map_body(*bodies[b].shape, data.nodes[b], data.vertices[b]);
  }
  return data;
}

std::vector<Vec3> rest_nodes_at(const BodyShape& shape, const Vec3& offset) {
  std::vector<Vec3> nodes = shape.lattice ? shape.lattice->rest_nodes() : shape.mesh.vertices;
  for (Vec3& n : nodes) n += offset;
  return nodes;
}

Body make_body(const std::string& name, TriangleMesh mesh, const Resolution& resolution,
               double padding) {
  return {name, make_shape(std::move(mesh), resolution, padding)};
}

}  // namespace contactcheck::test
