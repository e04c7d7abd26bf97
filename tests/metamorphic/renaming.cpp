#include "tests/metamorphic/renaming.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "core/types/check.h"

namespace contactcheck::test {
namespace {

// A shape, and how its ids are called in the one that it was made of.
struct RenamedShape {
  std::shared_ptr<const BodyShape> shape;
  std::vector<std::uint32_t> triangle, vertex;
};

// Of the standard's random numbers only the raw output is the same everywhere.
std::vector<std::uint32_t> order(std::size_t count, bool shuffled, std::uint64_t seed) {
  std::vector<std::uint32_t> out(count);
  std::iota(out.begin(), out.end(), 0u);
  std::mt19937_64 random(seed);
  for (std::size_t left = shuffled ? count : 0; left > 1; --left)
    std::swap(out[left - 1], out[random() % left]);
  return out;
}

std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& permutation) {
  std::vector<std::uint32_t> out(permutation.size());
  for (std::uint32_t i = 0; i < permutation.size(); ++i) out[permutation[i]] = i;
  return out;
}

Triangle renamed_triangle(Triangle t, std::uint32_t id, const std::vector<std::uint32_t>& vertex,
                          const Renaming& how) {
  for (std::uint32_t& v : t) v = vertex[v];
  if (how.turn_corners) std::rotate(t.begin(), t.begin() + 1 + id % 2, t.end());
  if (how.flip_winding) std::swap(t[1], t[2]);
  return t;
}

RenamedShape renamed_shape(const BodyShape& shape, const Renaming& how) {
  const TriangleMesh& mesh = shape.mesh;
  RenamedShape out;
  out.triangle = order(mesh.triangles.size(), how.shuffle_triangles, 1);
  out.vertex = order(mesh.vertices.size(), how.shuffle_vertices, 2);
  const std::vector<std::uint32_t> new_vertex = inverse(out.vertex);
  TriangleMesh made;
  for (std::uint32_t v : out.vertex) made.vertices.push_back(mesh.vertices[v]);
  for (std::uint32_t t : out.triangle)
    made.triangles.push_back(renamed_triangle(mesh.triangles[t], t, new_vertex, how));
  if (shape.lattice) {
    out.shape = make_shape_on_lines(std::move(made), shape.lattice->lines);
    CONTACTCHECK_INVARIANT(out.shape->lattice->cells == shape.lattice->cells,
                           "which cells are kept does not depend on ids");
  } else {
    out.shape = make_bare_shape(std::move(made));
  }
  if (!shape.welded.empty()) out.shape = welded(*out.shape);
  return out;
}

template <typename T>
std::vector<T> picked(const std::vector<T>& from, const std::vector<std::uint32_t>& ids) {
  std::vector<T> out;
  for (std::uint32_t id : ids) out.push_back(from[id]);
  return out;
}

// Lattice nodes stay, for cells do; without a lattice they are the vertices.
FrameData renamed_frame(const FrameData& frame, const Variant& variant) {
  FrameData out;
  for (std::size_t b = 0; b < variant.bodies.size(); ++b) {
    const std::uint32_t old = variant.names.body[b];
    const bool bare = !variant.bodies[b].shape->lattice;
    out.nodes.push_back(bare ? picked(frame.nodes[old], variant.names.vertex[b])
                             : frame.nodes[old]);
    out.vertices.push_back(picked(frame.vertices[old], variant.names.vertex[b]));
  }
  return out;
}

}  // namespace

Variant renamed(std::shared_ptr<const Subject> subject, const Renaming& how) {
  std::map<const BodyShape*, RenamedShape> made;
  Variant out;
  std::vector<std::uint32_t> bodies = order(subject->bodies.size(), false, 0);
  if (how.reverse_bodies) std::reverse(bodies.begin(), bodies.end());
  for (std::uint32_t b : bodies) {
    const Body& body = subject->bodies[b];
    RenamedShape& shape = made[body.shape.get()];
    if (!shape.shape) shape = renamed_shape(*body.shape, how);
    out.bodies.push_back({body.name, shape.shape});
    out.names.triangle.push_back(shape.triangle);
    out.names.vertex.push_back(shape.vertex);
  }
  out.names.body = std::move(bodies);
  for (const FrameData& frame : subject->frames) {
    FrameData data = renamed_frame(frame, out);
    CONTACTCHECK_INVARIANT(make_frame(out.bodies, data.nodes).vertices == data.vertices,
                           "mapping does not depend on ids");
    out.frames.push_back(std::move(data));
  }
  out.plain = std::move(subject);
  return out;
}

}  // namespace contactcheck::test
