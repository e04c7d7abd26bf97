#include "reference/oracle/closed_chain.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/types/vertex_places.h"
#include "reference/oracle/exact_predicates.h"
#include "reference/oracle/floating_point.h"

namespace contactcheck::oracle {
namespace {

// A corner is 3 * triangle + place, below 3 * 2^29; its edge leads to the next corner.
constexpr std::uint32_t kNoCorner = ~0u;

struct HalfEdge {
  std::uint32_t low, high;  // welded vertices, low < high
  std::uint32_t corner;
  bool forward;  // runs from low to high
};

// What all half-edges between two vertices come to.
struct EdgeSum {
  std::uint32_t low, high;
  std::uint32_t first;   // corner of the first half-edge that counts; kNoCorner: none does
  std::int64_t forward;  // runs from low to high, less those back
  bool of_no_area;       // a triangle of no area has this edge
};

// By edge, then corner. An edge from a vertex to itself is none.
std::vector<HalfEdge> sorted_half_edges(std::span<const Triangle> triangles,
                                        std::span<const std::uint32_t> welded) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = welded[triangles[t][k]], to = welded[triangles[t][(k + 1) % 3]];
      if (from != to)
        edges.push_back({std::min(from, to), std::max(from, to), 3 * t + k, from < to});
    }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  return edges;
}

// The edges that do not cancel, of the triangles that have an area.
template <typename HasArea>
std::vector<EdgeSum> uncancelled(const std::vector<HalfEdge>& edges, HasArea&& has_area) {
  std::vector<EdgeSum> out;
  for (auto edge = edges.begin(); edge != edges.end();) {
    EdgeSum sum{edge->low, edge->high, kNoCorner, 0, false};
    for (; edge != edges.end() && edge->low == sum.low && edge->high == sum.high; ++edge) {
      if (!has_area(edge->corner / 3)) {
        sum.of_no_area = true;
        continue;
      }
      sum.first = std::min(sum.first, edge->corner);
      sum.forward += edge->forward ? 1 : -1;
    }
    if (sum.forward != 0) out.push_back(sum);
  }
  return out;
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t t) {
  while (parent[t] != t) t = parent[t] = parent[parent[t]];
  return t;
}

void number_components(std::span<const Triangle> triangles, const std::vector<HalfEdge>& edges,
                       SurfaceChain& out) {
  std::vector<std::uint32_t> parent(triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i].low != edges[i - 1].low || edges[i].high != edges[i - 1].high) continue;
    const std::uint32_t a = root_of(parent, edges[i - 1].corner / 3),
                        b = root_of(parent, edges[i].corner / 3);
    parent[std::max(a, b)] = std::min(a, b);
  }
  out.component.resize(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t root = root_of(parent, t);
    if (root == t) {
      out.component[t] = static_cast<std::uint32_t>(out.component_vertex.size());
      out.component_vertex.push_back(triangles[t][0]);
    } else {
      out.component[t] = out.component[root];  // the root is the component's first triangle
    }
  }
}

// Lines through one point, given by another point of each, in an order that depends on nothing but
// their directions: -1, 0 or +1. They are sorted by dy / dx, then dz / dx; behind those come lines
// with dx = 0, by dz / dy, and last the line with dx = dy = 0.
int compare_lines(const Vec3& through, const Vec3& p, const Vec3& q) {
  for (int axis = 0; axis < 2; ++axis) {
    const bool level_p = p[axis] == through[axis], level_q = q[axis] == through[axis];
    if (level_p != level_q) return level_p ? 1 : -1;
    if (level_p) continue;
    // Slopes do not change where a direction is turned about; the sign of the turn does.
    const int turned = (p[axis] > through[axis]) == (q[axis] > through[axis]) ? 1 : -1;
    for (int up = axis + 1; up < 3; ++up) {
      const int seen = up - axis == 1 ? (axis + 2) % 3 : 1;  // the axis that is neither of the two
      const int turn = projected_orientation(through, p, q, seen) * (seen == 1 ? -1 : 1);
      if (turn != 0) return -turned * turn;
    }
    return 0;
  }
  return 0;
}

