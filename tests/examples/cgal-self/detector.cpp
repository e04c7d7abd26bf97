// CGAL's PMP::self_intersections, which contactcheck talks to over pipes
// (reference/plugin/README.md).
//
//   contactcheck run self --detector-cmd build/cgal-self/cgal_self --detector full-refit
//
// What CGAL 5.5 calls a self-intersection, with exact predicates:
//   no shared vertex   the closed triangles meet, as at level `self`
//   one                the edge opposite to it, of either, meets the other triangle: `self-vertex`
//   an edge            folded flat on one another: `self-edge`
//   two vertices that no edge joins in the mesh, or all three: treated as one shared vertex
// Triangles without area are beyond its preconditions. A Surface_mesh holds no edge of more than
// two triangles and no two neighbours of opposite orientation: such a mesh is refused.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "numbers are sent as they lie in memory");

struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <typename T>
std::vector<T> take(std::size_t count) {
  std::vector<T> out(count);
  const auto bytes = static_cast<std::streamsize>(count * sizeof(T));
  if (!std::cin.read(reinterpret_cast<char*>(out.data()), bytes))
    throw std::runtime_error("the input ends within a message");
  return out;
}

void write(Json line, const std::vector<std::uint32_t>& numbers = {}) {
  line["bytes"] = numbers.size() * sizeof(std::uint32_t);
  std::cout << line.dump() << '\n';
  std::cout.write(reinterpret_cast<const char*>(numbers.data()),
                  static_cast<std::streamsize>(numbers.size() * sizeof(std::uint32_t)));
  std::cout.flush();
}

Json hello() {
  return {
      {"message", "hello"},
      {"protocol", "contactcheck-pipe/1"},
      {"id", "cgal-self"},
      {"summary", "CGAL's self_intersections"},
      {"version", CGAL_VERSION_STR},
      {"needs", {"vertices"}},
      {"semantics",
       {{"levels", {"self", "self-vertex", "self-edge", "self-body"}}, {"questions", {"self"}}}}};
}

// The vertices come with every frame; of triangles, number t is face t.
Mesh mesh_of(const Json& body) {
  const auto vertices = body["vertices"].get<std::size_t>();
  const auto triangles = body["triangles"].get<std::size_t>();
  take<double>(3 * vertices);
  const std::vector<std::uint32_t> corners = take<std::uint32_t>(3 * triangles);
  if (const Json& lattice = body["lattice"]; !lattice.is_null()) {
    take<double>(3 * lattice["nodes"].get<std::size_t>());
    take<std::uint32_t>(8 * lattice["cells"].get<std::size_t>() + vertices);
    take<double>(3 * vertices);
    take<std::uint32_t>(triangles + 1 + lattice["labels"].get<std::size_t>());
  }
  Mesh mesh;
  for (std::size_t v = 0; v < vertices; ++v) mesh.add_vertex({0, 0, 0});
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto corner = [&](std::size_t k) { return Mesh::Vertex_index(corners[3 * t + k]); };
    if (mesh.add_face(corner(0), corner(1), corner(2)) == Mesh::null_face())
      throw Refused("triangle " + std::to_string(t) + " of body " + body["name"].dump() +
                    " fits no Surface_mesh: an edge of more than two triangles, or neighbours of "
                    "opposite orientation");
  }
  return mesh;
}

void move(Mesh& mesh) {
  const std::vector<double> numbers = take<double>(3 * mesh.number_of_vertices());
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    const double* at = &numbers[3 * static_cast<std::size_t>(v.idx())];
    mesh.point(v) = {at[0], at[1], at[2]};
  }
}

void answer(const std::vector<Mesh>& meshes) {
  std::vector<std::uint32_t> pairs;
  for (std::uint32_t body = 0; body < meshes.size(); ++body) {
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections(meshes[body], std::back_inserter(found));
    for (const auto& [a, b] : found) pairs.insert(pairs.end(), {body, body, a.idx(), b.idx()});
  }
  write({{"message", "contacts"}, {"triangles", pairs.size() / 4}}, pairs);
}

void serve() {
  std::vector<Mesh> meshes;
  for (std::string text; std::getline(std::cin, text);) {
    const Json line = Json::parse(text);
    const std::string message = line["message"];
    if (message == "hello") {
      write(hello());
    } else if (message == "prepare") {
      meshes.clear();
      for (const Json& body : line["bodies"]) meshes.push_back(mesh_of(body));
      write({{"message", "ready"}});
    } else if (message == "frame") {
      for (Mesh& mesh : meshes) move(mesh);
      write({{"message", "done"}});
    } else {
      answer(meshes);
    }
  }
}

}  // namespace

int main() {
  std::ios::sync_with_stdio(false);
  try {
    serve();
  } catch (const Refused& e) {
    write({{"message", "refused"}, {"text", e.what()}});
  } catch (const std::exception& e) {
    write({{"message", "error"}, {"text", e.what()}});
    return 1;
  }
}
