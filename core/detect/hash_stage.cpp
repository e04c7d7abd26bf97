#include "core/detect/hash_stage.h"

#include <algorithm>
#include <array>

namespace contactcheck {
namespace {

std::uint32_t probe_count(const FfdModel& model, CellVolume volume) {
  return static_cast<std::uint32_t>(volume == CellVolume::kFfdAabb
                                        ? 8 * model.pieces.size()
                                        : model.shape->lattice->nodes.size());
}

std::uint32_t probe_of_corner(const FfdModel& model, CellVolume volume, std::uint32_t cell,
                              int corner) {
  return volume == CellVolume::kFfdAabb ? 8 * cell + static_cast<std::uint32_t>(corner)
                                        : model.shape->lattice->cell_nodes[cell][corner];
}

bool in_any_pair(const SphereSurvivors& survivors, std::uint32_t body) {
  for (std::uint32_t other = 0; other < survivors.bodies; ++other)
    if (survivors.active(body, other)) return true;
  return false;
}

bool inside_active_sphere(const FfdState& state, const std::vector<char>& sphere_active,
                          std::size_t level, const Vec3& p) {
  for (std::size_t s = 0; s < sphere_active.size(); ++s) {
    if (!sphere_active[s]) continue;
    const Sphere& sphere = state.spheres[level][s];
    if ((p - sphere.center).norm() < sphere.radius) return true;
  }
  return false;
}

}  // namespace

Vec3 probe_position(const FfdState& state, CellVolume volume, std::uint32_t probe) {
  return volume == CellVolume::kFfdAabb ? state.corners[probe / 8][probe % 8] : state.nodes[probe];
}

std::vector<std::vector<char>> ProbeHashStage::active_probes(const std::vector<FfdModel>& models,
                                                             const std::vector<FfdState>& states,
                                                             const FfdConfig& config,
                                                             const SphereSurvivors& survivors) {
  std::vector<std::vector<char>> active(models.size());
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    const std::uint32_t probes = probe_count(models[body], config.volume);
    active[body].assign(probes, in_any_pair(survivors, body));
    if (config.sphere_levels < 2 || !in_any_pair(survivors, body)) continue;
    for (std::uint32_t p = 0; p < probes; ++p) {
      active[body][p] = inside_active_sphere(states[body], survivors.sphere_active[body],
                                             config.sphere_levels - 1,
                                             probe_position(states[body], config.volume, p));
    }
  }
  return active;
}

void ProbeHashStage::hash_boxes(const std::vector<FfdModel>& models,
                                const std::vector<FfdState>& states, const FfdConfig& config,
                                const std::vector<std::vector<char>>& active, double cell_size) {
  hash_ = SpatialHash(config.table_size);
  boxes_.clear();
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    for (std::uint32_t cell : models[body].cells) {
      std::array<GridKey, 8> keys;
      std::size_t count = 0;
      for (int c = 0; c < 8; ++c) {
        const std::uint32_t probe = probe_of_corner(models[body], config.volume, cell, c);
        if (!active[body][probe]) continue;
        keys[count++] = grid_key(probe_position(states[body], config.volume, probe), cell_size);
      }
      if (count == 0) continue;
      std::sort(keys.begin(), keys.begin() + count);
      const auto end = std::unique(keys.begin(), keys.begin() + count);
      for (auto key = keys.begin(); key != end; ++key)
        hash_.insert(*key, static_cast<std::uint32_t>(boxes_.size()));
      boxes_.push_back({body, cell});
    }
  }
  hash_.build();
}

void ProbeHashStage::run(const std::vector<FfdModel>& models, const std::vector<FfdState>& states,
                         const FfdConfig& config, const SphereSurvivors& survivors,
                         double cell_size, std::vector<ProbeHit>& out) {
  out.clear();
  if (survivors.body_pairs.empty()) return;
  const auto active = active_probes(models, states, config, survivors);
  hash_boxes(models, states, config, active, cell_size);
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    for (std::uint32_t probe = 0; probe < active[body].size(); ++probe) {
      if (!active[body][probe]) continue;
      const Vec3 p = probe_position(states[body], config.volume, probe);
      hash_.for_each(grid_key(p, cell_size), [&](std::uint32_t id) {
        const BoxId box = boxes_[id];
        if (box.body != body && survivors.active(body, box.body))
          out.push_back({body, probe, box.body, box.cell});
      });
    }
  }
}

std::vector<std::vector<char>> BoxHashStage::active_cells(const std::vector<FfdModel>& models,
                                                          const FfdConfig& config,
                                                          const SphereSurvivors& survivors) {
  std::vector<std::vector<char>> active(models.size());
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    const FfdModel& model = models[body];
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

void BoxHashStage::run(const std::vector<FfdModel>& models, const std::vector<FfdState>& states,
                       const FfdConfig& config, const SphereSurvivors& survivors, double cell_size,
                       std::vector<ElementPair>& out) {
  out.clear();
  if (survivors.body_pairs.empty()) return;
  const auto active = active_cells(models, config, survivors);
  boxes_.clear();
  for (std::uint32_t body = 0; body < models.size(); ++body)
    for (std::uint32_t cell : models[body].cells)
      if (active[body][cell]) boxes_.push_back({states[body].cell_box[cell], body, cell});
  pairs_.clear();
  BoxPairSettings settings;
  settings.cell_size = cell_size;
  settings.table_size = config.table_size;
  settings.fault_bucket_scale = config.faults.buckets;
  finder_.find(boxes_, settings, pairs_);
  for (const auto& [i, j] : pairs_) {
    const OwnedBox &a = boxes_[i], &b = boxes_[j];
    if (survivors.active(a.body, b.body)) out.push_back({a.body, b.body, a.cell, b.cell});
  }
}

}  // namespace contactcheck
