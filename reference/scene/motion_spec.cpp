#include "reference/scene/motion_spec.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace contactcheck::scene {
namespace {

// Far outside any real motion; keeps sums and products finite.
constexpr text::NumberRange kTime = {0.0, false, 1e9, false};     // seconds
constexpr text::NumberRange kOffset = {-1e6, false, 1e6, false};  // metres
// metres: beside the largest body
constexpr text::NumberRange kPlace = {-1e7, false, 1e7, false};
constexpr text::NumberRange kDegrees = {-1e6, false, 1e6, false};
constexpr text::NumberRange kTaperAmount = {-100.0, false, 100.0, false};
constexpr text::NumberRange kStretchAmount = {-1.0, true, 100.0, false};

// The time of a key, which must be above that of the key before.
double key_time(const text::JsonField& field, std::size_t index, double before) {
  const double time = field.number(kTime);
  if (index > 0 && !(time > before)) {
    field.refuse("above " + text::shown(before) + ", the time of the key before");
  }
  return time;
}

// Time and value of [time, value].
std::pair<text::JsonField, text::JsonField> key_parts(const text::JsonField& field) {
  if (!field.is(text::JsonValue::Kind::kArray) || field.value().items.size() != 2) {
    field.refuse("a key: an array of a time and a value");
  }
  std::vector<text::JsonField> parts = field.items();
  return {parts[0], parts[1]};
}

// A number, or keys [[time, number], ...].
Curve parse_curve(const text::JsonField& field, const text::NumberRange& range, bool smooth) {
  Curve curve;
  curve.smooth = smooth;
  if (field.is(text::JsonValue::Kind::kNumber)) {
    curve.keys.push_back({0.0, field.number(range)});
    return curve;
  }
  if (!field.is(text::JsonValue::Kind::kArray)) field.refuse("a number or an array of keys");
  const std::vector<text::JsonField> keys = field.items(1);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto [time, value] = key_parts(keys[i]);
    const double before = i > 0 ? curve.keys.back().time : 0.0;
    curve.keys.push_back({key_time(time, i, before), value.number(range)});
  }
  return curve;
}

std::array<Curve, 3> constant_curves(const Vec3& value) {
  std::array<Curve, 3> curves;
  for (int k = 0; k < 3; ++k) curves[k].keys.push_back({0.0, value[k]});
  return curves;
}

// [x, y, z], or keys [[time, [x, y, z]], ...].
std::array<Curve, 3> parse_position(const text::JsonField& field, bool smooth) {
  if (!field.is(text::JsonValue::Kind::kArray)) field.refuse("[x, y, z] or an array of keys");
  const std::vector<text::JsonValue>& items = field.value().items;
  if (std::all_of(items.begin(), items.end(), [](const text::JsonValue& item) {
        return item.kind == text::JsonValue::Kind::kNumber;
      }))
    return constant_curves(field.vector(kPlace));
  std::array<Curve, 3> curves;
  for (Curve& curve : curves) curve.smooth = smooth;
  const std::vector<text::JsonField> keys = field.items(1);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto [time_field, value] = key_parts(keys[i]);
    const double time = key_time(time_field, i, i > 0 ? curves[0].keys.back().time : 0.0);
    const Vec3 position = value.vector(kPlace);
    for (int k = 0; k < 3; ++k) curves[k].keys.push_back({time, position[k]});
  }
  return curves;
}

int parse_axis(const text::JsonField& field) { return field.one_of({"x", "y", "z"})[0] - 'x'; }

// "x", "y", "z", or a vector that is not zero.
Vec3 parse_direction(const text::JsonField& field) {
  if (field.is(text::JsonValue::Kind::kText)) return Vec3::Unit(parse_axis(field));
  if (!field.is(text::JsonValue::Kind::kArray))
    field.refuse("x, y, z, or an array of three numbers");
  Vec3 direction = field.vector(kOffset);
  if (!(direction.norm() > 1e-9)) field.fail("is too short; it must not be zero");
  return direction;
}

