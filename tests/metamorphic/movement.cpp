#include "tests/metamorphic/movement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

#include "core/deform/node_shape.h"
#include "core/types/hash.h"

namespace contactcheck::test {
namespace {

using Positions = std::vector<std::vector<Vec3>>;  // per body

constexpr int kDigits = 53;
constexpr int kLargestExponent = 1023, kSmallestExponent = -1074;

// So that frames take different turns, the same ones in every run.
std::uint64_t number_of(const std::string& label) {
  Fnv1a hash;
  hash.bytes(label.data(), label.size());
  return hash.digest();
}

template <typename Change>
Positions changed(Positions positions, Change change) {
  for (std::vector<Vec3>& body : positions)
    for (Vec3& p : body) p = change(p);
  return positions;
}

double largest_coordinate(const Positions& positions) {
  double largest = 0.0;
  for (const std::vector<Vec3>& body : positions)
    for (const Vec3& p : body) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

bool finite(const Positions& positions) { return std::isfinite(largest_coordinate(positions)); }

// Every coordinate is below 2 to this power. Of a scene in one point, the origin: any.
int exponent_above(const Positions& positions) {
  const double largest = largest_coordinate(positions);
  return largest > 0.0 ? std::ilogb(largest) + 1 : 0;
}

// The exponent of the last binary digit that any coordinate has.
int lowest_bit(const Positions& positions) {
  int lowest = kLargestExponent;
  const auto look_at = [&](double value) {
    if (value == 0.0) return;
    int exponent = 0;
    const auto digits = std::llabs(std::llrint(std::ldexp(std::frexp(value, &exponent), kDigits)));
    lowest =
        std::min(lowest, exponent - kDigits + std::countr_zero(static_cast<std::uint64_t>(digits)));
  };
  for (const std::vector<Vec3>& body : positions)
    for (const Vec3& p : body)
      for (int k = 0; k < 3; ++k) look_at(p[k]);
  return lowest;
}

Vec3 times_power(const Vec3& p, int exponent) {
  return {std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent)};
}

// Scaling back gives the same bits, so none was lost.
std::optional<Positions> scaled_positions(const Positions& positions, int exponent) {
  Positions out = changed(positions, [&](const Vec3& p) { return times_power(p, exponent); });
  const bool exact = finite(out) && changed(out, [&](const Vec3& p) {
                                      return times_power(p, -exponent);
                                    }) == positions;
  return exact ? std::optional(std::move(out)) : std::nullopt;
}

// The mapping has sums and products on the way that may leave the range where vertices do not.
std::optional<FrameData> scaled_frame(const std::vector<Body>& bodies, const FrameData& frame,
                                      int exponent) {
  const auto nodes = scaled_positions(frame.nodes, exponent);
  const auto vertices = scaled_positions(frame.vertices, exponent);
  if (!nodes || !vertices) return std::nullopt;
  FrameData mapped = make_frame(bodies, *nodes);
  return mapped.vertices == *vertices ? std::optional(std::move(mapped)) : std::nullopt;
}

// With the same vertices welded.
std::shared_ptr<const BodyShape> welded_as(const BodyShape& shape,
                                           std::shared_ptr<const BodyShape> moved) {
  if (shape.welded.empty()) return moved;
  auto out = std::make_shared<BodyShape>(*moved);
  out->welded = shape.welded;
  return out;
}

std::shared_ptr<const BodyShape> scaled_shape(const BodyShape& shape, int exponent) {
  TriangleMesh mesh = shape.mesh;
  for (Vec3& v : mesh.vertices) v = times_power(v, exponent);
  if (!shape.lattice) return welded_as(shape, make_bare_shape(std::move(mesh)));
  std::array<std::vector<double>, 3> lines = shape.lattice->lines;
  for (std::vector<double>& axis : lines)
    for (double& line : axis) line = std::ldexp(line, exponent);
  return welded_as(shape, make_shape_on_lines(std::move(mesh), std::move(lines)));
}

std::vector<Body> scaled_bodies(const std::vector<Body>& bodies, int exponent) {
  std::map<const BodyShape*, std::shared_ptr<const BodyShape>> made;
  std::vector<Body> out;
  for (const Body& body : bodies) {
    auto& shape = made[body.shape.get()];
    if (!shape) shape = scaled_shape(*body.shape, exponent);
    out.push_back({body.name, shape});
  }
  return out;
}

// `change(f)` gives the frame f in its new positions.
template <typename Change>
Variant with_frames(std::shared_ptr<const Subject> subject, std::vector<Body> bodies,
                    Change change) {
  Variant out;
  out.bodies = std::move(bodies);
  out.names = same_names(out.bodies);
  for (std::size_t f = 0; f < subject->frames.size(); ++f) out.frames.push_back(change(f));
  out.plain = std::move(subject);
  return out;
}

// A rotation or reflection that takes axes to axes, by its number below 48.
struct AxisTurn {
  std::array<int, 3> from;  // per new axis
  std::array<bool, 3> turned;

