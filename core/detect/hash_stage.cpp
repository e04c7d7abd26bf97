#include "core/detect/hash_stage.h"

#include <algorithm>
#include <array>

namespace contactcheck {
namespace {

std::uint32_t probe_count(const FfdStructure& model, CellVolume volume) {
  return static_cast<std::uint32_t>(volume == CellVolume::kFfdAabb
                                        ? 8 * model.pieces.size()
                                        : model.shape->lattice->nodes.size());
}

std::uint32_t probe_of_corner(const FfdStructure& model, CellVolume volume, std::uint32_t cell,
                              int corner) {
  return volume == CellVolume::kFfdAabb ? 8 * cell + static_cast<std::uint32_t>(corner)
                                        : model.shape->lattice->cell_nodes[cell][corner];
}

bool in_any_pair(const SphereSurvivors& survivors, std::uint32_t body) {
  for (std::uint32_t other = 0; other < survivors.bodies; ++other)
    if (survivors.active(body, other)) return true;
  return false;
}

// The finest spheres of a body that collide; asks whether a point lies strictly inside one.
template <typename T>
class ActiveSpheres {
 public:
  ActiveSpheres(const std::vector<SphereOf<T>>& spheres, const std::vector<char>& active) {
    for (std::size_t s = 0; s < active.size(); ++s)
      if (active[s]) balls_.push_back({spheres[s].center, spheres[s].radius * spheres[s].radius});
  }
  /// Begins with the sphere that held the last point: neighbouring points share one.
  bool hold(const Vec3Of<T>& p) {
    if (balls_.empty()) return false;
    if (holds(balls_[last_], p)) return true;
    for (std::size_t s = 0; s < balls_.size(); ++s) {
      if (!holds(balls_[s], p)) continue;
      last_ = s;
      return true;
    }
    return false;
  }

 private:
  struct Ball {
    Vec3Of<T> center;
    T radius2;
  };
  static bool holds(const Ball& ball, const Vec3Of<T>& p) {
    return squared_distance<T>(p, ball.center) < ball.radius2;
  }

  std::vector<Ball> balls_;
  std::size_t last_ = 0;
};

// Cells under one finest sphere; without a second level, all cells of the body.
std::span<const std::uint32_t> cells_of_sphere(const FfdStructure& model, const FfdConfig& config,
                                               std::uint32_t sphere) {
  if (config.sphere_levels < 2) return model.cells;
  return model.spheres.levels[config.sphere_levels - 1][sphere].cells;
}

template <typename T>
AabbOf<T> common_part(const AabbOf<T>& a, const AabbOf<T>& b) {
  return {a.lo.cwiseMax(b.lo), a.hi.cwiseMin(b.hi)};
}

}  // namespace

template <typename T>
Vec3Of<T> probe_position(const FfdStateOf<T>& state, CellVolume volume, std::uint32_t probe) {
  return volume == CellVolume::kFfdAabb ? state.corners[probe / 8][probe % 8] : state.nodes[probe];
}

template <typename T>
std::vector<std::vector<char>> ProbeHashStageOf<T>::active_probes(
    const FfdModels<T>& models, const FfdStates<T>& states, const FfdConfig& config,
    const SphereSurvivors& survivors) {
  std::vector<std::vector<char>> active;
  find_active_probes(models, states, config, survivors, active);
  return active;
}

template <typename T>
void ProbeHashStageOf<T>::find_active_probes(const FfdModels<T>& models, const FfdStates<T>& states,
                                             const FfdConfig& config,
                                             const SphereSurvivors& survivors,
                                             std::vector<std::vector<char>>& active) {
  active.resize(models.size());
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    const std::uint32_t probes = probe_count(models[body], config.volume);
    const bool in_pair = in_any_pair(survivors, body);
    active[body].assign(probes, in_pair);
    if (config.sphere_levels < 2 || !in_pair) continue;
    ActiveSpheres<T> spheres(states[body].spheres[config.sphere_levels - 1],
                             survivors.sphere_active[body]);
    for (std::uint32_t p = 0; p < probes; ++p)
      active[body][p] = spheres.hold(probe_position(states[body], config.volume, p));
  }
}

template <typename T>
void ProbeHashStageOf<T>::find_keys(const FfdStates<T>& states, CellVolume volume, T cell_size,
                                    const Vec3Of<T>& grid_offset) {
  keys_.resize(active_.size());
  for (std::size_t body = 0; body < active_.size(); ++body) {
    keys_[body].resize(active_[body].size());
    for (std::uint32_t probe = 0; probe < active_[body].size(); ++probe)
      if (active_[body][probe])
        keys_[body][probe] =
            grid_key<T>(probe_position(states[body], volume, probe) + grid_offset, cell_size);
  }
}

template <typename T>
void ProbeHashStageOf<T>::hash_boxes(const FfdModels<T>& models, const FfdConfig& config) {
  hash_.clear(config.table_size);
  boxes_.clear();
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    for (std::uint32_t cell : models[body].cells) {
      std::array<GridKey, 8> keys;
      std::size_t count = 0;
      for (int c = 0; c < 8; ++c) {
        const std::uint32_t probe = probe_of_corner(models[body], config.volume, cell, c);
        if (!active_[body][probe]) continue;
        const GridKey& key = keys_[body][probe];
        const auto end = keys.begin() + count;
        if (std::find(keys.begin(), end, key) != end) continue;  // a bucket holds the box once
        keys[count++] = key;
        hash_.insert(key, static_cast<std::uint32_t>(boxes_.size()));
      }
      if (count == 0) continue;
      boxes_.push_back({body, cell});
    }
  }
  hash_.build();
}

