#include "core/dynamics/simulation.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/types/borrowed_arena.h"
#include "core/types/check.h"
#include "core/types/shortest.h"

namespace contactcheck {
namespace {

// Metres, and metres per second, far beyond any scene. NaN is not below it either.
constexpr double kFarthest = 1e9;

bool sane(const Vec3& v) { return v.cwiseAbs().maxCoeff() < kFarthest && !v.hasNaN(); }

// Bodies do not touch one another's state, so the order they are visited in is of no consequence.
template <typename Work>
void for_bodies(std::uint32_t threads, std::size_t bodies, const Work& work) {
  if (threads <= 1) {
    for (std::size_t b = 0; b < bodies; ++b) work(b);
    return;
  }
  BorrowedArena arena(static_cast<int>(threads));
  arena->execute([&] { tbb::parallel_for(std::size_t{0}, bodies, work); });
}

}  // namespace

Simulation::Simulation(const std::vector<Body>& bodies,
                       std::vector<std::optional<Material>> materials,
                       const SimulationSettings& settings, std::vector<NodeState> start)
    : bodies_(bodies),
      materials_(std::move(materials)),
      settings_(settings),
      state_{std::move(start), {}, 0} {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    deformables_.push_back(materials_[b] ? make_deformable(*bodies_[b].shape, *materials_[b])
                                         : nullptr);
    if (deformables_[b]) choose_substeps(b);
  }
  check_state();
}

void Simulation::choose_substeps(std::size_t body) {
  const double stable = deformables_[body]->stable_step();
  const double needed = std::max(1.0, std::ceil(settings_.time_step / stable));
  constexpr double kMost = 10'000.0;
  if (needed > std::min(kMost, settings_.substeps ? settings_.substeps : kMost)) {
    throw InputError(
        "body \"" + bodies_[body].name + "\" is too stiff for its mass: " + shortest(stable) +
        " s is the longest stable step, the scene allows " +
        shortest(settings_.time_step / (settings_.substeps ? settings_.substeps : kMost)) + " s.");
  }
  substeps_ = std::max({static_cast<std::uint32_t>(needed), settings_.substeps, substeps_});
}

void Simulation::advance() {
  const double dt = settings_.time_step / substeps_;
  std::vector<ResponseBody> movers = response_bodies();
  for (std::uint32_t i = 0; i < substeps_; ++i) {
    for_bodies(settings_.threads, bodies_.size(),
               [&](std::size_t b) { advance_body(b, dt, movers[b]); });
    if (!state_.held.empty()) state_.held.stop_approach(movers);
  }
  ++state_.steps;
  check_state();
}

void Simulation::advance_body(std::size_t body, double dt, ResponseBody& mover) {
  if (!deformables_[body]) return;
  deformables_[body]->step(dt, settings_.gravity, state_.bodies[body]);
  if (settings_.ground) answer_ground(body, mover);
}

void Simulation::answer_ground(std::size_t body, ResponseBody& mover) {
  const BodyShape& shape = *bodies_[body].shape;
  const std::vector<std::uint32_t> below =
      vertices_in_ground(shape, state_.bodies[body].positions, *settings_.ground);
  if (!below.empty()) respond_to_ground(shape, below, *settings_.ground, settings_.response, mover);
}

ResponseBody Simulation::response_body(std::size_t body) {
  ResponseBody out;
  out.state = &state_.bodies[body];
  if (!deformables_[body]) return out;
  out.masses = deformables_[body]->masses();
  out.restitution = materials_[body]->restitution;
  out.friction = materials_[body]->friction;
  return out;
}

std::vector<ResponseBody> Simulation::response_bodies() {
  std::vector<ResponseBody> out;
  for (std::size_t b = 0; b < bodies_.size(); ++b) out.push_back(response_body(b));
  return out;
}

void Simulation::respond(std::vector<ContactPoint> points) {
  std::vector<ResponseBody> movers = response_bodies();
  respond_to_contacts(points, settings_.response, movers);
  state_.held.hold(std::move(points), movers);
}

void Simulation::check_state() const {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (std::size_t n = 0; n < state_.bodies[b].positions.size(); ++n)
      if (!sane(state_.bodies[b].positions[n]) || !sane(state_.bodies[b].velocities[n]))
        throw Diverged("the simulation diverged: body \"" + bodies_[b].name + "\", node " +
                       std::to_string(n) + ", step " + std::to_string(state_.steps) + ".");
}

Energy Simulation::energy() const {
  Energy out;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!deformables_[b]) continue;
    const std::span<const double> masses = deformables_[b]->masses();
    for (std::size_t n = 0; n < masses.size(); ++n) {
      out.kinetic += 0.5 * masses[n] * state_.bodies[b].velocities[n].squaredNorm();
      out.potential -= masses[n] * settings_.gravity.dot(state_.bodies[b].positions[n]);
    }
    out.elastic += deformables_[b]->elastic_energy(state_.bodies[b].positions);
  }
  return out;
}

Vec3 Simulation::momentum() const {
  Vec3 out = Vec3::Zero();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!deformables_[b]) continue;
    const std::span<const double> masses = deformables_[b]->masses();
    for (std::size_t n = 0; n < masses.size(); ++n)
      out += masses[n] * state_.bodies[b].velocities[n];
  }
  return out;
}

}  // namespace contactcheck
