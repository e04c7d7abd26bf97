// Answers about a step as plug-ins give them: an edge by its two vertices, contact of a body with
// itself by naming it twice.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/mesh_edges.h"

namespace contactcheck::plugin {

/// Two edges, each by its vertices in either order.
struct NamedEdges {
  std::uint32_t body_a = 0, body_b = 0;
  Edge a = {}, b = {};
};

struct StepAnswer {
  std::vector<BodyImpact> bodies;
  std::vector<ElementPair> triangles;
  std::vector<NearPair> vertices;
  std::vector<NamedEdges> edges;
};

/// Turns such answers into those of a Detector.
class StepAnswerReader {
 public:
  /// Keeps the shapes of `bodies`.
  void prepare(const std::vector<Body>& bodies);
  /// Appends. Of a welded mesh an edge stands for all edges at its place, as the mesh that a
  /// plug-in is given has one number for all vertices at one place. Pairs of one body's triangles
  /// say nothing: no level counts them.
  /// @throws InputError, with `from`, for a body or an edge that does not exist
  void read(const std::string& from, const StepAnswer& answer, ContactSet& out);

 private:
  /// By the vertices that a plug-in knows: the numbers of edges, ascending.
  using EdgeNumbers = std::vector<std::pair<Edge, std::uint32_t>>;
  std::vector<std::uint32_t> numbers_of(const std::string& from, std::uint32_t body, Edge edge);

  std::vector<Body> bodies_;
  std::map<const BodyShape*, EdgeNumbers> known_;
};

}  // namespace contactcheck::plugin