// The first corner among edges that do not cancel along lines, kNoCorner where all do. What runs
// along a line cancels everywhere on it when at each point as much arrives as leaves.
std::uint32_t first_open_along_lines(const std::vector<EdgeSum>& edges,
                                     std::span<const Vec3> vertices) {
  struct End {
    std::uint32_t vertex, other, first;
    std::int64_t arrives;
  };
  std::vector<End> ends;
  for (const EdgeSum& e : edges) {
    ends.push_back({e.low, e.high, e.first, -e.forward});
    ends.push_back({e.high, e.low, e.first, e.forward});
  }
  const auto compare = [&](const End& a, const End& b) {
    if (a.vertex != b.vertex) return a.vertex < b.vertex ? -1 : 1;
    return compare_lines(vertices[a.vertex], vertices[a.other], vertices[b.other]);
  };
  std::sort(ends.begin(), ends.end(),
            [&](const End& a, const End& b) { return compare(a, b) < 0; });
  std::uint32_t open = kNoCorner;
  for (auto end = ends.begin(); end != ends.end();) {
    const End& same = *end;
    std::int64_t arrives = 0;
    std::uint32_t first = kNoCorner;
    for (; end != ends.end() && compare(same, *end) == 0; ++end) {
      arrives += end->arrives;
      first = std::min(first, end->first);
    }
    if (arrives != 0) open = std::min(open, first);
  }
  return open;
}

// For a surface with edges that do not cancel: the first corner of an open edge, or kNoCorner if
// only triangles without area keep them from cancelling.
std::uint32_t first_open(std::span<const Triangle> triangles, const std::vector<HalfEdge>& edges,
                         std::span<const Vec3> vertices) {
  std::vector<char> area(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    area[t] =
        !collinear(vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]);
  std::vector<EdgeSum> sums = uncancelled(edges, [&](std::uint32_t t) { return area[t] != 0; });
  std::uint32_t open = kNoCorner;
  for (const EdgeSum& sum : sums)
    if (!sum.of_no_area) open = std::min(open, sum.first);
  std::erase_if(sums, [](const EdgeSum& sum) { return !sum.of_no_area; });
  return std::min(open, first_open_along_lines(sums, vertices));
}

OpenEdge edge_at(std::span<const Triangle> triangles, std::uint32_t corner) {
  const Triangle& triangle = triangles[corner / 3];
  return {corner / 3, triangle[corner % 3], triangle[(corner + 1) % 3]};
}

}  // namespace

std::string open_reason(const OpenEdge& edge, const GivenVertices& given,
                        const std::string& where) {
  return "open (" + where + (where.empty() ? "" : ", ") + "edge of vertices " +
         std::to_string(given.number_of(edge.from)) + " and " +
         std::to_string(given.number_of(edge.to)) + ")";
}

SurfaceChain surface_chain(std::span<const Triangle> triangles, std::span<const Vec3> vertices) {
  const FloatingPointGuard guard;
  SurfaceChain out;
  out.welded = first_at_place(vertices);
  const std::vector<HalfEdge> edges = sorted_half_edges(triangles, out.welded);
  number_components(triangles, edges, out);
  // Where all edges cancel, those of triangles of no area cancel along their lines, and so do the
  // others.
  if (uncancelled(edges, [](std::uint32_t) { return true; }).empty()) return out;
  const std::uint32_t open = first_open(triangles, edges, vertices);
  if (open != kNoCorner) out.open = edge_at(triangles, open);
  return out;
}

SurfaceChain surface_chain_as_written(std::span<const Triangle> triangles, std::size_t vertices) {
  SurfaceChain out;
  out.welded.resize(vertices);
  std::iota(out.welded.begin(), out.welded.end(), 0u);
  const std::vector<HalfEdge> edges = sorted_half_edges(triangles, out.welded);
  number_components(triangles, edges, out);
  std::uint32_t open = kNoCorner;
  for (const EdgeSum& sum : uncancelled(edges, [](std::uint32_t) { return true; }))
    open = std::min(open, sum.first);
  if (open != kNoCorner) out.open = edge_at(triangles, open);
  return out;
}

}  // namespace contactcheck::oracle
