#include "reference/plugin/step_answer.h"

#include <algorithm>

#include "core/types/check.h"
#include "reference/text/counted.h"

namespace contactcheck::plugin {

void StepAnswerReader::prepare(const std::vector<Body>& bodies) {
  bodies_ = bodies;
  known_.clear();
}

std::vector<std::uint32_t> StepAnswerReader::numbers_of(const std::string& from, std::uint32_t body,
                                                        Edge edge) {
  if (body >= bodies_.size())
    throw InputError(from + " names body " + std::to_string(body) + " of " +
                     text::counted(bodies_.size(), "body", "bodies"));
  const BodyShape& shape = *bodies_[body].shape;
  EdgeNumbers& known = known_[&shape];
  if (known.empty()) {
    const MeshEdges edges = mesh_edges(shape.mesh.triangles);
    for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t number = edges.of_triangle[t][i];
        const Triangle& named = shape.linked()[t];
        const std::uint32_t v = named[i], w = named[(i + 1) % 3];
        if (number != MeshEdges::kNone) known.push_back({{std::min(v, w), std::max(v, w)}, number});
      }
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
  }
  const Edge wanted = {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
  std::vector<std::uint32_t> out;
  for (auto at = std::lower_bound(known.begin(), known.end(), std::pair(wanted, 0u));
       at != known.end() && at->first == wanted; ++at)
    out.push_back(at->second);
  if (out.empty())
    throw InputError(from + " names an edge from vertex " + std::to_string(edge[0]) +
                     " to vertex " + std::to_string(edge[1]) + ", which body \"" +
                     bodies_[body].name + "\" does not have");
  return out;
}

void StepAnswerReader::read(const std::string& from, const StepAnswer& answer, ContactSet& out) {
  for (const BodyImpact& impact : answer.bodies)
    if (impact.bodies.a != impact.bodies.b) out.impacts.push_back(impact);
  for (const ElementPair& pair : answer.triangles)
    if (pair.body_a != pair.body_b) out.impact_triangles.push_back(pair);
  for (const NearPair& pair : answer.vertices)
    (pair.body == pair.other ? out.self_impact_vertices : out.impact_vertices).push_back(pair);
  for (const NamedEdges& pair : answer.edges)
    for (const std::uint32_t a : numbers_of(from, pair.body_a, pair.a))
      for (const std::uint32_t b : numbers_of(from, pair.body_b, pair.b)) {
        if (pair.body_a == pair.body_b) {
          out.self_impact_edges.push_back({pair.body_a, a, b});
        } else {
          out.impact_edges.push_back({pair.body_a, pair.body_b, a, b});
        }
      }
}

}  // namespace contactcheck::plugin
