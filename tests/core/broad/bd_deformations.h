// Deformed lattices, from rest to both ends of the doubles, for the tests of BD-trees.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/broad/bd_tree.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

inline const BdSettings kBdVariants[] = {{4, ReferenceKind::kAffine, false},
                                         {4, ReferenceKind::kAffine, true},
                                         {1, ReferenceKind::kRigid, true},
                                         {16, ReferenceKind::kNone, true},
                                         {1, ReferenceKind::kNone, false}};

inline Body sphere_body(double scale = 1.0, const Vec3& at = Vec3::Zero()) {
  TriangleMesh mesh = sphere_mesh(Vec3::Zero(), 1.0, 2);
  for (Vec3& v : mesh.vertices) v = scale * v + at;
  return make_body("", mesh, {3, 4, 3});
}

/// "" or the first broken promise over all variants, in one frame.
template <typename T>
std::string broken(const Body& body, const std::vector<Vec3>& nodes) {
  for (const BdSettings& settings : kBdVariants) {
    BdTreeOf<T> tree(make_bd_model(*body.shape, settings.leaf_size), settings);
    tree.begin_frame(nodes);
    const std::string fault = tree.validate();
    if (!fault.empty()) return fault;
  }
  return "";
}

using NodeDeform = std::function<Vec3(TriangleSource&, const Vec3&)>;

struct NodeCase {
  const char* name;
  NodeDeform deform;
};

inline const NodeCase kNodeCases[] = {
    {"rest", [](TriangleSource&, const Vec3& p) -> Vec3 { return p; }},
    {"noise", [](TriangleSource& random, const Vec3& p) -> Vec3 { return random.point(p, 0.3); }},
    {"wild noise",
     [](TriangleSource& random, const Vec3& p) -> Vec3 { return random.point(p, 50.0); }},
    {"one point", [](TriangleSource&, const Vec3&) -> Vec3 { return Vec3(0.1, 0.2, 0.3); }},
    {"a plane",
     [](TriangleSource&, const Vec3& p) -> Vec3 { return Vec3(p.x(), p.y(), 1.0 / 3.0); }},
    {"a line",
     [](TriangleSource&, const Vec3& p) -> Vec3 { return (p.sum() / 3.0) * Vec3(1, 2, 3); }},
    {"mirrored", [](TriangleSource&, const Vec3& p) -> Vec3 { return Vec3(-p.x(), p.y(), p.z()); }},
    {"mirrored noise",
     [](TriangleSource& random, const Vec3& p) -> Vec3 {
       return random.point(Vec3(-1.1 * p.x(), p.z(), p.y()), 0.1);
     }},
    {"far away",
     [](TriangleSource& random, const Vec3& p) -> Vec3 {
       return random.point(p, 0.1) + Vec3(1e8, -1e8, 1e8);
     }},
    {"very far away",
     [](TriangleSource& random, const Vec3& p) -> Vec3 {
       return random.point(p, 0.1) + Vec3(1e15, 1, -1e15);
     }},
    {"1e150",
     [](TriangleSource& random, const Vec3& p) -> Vec3 { return 1e150 * random.point(p, 0.2); }},
    {"1e200",
     [](TriangleSource& random, const Vec3& p) -> Vec3 { return 1e200 * random.point(p, 0.2); }},
    {"1e308",
     [](TriangleSource& random, const Vec3& p) -> Vec3 { return 1.2e308 * random.point(p, 0.2); }},
    {"1e-150",
     [](TriangleSource& random, const Vec3& p) -> Vec3 { return 1e-150 * random.point(p, 0.2); }},
    {"1e-310",
     [](TriangleSource& random, const Vec3& p) -> Vec3 { return 1e-310 * random.point(p, 0.2); }},
    {"mixed scales",
     [](TriangleSource& random, const Vec3& p) -> Vec3 {
       return Vec3(1e120 * p.x(), random.point(p, 0.1).y(), 1e-120 * p.z());
     }},
    {"one node torn off", [](TriangleSource& random, const Vec3& p) -> Vec3 {
       return random.below(40) ? p : Vec3(p * 1e6);
     }}};

inline std::vector<Vec3> deformed(const NodeCase& c, std::vector<Vec3> nodes, std::uint64_t seed) {
  TriangleSource random(seed);
  for (Vec3& n : nodes) n = c.deform(random, n);
  return nodes;
}

}  // namespace contactcheck::test
