#include "core/detect/frame_numbers.h"

#include "core/deform/mapping.h"
#include "core/types/local_origin.h"

namespace contactcheck {

void FrameNumbers<double>::update(const Frame& frame) {
  nodes_.clear();
  vertices_.clear();
  for (const BodyState& body : frame.bodies) {
    nodes_.push_back(body.nodes);
    vertices_.push_back(body.vertices);
  }
}

void FrameNumbers<float>::prepare(const std::vector<Body>& bodies, bool with_vertices) {
  with_vertices_ = with_vertices;
  sources_.clear();
  nodes_.assign(bodies.size(), {});
  vertices_.assign(bodies.size(), {});
  spans_.assign(bodies.size(), {});
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyShape& shape = *bodies[b].shape;
    sources_.push_back({&shape, with_vertices ? single_local(shape.embedding) : SingleLocal{}});
    nodes_[b].resize(shape.node_count());
    if (with_vertices) vertices_[b].resize(shape.mesh.vertices.size());
    spans_[b] = vertices_[b];
  }
}

void FrameNumbers<float>::update(const Frame& frame) {
  origin_ = local_origin(frame);
  for (std::size_t b = 0; b < sources_.size(); ++b) {
    round_to_local(frame.bodies[b].nodes, origin_, nodes_[b]);
    if (!with_vertices_) continue;
    const BodyShape& shape = *sources_[b].shape;
    map_vertices(*shape.lattice, shape.embedding, sources_[b].local, nodes_[b], vertices_[b]);
  }
}

}  // namespace contactcheck
