#include "reference/reduce/candidate.h"

#include <algorithm>
#include <utility>

#include "core/deform/lattice.h"
#include "core/deform/node_shape.h"
#include "core/types/check.h"
#include "core/types/given_vertices.h"
#include "reference/oracle/exact_predicates.h"
#include "reference/oracle/oracle.h"

namespace contactcheck::reduce {
namespace {

// The faces of a cell. Its corner c is at the high end of x, y, z where bit 0, 1, 2 of c is set,
// which is also the order of nodes in make_node_shape.
constexpr Triangle kFaceTriangles[] = {{0, 1, 2}, {3, 2, 1}, {4, 5, 6}, {7, 6, 5},
                                       {0, 1, 4}, {5, 4, 1}, {2, 3, 6}, {7, 6, 3},
                                       {0, 2, 4}, {6, 4, 2}, {1, 3, 5}, {7, 5, 3}};

oracle::TriangleCorners triangle_corners(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

int dimension_of(const oracle::TriangleCorners& c) {
  if (!oracle::collinear(c[0], c[1], c[2])) return 2;
  return c[0] == c[1] && c[1] == c[2] ? 0 : 1;
}

/// No corner of `of` lies in the plane of `plane`. Three collinear corners span none: then every
/// sign is 0.
bool off_plane(const oracle::TriangleCorners& of, const oracle::TriangleCorners& plane) {
  return std::all_of(of.begin(), of.end(), [&](const Vec3& corner) {
    return oracle::orientation(plane[0], plane[1], plane[2], corner) != 0;
  });
}

}  // namespace

Snapshot snapshot_of(const CaseCandidate& candidate) {
  Snapshot out;
  for (std::size_t m = 0; m < candidate.meshes.size(); ++m) {
    const TriangleMesh& mesh = candidate.meshes[m];
    if (candidate.on_nodes) {
      const NodeShape on_nodes = make_node_shape(mesh.vertices.size(), mesh.triangles);
      out.bodies.push_back({candidate.names[m], on_nodes.shape});
      out.nodes.push_back(on_nodes.nodes_for(mesh.vertices));
    } else {
      out.bodies.push_back({candidate.names[m], make_bare_shape(mesh)});
      out.nodes.push_back(out.bodies.back().shape->given.kept(mesh.vertices));
    }
  }
  return out;
}

CaseCandidate candidate_of(const Snapshot& snapshot) {
  CaseCandidate out;
  for (std::size_t m = 0; m < snapshot.bodies.size(); ++m) {
    const Body& body = snapshot.bodies[m];
    out.names.push_back(body.name);
    std::vector<Vec3> vertices(body.shape->mesh.vertices.size());
    map_body(*body.shape, snapshot.nodes[m], vertices);
    out.meshes.push_back({std::move(vertices), body.shape->linked()});
  }
  return out;
}

std::vector<CaseCandidate> cell_candidates(const Snapshot& snapshot, const CellPair& cells) {
  CaseCandidate base;
  base.on_nodes = true;
  base.meshes.resize(2);
  for (std::size_t m = 0; m < 2; ++m) {
    const BodyShape& shape = *snapshot.bodies[m].shape;
    const Corners corners = corners_of(*shape.lattice, cells[m], snapshot.nodes[m]);
    base.names.push_back(snapshot.bodies[m].name);
    base.meshes[m].vertices.assign(corners.begin(), corners.end());
  }
  std::vector<CaseCandidate> out;
  for (const Triangle& first : kFaceTriangles)
    for (const Triangle& second : kFaceTriangles) {
      base.meshes[0].triangles = {first};
      base.meshes[1].triangles = {second};
      out.push_back(base);
    }
  return out;
}

CaseCandidate with_pieces(const CaseCandidate& candidate, const std::vector<Piece>& pieces) {
  CaseCandidate out;
  out.names = candidate.names;
  out.on_nodes = candidate.on_nodes;
  out.sides = candidate.sides;
  std::vector<std::vector<Triangle>> triangles(candidate.meshes.size());
  for (const Piece& p : pieces)
    triangles[p.mesh].push_back(candidate.meshes[p.mesh].triangles[p.triangle]);
  for (std::size_t m = 0; m < triangles.size(); ++m) {
    out.meshes.push_back({candidate.meshes[m].vertices, std::move(triangles[m])});
    drop_unused_vertices(out.meshes.back());
  }
  return out;
}

CaseCandidate without_mesh(CaseCandidate candidate, std::size_t mesh) {
  const auto at = static_cast<std::ptrdiff_t>(mesh);
  candidate.names.erase(candidate.names.begin() + at);
  candidate.meshes.erase(candidate.meshes.begin() + at);
  for (std::size_t& side : candidate.sides)
    if (side > mesh) --side;
  return candidate;
}

std::vector<Piece> pieces_of(const CaseCandidate& candidate) {
  std::vector<Piece> out;
  for (std::uint32_t m = 0; m < candidate.meshes.size(); ++m)
    for (std::uint32_t t = 0; t < candidate.meshes[m].triangles.size(); ++t) out.push_back({m, t});
  return out;
}

std::vector<double> coordinates_of(const CaseCandidate& candidate) {
  std::vector<double> out;
  for (const TriangleMesh& mesh : candidate.meshes)
    for (const Vec3& v : mesh.vertices) out.insert(out.end(), {v.x(), v.y(), v.z()});
  return out;
}

CaseCandidate with_coordinates(CaseCandidate candidate, const std::vector<double>& coordinates) {
  CONTACTCHECK_INVARIANT(coordinates.size() == 3 * candidate.vertices(), "three per vertex");
  std::size_t at = 0;
  for (TriangleMesh& mesh : candidate.meshes)
    for (Vec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) v[k] = coordinates[at++];
  return candidate;
}

std::vector<int> dimensions_of(const CaseCandidate& candidate) {
  std::vector<int> out;
  for (const TriangleMesh& mesh : candidate.meshes)
    for (const Triangle& t : mesh.triangles) out.push_back(dimension_of(triangle_corners(mesh, t)));
  return out;
}

double relative_gap(const TriangleMesh& first, const TriangleMesh& second) {
  CaseCandidate pair;
  pair.names = {"first", "second"};
  pair.meshes = {first, second};
  const Snapshot snapshot = snapshot_of(pair);
  Aabb box;
  Frame frame;
  for (const std::vector<Vec3>& vertices : snapshot.nodes) {
    for (const Vec3& vertex : vertices) box.extend(vertex);
    frame.bodies.push_back({vertices, vertices});
  }
  const double gap = oracle::Oracle(snapshot.bodies).distance(frame, {0, 1}).lower;
  return gap > 0.0 ? gap / box.extent().maxCoeff() : 0.0;
}

bool in_general_position(const CaseCandidate& candidate, const Piece& first, const Piece& second) {
  const auto corners = [&](const Piece& piece) {
    const TriangleMesh& mesh = candidate.meshes[piece.mesh];
    return triangle_corners(mesh, mesh.triangles[piece.triangle]);
  };
  return off_plane(corners(first), corners(second)) && off_plane(corners(second), corners(first));
}

}  // namespace contactcheck::reduce
