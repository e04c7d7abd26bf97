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

// The finest spheres of a body that collide; asks whether a point lies strictly inside one.
class ActiveSpheres {
 public:
  ActiveSpheres(const std::vector<Sphere>& spheres, const std::vector<char>& active) {
    for (std::size_t s = 0; s < active.size(); ++s)
      if (active[s]) spheres_.push_back(spheres[s]);
  }
  /// Begins with the sphere that held the last point: neighbouring points share one.
  bool hold(const Vec3& p) {
    if (spheres_.empty()) return false;
    if (holds(spheres_[last_], p)) return true;
    for (std::size_t s = 0; s < spheres_.size(); ++s) {
      if (!holds(spheres_[s], p)) continue;
      last_ = s;
      return true;
    }
    return false;
  }

 private:
  static bool holds(const Sphere& sphere, const Vec3& p) {
    return (p - sphere.center).norm() < sphere.radius;
  }

  std::vector<Sphere> spheres_;
  std::size_t last_ = 0;
};

// The parts of space where a body can meet its partners: the common parts of their boxes.
using Regions = std::vector<std::vector<Aabb>>;

void find_regions(const std::vector<FfdState>& states,
                  const std::vector<std::vector<char>>& active_cells,
                  const SphereSurvivors& survivors, Regions& out) {
  std::vector<Aabb> bounds(states.size());
  for (std::size_t body = 0; body < states.size(); ++body)
    for (std::size_t cell = 0; cell < active_cells[body].size(); ++cell)
      if (active_cells[body][cell]) bounds[body].extend(states[body].cell_box[cell]);
  out.resize(states.size());
  for (std::vector<Aabb>& regions : out) regions.clear();
  for (const BodyPair& pair : survivors.body_pairs) {
    if (!bounds[pair.a].overlaps(bounds[pair.b])) continue;
    const Aabb common{bounds[pair.a].lo.cwiseMax(bounds[pair.b].lo),
                      bounds[pair.a].hi.cwiseMin(bounds[pair.b].hi)};
    out[pair.a].push_back(common);
    out[pair.b].push_back(common);
  }
}

bool meets_any(const std::vector<Aabb>& regions, const Aabb& box) {
  return std::any_of(regions.begin(), regions.end(),
                     [&](const Aabb& region) { return region.overlaps(box); });
}

}  // namespace

Vec3 probe_position(const FfdState& state, CellVolume volume, std::uint32_t probe) {
  return volume == CellVolume::kFfdAabb ? state.corners[probe / 8][probe % 8] : state.nodes[probe];
}

std::vector<std::vector<char>> ProbeHashStage::active_probes(const std::vector<FfdModel>& models,
                                                             const std::vector<FfdState>& states,
                                                             const FfdConfig& config,
                                                             const SphereSurvivors& survivors) {
  std::vector<std::vector<char>> active;
  find_active_probes(models, states, config, survivors, active);
  return active;
}

void ProbeHashStage::find_active_probes(const std::vector<FfdModel>& models,
                                        const std::vector<FfdState>& states,
                                        const FfdConfig& config, const SphereSurvivors& survivors,
                                        std::vector<std::vector<char>>& active) {
  active.resize(models.size());
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    const std::uint32_t probes = probe_count(models[body], config.volume);
    const bool in_pair = in_any_pair(survivors, body);
    active[body].assign(probes, in_pair);
    if (config.sphere_levels < 2 || !in_pair) continue;
    ActiveSpheres spheres(states[body].spheres[config.sphere_levels - 1],
                          survivors.sphere_active[body]);
    for (std::uint32_t p = 0; p < probes; ++p)
      active[body][p] = spheres.hold(probe_position(states[body], config.volume, p));
  }
}

void ProbeHashStage::find_keys(const std::vector<FfdState>& states, CellVolume volume,
                               double cell_size) {
  keys_.resize(active_.size());
  for (std::size_t body = 0; body < active_.size(); ++body) {
    keys_[body].resize(active_[body].size());
    for (std::uint32_t probe = 0; probe < active_[body].size(); ++probe)
      if (active_[body][probe])
        keys_[body][probe] = grid_key(probe_position(states[body], volume, probe), cell_size);
  }
}

void ProbeHashStage::hash_boxes(const std::vector<FfdModel>& models, const FfdConfig& config) {
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

void ProbeHashStage::run(const std::vector<FfdModel>& models, const std::vector<FfdState>& states,
                         const FfdConfig& config, const SphereSurvivors& survivors,
                         double cell_size, std::vector<ProbeHit>& out) {
  out.clear();
  if (survivors.body_pairs.empty()) return;
  find_active_probes(models, states, config, survivors, active_);
  find_keys(states, config.volume, cell_size);
  hash_boxes(models, config);
  for (std::uint32_t body = 0; body < models.size(); ++body) {
    for (std::uint32_t probe = 0; probe < active_[body].size(); ++probe) {
      if (!active_[body][probe]) continue;
      hash_.for_each(keys_[body][probe], [&](std::uint32_t id) {
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
  find_regions(states, active, survivors, regions_);
  boxes_.clear();
  for (std::uint32_t body = 0; body < models.size(); ++body)
    for (std::uint32_t cell : models[body].cells)
      if (active[body][cell] && meets_any(regions_[body], states[body].cell_box[cell]))
        boxes_.push_back({states[body].cell_box[cell], body, cell});
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