  Vec3 operator()(const Vec3& p) const {
    Vec3 out;
    for (int k = 0; k < 3; ++k) out[k] = turned[k] ? -p[from[k]] : p[from[k]];
    return out;
  }
};

AxisTurn axis_turn(std::size_t number) {
  constexpr std::array<std::array<int, 3>, 6> kOrders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  return {kOrders[number / 8], {number % 2 == 1, number / 2 % 2 == 1, number / 4 % 2 == 1}};
}

bool reflects(const AxisTurn& turn) {
  const bool odd_order = (turn.from[1] + 3 - turn.from[0]) % 3 == 2;
  return odd_order ^ turn.turned[0] ^ turn.turned[1] ^ turn.turned[2];
}

// Without the identity.
std::vector<AxisTurn> axis_turns(bool mirrored) {
  std::vector<AxisTurn> out;
  for (std::size_t number = 1; number < 48; ++number)
    if (reflects(axis_turn(number)) == mirrored) out.push_back(axis_turn(number));
  return out;
}

// Bodies that can be given any vertices, made once per shape.
class Carriers {
 public:
  Carriers(const std::vector<Body>& bodies, Carrier carrier) {
    std::map<const BodyShape*, NodeShape> made;
    for (const Body& body : bodies) {
      NodeShape& shape = made[body.shape.get()];
      const TriangleMesh& mesh = body.shape->mesh;
      if (shape.shape == nullptr && carrier == Carrier::kNodes)
        shape = make_node_shape(mesh.vertices.size(), mesh.triangles);
      if (shape.shape == nullptr) shape.shape = make_bare_shape(mesh);
      shape.shape = welded_as(*body.shape, shape.shape);
      shapes_.push_back(shape);
      bodies_.push_back({body.name, shape.shape});
    }
  }

  const std::vector<Body>& bodies() const { return bodies_; }
  FrameData frame(const Positions& vertices) const {
    Positions nodes;
    for (std::size_t b = 0; b < vertices.size(); ++b)
      nodes.push_back(bodies_[b].shape->lattice ? shapes_[b].nodes_for(vertices[b]) : vertices[b]);
    return make_frame(bodies_, std::move(nodes));
  }

 private:
  std::vector<NodeShape> shapes_;
  std::vector<Body> bodies_;
};

// A shift for one frame, and the unit of which it and the rounded vertices are multiples. Sums
// stay below 2^(reach + 2) and have at most 53 digits above the unit.
struct ExactShift {
  Vec3 by;
  double unit;
};

std::optional<ExactShift> exact_shift(const Positions& vertices, int exponent) {
  const int reach = exponent_above(vertices) + std::max(exponent, 0);
  if (reach + 2 > kLargestExponent) return std::nullopt;
  const int unit = std::max(reach + 2 - kDigits, kSmallestExponent);
  const Vec3 by = times_power({1.25, -0.75, 1.5}, exponent_above(vertices) + exponent);
  return ExactShift{by, std::ldexp(1.0, unit)};
}

double rounded_to(double value, double unit) {
  // Dividing by a power of two is exact, also below the normal range, where it gives whole numbers.
  return std::nearbyint(value / unit) * unit;
}

bool is_exact_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return (a - (sum - part)) + (b - part) == 0.0;
}

std::optional<Positions> shifted(const Positions& vertices, const Vec3& by) {
  bool exact = true;
  Positions out = changed(vertices, [&](const Vec3& p) -> Vec3 {
    for (int k = 0; k < 3; ++k) exact = exact && is_exact_sum(p[k], by[k]);
    return p + by;
  });
  return exact && finite(out) ? std::optional(std::move(out)) : std::nullopt;
}

// A rotation by the quaternion (w, x, y, z) over its squared length, as families have it.
Eigen::Matrix3d rotation(double w, double x, double y, double z) {
  Eigen::Matrix3d m;
  m << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z),
      w * w - x * x + y * y - z * z, 2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x),
      w * w - x * x - y * y + z * z;
  return m / (w * w + x * x + y * y + z * z);
}

