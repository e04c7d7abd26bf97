#include "core/types/mesh_topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/types/check.h"

namespace contactcheck {
namespace {

struct HalfEdge {
  std::uint32_t low, high, triangle;
  bool forward;  // runs from low to high
};

bool has_repeated_index(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& tri = mesh.triangles[t];
    // A triangle with a repeated index is reported as such; its edges would be false alarms.
    if (has_repeated_index(tri)) continue;
    for (int e = 0; e < 3; ++e) {
      const std::uint32_t a = tri[e], b = tri[(e + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return std::tie(x.low, x.high, x.triangle) < std::tie(y.low, y.high, y.triangle);
  });
  return edges;
}

// A power of two brings the largest component near 1, so that products neither overflow nor vanish
// in a mesh of any scale.
Vec3 near_unit_size(const Vec3& v) {
  int exponent = 0;
  std::frexp(v.cwiseAbs().maxCoeff(), &exponent);
  return {std::ldexp(v.x(), -exponent), std::ldexp(v.y(), -exponent), std::ldexp(v.z(), -exponent)};
}

// In double: the differences and products round, so a triangle within rounding of a line may fall
// on either side. This is a report to the user, never a verdict.
bool zero_area(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 u = near_unit_size(mesh.vertices[t[1]] - mesh.vertices[t[0]]);
  const Vec3 v = near_unit_size(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
  return u.cross(v).isZero(0.0);
}

void check_vertices_and_indices(const TriangleMesh& mesh, MeshTopology& out) {
  if (mesh.vertices.empty() || mesh.triangles.empty()) {
    out.defects.push_back({MeshDefectKind::kEmpty, 0});
  }
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!mesh.vertices[v].allFinite()) out.defects.push_back({MeshDefectKind::kNonFiniteVertex, v});
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t index : mesh.triangles[t]) {
      if (index >= mesh.vertices.size()) {
        out.defects.push_back({MeshDefectKind::kIndexOutOfRange, t});
        break;
      }
    }
  }
  out.fatal = !out.defects.empty();
}

void check_triangles(const TriangleMesh& mesh, MeshTopology& out) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& tri = mesh.triangles[t];
    if (has_repeated_index(tri)) {
      out.defects.push_back({MeshDefectKind::kRepeatedIndex, t});
    } else if (zero_area(mesh, tri)) {
      out.defects.push_back({MeshDefectKind::kZeroAreaTriangle, t});
    }
  }
}

void check_duplicates(const TriangleMesh& mesh, MeshTopology& out) {
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  sorted.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle corners = mesh.triangles[t];
    std::sort(corners.begin(), corners.end());
    if (!has_repeated_index(corners)) sorted.push_back({corners, t});
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].first == sorted[i - 1].first)
      out.defects.push_back({MeshDefectKind::kDuplicateTriangle, sorted[i].second});
}

void check_edges(const TriangleMesh& mesh, MeshTopology& out) {
  const std::vector<HalfEdge> edges = sorted_half_edges(mesh);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    if (j - i == 1) out.defects.push_back({MeshDefectKind::kBoundaryEdge, edges[i].triangle});
    if (j - i > 2) out.defects.push_back({MeshDefectKind::kNonManifoldEdge, edges[i].triangle});
    if (j - i == 2 && edges[i].forward == edges[i + 1].forward) {
      out.defects.push_back({MeshDefectKind::kInconsistentOrientation, edges[i + 1].triangle});
    }
    i = j;
  }
}

}  // namespace

