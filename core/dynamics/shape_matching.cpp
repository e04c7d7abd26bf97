#include "core/dynamics/shape_matching.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/polar_rotation.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

using Ids = std::vector<std::uint32_t>;

void sort_unique(Ids& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

std::vector<Ids> cells_of_nodes(const Lattice& lattice) {
  std::vector<Ids> out(lattice.nodes.size());
  for (std::uint32_t c = 0; c < lattice.cells.size(); ++c)
    for (std::uint32_t node : lattice.cell_nodes[c]) out[node].push_back(c);
  return out;
}

// The nodes of the cells that `cell` reaches over at most `steps` neighbours, ascending.
Ids nodes_within(const Lattice& lattice, const std::vector<Ids>& cells_of, std::uint32_t cell,
                 std::uint32_t steps) {
  Ids nodes(lattice.cell_nodes[cell].begin(), lattice.cell_nodes[cell].end());
  sort_unique(nodes);
  for (std::uint32_t i = 0; i < steps && nodes.size() < lattice.nodes.size(); ++i) {
    Ids wider;
    for (std::uint32_t node : nodes)
      for (std::uint32_t c : cells_of[node])
        wider.insert(wider.end(), lattice.cell_nodes[c].begin(), lattice.cell_nodes[c].end());
    sort_unique(wider);
    if (wider.size() == nodes.size()) break;  // a whole component of a body that is not connected
    nodes = std::move(wider);
  }
  return nodes;
}

std::vector<Ids> regions_of(const Lattice& lattice, std::uint32_t width) {
  if (width == 0) {
    Ids all(lattice.nodes.size());
    for (std::uint32_t n = 0; n < all.size(); ++n) all[n] = n;
    return {all};
  }
  const std::vector<Ids> cells_of = cells_of_nodes(lattice);
  std::vector<Ids> regions;
  for (std::uint32_t c = 0; c < lattice.cells.size(); ++c)
    regions.push_back(nodes_within(lattice, cells_of, c, width));
  return regions;
}

// A set of masses on a line has no inertia about it: it gets no spin, and so what it has of one is
// damped.
Vec3 spin_of(const Mat3& inertia, const Vec3& angular_momentum) {
  // Relative to the cube of the inertia: below it, the inverse would be made of rounding.
  constexpr double kLeastVolume = 1e-12;
  const Mat3 cofactor = cofactors(inertia);
  const double determinant = ordered_dot(inertia.col(0), cofactor.col(0));
  const double size = inertia.cwiseAbs().maxCoeff();
  if (!(determinant > kLeastVolume * size * size * size)) return Vec3::Zero();
  return transposed_product(cofactor, angular_momentum) / determinant;
}

}  // namespace

ShapeMatching::ShapeMatching(const Lattice& lattice, const Material& material)
    : relaxation_time_(material.relaxation_time),
      masses_(node_masses(lattice, material.mass)),
      region_shares_(lattice.nodes.size()),
      first_member_{0} {
  CONTACTCHECK_INVARIANT(relaxation_time_ > 0.0, "a goal is reached in time");
  const std::vector<Ids> regions = regions_of(lattice, material.region);
  std::vector<double> counts(lattice.nodes.size(), 0.0);
  for (const Ids& nodes : regions)
    for (std::uint32_t n : nodes) counts[n] += 1.0;
  for (std::size_t n = 0; n < counts.size(); ++n) region_shares_[n] = 1.0 / counts[n];
  const std::vector<Vec3> rest = lattice.rest_nodes();
  for (const Ids& nodes : regions) add_region(nodes, rest);
}

void ShapeMatching::add_region(const std::vector<std::uint32_t>& nodes,
                               const std::vector<Vec3>& rest) {
  double mass = 0.0;
  Vec3 moment = Vec3::Zero();
  for (std::uint32_t n : nodes) {
    members_.push_back({n, masses_[n] * region_shares_[n], rest[n] - rest[nodes.front()]});
    mass += members_.back().mass;
    moment += members_.back().rest * members_.back().mass;
  }
  const Vec3 center = moment / mass;
  for (std::size_t m = first_member_.back(); m < members_.size(); ++m) members_[m].rest -= center;
  first_member_.push_back(members_.size());
  region_masses_.push_back(mass);
}