// None of these takes an axis to an axis.
Eigen::Matrix3d rotation(std::uint64_t number) {
  const auto step = static_cast<double>(number % 7);
  return rotation(5.0 - step, 1.0 + step, 2.0, 3.0 - 0.5 * step);
}

// By rows and in this order on every machine; Eigen's product may choose another.
Vec3 turned(const Eigen::Matrix3d& m, const Vec3& p) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) out[k] = m(k, 0) * p.x() + m(k, 1) * p.y() + m(k, 2) * p.z();
  return out;
}

}  // namespace

Variant scaled(std::shared_ptr<const Subject> subject, int exponent, Rest rest) {
  const std::vector<Body> bodies =
      rest == Rest::kMoves ? scaled_bodies(subject->bodies, exponent) : subject->bodies;
  const Subject& from = *subject;
  return with_frames(std::move(subject), bodies,
                     [&](std::size_t f) { return scaled_frame(bodies, from.frames[f], exponent); });
}

Variant scaled_to_the_largest(std::shared_ptr<const Subject> subject) {
  const Subject& from = *subject;
  return with_frames(std::move(subject), from.bodies, [&](std::size_t f) {
    const FrameData& frame = from.frames[f];
    return scaled_frame(from.bodies, frame, kLargestExponent + 1 - exponent_above(frame.nodes));
  });
}

Variant scaled_to_the_smallest(std::shared_ptr<const Subject> subject) {
  const Subject& from = *subject;
  return with_frames(std::move(subject), from.bodies, [&](std::size_t f) {
    const FrameData& frame = from.frames[f];
    const int lowest = std::min(lowest_bit(frame.nodes), lowest_bit(frame.vertices));
    std::optional<FrameData> exact;
    // The mapping's products have twice the digits, of which some weights need all.
    for (int spare = 0; !exact && spare <= 2 * kDigits; ++spare)
      exact = scaled_frame(from.bodies, frame, kSmallestExponent - lowest + spare);
    return exact;
  });
}

Variant turned_to_other_axes(std::shared_ptr<const Subject> subject, bool mirrored) {
  const std::vector<AxisTurn> turns = axis_turns(mirrored);
  const Subject& from = *subject;
  return with_frames(std::move(subject), from.bodies, [&](std::size_t f) {
    const AxisTurn& turn = turns[number_of(from.labels[f]) % turns.size()];
    return make_frame(from.bodies, changed(from.frames[f].nodes, turn));
  });
}

Variant translated(std::shared_ptr<const Subject> subject, int exponent, Carrier carrier) {
  const Carriers carriers(subject->bodies, carrier);
  Subject plain{carriers.bodies(), {}, subject->labels};
  std::vector<std::optional<FrameData>> frames;
  for (const FrameData& frame : subject->frames) {
    const auto shift = exact_shift(frame.vertices, exponent);
    Positions rounded = frame.vertices;
    if (shift)
      rounded = changed(std::move(rounded), [&](const Vec3& p) -> Vec3 {
        return p.unaryExpr([&](double x) { return rounded_to(x, shift->unit); });
      });
    const auto there = shift ? shifted(rounded, shift->by) : std::nullopt;
    plain.frames.push_back(carriers.frame(rounded));
    frames.push_back(there ? std::optional(carriers.frame(*there)) : std::nullopt);
  }
  return {std::make_shared<const Subject>(std::move(plain)), carriers.bodies(), std::move(frames),
          same_names(carriers.bodies())};
}

Variant moved_with_rounding(std::shared_ptr<const Subject> subject) {
  Subject moved{subject->bodies, {}, subject->labels};
  std::vector<std::optional<FrameData>> frames;
  for (std::size_t f = 0; f < subject->frames.size(); ++f) {
    const Positions& nodes = subject->frames[f].nodes;
    const Eigen::Matrix3d turn = rotation(number_of(subject->labels[f]));
    const Vec3 by = largest_coordinate(nodes) * Vec3(0.3, -0.7, 0.2);
    const Positions there =
        changed(nodes, [&](const Vec3& p) -> Vec3 { return turned(turn, p) + by; });
    moved.frames.push_back(finite(there) ? make_frame(moved.bodies, there) : subject->frames[f]);
    frames.push_back(finite(there) ? std::optional(moved.frames.back()) : std::nullopt);
  }
  const std::vector<Body> bodies = subject->bodies;
  return {std::make_shared<const Subject>(std::move(moved)), bodies, std::move(frames),
          same_names(bodies)};
}

}  // namespace contactcheck::test
