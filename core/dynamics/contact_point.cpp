#include "core/dynamics/contact_point.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/deform/ffd_aabb.h"
#include "core/dynamics/triangle_contact.h"
#include "core/dynamics/unit_vector.h"
#include "core/narrow/node_plane.h"
#include "core/types/check.h"

namespace contactcheck {
void agree_on_directions(const Directions& common, std::vector<ContactPoint>& points) {
  constexpr double kCosine = 0.5;
  for (ContactPoint& point : points) {
    const auto at = common.find({point.body_a, point.body_b});
    if (at == common.end()) continue;
    const Vec3 direction = unit_or_zero(at->second);
    if (direction.isZero(0.0) || ordered_dot(direction, point.normal) >= kCosine) continue;
    point.normal = direction;
  }
}

namespace {

Vec3 corner_of(const Aabb& box, int corner) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) out[k] = (corner >> k & 1) ? box.hi[k] : box.lo[k];
  return out;
}

// One cell's box of this frame.
struct CellBox {
  const Lattice* lattice = nullptr;
  std::uint32_t cell = 0;
  Aabb local;  // within the cell
  Corners corners;
  BoxPlanes planes;
};

CellBox cell_box(const Body& body, std::uint32_t cell, const Aabb& local,
                 std::span<const Vec3> nodes) {
  CellBox box;
  box.lattice = &*body.shape->lattice;
  box.cell = cell;
  box.local = local;
  box.corners = mapped_box(*box.lattice, cell, local, nodes);
  box.planes = planes_of_box(box.corners);
  return box;
}

// Between the box's low (0) and high (1) plane along a local axis, by the distances to both: exact
// for parallelepipeds. Where a plane is missing or both are one, all places are as good.
double share_along(const BoxPlanes& planes, int axis, const Vec3& point) {
  std::array<double, 2> distance;
  for (int side = 0; side < 2; ++side) {
    const int face = 2 * axis + side;
    const Vec3 outward = unit_or_zero(planes.normal[face]);
    if (outward.isZero(0.0)) return 0.5;
    distance[side] = std::max(0.0, ordered_dot(outward, planes.point[face] - point));
  }
  const double sum = distance[0] + distance[1];
  return sum > 0.0 ? distance[0] / sum : 0.5;
}

Vec3 local_in_cell(const CellBox& box, const Vec3& point) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    const double share = share_along(box.planes, k, point);
    out[k] = std::clamp(box.local.lo[k] * (1.0 - share) + box.local.hi[k] * share, 0.0, 1.0);
  }
  return out;
}

// A point per corner of `probe` inside `box`. The probe's body is body_a when probe_is_a.
void probe_corners(const CellBox& probe, const CellBox& box, bool probe_is_a,
                   const ElementPair& pair, std::vector<ContactPoint>& out) {
  for (int c = 0; c < 8; ++c) {
    const Vec3& corner = probe.corners[c];
    if (!node_inside(box.planes, corner)) continue;
    const NodeDepth penetration = node_depth(box.planes, corner);
    // A box that is flattened to a segment or a point excludes nothing and says nothing.
    if (penetration.outward.isZero(0.0)) continue;
    ContactPoint point;
    point.body_a = pair.body_a;
    point.body_b = pair.body_b;
    point.depth = penetration.depth;
    point.normal = probe_is_a ? Vec3(-penetration.outward) : penetration.outward;
    point.a = blend_of_local(*probe.lattice, probe.cell, corner_of(probe.local, c));
    point.b = blend_of_local(*box.lattice, box.cell, local_in_cell(box, corner));
    if (!probe_is_a) std::swap(point.a, point.b);
    out.push_back(std::move(point));
  }
}

void add_weighted(const NodeBlend& part, double weight, NodeBlend& out) {
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    const auto at = std::find(out.nodes.begin(), out.nodes.end(), part.nodes[i]);
    const auto index = static_cast<std::size_t>(at - out.nodes.begin());
    if (at == out.nodes.end()) {
      out.nodes.push_back(part.nodes[i]);
      out.weights.push_back(0.0);
    }
    out.weights[index] += weight * part.weights[i];
  }
}

NodeBlend blend_on_triangle(const BodyShape& shape, const Triangle& triangle,
                            const Barycentric& weights) {
  NodeBlend out;
  for (int i = 0; i < 3; ++i)
    if (weights[i] > 0.0) add_weighted(blend_of_vertex(shape, triangle[i]), weights[i], out);
  return out;
}

void add_direction(const ElementPair& pair, const Vec3& direction, Directions& common) {
  common.try_emplace({pair.body_a, pair.body_b}, Vec3::Zero()).first->second += direction;
}

template <typename Points>
Vec3 mean_of(const Points& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

TrianglePoints points_of(const Triangle& t, std::span<const Vec3> vertices) {
  return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
}

}  // namespace

