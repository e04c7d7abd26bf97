// Boxes for the tests of the simulation, with a detector by brute force.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/dynamics/simulation.h"
#include "tests/core/dynamics/contact_cases.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// Side of every box, metres.
inline constexpr double kBoxSide = 0.2;

/// A box of 0.2 m around the origin. Its lattice reaches 2 % beyond it.
inline Body box_body(const std::string& name, const Resolution& cells = {2, 2, 2}) {
  const Vec3 half = Vec3::Constant(0.5 * kBoxSide);
  return make_body(name, box_mesh(-half, half, 2), cells);
}

/// At rest in shape, its centre at `centre`, all nodes with one velocity.
inline NodeState moving(const Body& body, const Vec3& centre, const Vec3& velocity) {
  const std::vector<Vec3> nodes = rest_nodes_at(*body.shape, centre);
  return {nodes, std::vector<Vec3>(nodes.size(), velocity)};
}

/// 1 kg, soft enough for few substeps and stiff enough to bear its weight.
inline Material material_of(DeformableModel model) {
  Material material;
  material.model = model;
  material.stiffness = 400.0;
  material.damping = 1.0;
  material.youngs_modulus = 2e4;
  material.damping_time = 0.005;
  return material;
}

inline Material springs() { return material_of(DeformableModel::kMassSpring); }

inline bool same_bits(const std::vector<NodeState>& p, const std::vector<NodeState>& q) {
  bool same = p.size() == q.size();
  for (std::size_t b = 0; same && b < p.size(); ++b) same = same_bits(p[b], q[b]);
  return same;
}

/// Steps with an exact detector for bodies 0 and 1 in the loop. The bodies outlive this.
class BoxLoop {
 public:
  BoxLoop(const std::vector<Body>& bodies, const std::vector<std::optional<Material>>& materials,
          const SimulationSettings& settings, std::vector<NodeState> start)
      : bodies_(bodies),
        points_(bodies, ContactVolume::kCell),
        simulation_(bodies, materials, settings, std::move(start)) {}

  void step() {
    simulation_.advance();
    std::vector<std::vector<Vec3>> nodes;
    for (const NodeState& body : simulation_.state().bodies) nodes.push_back(body.positions);
    const FrameData data = make_frame(bodies_, std::move(nodes));
    const Frame frame = data.frame();
    const ContactSet contacts = triangle_contacts(bodies_, frame);
    if (!contacts.triangles.empty()) ++contact_steps_;
    simulation_.respond(points_.from(contacts, frame));
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  int contact_steps() const { return contact_steps_; }
  Simulation& simulation() { return simulation_; }
  const SimulationState& state() const { return simulation_.state(); }

 private:
  const std::vector<Body>& bodies_;
  ContactPoints points_;
  Simulation simulation_;
  int contact_steps_ = 0;
};

}  // namespace contactcheck::test