// [[time, [{"node": [i, j, k], "offset": [x, y, z]}, ...]], ...]
Deformer parse_nodes(const text::JsonField& field, const BodyShape& shape) {
  if (!shape.lattice) field.fail("needs a lattice; this body has none");
  const Lattice& lattice = *shape.lattice;
  NodeKeys out;
  const std::vector<text::JsonField> keys = field.items(1);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto [time, list] = key_parts(keys[i]);
    NodeKeys::Key key;
    key.time = key_time(time, i, i > 0 ? out.keys.back().time : 0.0);
    std::set<GridIndex> seen;
    for (const text::JsonField& entry : list.items()) {
      entry.only_keys({"node", "offset"});
      const text::JsonField field_of_node = entry.at("node");
      if (!field_of_node.is(text::JsonValue::Kind::kArray) ||
          field_of_node.value().items.size() != 3)
        field_of_node.refuse("an array of three whole numbers");
      const std::vector<text::JsonField> parts = field_of_node.items();
      GridIndex node;
      for (std::size_t k = 0; k < 3; ++k)
        node[k] = static_cast<std::uint32_t>(parts[k].whole(0, lattice.lines[k].size() - 1));
      if (std::find(lattice.nodes.begin(), lattice.nodes.end(), node) == lattice.nodes.end())
        field_of_node.fail(
            "is no node of the body's lattice; only cells that hold surface are kept");
      if (!seen.insert(node).second) field_of_node.fail("is named twice in this key");
      key.offsets.emplace_back(node, entry.at("offset").vector(kOffset));
    }
    out.keys.push_back(std::move(key));
  }
  return out;
}

Deformer parse_deformer(const text::JsonField& field, const BodyShape& shape, bool smooth) {
  const std::vector<std::string> kinds = {"twist", "bend", "taper", "stretch", "nodes"};
  field.only_keys(kinds);
  const std::string kind = field.exactly_one_of(kinds);
  const text::JsonField inner = field.at(kind);
  if (kind == "nodes") return parse_nodes(inner, shape);
  if (kind == "bend") {
    inner.only_keys({"axis", "toward", "degrees"});
    Bend bend;
    bend.axis = parse_axis(inner.at("axis"));
    bend.toward = parse_axis(inner.at("toward"));
    if (bend.toward == bend.axis) inner.at("toward").refuse("another axis than \"axis\"");
    bend.angle = parse_curve(inner.at("degrees"), kDegrees, smooth);
    return bend;
  }
  const std::string amount = kind == "twist" ? "degrees" : "amount";
  inner.only_keys({"axis", amount});
  const int axis = parse_axis(inner.at("axis"));
  const text::JsonField curve = inner.at(amount);
  if (kind == "twist") return Twist{axis, parse_curve(curve, kDegrees, smooth)};
  if (kind == "taper") return Taper{axis, parse_curve(curve, kTaperAmount, smooth)};
  return Stretch{axis, parse_curve(curve, kStretchAmount, smooth)};
}

}  // namespace

Motion parse_motion(const text::JsonField& field, const BodyShape& shape) {
  field.only_keys({"ease", "sines", "position", "spins", "deformers"});
  const bool smooth =
      field.has("ease") && field.at("ease").one_of({"linear", "smooth"}) == "smooth";
  Motion motion;
  motion.portable_sines =
      field.has("sines") && field.at("sines").one_of({"library", "portable"}) == "portable";
  if (field.has("deformers")) {
    for (const text::JsonField& item : field.at("deformers").items()) {
      motion.deformers.push_back(parse_deformer(item, shape, smooth));
    }
  }
  if (field.has("spins")) {
    for (const text::JsonField& item : field.at("spins").items()) {
      item.only_keys({"axis", "degrees"});
      const Vec3 axis = parse_direction(item.at("axis"));
      motion.path.spins.push_back({axis, parse_curve(item.at("degrees"), kDegrees, smooth)});
    }
  }
  if (field.has("position")) {
    motion.path.position = parse_position(field.at("position"), smooth);
  } else if (!motion.deformers.empty() || !motion.path.spins.empty()) {
    motion.path.position = constant_curves(bounding_box(shape.mesh.vertices).center());
  }
  return motion;
}

bool is_rest(const Motion& motion) {
  return motion.deformers.empty() && motion.path.spins.empty() &&
         std::all_of(motion.path.position.begin(), motion.path.position.end(),
                     [](const Curve& curve) { return curve.keys.empty(); });
}

}  // namespace contactcheck::scene