// A point on the inner side of a triangle, without trust in its orientation (open meshes have
// none): the centre of the cell that holds its first vertex, or of all vertices without a lattice.
class ContactPoints::Insides {
 public:
  Insides(const std::vector<Body>& bodies, const Frame& frame)
      : bodies_(bodies), frame_(frame), known_(bodies.size()) {}

  Vec3 of(std::uint32_t body, std::uint32_t triangle) {
    const BodyShape& shape = *bodies_[body].shape;
    const BodyState& state = frame_.bodies[body];
    std::vector<std::optional<Vec3>>& known = known_[body];
    known.resize(shape.lattice ? shape.lattice->cells.size() : 1);
    const std::uint32_t cell =
        shape.lattice ? shape.embedding.home_cell[shape.mesh.triangles[triangle][0]] : 0;
    if (!known[cell])
      known[cell] = shape.lattice ? mean_of(corners_of(*shape.lattice, cell, state.nodes))
                                  : mean_of(state.vertices);
    return *known[cell];
  }

 private:
  const std::vector<Body>& bodies_;
  const Frame& frame_;
  std::vector<std::vector<std::optional<Vec3>>> known_;
};

NodeBlend blend_of_local(const Lattice& lattice, std::uint32_t cell, const Vec3& local) {
  const CornerIds& ids = lattice.cell_nodes[cell];
  NodeBlend out;
  out.nodes.assign(ids.begin(), ids.end());
  out.weights.resize(8);
  for (int c = 0; c < 8; ++c) {
    double weight = 1.0;
    for (int k = 0; k < 3; ++k) weight *= (c >> k & 1) ? local[k] : 1.0 - local[k];
    out.weights[c] = weight;
  }
  return out;
}

NodeBlend blend_of_vertex(const BodyShape& shape, std::uint32_t vertex) {
  if (!shape.lattice) return {{vertex}, {1.0}};
  return blend_of_local(*shape.lattice, shape.embedding.home_cell[vertex],
                        shape.embedding.local[vertex]);
}

ContactPoints::ContactPoints(const std::vector<Body>& bodies, ContactVolume volume)
    : bodies_(bodies), volume_(volume), boxes_(bodies.size()) {
  if (volume_ != ContactVolume::kFfdAabb) return;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const BodyShape& shape = *bodies_[b].shape;
    if (shape.lattice) boxes_[b] = ffd_aabbs(shape.mesh, *shape.lattice, shape.embedding);
  }
}

std::vector<ContactPoint> ContactPoints::from(const ContactSet& contacts,
                                              const Frame& frame) const {
  CONTACTCHECK_INVARIANT(frame.bodies.size() == bodies_.size(), "one state per body");
  std::vector<ContactPoint> out;
  out.reserve(contacts.triangles.size());
  Directions common;
  Insides insides(bodies_, frame);
  for (const ElementPair& pair : contacts.triangles) {
    add_direction(pair, add_triangles(pair, frame, insides, out), common);
  }
  if (contacts.triangles.empty())
    for (const ElementPair& pair : contacts.cells)
      add_direction(pair, add_cells(pair, frame, out), common);
  agree_on_directions(common, out);
  return out;
}

Vec3 ContactPoints::add_triangles(const ElementPair& pair, const Frame& frame, Insides& insides,
                                  std::vector<ContactPoint>& out) const {
  const BodyShape &shape_a = *bodies_[pair.body_a].shape, &shape_b = *bodies_[pair.body_b].shape;
  const Triangle &a = shape_a.mesh.triangles[pair.a], &b = shape_b.mesh.triangles[pair.b];
  const TriangleContact contact =
      triangle_contact(points_of(a, frame.bodies[pair.body_a].vertices),
                       points_of(b, frame.bodies[pair.body_b].vertices));
  // Zero: no direction to separate along, and nothing to correct: such triangles have no depth.
  if (!contact.normal.isZero(0.0))
    out.push_back({pair.body_a, pair.body_b, blend_on_triangle(shape_a, a, contact.on_a),
                   blend_on_triangle(shape_b, b, contact.on_b), contact.normal, contact.depth});
  // The normals of a mesh that bounds nothing need not agree with one another.
  if (shape_a.topology.solid && shape_b.topology.solid) return contact.normal;
  return insides.of(pair.body_b, pair.b) - insides.of(pair.body_a, pair.a);
}

Vec3 ContactPoints::add_cells(const ElementPair& pair, const Frame& frame,
                              std::vector<ContactPoint>& out) const {
  const auto box = [&](std::uint32_t body, std::uint32_t cell) {
    const Aabb local =
        volume_ == ContactVolume::kFfdAabb ? boxes_[body][cell] : Aabb{Vec3::Zero(), Vec3::Ones()};
    return cell_box(bodies_[body], cell, local, frame.bodies[body].nodes);
  };
  const CellBox a = box(pair.body_a, pair.a), b = box(pair.body_b, pair.b);
  probe_corners(a, b, true, pair, out);
  probe_corners(b, a, false, pair, out);
  return mean_of(b.corners) - mean_of(a.corners);
}

}  // namespace contactcheck
