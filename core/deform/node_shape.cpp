#include "core/deform/node_shape.h"

#include <algorithm>
#include <utility>

#include "core/types/check.h"

namespace contactcheck {
namespace {

// Lines per axis of the smallest cube of nodes that holds at least that many.
std::size_t lines_for(std::size_t vertices) {
  std::size_t lines = 2;
  while (lines * lines * lines < vertices) ++lines;
  return lines;
}

std::vector<Vec3> rest_vertices(std::size_t count, std::size_t lines) {
  std::vector<Vec3> out;
  for (std::size_t v = 0; v < count; ++v) {
    const std::size_t x = v % lines, y = v / lines % lines, z = v / lines / lines;
    out.emplace_back(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
  }
  // So that the mesh fills its box along every axis.
  if (count > 0) out.back() = Vec3::Constant(static_cast<double>(lines - 1));
  return out;
}

std::vector<std::uint32_t> vertices_of_nodes(const BodyShape& shape, std::size_t lines) {
  const std::size_t last = shape.given_vertex_count() - 1;
  std::vector<std::uint32_t> out;
  for (const GridIndex& n : shape.lattice->nodes) {
    const std::size_t place = (n[2] * lines + n[1]) * lines + n[0];
    out.push_back(static_cast<std::uint32_t>(std::min(place, last)));
  }
  return out;
}

}  // namespace

std::vector<Vec3> NodeShape::nodes_for(std::span<const Vec3> vertices) const {
  CONTACTCHECK_INVARIANT(vertices.size() == shape->given_vertex_count(), "one position per vertex");
  std::vector<Vec3> nodes;
  for (std::uint32_t v : vertex_of_node) nodes.push_back(vertices[v]);
  return nodes;
}

NodeShape make_node_shape(std::size_t vertices, std::vector<Triangle> triangles) {
  const std::size_t lines = lines_for(vertices);
  std::vector<double> line;
  for (std::size_t i = 0; i < lines; ++i) line.push_back(static_cast<double>(i));
  const auto shape = make_shape_on_lines({rest_vertices(vertices, lines), std::move(triangles)},
                                         {line, line, line});
  return {shape, vertices_of_nodes(*shape, lines)};
}

}  // namespace contactcheck