std::span<const ShapeMatching::Member> ShapeMatching::members(std::size_t region) const {
  return std::span(members_).subspan(first_member_[region],
                                     first_member_[region + 1] - first_member_[region]);
}

ShapeMatching::Fit ShapeMatching::place(std::size_t region, std::span<const Vec3> positions) const {
  // Relative to one member, or a body far from the origin would lose digits.
  const Vec3 base = positions[members(region).front().node];
  Vec3 moment = Vec3::Zero();
  Mat3 covariance = Mat3::Zero();  // the rest places sum to zero: any base gives the same
  for (const Member& m : members(region)) {
    const Vec3 from_base = positions[m.node] - base;
    moment += from_base * m.mass;
    add_outer(covariance, m.mass, from_base, m.rest);
  }
  Fit fit;
  fit.center = base + moment / region_masses_[region];
  // Only NaN and infinity do not converge, and they reach the caller in the positions.
  fit.rotation = polar_rotation(covariance).rotation;
  return fit;
}

void ShapeMatching::add_motion(std::size_t region, const NodeState& state, Fit& fit) const {
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
  const Vec3 base = state.velocities[members(region).front().node];
  for (const Member& m : members(region)) {
    const Vec3 d = state.positions[m.node] - fit.center;
    const Vec3 velocity = state.velocities[m.node] - base;
    momentum += velocity * m.mass;
    angular += d.cross(velocity) * m.mass;
    add_outer(inertia, -m.mass, d, d);
    for (int k = 0; k < 3; ++k) inertia(k, k) += m.mass * ordered_dot(d, d);
  }
  fit.velocity = base + momentum / region_masses_[region];
  fit.spin = spin_of(inertia, angular);
}

void ShapeMatching::add_pulls(const NodeState& state, std::span<Pull> pulls) const {
  for (std::size_t region = 0; region < region_count(); ++region) {
    Fit fit = place(region, state.positions);
    add_motion(region, state, fit);
    for (const Member& m : members(region)) {
      const Vec3& p = state.positions[m.node];
      pulls[m.node].offset += fit.goal(m) - p;
      pulls[m.node].excess +=
          fit.velocity + fit.spin.cross(p - fit.center) - state.velocities[m.node];
    }
  }
}

void ShapeMatching::step(double dt, const Vec3& acceleration, NodeState& state) const {
  // Kept between steps, one per thread: a step allocates nothing.
  thread_local std::vector<Pull> pulls;
  pulls.assign(masses_.size(), Pull{Vec3::Zero(), Vec3::Zero()});
  for (std::size_t n = 0; n < masses_.size(); ++n)
    state.positions[n] += state.velocities[n] * (0.5 * dt);
  add_pulls(state, pulls);
  const double share = dt / (dt + relaxation_time_);
  const double of_offset = share * share / dt, of_excess = share * (2.0 - share);
  for (std::size_t n = 0; n < masses_.size(); ++n) {
    const Vec3 kick = pulls[n].offset * of_offset + pulls[n].excess * of_excess;
    state.velocities[n] += acceleration * dt + kick * region_shares_[n];
    state.positions[n] += state.velocities[n] * (0.5 * dt);
  }
}

double ShapeMatching::elastic_energy(std::span<const Vec3> positions) const {
  double sum = 0.0;
  for (std::size_t region = 0; region < region_count(); ++region) {
    const Fit fit = place(region, positions);
    for (const Member& m : members(region)) {
      const Vec3 offset = fit.goal(m) - positions[m.node];
      sum += m.mass * ordered_dot(offset, offset);
    }
  }
  return 0.5 * sum / (relaxation_time_ * relaxation_time_);
}

}  // namespace contactcheck
