#include "reference/scene/driven_simulation.h"

#include "core/types/check.h"

namespace contactcheck::scene {
namespace {

const Semantics& prepared(Detector& detector, const Scene& scene) {
  detector.prepare(scene.bodies);
  const std::string fault = why_no_driver(detector.semantics());
  if (!fault.empty()) throw InputError(fault);
  return detector.semantics();
}

}  // namespace

std::vector<NodeState> start_of(const Scene& scene) {
  std::vector<NodeState> start;
  const std::vector<std::vector<Vec3>> nodes = scene.nodes_at(0.0);
  for (std::size_t b = 0; b < nodes.size(); ++b) {
    const Vec3& velocity = scene.simulation()->velocities[b];
    start.push_back({nodes[b], std::vector<Vec3>(nodes[b].size(), velocity)});
  }
  return start;
}

std::string why_no_driver(const Semantics& semantics) {
  if (semantics.answers(Question::kTriangles) || semantics.answers(Question::kCells)) return "";
  return "it answers with neither cells nor triangles, so there is no point to respond at";
}

DrivenSimulation::DrivenSimulation(const Scene& scene, Detector& detector)
    : scene_(scene),
      detector_(detector),
      question_(prepared(detector, scene).answers(Question::kTriangles) ? Question::kTriangles
                                                                        : Question::kCells),
      simulation_(scene.bodies, scene.simulation()->materials, scene.simulation()->settings,
                  start_of(scene)),
      points_(scene.bodies,
              detector.semantics().whole_cells ? ContactVolume::kCell : ContactVolume::kFfdAabb) {
  for (const Body& body : scene.bodies) {
    nodes_.emplace_back(body.shape->node_count(), Vec3::Zero());
    vertices_.emplace_back(body.shape->mesh.vertices.size(), Vec3::Zero());
  }
  for (std::size_t b = 0; b < nodes_.size(); ++b)
    frame_.bodies.push_back({nodes_[b], vertices_[b]});
}

void DrivenSimulation::deform() { simulation_.advance(); }

void DrivenSimulation::update_cells() {
  frame_.index = simulation_.state().steps;
  frame_.time =
      static_cast<double>(simulation_.state().steps) * scene_.simulation()->settings.time_step;
  for (std::size_t b = 0; b < nodes_.size(); ++b) {
    nodes_[b] = simulation_.state().bodies[b].positions;
    map_body(*scene_.bodies[b].shape, nodes_[b], vertices_[b]);
  }
  detector_.update(frame_);
}

void DrivenSimulation::test() {
  contacts_.clear();
  detector_.query(question_, contacts_);
}

void DrivenSimulation::respond() {
  contacts_.canonicalize();
  simulation_.respond(points_.from(contacts_, frame_));
}

void DrivenSimulation::step() {
  deform();
  update_cells();
  test();
  respond();
}

}  // namespace contactcheck::scene
