#include "reference/scene/copies_spec.h"

#include <variant>
#include <vector>

namespace contactcheck::scene {
namespace {

constexpr text::NumberRange kSpacing = {-1e6, false, 1e6, false};  // metres
constexpr text::NumberRange kTurnDegrees = {-1e6, false, 1e6, false};
constexpr text::NumberRange kDelaySeconds = {0.0, false, 1e6, false};

std::array<std::size_t, 3> parse_counts(const text::JsonField& field) {
  const std::vector<text::JsonField> parts = field.items();
  if (parts.size() != 3) field.refuse("an array of three whole numbers");
  std::array<std::size_t, 3> counts;
  for (std::size_t k = 0; k < 3; ++k) counts[k] = parts[k].whole(1, CopiesSpec::kMost);
  if (counts[0] * counts[1] > CopiesSpec::kMost ||
      counts[0] * counts[1] * counts[2] > CopiesSpec::kMost)
    field.fail("asks for more than " + std::to_string(CopiesSpec::kMost) + " copies");
  return counts;
}

void shift_time(double seconds, Curve& curve) {
  for (Curve::Key& key : curve.keys) key.time += seconds;
}

struct Delay {
  double seconds;
  void operator()(Twist& d) const { shift_time(seconds, d.angle); }
  void operator()(Bend& d) const { shift_time(seconds, d.angle); }
  void operator()(Taper& d) const { shift_time(seconds, d.amount); }
  void operator()(Stretch& d) const { shift_time(seconds, d.amount); }
  void operator()(NodeKeys& d) const {
    for (NodeKeys::Key& key : d.keys) key.time += seconds;
  }
};

void delay_all(double seconds, Motion& motion) {
  for (Deformer& deformer : motion.deformers) std::visit(Delay{seconds}, deformer);
  for (RigidPath::Spin& spin : motion.path.spins) shift_time(seconds, spin.angle);
  for (Curve& curve : motion.path.position) shift_time(seconds, curve);
}

}  // namespace

CopiesSpec parse_copies(const text::JsonField& field) {
  field.only_keys({"counts", "spacing", "turn", "delay"});
  CopiesSpec out;
  out.counts = parse_counts(field.at("counts"));
  out.spacing = field.at("spacing").vector(kSpacing);
  if (field.has("turn")) out.turn_degrees = field.at("turn").number(kTurnDegrees);
  if (field.has("delay")) out.delay = field.at("delay").number(kDelaySeconds);
  return out;
}

Motion motion_of_copy(const CopiesSpec& copies, const Motion& motion, std::size_t i) {
  Motion out = motion;
  const auto number = static_cast<double>(i);
  delay_all(copies.delay * number, out);
  if (copies.turn_degrees != 0.0) {
    Curve angle;
    angle.keys.push_back({0.0, copies.turn_degrees * number});
    out.path.spins.insert(out.path.spins.begin(), {Vec3::UnitY(), angle});
  }
  const std::size_t nx = copies.counts[0], ny = copies.counts[1];
  const std::array<std::size_t, 3> place = {i % nx, i / nx % ny, i / (nx * ny)};
  for (int k = 0; k < 3; ++k)
    for (Curve::Key& key : out.path.position[k].keys)
      key.value += copies.spacing[k] * static_cast<double>(place[k]);
  return out;
}

std::string name_of_copy(const std::string& name, std::size_t i) {
  return name + "-" + std::to_string(i + 1);
}

}  // namespace contactcheck::scene
