#include "reference/compare/graded_judge.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "reference/compare/label_cover.h"
#include "reference/statistics/statistics.h"

namespace contactcheck {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

double angle_degrees(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegreesPerRadian;
}

// The last of the contacts from `first` on that have the same key.
template <typename Contacts, typename Key>
std::size_t end_of_group(const Contacts& contacts, std::size_t first, Key key) {
  std::size_t end = first + 1;
  while (end < contacts.size() && key(contacts[end]) == key(contacts[first])) ++end;
  return end;
}

bool shallower(const VertexContact& x, const VertexContact& y) { return x.depth < y.depth; }
std::vector<results::HistogramBin> bins_of(Histogram histogram, const std::vector<double>& errors) {
  for (double error : errors) histogram.add(error);
  return histogram.bins();
}

bool less_deep(const PieceContact& x, const PieceContact& y) { return x.depth < y.depth; }

}  // namespace

results::ErrorSpread spread_of(std::vector<double>& errors) {
  results::ErrorSpread out;
  out.judged = errors.size();
  if (errors.empty()) return out;
  std::sort(errors.begin(), errors.end());
  out.max = errors.back();
  out.mean =
      std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  out.p95 = quantile(errors, 0.95);
  return out;
}

GradedJudge::GradedJudge(const std::vector<Body>& bodies, const Semantics& semantics, double size)
    : bodies_(bodies), semantics_(semantics), size_(size) {}

bool GradedJudge::covers(const ContactSet& reported, const ElementPair& pair) const {
  if (semantics_.claims(Level::kTriangle))
    return std::binary_search(reported.triangles.begin(), reported.triangles.end(), pair);
  return covered_by_cells(bodies_, reported.cells, pair, [](std::size_t) {});
}

void GradedJudge::add_contour(const Truth& truth, const std::vector<double>& contour,
                              const ContactSet& reported) {
  double whole = 0.0, missed = 0.0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    whole += contour[i];
    if (contour[i] > 0.0 && !covers(reported, truth.surface.triangles[i])) missed += contour[i];
  }
  contour_ += whole;
  missed_ += missed;
  last_covered_.reset();
  if (whole > 0.0) last_covered_ = (whole - missed) / whole;
}

void GradedJudge::add_spurious(const Truth& truth, const ContactSet& reported,
                               const SurfaceGeometry& geometry) {
  std::vector<ElementPair> spurious;
  std::set_difference(reported.triangles.begin(), reported.triangles.end(),
                      truth.surface.triangles.begin(), truth.surface.triangles.end(),
                      std::back_inserter(spurious));
  for (const ElementPair& pair : spurious) {
    const double distance = geometry.triangle_distance(pair);
    spurious_distance_ = std::max(spurious_distance_.value_or(0.0), distance);
    spurious_distances_.add(distance);
  }
}

void GradedJudge::add_way_out(const WayOut& truth, double depth, const Vec3& normal) {
  depth_errors_.push_back(std::abs(depth - truth.depth));
  if (truth.depth < kNormalFloor * size_ || truth.directions.empty()) return;
  double nearest = 180.0;
  for (const Vec3& way : truth.directions) nearest = std::min(nearest, angle_degrees(normal, way));
  normal_errors_.push_back(nearest);
}

void GradedJudge::add_pieces(const ContactSet& reported, SurfaceGeometry& geometry) {
  const std::vector<PieceContact>& contacts = reported.piece_contacts;
  for (std::size_t i = 0, end = 0; i < contacts.size(); i = end) {
    end = end_of_group(contacts, i, [](const PieceContact& c) { return c.pieces; });
    const PieceContact& c =
        *std::max_element(contacts.begin() + static_cast<std::ptrdiff_t>(i),
                          contacts.begin() + static_cast<std::ptrdiff_t>(end), less_deep);
    const std::optional<WayOut> truth = semantics_.claims(Level::kTriangle)
                                            ? geometry.part_triangles(c.pieces)
                                            : geometry.part_boxes(c.pieces);
    if (truth) add_way_out(*truth, c.depth, c.normal);
  }
}

void GradedJudge::add_vertices(const Truth& truth, const ContactSet& reported,
                               const SurfaceGeometry& geometry) {
  const std::vector<VertexContact>& contacts = reported.vertex_contacts;
  const std::vector<VertexInBody>& inside = truth.surface.vertices;
  for (std::size_t i = 0, end = 0; i < contacts.size(); i = end) {
    end = end_of_group(contacts, i, [](const VertexContact& c) { return c.where; });
    if (!std::binary_search(inside.begin(), inside.end(), contacts[i].where)) continue;
    const VertexContact& c =
        *std::min_element(contacts.begin() + static_cast<std::ptrdiff_t>(i),
                          contacts.begin() + static_cast<std::ptrdiff_t>(end), shallower);
    add_way_out(geometry.vertex_to_surface(c.where), c.depth, c.normal);
  }
}

void GradedJudge::add_frame(const Truth& truth, const std::vector<double>& contour,
                            const ContactSet& reported, SurfaceGeometry& geometry) {
  if (semantics_.claims(Level::kTriangle) || semantics_.claims(Level::kCell))
    add_contour(truth, contour, reported);
  if (semantics_.claims(Level::kTriangle)) add_spurious(truth, reported, geometry);
  if (semantics_.depth == DepthKind::kConvexPair) add_pieces(reported, geometry);
  if (semantics_.depth == DepthKind::kVertexSurface) add_vertices(truth, reported, geometry);
}

results::Geometry GradedJudge::errors() {
  results::Geometry out;
  if (semantics_.claims(Level::kTriangle) || semantics_.claims(Level::kCell)) {
    out.missed_length = missed_;
    if (contour_ > 0.0) out.covered_length_fraction = (contour_ - missed_) / contour_;
  }
  if (semantics_.claims(Level::kTriangle))
    out.spurious_distance_max = spurious_distance_.value_or(0.0);
  out.spurious_distance_histogram = spurious_distances_.bins();
  out.depth = spread_of(depth_errors_);
  out.depth.histogram = bins_of(Histogram::of_lengths(), depth_errors_);
  out.normal_deg = spread_of(normal_errors_);
  out.normal_deg.histogram = bins_of(Histogram::of_angles(), normal_errors_);
  return out;
}

}  // namespace contactcheck
