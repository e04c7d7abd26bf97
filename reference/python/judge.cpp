#include "reference/python/judge.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "core/types/check.h"
#include "core/types/shared_corners.h"
#include "reference/oracle/closed_chain.h"
#include "reference/oracle/elementary_impact.h"
#include "reference/oracle/exact_tests.h"
#include "reference/oracle/floating_point.h"
#include "reference/oracle/frame_certificate.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/surface_distance.h"
#include "reference/oracle/surface_geometry.h"
#include "reference/oracle/vertex_queries.h"
#include "reference/python/arrays.h"
#include "reference/scene/lattice_spec.h"

namespace contactcheck::python {
namespace {

using Released = py::gil_scoped_release;
// Whatever the caller's thread has set, such as flush-to-zero by a library that was imported.
using CleanNumbers = py::call_guard<oracle::FloatingPointGuard>;

TriangleMesh read_mesh(const py::object& vertices, const py::object& faces,
                       const std::string& vertices_name, const std::string& faces_name,
                       bool any_value = false) {
  TriangleMesh out;
  out.vertices = read_points(vertices, vertices_name, any_value);
  out.triangles = read_triangles(faces, faces_name, out.vertices.size(), any_value);
  return out;
}

// `lattice`: as the lattice of a body in a scene file that is fitted to a recording; "null": none.
Shape make_shape(const py::object& vertices, const py::object& faces,
                 const std::string& vertices_name, const std::string& faces_name, bool weld,
                 const std::string& lattice, const std::string& lattice_name) {
  TriangleMesh mesh = read_mesh(vertices, faces, vertices_name, faces_name);
  if (mesh.triangles.empty())
    throw InputError(faces_name + " has no triangle; a mesh has one at least");
  const Released released;
  const text::JsonValue json = text::parse_json(lattice, lattice_name);
  const scene::LatticeSpec spec =
      scene::parse_lattice_spec(text::JsonField(json, lattice_name), true);
  Shape out;
  out.body = scene::build_shape(std::move(mesh), spec);
  if (weld) out.body = welded(*out.body);
  out.smoothing = spec.smoothing;
  return out;
}

// Shapes at rest, as the bodies of a frame.
struct AtRest {
  explicit AtRest(std::vector<Shape> shapes) {
    for (Shape& shape : shapes) bodies.push_back({"", std::move(shape.body)});
    for (const Body& body : bodies) {
      const std::vector<Vec3>& vertices = body.shape->mesh.vertices;
      frame.bodies.push_back({vertices, vertices});
    }
  }
  oracle::TriangleCorners corners(std::size_t body, std::uint32_t triangle) const {
    const TriangleMesh& mesh = bodies[body].shape->mesh;
    const Triangle& t = mesh.triangles[triangle];
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  }