template <typename T>
void ProbeHashStageOf<T>::run(const FfdModels<T>& models, const FfdStates<T>& states,
                              const FfdConfig& config, const SphereSurvivors& survivors,
                              T cell_size, const Vec3Of<T>& grid_offset,
                              std::vector<ProbeHit>& out) {
  out.clear();
  if (survivors.body_pairs.empty()) return;
  find_active_probes(models, states, config, survivors, active_);
  find_keys(states, config.volume, cell_size, grid_offset);
  hash_boxes(models, config);
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    for (std::uint32_t probe = 0; probe < active_[body].size(); ++probe) {
      if (!active_[body][probe]) continue;
      hash_.for_each(keys_[body][probe], [&](std::uint32_t id) {
        const BoxId box = boxes_[id];
        if (survivors.active(body, box.body))  // with `own`, only boxes of the same body
          out.push_back({body, probe, box.body, box.cell});
      });
    }
  }
}

template <typename T>
std::vector<std::vector<char>> BoxHashStageOf<T>::active_cells(const FfdModels<T>& models,
                                                               const FfdConfig& config,
                                                               const SphereSurvivors& survivors) {
  std::vector<std::vector<char>> active(models.size());
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    const FfdModelOf<T>& model = models[body];
    active[body].assign(model.piece_begin.size() - 1, 0);
    if (!in_any_pair(survivors, body)) continue;
    if (config.sphere_levels < 2) {
      for (std::uint32_t cell : model.cells) active[body][cell] = 1;
      continue;
    }
    const auto& spheres = model.spheres.levels[config.sphere_levels - 1];
    for (std::size_t s = 0; s < spheres.size(); ++s)
      if (survivors.sphere_active[body][s])
        for (std::uint32_t cell : spheres[s].cells) active[body][cell] = 1;
  }
  return active;
}

// Where the cells under a sphere can meet those under a sphere it collides with: the common part of
// the bounds of both.
template <typename T>
void BoxHashStageOf<T>::find_regions(const FfdModels<T>& models, const FfdStates<T>& states,
                                     const FfdConfig& config, const SphereSurvivors& survivors) {
  groups_.resize(models.size());
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    const std::vector<char>& active = survivors.sphere_active[body];
    groups_[body].resize(active.size());
    for (std::uint32_t s = 0; s < active.size(); ++s) {
      Group& group = groups_[body][s];
      group.regions.clear();
      group.bounds = group.reach = AabbOf<T>{};
      if (!active[s]) continue;
      for (std::uint32_t cell : cells_of_sphere(models[body], config, s))
        group.bounds.extend(states[body].cell_box[cell]);
    }
  }
  for (const SpherePair& pair : survivors.sphere_pairs) {
    Group &a = groups_[pair.bodies.a][pair.a], &b = groups_[pair.bodies.b][pair.b];
    if (!a.bounds.overlaps(b.bounds)) continue;
    const AabbOf<T> common = common_part(a.bounds, b.bounds);
    for (Group* group : {&a, &b}) {
      group->regions.push_back(common);
      group->reach.extend(common);
    }
  }
}

template <typename T>
bool BoxHashStageOf<T>::Group::meets(const AabbOf<T>& box) const {
  return reach.overlaps(box) &&
         std::any_of(regions.begin(), regions.end(),
                     [&](const AabbOf<T>& region) { return region.overlaps(box); });
}

template <typename T>
void BoxHashStageOf<T>::collect_boxes(const FfdModels<T>& models, const FfdStates<T>& states,
                                      const FfdConfig& config) {
  boxes_.clear();
  for (std::uint32_t body = 0; body < models.size(); ++body)
    for (std::uint32_t s = 0; s < groups_[body].size(); ++s) {
      const Group& group = groups_[body][s];
      if (group.regions.empty()) continue;
      for (std::uint32_t cell : cells_of_sphere(models[body], config, s))
        if (group.meets(states[body].cell_box[cell]))
          boxes_.push_back({states[body].cell_box[cell], body, cell});
    }
}

template <typename T>
void BoxHashStageOf<T>::run(const FfdModels<T>& models, const FfdStates<T>& states,
                            const FfdConfig& config, const SphereSurvivors& survivors, T cell_size,
                            std::vector<ElementPair>& out) {
  out.clear();
  if (survivors.body_pairs.empty()) return;
  find_regions(models, states, config, survivors);
  collect_boxes(models, states, config);
  pairs_.clear();
  BoxPairSettings settings;
  settings.cell_size = cell_size;
  settings.table_size = config.table_size;
  settings.own = survivors.body_pairs.front().a == survivors.body_pairs.front().b;
  finder_.find(boxes_, settings, pairs_);
  for (const auto& [i, j] : pairs_) {
    const OwnedBoxOf<T>&a = boxes_[i], &b = boxes_[j];
    if (survivors.active(a.body, b.body)) out.push_back({a.body, b.body, a.cell, b.cell});
  }
}

template Vec3Of<double> probe_position(const FfdStateOf<double>&, CellVolume, std::uint32_t);
template Vec3Of<float> probe_position(const FfdStateOf<float>&, CellVolume, std::uint32_t);
template class ProbeHashStageOf<double>;
template class ProbeHashStageOf<float>;
template class BoxHashStageOf<double>;
template class BoxHashStageOf<float>;

}  // namespace contactcheck
