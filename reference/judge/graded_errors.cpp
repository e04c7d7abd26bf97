#include "reference/judge/graded_errors.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>

#include "core/types/check.h"
#include "reference/judge/judge.h"
#include "reference/results/statistics.h"

namespace contactcheck::judge {
namespace {

double angle_degrees(const Vec3& a, const Vec3& b) {
  constexpr double kDegreesPerRadian = 57.29577951308232;
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegreesPerRadian;
}

// The end of the contacts from `first` on that have the same key.
template <typename Iterator, typename Key>
Iterator end_of_group(Iterator first, Iterator last, Key key) {
  return std::find_if(first, last, [&](const auto& c) { return !(key(c) == key(*first)); });
}

}  // namespace

const std::vector<double>& length_edges() {
  static const std::vector<double> edges = [] {
    constexpr int kLowestPower = -12, kHighestPower = 307;
    std::vector<double> out = {0.0};
    for (int power = kLowestPower; power <= kHighestPower; ++power)
      for (const int digit : {1, 2, 5}) {
        // The double next to the decimal number, in every locale.
        const std::string text = std::to_string(digit) + "e" + std::to_string(power);
        std::from_chars(text.data(), text.data() + text.size(), out.emplace_back());
      }
    out.push_back(std::numeric_limits<double>::max());
    return out;
  }();
  return edges;
}

const std::vector<double>& angle_edges() {
  static const std::vector<double> edges = [] {
    constexpr int kDegreesPerBin = 5, kMostDegrees = 180;
    std::vector<double> out;
    for (int degrees = 0; degrees <= kMostDegrees; degrees += kDegreesPerBin)
      out.push_back(degrees);
    return out;
  }();
  return edges;
}

std::vector<results::HistogramBin> histogram(const std::vector<double>& values,
                                             const std::vector<double>& edges) {
  std::vector<std::uint64_t> counts(edges.size() - 1, 0);
  for (const double value : values) {
    CONTACTCHECK_INVARIANT(value >= 0, "an error has a size");
    const auto above = std::upper_bound(edges.begin(), edges.end(), value);
    const auto bin = static_cast<std::size_t>(above - edges.begin()) - 1;
    ++counts[std::min(bin, counts.size() - 1)];
  }
  std::vector<results::HistogramBin> out;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) out.push_back({edges[i], edges[i + 1], counts[i]});
  return out;
}

results::ErrorSpread spread_of(std::vector<double>& errors) {
  results::ErrorSpread out;
  out.judged = errors.size();
  if (errors.empty()) return out;
  std::sort(errors.begin(), errors.end());
  out.max = errors.back();
  out.mean =
      std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  out.p95 = results::quantile(errors, 0.95);
  return out;
}

void GradedErrors::add_depth(const oracle::Penetration& truth, double depth, const Vec3& normal) {
  depth_errors_.push_back(std::abs(depth - truth.depth));
  if (truth.depth < kNormalFloor * size_ || truth.directions.empty()) return;
  double nearest = 180.0;
  for (const Vec3& out : truth.directions) nearest = std::min(nearest, angle_degrees(normal, out));
  normal_errors_.push_back(nearest);
}

std::optional<double> GradedErrors::add_frame(const oracle::Truth& truth,
                                              const std::vector<double>& contour,
                                              const ContactSet& reported,
                                              oracle::SurfaceGeometry& geometry) {
  const bool of_triangles = semantics_.claims(Level::kTriangle);
  const std::vector<ElementPair>& true_pairs = truth.surface.triangles;
  const auto shallower = [](const auto& x, const auto& y) { return x.depth < y.depth; };

  std::optional<double> covered;
  if (of_triangles || semantics_.claims(Level::kCell)) {
    double whole = 0.0, missed = 0.0;
    for (std::size_t i = 0; i < contour.size(); ++i) {
      whole += contour[i];
      if (!(contour[i] > 0.0)) continue;
      const bool found = of_triangles ? std::binary_search(reported.triangles.begin(),
                                                           reported.triangles.end(), true_pairs[i])
                                      : covered_by_cells(bodies_, reported.cells, true_pairs[i]);
      if (!found) missed += contour[i];
    }
    contour_ += whole;
    missed_ += missed;
    if (whole > 0.0) covered = (whole - missed) / whole;
  }

  if (of_triangles) {
    std::vector<ElementPair> spurious;
    std::set_difference(reported.triangles.begin(), reported.triangles.end(), true_pairs.begin(),
                        true_pairs.end(), std::back_inserter(spurious));
    for (const ElementPair& pair : spurious)
      spurious_distances_.push_back(geometry.triangle_distance(pair));
  }

  if (semantics_.depth == DepthKind::kConvexPair) {
    const std::vector<PieceContact>& contacts = reported.piece_contacts;
    for (auto it = contacts.begin(), end = it; it != contacts.end(); it = end) {
      end = end_of_group(it, contacts.end(), [](const PieceContact& c) { return c.pieces; });
      const PieceContact& deepest = *std::max_element(it, end, shallower);
      const std::optional<oracle::Penetration> penetration =
          of_triangles ? geometry.triangle_penetration(deepest.pieces)
                       : geometry.box_penetration(deepest.pieces);
      if (penetration) add_depth(*penetration, deepest.depth, deepest.normal);
    }
  }

  if (semantics_.depth == DepthKind::kVertexSurface) {
    const std::vector<VertexContact>& contacts = reported.vertex_contacts;
    const std::vector<VertexInBody>& inside = truth.surface.vertices;
    for (auto it = contacts.begin(), end = it; it != contacts.end(); it = end) {
      end = end_of_group(it, contacts.end(), [](const VertexContact& c) { return c.where; });
      if (!std::binary_search(inside.begin(), inside.end(), it->where)) continue;
      const VertexContact& shallowest = *std::min_element(it, end, shallower);
      add_depth(geometry.vertex_to_surface(shallowest.where), shallowest.depth, shallowest.normal);
    }
  }
  return covered;
}

results::Geometry GradedErrors::summary() {
  results::Geometry out;
  if (semantics_.claims(Level::kTriangle) || semantics_.claims(Level::kCell)) {
    out.missed_length = missed_;
    if (contour_ > 0.0) out.covered_length_fraction = (contour_ - missed_) / contour_;
  }
  if (semantics_.claims(Level::kTriangle)) {
    out.spurious_distance_max = 0.0;
    for (const double distance : spurious_distances_)
      out.spurious_distance_max = std::max(*out.spurious_distance_max, distance);
  }
  out.spurious_distance_histogram = histogram(spurious_distances_, length_edges());
  out.depth = spread_of(depth_errors_);
  out.depth.histogram = histogram(depth_errors_, length_edges());
  out.normal_deg = spread_of(normal_errors_);
  out.normal_deg.histogram = histogram(normal_errors_, angle_edges());
  return out;
}

}  // namespace contactcheck::judge
