// Small bodies and frames for tests.
#pragma once

#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/types/frame.h"
#include "core/types/mesh.h"

namespace contactcheck::test {

/// A closed, welded, outward-oriented box, every face divided into n x n quads of two triangles.
TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi, int n);
/// The box [0, 1]^3.
TriangleMesh unit_box_mesh(int n);
/// A closed, outward-oriented sphere: an octahedron, every triangle divided in four `levels` times.
TriangleMesh sphere_mesh(const Vec3& center, double radius, int levels);
/// One triangle.
TriangleMesh triangle_mesh(const Vec3& a, const Vec3& b, const Vec3& c);

/// One moment of a scene that owns its nodes and vertices.
struct FrameData {
  std::vector<std::vector<Vec3>> nodes;     ///< per body
  std::vector<std::vector<Vec3>> vertices;  ///< per body, mapped
  /// Points into this object: valid while it lives and stays unchanged.
  Frame frame(std::size_t index = 0) const;
};

/// Maps the vertices of every body by its nodes.
FrameData make_frame(const std::vector<Body>& bodies, std::vector<std::vector<Vec3>> nodes);

/// Rest nodes of a body (its vertices, without a lattice), moved by `offset`.
std::vector<Vec3> rest_nodes_at(const BodyShape& shape, const Vec3& offset);

Body make_body(const std::string& name, TriangleMesh mesh, const Resolution& resolution,
               double padding = 0.02);

}  // namespace contactcheck::test