const char* name_of(MeshDefectKind kind) {
  switch (kind) {
    case MeshDefectKind::kEmpty:
      return "empty-mesh";
    case MeshDefectKind::kNonFiniteVertex:
      return "non-finite-vertex";
    case MeshDefectKind::kIndexOutOfRange:
      return "index-out-of-range";
    case MeshDefectKind::kRepeatedIndex:
      return "repeated-index";
    case MeshDefectKind::kZeroAreaTriangle:
      return "zero-area-triangle";
    case MeshDefectKind::kDuplicateTriangle:
      return "duplicate-triangle";
    case MeshDefectKind::kNonManifoldEdge:
      return "non-manifold-edge";
    case MeshDefectKind::kBoundaryEdge:
      return "boundary-edge";
    case MeshDefectKind::kInconsistentOrientation:
      return "inconsistent-orientation";
  }
  return "unknown";
}

bool is_fatal(MeshDefectKind kind) {
  return kind == MeshDefectKind::kEmpty || kind == MeshDefectKind::kNonFiniteVertex ||
         kind == MeshDefectKind::kIndexOutOfRange;
}

std::size_t MeshTopology::count(MeshDefectKind kind) const {
  return static_cast<std::size_t>(std::count_if(
      defects.begin(), defects.end(), [&](const MeshDefect& d) { return d.kind == kind; }));
}

std::string mesh_size_fault(std::uint64_t vertices, std::uint64_t triangles) {
  const auto more = [](std::uint64_t count, const char* of, std::uint64_t most) {
    return "has " + std::to_string(count) + " " + of + "; at most " + std::to_string(most) +
           " can be judged";
  };
  if (vertices > kMostMeshVertices) return more(vertices, "vertices", kMostMeshVertices);
  if (triangles > kMostMeshTriangles) return more(triangles, "triangles", kMostMeshTriangles);
  return "";
}

MeshTopology analyse_topology(const TriangleMesh& mesh) {
  MeshTopology out;
  check_vertices_and_indices(mesh, out);
  if (out.fatal) return out;
  check_triangles(mesh, out);
  check_duplicates(mesh, out);
  check_edges(mesh, out);
  std::stable_sort(out.defects.begin(), out.defects.end(),
                   [](const MeshDefect& a, const MeshDefect& b) {
                     return std::tie(a.kind, a.index) < std::tie(b.kind, b.index);
                   });
  out.solid = out.count(MeshDefectKind::kRepeatedIndex) == 0 &&
              out.count(MeshDefectKind::kNonManifoldEdge) == 0 &&
              out.count(MeshDefectKind::kBoundaryEdge) == 0 &&
              out.count(MeshDefectKind::kInconsistentOrientation) == 0;
  return out;
}

std::string describe(const MeshTopology& topology) {
  std::string text;
  for (std::size_t i = 0; i < topology.defects.size();) {
    const MeshDefectKind kind = topology.defects[i].kind;
    const std::size_t n = topology.count(kind);
    const char* of = kind == MeshDefectKind::kNonFiniteVertex ? "vertex " : "triangle ";
    if (!text.empty()) text += ", ";
    text += std::to_string(n) + " " + name_of(kind);
    if (kind != MeshDefectKind::kEmpty) {
      text += std::string(" (") + (n > 1 ? "first: " : "") + of +
              std::to_string(topology.defects[i].index) + ")";
    }
    i += n;
  }
  return text;
}

void refuse_many_adjacent_pairs(std::span<const Triangle> triangles) {
  std::uint32_t vertices = 0;
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) vertices = std::max(vertices, v + 1);
  std::vector<std::uint64_t> valence(vertices, 0);
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) ++valence[v];
  std::uint64_t pairs = 0;
  for (const std::uint64_t n : valence)
    if (n > 0) pairs += n * (n - 1) / 2;
  if (pairs <= kMostAdjacentPairs) return;
  const auto most = std::max_element(valence.begin(), valence.end());
  throw RefusedInput("its triangles share a vertex in " + std::to_string(pairs) +
                     " pairs (vertex " + std::to_string(most - valence.begin()) + " is in " +
                     std::to_string(*most) + " triangles); self-contact is judged of at most " +
                     std::to_string(kMostAdjacentPairs));
}

}  // namespace contactcheck
