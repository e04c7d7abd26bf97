#include "reference/scene/family_step.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/types/check.h"

namespace contactcheck {
namespace {

constexpr std::size_t kMostNodesPerAxis = 129, kLargestVertex = 10'000'000;

AmountVector parse_scale(const JsonField& field) {
  if (field.is(JsonValue::Kind::kArray)) return parse_amount_vector(field);
  const Amount all = parse_amount(field);
  return {all, all, all};
}

std::array<Amount, 4> parse_quaternion(const JsonField& field) {
  if (!field.is(JsonValue::Kind::kArray) || field.value().items.size() != 4)
    field.refuse("an array of four amounts: w, x, y, z");
  const std::vector<JsonField> parts = field.items();
  return {parse_amount(parts[0]), parse_amount(parts[1]), parse_amount(parts[2]),
          parse_amount(parts[3])};
}

GridIndex parse_node(const JsonField& field) {
  if (!field.is(JsonValue::Kind::kArray) || field.value().items.size() != 3)
    field.refuse("an array of three whole numbers");
  const std::vector<JsonField> parts = field.items();
  GridIndex node;
  for (std::size_t k = 0; k < 3; ++k)
    node[k] = static_cast<std::uint32_t>(parts[k].whole(0, kMostNodesPerAxis - 1));
  return node;
}

// Rows of the rotation matrix of a quaternion, times its squared length.
std::array<Vec3, 3> rotation_rows(double w, double x, double y, double z) {
  const double xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  return {Vec3(ww + xx - yy - zz, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
          Vec3(2.0 * (x * y + w * z), ww - xx + yy - zz, 2.0 * (y * z - w * x)),
          Vec3(2.0 * (x * z - w * y), 2.0 * (y * z + w * x), ww - xx - yy + zz)};
}

double sum_of_products(const Vec3& a, const Vec3& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

void rotate(const FamilyStep& step, double parameter, std::span<Vec3> positions) {
  std::array<double, 4> q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = step.quaternion[i].at(parameter);
  const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const std::array<Vec3, 3> rows = rotation_rows(q[0], q[1], q[2], q[3]);
  for (Vec3& p : positions)
    p = Vec3(sum_of_products(rows[0], p), sum_of_products(rows[1], p),
             sum_of_products(rows[2], p)) /
        square;
}

void round_to(double unit, std::span<Vec3> positions) {
  for (Vec3& p : positions)
    for (int k = 0; k < 3; ++k) p[k] = std::nearbyint(p[k] / unit) * unit;
}

}  // namespace

FamilyStep parse_family_step(const JsonField& field) {
  FamilyStep step;
  const std::string kind =
      field.exactly_one_of({"scale", "translate", "rotate", "round", "node", "vertex"});
  if (kind == "node" || kind == "vertex") {
    field.only_keys({kind, "by"});
    step.kind = kind == "node" ? FamilyStep::Kind::kMoveNode : FamilyStep::Kind::kMoveVertex;
    if (kind == "node") step.node = parse_node(field.at("node"));
    if (kind == "vertex") step.vertex = field.at("vertex").whole(0, kLargestVertex);
    step.vector = parse_amount_vector(field.at("by"));
    return step;
  }
  field.only_keys({kind});
  const JsonField value = field.at(kind);
  if (kind == "scale") {
    step.vector = parse_scale(value);
  } else if (kind == "translate") {
    step.kind = FamilyStep::Kind::kTranslate;
    step.vector = parse_amount_vector(value);
  } else if (kind == "rotate") {
    step.kind = FamilyStep::Kind::kRotate;
    step.quaternion = parse_quaternion(value);
  } else {
    step.kind = FamilyStep::Kind::kRound;
    step.amount = parse_amount(value);
  }
  return step;
}

void apply(const FamilyStep& step, double parameter, const Lattice* lattice,
           std::span<Vec3> positions) {
  const Vec3 vector = at(step.vector, parameter);
  switch (step.kind) {
    case FamilyStep::Kind::kScale:
      for (Vec3& p : positions) p = p.cwiseProduct(vector);
      return;
    case FamilyStep::Kind::kTranslate:
      for (Vec3& p : positions) p += vector;
      return;
    case FamilyStep::Kind::kRotate:
      return rotate(step, parameter, positions);
    case FamilyStep::Kind::kRound:
      return round_to(step.amount.at(parameter), positions);
    case FamilyStep::Kind::kMoveNode: {
      CONTACTCHECK_INVARIANT(lattice != nullptr, "nodes are moved in a lattice");
      const auto node = std::find(lattice->nodes.begin(), lattice->nodes.end(), step.node);
      CONTACTCHECK_INVARIANT(node != lattice->nodes.end(), "the node was looked up before");
      positions[static_cast<std::size_t>(node - lattice->nodes.begin())] += vector;
      return;
    }
    case FamilyStep::Kind::kMoveVertex:
      positions[step.vertex] += vector;
  }
}

}  // namespace contactcheck