  std::vector<Body> bodies;
  Frame frame;
};

oracle::SurfaceTree tree_at_rest(const Shape& shape) {
  oracle::SurfaceTree tree(shape.body->mesh);
  tree.refit(shape.body->mesh.vertices);
  return tree;
}

// The first pairs that are found, ascending, and whether there are more.
py::tuple contacts(const Shape& a, const Shape& b, std::size_t most) {
  std::vector<std::array<std::uint32_t, 2>> found;
  bool more = false;
  {
    const Released released;
    const oracle::SurfaceTree tree_a = tree_at_rest(a), tree_b = tree_at_rest(b);
    more = any_box_pair(tree_a, tree_b, [&](std::uint32_t i, std::uint32_t j) {
      if (!oracle::triangles_intersect(tree_a.corners(i), tree_b.corners(j))) return false;
      if (found.size() == most) return true;
      if (found.size() == oracle::kMostContacts)
        oracle::refuse_many_contacts(oracle::kMostContacts);
      found.push_back({i, j});
      return false;
    });
    std::sort(found.begin(), found.end());
  }
  return py::make_tuple(table<std::int32_t, 2>(found, [](const auto& pair) { return pair; }), more);
}

py::tuple self_contacts(const Shape& shape) {
  const AtRest scene({shape});
  std::vector<SelfPair> found;
  std::vector<std::uint32_t> shared;
  {
    const Released released;
    oracle::WantedTruth wanted;
    wanted.triangles = false;
    wanted.self = true;
    found = oracle::Oracle(scene.bodies).judge(scene.frame, wanted).surface.self;
    const std::vector<Triangle>& linked = shape.body->linked();
    for (const SelfPair& p : found)
      shared.push_back(shared_corners(linked[p.a], linked[p.b]).count);
  }
  return py::make_tuple(table<std::int32_t, 2>(found,
                                               [](const SelfPair& p) {
                                                 return std::array{p.a, p.b};
                                               }),
                        column<std::int32_t>(shared, [](std::uint32_t count) { return count; }));
}

// Four rows of points a query, at t = 0 and at t = 1.
py::tuple impacts(bool edges, const py::object& start_rows, const py::object& end_rows) {
  const std::vector<Vec3> start = read_points(start_rows, "start"),
                          end = read_points(end_rows, "end");
  CONTACTCHECK_INVARIANT(start.size() == end.size() && start.size() % 4 == 0,
                         "contactcheck/__init__.py checks the shapes");
  std::vector<Impact> found(start.size() / 4);
  {
    const Released released;
    for (std::size_t i = 0; i < found.size(); ++i) {
      ImpactQuery query{edges ? ImpactKind::edge_edge : ImpactKind::vertex_triangle, {}, {}};
      for (std::size_t point = 0; point < 4; ++point) {
        query.start[point] = start[4 * i + point];
        query.end[point] = end[4 * i + point];
      }
      found[i] = oracle::elementary_impact(query);
    }
  }
  return py::make_tuple(column<bool>(found, [](const Impact& i) { return i.contact; }),
                        column<bool>(found, [](const Impact& i) { return i.starts_in_contact; }),
                        column<double>(found, [](const Impact& i) { return i.earliest; }),
                        column<double>(found, [](const Impact& i) { return i.latest; }));
}

py::tuple distance(const Shape& a, const Shape& b) {
  const AtRest scene({a, b});
  oracle::DistanceInterval found;
  std::vector<Vec3> points;
  {
    const Released released;
    found = oracle::Oracle(scene.bodies).distance(scene.frame, {0, 1});
    const std::array<Vec3, 2> nearest = oracle::certify::nearest_points_rounded(
        scene.corners(0, found.triangles[0]), scene.corners(1, found.triangles[1]));
    points.assign(nearest.begin(), nearest.end());
  }
  return py::make_tuple(found.lower, found.upper, points_table(points));
}

py::tuple point_distances(const py::object& points_object, const Shape& shape) {
  const std::vector<Vec3> points = read_points(points_object, "points");
  std::vector<oracle::DistanceInterval> found;
  std::vector<Vec3> nearest;
  {
    const Released released;
    const AtRest scene({shape});
    oracle::SurfaceTree tree(shape.body->mesh);
    oracle::ScaledSurface surface;
    surface.tree = &tree;
    surface.vertices = shape.body->mesh.vertices;
    found = oracle::point_distances(points, surface);
    for (std::size_t i = 0; i < points.size(); ++i)
      nearest.push_back(oracle::certify::nearest_points_rounded(
          {points[i], points[i], points[i]}, scene.corners(0, found[i].triangles[1]))[1]);
  }
  const auto lower = [](const oracle::DistanceInterval& d) { return d.lower; };
  const auto upper = [](const oracle::DistanceInterval& d) { return d.upper; };
  const auto triangle = [](const oracle::DistanceInterval& d) { return d.triangles[1]; };
  return py::make_tuple(column<double>(found, lower), column<double>(found, upper),
                        points_table(nearest), column<std::int32_t>(found, triangle));
}

py::tuple depth(const Shape& a, const Shape& b) {
  const AtRest scene({a, b});
  oracle::SurfaceDepth found;
  {
    const Released released;
    oracle::SurfaceGeometry geometry(scene.bodies);
    geometry.set_frame(scene.frame);
    found = geometry.surface_depth({0, 1});
  }
  if (found.unknown)
    throw InputError(
        std::string(found.unknown->body == 0 ? "Va, Fa" : "Vb, Fb") + " is not a simple solid: " +
        oracle::describe(found.unknown->fault, scene.bodies[found.unknown->body].shape->given));
  return py::make_tuple(found.lower, found.upper);
}

py::tuple inside(const py::object& points_object, const Shape& shape) {
  const std::vector<Vec3> points = read_points(points_object, "points");
  std::vector<std::optional<int>> winding(points.size());
  {
    const Released released;
    const TriangleMesh& mesh = shape.body->mesh;
    const auto chain = oracle::surface_chain(mesh.triangles, mesh.vertices);
    if (!chain.closed())
      throw InputError("V, F has no inside: it is " +
                       oracle::open_reason(*chain.open, shape.body->given) +
                       "; a closed mesh is wanted, every edge run equally often in both "
                       "directions, equal coordinates being one vertex");
    const oracle::SurfaceTree tree = tree_at_rest(shape);
    for (std::size_t i = 0; i < points.size(); ++i)
      winding[i] = oracle::winding_number(tree, points[i]);
  }
  return py::make_tuple(
      column<std::int32_t>(winding, [](const std::optional<int>& w) { return w.value_or(0); }),
      column<bool>(winding, [](const std::optional<int>& w) { return !w.has_value(); }));
}

py::dict check_mesh(const py::object& vertices, const py::object& faces) {
  const TriangleMesh mesh = read_mesh(vertices, faces, "V", "F", true);
  MeshTopology topology;
  {
    const Released released;
    topology = analyse_topology(mesh);
  }
  std::map<MeshDefectKind, std::vector<std::uint32_t>> defects;
  for (const MeshDefect& defect : topology.defects) defects[defect.kind].push_back(defect.index);
  py::dict out;
  for (const auto& [kind, indices] : defects)
    out[name_of(kind)] = column<std::int32_t>(indices, [](std::uint32_t i) { return i; });
  return out;
}

std::vector<Vec3> read_positions(const py::object& object, const std::string& name,
                                 std::size_t count, const char* of) {
  std::vector<Vec3> out = read_points(object, name);
  if (out.size() != count)
    throw InputError(name + " has " + std::to_string(out.size()) + " rows; the " + of + " are " +
                     std::to_string(count));
  return out;
}

py::array deform(const Shape& shape, const py::object& nodes_object) {
  const std::vector<Vec3> nodes =
      read_positions(nodes_object, "nodes", shape.body->node_count(), "nodes of the lattice");
  std::vector<Vec3> out(shape.body->mesh.vertices.size());
  {
    const Released released;
    map_body(*shape.body, nodes, out);
  }
  return points_table(shape.body->given.spread(out));
}

py::array fit(const Shape& shape, const py::object& vertices_object) {
  const std::vector<Vec3> vertices = shape.body->given.kept(read_positions(
      vertices_object, "V", shape.body->given_vertex_count(), "vertices of the mesh"));
  std::vector<Vec3> out;
  {
    const Released released;
    Shape::Fit& fit = *shape.fit;
    std::call_once(fit.made, [&] { fit.value.emplace(*shape.body, shape.smoothing); });
    scene::FitError error;
    out = fit.value->fitted(vertices, error);
  }
  return points_table(out);
}

}  // namespace

void add_judge(py::module_& module) {
  py::class_<Shape>(module, "Shape")
      .def(py::init(&make_shape), py::arg("vertices"), py::arg("faces"), py::arg("vertices_name"),
           py::arg("faces_name"), py::arg("weld") = false, py::arg("lattice") = "null",
           py::arg("lattice_name") = "", CleanNumbers())
      .def_property_readonly("nodes",
                             [](const Shape& shape) {
                               return points_table(shape.body->lattice
                                                       ? shape.body->lattice->rest_nodes()
                                                       : shape.body->mesh.vertices);
                             })
      .def_property_readonly("faces",
                             [](const Shape& shape) {
                               return table<std::int32_t, 3>(
                                   shape.body->given.numbered(shape.body->mesh.triangles),
                                   [](const Triangle& t) { return t; });
                             })
      .def_property_readonly("cells",
                             [](const Shape& shape) { return shape.body->lattice->cells.size(); })
      .def("positions",
           [](const Shape& shape, const py::object& object, const std::string& name) {
             return points_table(read_positions(object, name, shape.body->given_vertex_count(),
                                                "vertices of the mesh"));
           })
      .def("deform", &deform, CleanNumbers())
      .def("fit", &fit, CleanNumbers());
  module.def("contacts", &contacts, CleanNumbers());
  module.def("self_contacts", &self_contacts, CleanNumbers());
  module.def("impacts", &impacts, CleanNumbers());
  module.def("distance", &distance, CleanNumbers());
  module.def("point_distances", &point_distances, CleanNumbers());
  module.def("depth", &depth, CleanNumbers());
  module.def("inside", &inside, CleanNumbers());
  module.def("check_mesh", &check_mesh, CleanNumbers());
}

}  // namespace contactcheck::python
