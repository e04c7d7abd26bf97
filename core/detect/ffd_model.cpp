#include "core/detect/ffd_model.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "core/broad/sphere.h"
#include "core/deform/ffd_aabb.h"
#include "core/types/check.h"
#include "core/types/count.h"

namespace contactcheck {
namespace {

Aabb unit_box() { return {Vec3::Zero(), Vec3::Ones()}; }

// Turns (row, value) pairs, given in ascending order of value per row, into rows.
Rows make_rows(std::size_t rows,
               const std::vector<std::pair<std::uint32_t, std::uint32_t>>& items) {
  in_32_bits<RefusedInput>(items.size(), "items of cells or nodes");
  Rows out;
  out.begin.assign(rows + 1, 0);
  for (const auto& [row, value] : items) ++out.begin[row + 1];
  std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
  out.values.resize(items.size());
  std::vector<std::uint32_t> next(out.begin.begin(), out.begin.end() - 1);
  for (const auto& [row, value] : items) out.values[next[row]++] = value;
  return out;
}

std::uint32_t owner_of(const Triangle& t, const std::vector<std::uint32_t>& home) {
  const std::uint32_t a = home[t[0]], b = home[t[1]], c = home[t[2]];
  return b == c ? b : a;
}

// The bounds of the vertices of one owner's triangles, per home cell.
void add_safe_pieces(const BodyShape& shape, CellVolume volume, std::uint32_t cell,
                     FfdModel& model) {
  const std::size_t first = model.pieces.size();
  for (std::uint32_t t : model.triangles.row(cell)) {
    for (std::uint32_t v : shape.mesh.triangles[t]) {
      const std::uint32_t home = shape.embedding.home_cell[v];
      auto piece = std::find_if(model.pieces.begin() + first, model.pieces.end(),
                                [&](const FfdPiece& p) { return p.home == home; });
      if (piece == model.pieces.end()) {
        piece = model.pieces.insert(piece, {cell, home, Aabb{}});
        if (volume == CellVolume::kLatticeCell) piece->local = unit_box();
      }
      piece->local.extend(shape.embedding.local[v]);
    }
  }
}

void index_pieces(std::size_t kept, FfdModel& model) {
  // As many as probes: eight corners each (hash_stage.h).
  in_32_bits<RefusedInput>(8 * model.pieces.size(), "corners of the boxes of cells");
  model.piece_begin.assign(kept + 1, 0);
  for (const FfdPiece& p : model.pieces) {
    ++model.piece_begin[p.cell + 1];
    model.piece_boxes.push_back({p.home, p.local});
  }
  std::partial_sum(model.piece_begin.begin(), model.piece_begin.end(), model.piece_begin.begin());
  for (std::uint32_t cell = 0; cell < kept; ++cell)
    if (model.piece_begin[cell] < model.piece_begin[cell + 1]) model.cells.push_back(cell);
}

double mean_edge_of(const std::vector<Corners>& boxes) {
  double sum = 0.0;
  for (const Corners& box : boxes)
    for (int c = 0; c < 8; ++c)
      for (int axis = 1; axis <= 4; axis *= 2)
        if (!(c & axis)) sum += (box[c | axis] - box[c]).norm();
  return boxes.empty() ? 0.0 : sum / (12.0 * static_cast<double>(boxes.size()));
}

// The mean edge of the boxes that the safe reading hashes, one per owner round all its pieces. (The
// pieces' own edges are far shorter, and would make every box meet hundreds of buckets.)
double mean_owner_edge(const FfdModel& model, const std::vector<Corners>& corners) {
  double sum = 0.0;
  for (std::uint32_t cell : model.cells) {
    Aabb box;
    for (std::uint32_t p = model.piece_begin[cell]; p < model.piece_begin[cell + 1]; ++p)
      for (const Vec3& corner : corners[p]) box.extend(corner);
    sum += box.extent().sum();
  }
  return model.cells.empty() ? 0.0 : sum / (3.0 * static_cast<double>(model.cells.size()));
}

double rest_radius(const FfdModel& model, const std::vector<Corners>& corners,
                   const SphereNode& sphere, const Vec3& center) {
  double radius = 0.0;
  for (std::uint32_t cell : sphere.cells)
    for (std::uint32_t p = model.piece_begin[cell]; p < model.piece_begin[cell + 1]; ++p)
      radius = std::max(radius, covering_radius(center, corners[p], 0.0));
  return radius;
}

void measure_spheres(const std::vector<Corners>& corners, FfdModel& model) {
  Aabb box;
  for (const Corners& c : corners)
    for (const Vec3& p : c) box.extend(p);
  for (std::size_t level = 0; level < model.spheres.levels.size(); ++level) {
    std::vector<double> radii;
    for (const SphereNode& sphere : model.spheres.levels[level]) {
      const Vec3 center =
          level == 0 ? box.center() : model.shape->lattice->rest_node(sphere.center_node);
      radii.push_back(rest_radius(model, corners, sphere, center));
    }
    model.rest_radius.push_back(std::move(radii));
  }
}

}  // namespace

FfdModelOf<float> rounded_model(FfdModel model) {
  // Infinite beyond the range of floats, where a conversion is not defined.
  const auto single = [](double x) {
    return x > std::numeric_limits<float>::max() ? std::numeric_limits<float>::infinity()
                                                 : static_cast<float>(x);
  };
  FfdModelOf<float> out;
  for (const LocalBox& box : model.piece_boxes)
    out.piece_boxes.push_back({box.home, {box.local.lo.cast<float>(), box.local.hi.cast<float>()}});
  for (const std::vector<double>& level : model.rest_radius)
    std::transform(level.begin(), level.end(), std::back_inserter(out.rest_radius.emplace_back()),
                   single);
  static_cast<FfdStructure&>(out) = std::move(model);
  return out;
}

FfdModel make_ffd_model(const BodyShape& shape, const FfdConfig& config) {
  if (!shape.lattice) throw RefusedInput("the FFD-AABB family needs a lattice for every body");
  FfdModel model;
  model.shape = &shape;
  const Lattice& lattice = *shape.lattice;
  const std::size_t kept = lattice.cells.size();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cell_triangles, node_cells;
  if (config.bounds == BoundsReading::kSafe) {
    for (std::uint32_t t = 0; t < shape.mesh.triangles.size(); ++t) {
      model.owner.push_back(owner_of(shape.mesh.triangles[t], shape.embedding.home_cell));
      cell_triangles.emplace_back(model.owner.back(), t);
    }
    model.triangles = make_rows(kept, cell_triangles);
    for (std::uint32_t cell = 0; cell < kept; ++cell)
      add_safe_pieces(shape, config.volume, cell, model);
  } else {
    for (std::uint32_t t = 0; t < shape.mesh.triangles.size(); ++t)
      for (std::uint32_t cell : shape.embedding.cells_of_triangle(t))
        cell_triangles.emplace_back(cell, t);
    model.triangles = make_rows(kept, cell_triangles);
    const std::vector<Aabb> boxes = config.volume == CellVolume::kFfdAabb
                                        ? ffd_aabbs(shape.mesh, lattice, shape.embedding)
                                        : std::vector<Aabb>(kept, unit_box());
    for (std::uint32_t cell = 0; cell < kept; ++cell)
      model.pieces.push_back({cell, cell, boxes[cell]});
  }
  index_pieces(kept, model);
  for (std::uint32_t cell = 0; cell < kept; ++cell)
    for (std::uint32_t node : lattice.cell_nodes[cell]) node_cells.emplace_back(node, cell);
  model.node_cells = make_rows(lattice.nodes.size(), node_cells);
  std::vector<Corners> corners(model.pieces.size());
  map_boxes(lattice, model.piece_boxes, lattice.rest_nodes(), corners);
  model.mean_edge = config.bounds == BoundsReading::kSafe ? mean_owner_edge(model, corners)
                                                          : mean_edge_of(corners);
  if (config.sphere_levels > 0) {
    model.spheres = make_sphere_tree(lattice, model.cells, config.sphere_levels, config.spheres);
    measure_spheres(corners, model);
  }
  return model;
}

}  // namespace contactcheck
