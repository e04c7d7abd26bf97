#include "reference/scene/drawn_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "core/broad/aabb_tree.h"
#include "core/types/check.h"
#include "reference/mesh/datasets.h"
#include "reference/mesh/mesh_file.h"
#include "reference/mesh/shapes.h"
#include "reference/scene/draw_rules.h"
#include "reference/scene/first_touch.h"
#include "reference/scene/lattice_spec.h"
#include "reference/scene/mesh_scene.h"
#include "reference/scene/seeded_random.h"
#include "reference/text/file_text.h"
#include "reference/text/lists.h"

namespace contactcheck::scene {
namespace {

namespace fs = std::filesystem;
using text::shown;

constexpr double kTimeStep = 0x1p-5;  // seconds: times of frames are exact
constexpr const char* kLevels = R"(["body", "containment", "cell", "triangle", "vertex"])";
constexpr const char* kStepLevels = R"(["impact-vf", "impact-ee", "impact-triangle", "impact"])";
constexpr const char* kSelfStepLevels =
    R"(["impact-vf", "impact-ee", "impact-triangle", "impact", "impact-self-vf", "impact-self-ee"])";
// In the size of the first body: the gap of meeting bodies that do not meet yet.
constexpr double kClearGap = 1e-3;
// What is nested: its size, of that of the body around it, and how that one may deform.
constexpr double kNestedSize = 0.25, kNestedAmount = 0.15;
constexpr int kMostAims = 12, kMostHalvings = 8;
// Tumbling and deforming move no point faster than half the drawn speed: degrees and amounts per
// size of the body (its points are at most 0.87 sizes from its centre).
constexpr double kTumble = 30.0, kTwistTurn = 60.0, kAmountGrowth = 0.5;
// A twist that moves points by the size of the body: about so many degrees.
constexpr double kTwistBySize = 120.0;

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

std::size_t whole_log(SeededRandom& random, const DrawRange& range) {
  const double drawn = std::floor(random.log_between(range.low, range.high + 1.0));
  return static_cast<std::size_t>(std::min(drawn, range.high));
}

Happening draw_happening(const DrawRules& rules, SeededRandom random) {
  double sum = 0.0;
  for (const double share : rules.shares) sum += share;
  double left = random.unit() * sum;
  std::size_t last = 0;
  for (std::size_t i = 0; i < rules.shares.size(); ++i) {
    if (!(rules.shares[i] > 0.0)) continue;
    last = i;
    left -= rules.shares[i];
    if (left < 0.0) break;
  }
  return static_cast<Happening>(last);
}

bool has_contact(Happening what) {
  return what == Happening::kGraze || what == Happening::kTouch || what == Happening::kDeep ||
         what == Happening::kPile;
}

/// A mesh in a lattice that some bodies share.
struct Kind {
  std::string mesh;  ///< its JSON, but for the size
  double size = 1.0;
};

struct BodyPlan {
  std::size_t kind = 0;
  Motion motion;
  double distance = 0.0;              ///< to what it meets, of the smaller size; below 0: a depth
  double leaving = 1.0;               ///< of the drawn speed, outside the frames of the contact
  double slide = 0.0;                 ///< sideways, per frame
  bool passes = false;                ///< from one side of what it meets to the other, and back
  std::optional<std::size_t> inside;  ///< of that body
};

/// Draws one scene: everything but where the bodies are.
class Drawing {
 public:
  explicit Drawing(const DrawnSpec& spec, fs::path folder = {})
      : spec_(spec),
        folder_(std::move(folder)),
        rules_(parse_draw_rules(spec.rules, spec.rules_name)) {
    what_ = draw_happening(rules_, named("happens"));
    SeededRandom bodies = named("bodies"), triangles = named("triangles"), cells = named("cells"),
                 frames = named("frames");
    bodies_ = whole_log(bodies, rules_.bodies);
    speed_ = draw_speed();
    draw_steps();
    triangles_ = std::min({whole_log(triangles, rules_.triangles), rules_.most_triangles / bodies_,
                           swept_triangles_});
    cells_ = whole_log(cells, rules_.cells);
    frames_ = frames.whole(static_cast<std::size_t>(rules_.frames.low),
                           static_cast<std::size_t>(rules_.frames.high));
    ratio_ = named("size_ratio").log_between(rules_.size_ratio.low, rules_.size_ratio.high);
    share_ = named("contact_share").between(rules_.contact_share.low, rules_.contact_share.high);
    const auto window = std::ceil(share_ * static_cast<double>(frames_));
    length_ = std::clamp<std::size_t>(static_cast<std::size_t>(window), 1, frames_);
    begin_ = named("contact begins").below(frames_ - length_ + 1);
    for (std::size_t b = 0; b < bodies_; ++b) plans_.push_back(draw_body(b));
    if (self_twist_ > 0.0) add_twist(plans_[named("self twist").below(bodies_)]);
  }

  Drawn drawn() const {
    Drawn out;
    out.seed = spec_.seed;
    out.number = spec_.number;
    out.redrawn = spec_.redrawn;
    out.happens = name_of(what_);
    std::size_t deformers = 0;
    for (const BodyPlan& plan : plans_) deformers += plan.motion.deformers.size();
    out.parameters = {{"bodies", static_cast<double>(bodies_)},
                      {"cells", static_cast<double>(cells_)},
                      {"contact_share", has_contact(what_) ? share_ : 0.0},
                      {"deformers", static_cast<double>(deformers)},
                      {"distance", plans_[what_ == Happening::kNested ? 0 : 1].distance},
                      {"frames", static_cast<double>(frames_)},
                      {"size_ratio", ratio_},
                      {"speed", speed_},
                      {"triangles", static_cast<double>(triangles_)}};
    return out;
  }

  SeededRandom named(const std::string& name) const {
    return {spec_.seed, spec_.number, spec_.redrawn, name};
  }
  SeededRandom named(const std::string& name, std::size_t body) const {
    return named(name + " " + std::to_string(body));
  }

  /// Loads meshes to count their triangles.
  std::vector<Kind> draw_kinds() const {
    std::vector<Kind> kinds(kind_count());
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      SeededRandom random = named("mesh", k);
      if (what_ == Happening::kNested && k == 0) {
        kinds[k].mesh = shape_text(random.below(2) == 0 ? "box" : "sphere", random);
      } else if (!spec_.meshes.empty()) {
        const fs::path& file = spec_.meshes[random.below(spec_.meshes.size())];
        kinds[k].mesh =
            "\"file\": " + quoted(folder_.empty() ? file.string() : mesh_path_from(folder_, file)) +
            count_text(mesh::read_mesh_file(file).mesh.triangles.size());
      } else {
        const std::string& name = rules_.meshes[random.below(rules_.meshes.size())];
        kinds[k].mesh = is_shape(name)
                            ? shape_text(name, random)
                            : "\"dataset\": " + quoted(name) +
                                  count_text(mesh::load_dataset(name).mesh.triangles.size());
      }
      // The first is the largest, the last the smallest.
      if (k + 1 == kinds.size())
        kinds[k].size = 1.0 / ratio_;
      else if (k > 0)
        kinds[k].size = 1.0 / named("size", k).log_between(1.0, ratio_);
      if (what_ == Happening::kNested && k > 0)
        kinds[k].size = std::min(kinds[k].size, kNestedSize);
    }
    return kinds;
  }

  const DrawRules& rules() const { return rules_; }
  Happening what() const { return what_; }
  std::size_t frames() const { return frames_; }
  std::size_t cells() const { return cells_; }
  std::size_t begin() const { return begin_; }
  std::size_t end() const { return begin_ + length_; }
  double speed() const { return speed_; }
  /// The drift of all bodies together, per frame.
  const Vec3& drift() const { return drift_; }
  const char* levels() const {
    return !rules_.steps ? kLevels : self_twist_ > 0.0 ? kSelfStepLevels : kStepLevels;
  }
  std::vector<BodyPlan>& plans() { return plans_; }

 private:
  std::size_t kind_count() const {
    if (what_ == Happening::kNested) return 2;
    return std::min<std::size_t>(bodies_, 2 + named("kinds").below(2));
  }

  static bool is_shape(const std::string& name) {
    return name == "box" || name == "letter" || name == "sphere" || name == "teapot" ||
           name == "torus";
  }

  double draw_speed() const {
    SeededRandom random = named("speed");
    return rules_.steps ? random.log_between(rules_.speed.low, rules_.speed.high)
                        : random.between(rules_.speed.low, rules_.speed.high);
  }

  // What steps have beside speeds, and fewer triangles where they sweep far.
  void draw_steps() {
    if (!rules_.steps) return;
    const DrawnSteps& steps = *rules_.steps;
    SeededRandom self = named("self"), drift = named("drift");
    const double twist = self.log_between(steps.self_twist.low, steps.self_twist.high);
    if (self.unit() < steps.self_share) self_twist_ = twist;
    const Vec3 direction = drift.direction();
    if (drift.below(2) == 0) drift_ = drift.unit() * speed_ * direction;
    // Bodies that change sides move by their own thickness and more.
    const double fastest =
        std::max({speed_, self_twist_ / kTwistBySize, what_ == Happening::kPass ? 1.0 : 0.0});
    const double most = steps.most_swept / (fastest * static_cast<double>(bodies_));
    swept_triangles_ = static_cast<std::size_t>(std::max(most, rules_.triangles.low));
  }

  // To and fro, so that a body of few frames is never wound up.
  void add_twist(BodyPlan& plan) const {
    SeededRandom random = named("self twist axis");
    Curve curve{{}, false};
    const double start = random.between(-0.5, 0.5) * self_twist_;
    for (std::size_t f = 0; f < frames_; ++f)
      curve.keys.push_back(
          {static_cast<double>(f) * kTimeStep, start + (f % 2 == 0 ? 0.0 : self_twist_)});
    plan.motion.deformers.push_back(Twist{static_cast<int>(random.below(3)), curve});
  }

  // Simplified to the triangles that are drawn, or simplified less and subdivided to them.
  std::string count_text(std::size_t given) const {
    std::size_t times = 0;
    while (times < 6 && (given << (2 * times)) < triangles_) ++times;
    const std::size_t wanted = std::min(given, std::max<std::size_t>(4, triangles_ >> (2 * times)));
    return ", \"triangles\": " + std::to_string(wanted) +
           (times > 0 ? ", \"subdivide\": " + std::to_string(times) : "");
  }

  std::string shape_text(const std::string& name, SeededRandom& random) const {
    const std::string shape = "\"shape\": \"" + name + "\"";
    const auto divided = [](std::size_t n) { return ", \"divisions\": " + std::to_string(n); };
    if (name == "sphere") {
      std::size_t n = 0;
      while (n < 7 && (std::size_t{20} << (2 * n)) < triangles_) ++n;
      return shape + divided(n) + count_text(std::size_t{20} << (2 * n));
    }
    std::size_t per_square = 12, least = 1, most = 256;
    std::string keys;
    if (name == "torus") per_square = 4, least = 3, most = 512;
    if (name == "teapot") per_square = 64, most = 64;
    if (name == "letter") {
      per_square = 256, most = 32;  // about: letters differ
      const std::string& letters = mesh::known_letters();
      keys = ", \"letter\": \"" + std::string(1, letters[random.below(letters.size())]) + "\"";
    }
    const double root =
        std::sqrt(static_cast<double>(triangles_) / static_cast<double>(per_square));
    return shape + keys + divided(std::clamp(static_cast<std::size_t>(root), least, most));
  }

  double draw_distance(std::size_t b, SeededRandom random) const {
    const auto log = [&](const DrawRange& r) { return random.log_between(r.low, r.high); };
    // The second body shows what happens; of those after it about half do, too.
    const bool meets = what_ == Happening::kPile || b == 1 || random.below(2) == 0;
    if (!meets) return log(rules_.apart_gap);
    switch (what_) {
      case Happening::kNearMiss:
      case Happening::kPass:
        return log(rules_.near_gap);
      case Happening::kGraze:
        return -log(rules_.graze_depth);
      case Happening::kTouch:
      case Happening::kPile:
        return -log(rules_.touch_depth);
      case Happening::kDeep:
        return -log(rules_.deep_depth);
      case Happening::kApart:
      case Happening::kNested:
        break;
    }
    return log(rules_.apart_gap);
  }

  // From a drawn amount to another one, so near that no point goes faster than allowed.
  Curve draw_curve(SeededRandom& random, const DrawRange& range, double per_size) const {
    const double start = random.between(range.low, range.high);
    const double most = per_size * speed_ * static_cast<double>(frames_ - 1);
    const double end = std::clamp(start + random.between(-most, most), range.low, range.high);
    if (frames_ == 1) return {{{0.0, start}}, false};
    return {{{0.0, start}, {static_cast<double>(frames_ - 1) * kTimeStep, end}}, false};
  }

  Deformer draw_deformer(SeededRandom& random, bool around) const {
    const auto within = [&](DrawRange range) {
      if (!around) return range;
      return DrawRange{std::clamp(range.low, -kNestedAmount, kNestedAmount),
                       std::clamp(range.high, -kNestedAmount, kNestedAmount)};
    };
    const std::size_t type = around ? 2 + random.below(2) : random.below(4);
    const int axis = static_cast<int>(random.below(3));
    if (type == 0) return Twist{axis, draw_curve(random, rules_.twist, kTwistTurn)};
    if (type == 1) {
      const int toward = (axis + 1 + static_cast<int>(random.below(2))) % 3;
      return Bend{axis, toward, draw_curve(random, rules_.bend, kTwistTurn)};
    }
    if (type == 2) return Taper{axis, draw_curve(random, within(rules_.taper), kAmountGrowth)};
    return Stretch{axis, draw_curve(random, within(rules_.stretch), kAmountGrowth)};
  }

  BodyPlan draw_body(std::size_t b) const {
    BodyPlan plan;
    SeededRandom random = named("body", b);
    const std::size_t kinds = kind_count();
    plan.kind = b < kinds ? b : random.below(kinds);
    if (what_ == Happening::kNested) {
      plan.kind = b % 2;
      if (b % 2 == 1) plan.inside = b - 1;
      if (b % 2 == 0 && b + 1 == bodies_) plan.kind = 1;  // left over: it holds nothing
    }
    const bool around = what_ == Happening::kNested && plan.kind == 0;
    SeededRandom deformers = named("deformers", b);
    const std::size_t count = deformers.whole(static_cast<std::size_t>(rules_.deformers.low),
                                              static_cast<std::size_t>(rules_.deformers.high));
    for (std::size_t i = 0; i < (around ? std::min<std::size_t>(count, 1) : count); ++i)
      plan.motion.deformers.push_back(draw_deformer(deformers, around));
    plan.motion.portable_sines = true;
    SeededRandom turn = named("turn", b);
    for (const Vec3& axis : turn.rotation())
      plan.motion.path.spins.push_back({axis, {{{0.0, 180.0}}, false}});
    if (frames_ > 1) {
      const Vec3 axis = turn.direction();
      const double degrees = turn.unit() * kTumble * speed_ * static_cast<double>(frames_ - 1);
      plan.motion.path.spins.push_back(
          {axis, {{{0.0, 0.0}, {static_cast<double>(frames_ - 1) * kTimeStep, degrees}}, false}});
    }
    plan.distance = draw_distance(b, named("distance", b));
    plan.leaving = b == 0 ? 0.0 : named("leaving", b).between(0.5, 1.0);
    if (b == 1) plan.leaving = 1.0;
    plan.passes = what_ == Happening::kPass && plan.distance <= rules_.near_gap.high;
    if (rules_.steps) plan.slide = named("slide", b).between(-1.0, 1.0) * speed_;
    return plan;
  }

  const DrawnSpec& spec_;
  const fs::path folder_;
  const DrawRules rules_;
  Happening what_ = Happening::kApart;
  std::size_t bodies_ = 0, triangles_ = 0, cells_ = 0, frames_ = 0, begin_ = 0, length_ = 0;
  double ratio_ = 1.0, speed_ = 0.0, share_ = 0.0;
  double self_twist_ = 0.0;  // degrees per step; 0: contact of bodies with themselves is not judged
  Vec3 drift_ = Vec3::Zero();
  std::size_t swept_triangles_ = std::numeric_limits<std::size_t>::max();  // most of a body
  std::vector<BodyPlan> plans_;
};

/// Finds where bodies are, frame by frame, in the frame that is turned afterwards.
class Placing {
 public:
  Placing(Drawing& drawing, const Scene& scene, const std::vector<Kind>& kinds)
      : drawing_(drawing), kinds_(kinds), frames_(drawing.frames()) {
    std::vector<Body> bodies = scene.bodies;
    const auto trees = make_triangle_trees(bodies, kLeafSize);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      trees_.emplace_back(trees[b]);
      fitted_.push_back(frames_);
      std::vector<std::vector<Vec3>>& own = vertices_.emplace_back();
      std::vector<Aabb>& boxes = boxes_.emplace_back();
      const BodyShape& shape = *bodies[b].shape;
      for (std::size_t f = 0; f < frames_; ++f) {
        const auto nodes = contactcheck::nodes_at(shape, drawing.plans()[b].motion,
                                                  static_cast<double>(f) * kTimeStep);
        own.emplace_back(shape.mesh.vertices.size());
        map_body(shape, nodes, own.back());
        boxes.push_back(bounding_box(own.back()));
      }
    }
    offsets_.assign(bodies.size(), std::vector<Vec3>(frames_, Vec3::Zero()));
  }

  /// Per body and frame.
  std::vector<std::vector<Vec3>> place() {
    placed_ = {0};
    for (std::size_t b = 1; b < trees_.size(); ++b) {
      if (plan(b).inside) continue;
      place_outside(b);
      placed_.push_back(b);
    }
    for (std::size_t b = 1; b < trees_.size(); ++b)
      if (plan(b).inside) place_inside(b);
    return offsets_;
  }

 private:
  static constexpr std::uint32_t kLeafSize = 4;

  /// A way in: along an axis, aside of the origin.
  struct Way {
    AxisDirection from;
    Vec3 aside = Vec3::Zero();
    double smaller = 1.0;  ///< size of this body or of the one that it is led to
  };

  const BodyPlan& plan(std::size_t b) const { return drawing_.plans()[b]; }
  double size(std::size_t b) const { return kinds_[plan(b).kind].size; }

  OffsetSurface surface(std::size_t b, std::size_t f, const Vec3& offset) {
    if (fitted_[b] != f) trees_[b].refit(vertices_[b][f]);
    fitted_[b] = f;
    return {vertices_[b][f], trees_[b], offset};
  }

  static bool seen_over(const Aabb& a, const Vec3& at_a, const Aabb& b, const Vec3& at_b,
                        int axis) {
    for (int k = 0; k < 3; ++k)
      if (k != axis &&
          !(a.lo[k] + at_a[k] <= b.hi[k] + at_b[k] && b.lo[k] + at_b[k] <= a.hi[k] + at_a[k]))
        return false;
    return true;
  }

  // Along the way: where the body first touches one that stands.
  std::optional<double> touch(std::size_t b, std::size_t f, const Way& way) {
    std::optional<double> best;
    for (const std::size_t other : placed_) {
      const Vec3& at = offsets_[other][f];
      if (!seen_over(boxes_[other][f], at, boxes_[b][f], way.aside, way.from.axis)) continue;
      const auto found = first_touch(surface(other, f, at), surface(b, f, way.aside), way.from,
                                     best.value_or(-std::numeric_limits<double>::infinity()));
      if (found) best = found;
    }
    return best;
  }

  bool meets(std::size_t b, std::size_t f, const Vec3& offset) {
    for (const std::size_t other : placed_)
      if (surfaces_touch(surface(other, f, offsets_[other][f]), surface(b, f, offset))) return true;
    return false;
  }

  // In the first frame of the contact there is something on the way.
  Way draw_way(std::size_t b) {
    SeededRandom random = drawing_.named("way", b);
    const std::size_t f = drawing_.begin();
    const int pile_axis = static_cast<int>(drawing_.named("pile").below(3));
    Way way;
    for (int aim = 0; aim < kMostAims; ++aim) {
      const std::size_t other = placed_[random.below(placed_.size())];
      way.from = {static_cast<int>(random.below(3)), random.below(2) == 0 ? 1.0 : -1.0};
      if (drawing_.what() == Happening::kPile) way.from = {pile_axis, 1.0};
      way.smaller = std::min(size(b), size(other));
      const Aabb& box = boxes_[other][f];
      way.aside = offsets_[other][f] + box.center() - boxes_[b][f].center();
      for (int k = 0; k < 3; ++k) way.aside[k] += 0.5 * random.between(-0.8, 0.8) * box.extent()[k];
      way.aside[way.from.axis] = 0.0;
      if (touch(b, f, way)) break;
    }
    return way;
  }

  // The way in a frame, of a body that slides.
  Way way_at(std::size_t f, std::size_t b, Way way) const {
    const double slid = static_cast<double>(f) - static_cast<double>(drawing_.begin());
    if (plan(b).slide != 0.0) way.aside[(way.from.axis + 1) % 3] += slid * plan(b).slide;
    return way;
  }

  // From side to side, frame by frame, at its distance.
  void place_passing(std::size_t b, const Way& way) {
    const double distance = plan(b).distance * way.smaller;
    std::array<double, 2> last = {};  // by side, where nothing is on the way
    for (std::size_t f = 0; f < frames_; ++f) {
      Way from = way_at(f, b, way);
      if (f % 2 == 1) from.from.sign = -from.from.sign;
      last[f % 2] = touch(b, f, from).value_or(last[f % 2]);
      offsets_[b][f] = from.aside + (last[f % 2] + distance) * from.from.vector();
    }
  }

  void place_outside(std::size_t b) {
    const Way drawn = draw_way(b);
    if (plan(b).passes) return place_passing(b, drawn);
    Way way = drawn;
    const Vec3 along = way.from.vector();
    const double distance = plan(b).distance * way.smaller;
    // Where nothing is on the way: what was found in the frame before.
    double last = 0.0;
    const auto reach = [&](std::size_t f) {
      way = way_at(f, b, drawn);
      last = touch(b, f, way).value_or(last);
      return last;
    };
    for (std::size_t f = drawing_.begin(); f < drawing_.end(); ++f) {
      const double at = reach(f);
      double back = distance;
      offsets_[b][f] = way.aside + (at + back) * along;
      for (int i = 0; i < kMostHalvings && back < 0.0 && !meets(b, f, offsets_[b][f]); ++i) {
        back *= 0.5;
        offsets_[b][f] = way.aside + (at + back) * along;
      }
    }
    const double gap = std::max(distance, kClearGap);
    const auto leave = [&](std::size_t f, std::size_t steps) {
      const double away = plan(b).leaving * drawing_.speed() * static_cast<double>(steps);
      const double at = reach(f);
      offsets_[b][f] = way.aside + (at + gap + away) * along;
    };
    reach(drawing_.end() - 1);
    for (std::size_t f = drawing_.end(); f < frames_; ++f) leave(f, f - drawing_.end() + 1);
    reach(drawing_.begin());
    for (std::size_t f = drawing_.begin(); f-- > 0;) leave(f, drawing_.begin() - f);
  }

  // Within the largest ball about the centre of the body around it, which is nearly one itself.
  void place_inside(std::size_t b) {
    constexpr double kFacets = 0.9;  // vertices of a ball are further out than its triangles
    const std::size_t around = *plan(b).inside;
    double free = std::numeric_limits<double>::infinity(), own = 0.0;
    const auto length = [](const Vec3& v) {
      return std::sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z());
    };
    for (std::size_t f = 0; f < frames_; ++f) {
      for (const Vec3& v : vertices_[around][f]) free = std::min(free, length(v));
      for (const Vec3& v : vertices_[b][f]) own = std::max(own, length(v));
    }
    SeededRandom random = drawing_.named("inside", b);
    const Vec3 direction = random.direction();
    const Vec3 aside = random.unit() * std::max(0.0, kFacets * free - own) * direction;
    for (std::size_t f = 0; f < frames_; ++f) offsets_[b][f] = offsets_[around][f] + aside;
  }

  Drawing& drawing_;
  const std::vector<Kind>& kinds_;
  const std::size_t frames_;
  std::vector<AabbTree> trees_;
  std::vector<std::size_t> fitted_;                       // the frame that a tree was fitted to
  std::vector<std::vector<std::vector<Vec3>>> vertices_;  // body, frame; about the body's centre
  std::vector<std::vector<Aabb>> boxes_;                  // of these
  std::vector<std::vector<Vec3>> offsets_;
  std::vector<std::size_t> placed_;
};

// The scene as a text.

std::string vector_text(const Vec3& v) {
  return "[" + shown(v.x()) + ", " + shown(v.y()) + ", " + shown(v.z()) + "]";
}

std::string curve_text(const Curve& curve) {
  if (curve.keys.size() == 1) return shown(curve.keys[0].value);
  std::string out;
  for (const Curve::Key& key : curve.keys)
    out += (out.empty() ? "[[" : ", [") + shown(key.time) + ", " + shown(key.value) + "]";
  return out + "]";
}

std::string deformer_text(const Deformer& deformer) {
  constexpr const char* kAxes[] = {"\"x\"", "\"y\"", "\"z\""};
  const auto text = [&](const char* kind, int axis, const std::string& more, const char* amount,
                        const Curve& curve) {
    return std::string("{\"") + kind + "\": {\"axis\": " + kAxes[axis] + more + ", \"" + amount +
           "\": " + curve_text(curve) + "}}";
  };
  if (const auto* twist = std::get_if<Twist>(&deformer))
    return text("twist", twist->axis, "", "degrees", twist->angle);
  if (const auto* bend = std::get_if<Bend>(&deformer))
    return text("bend", bend->axis, std::string(", \"toward\": ") + kAxes[bend->toward], "degrees",
                bend->angle);
  if (const auto* taper = std::get_if<Taper>(&deformer))
    return text("taper", taper->axis, "", "amount", taper->amount);
  const auto& stretch = std::get<Stretch>(deformer);
  return text("stretch", stretch.axis, "", "amount", stretch.amount);
}

std::string motion_text(const Motion& motion) {
  std::string out = "{\n        \"sines\": \"portable\"";
  const auto list = [&](const char* key, const std::vector<std::string>& items) {
    if (items.empty()) return;
    out += std::string(",\n        \"") + key + "\": [";
    for (std::size_t i = 0; i < items.size(); ++i)
      out += (i == 0 ? "\n          " : ",\n          ") + items[i];
    out += "\n        ]";
  };
  std::vector<std::string> deformers, spins, position;
  for (const Deformer& deformer : motion.deformers) deformers.push_back(deformer_text(deformer));
  for (const RigidPath::Spin& spin : motion.path.spins)
    spins.push_back("{\"axis\": " + vector_text(spin.axis) +
                    ", \"degrees\": " + curve_text(spin.angle) + "}");
  const std::array<Curve, 3>& at = motion.path.position;
  for (std::size_t i = 0; i < at[0].keys.size(); ++i)
    position.push_back(
        "[" + shown(at[0].keys[i].time) + ", " +
        vector_text({at[0].keys[i].value, at[1].keys[i].value, at[2].keys[i].value}) + "]");
  list("deformers", deformers);
  list("spins", spins);
  list("position", position);
  return out + "\n      }";
}

std::string drawn_text(const Drawn& drawn) {
  const std::string parameters = text::joined(drawn.parameters, [](const auto& one) {
    return "\"" + one.first + "\": " + shown(one.second);
  });
  return "{\"seed\": " + std::to_string(drawn.seed) +
         ", \"number\": " + std::to_string(drawn.number) +
         ", \"redrawn\": " + std::to_string(drawn.redrawn) + ", \"happens\": \"" + drawn.happens +
         "\",\n            \"parameters\": {" + parameters + "}}";
}

std::string title_of(const Drawn& drawn) {
  return "Drawn from seed " + std::to_string(drawn.seed) + ": " + drawn.happens;
}

// `motions`: with what moves the bodies.
std::string scene_text(const DrawnSpec& spec, Drawing& drawing, const std::vector<Kind>& kinds,
                       bool motions) {
  const Drawn drawn = drawing.drawn();
  std::string out = "{\n  \"id\": \"" + drawn_id(spec) + "\",\n  \"title\": \"" + title_of(drawn) +
                    "\",\n  \"drawn\": " + drawn_text(drawn) +
                    ",\n  \"frames\": " + std::to_string(drawing.frames()) +
                    ",\n  \"time_step\": " + shown(kTimeStep) +
                    ",\n  \"levels\": " + drawing.levels() + ",\n  \"bodies\": [";
  for (std::size_t b = 0; b < drawing.plans().size(); ++b) {
    const BodyPlan& plan = drawing.plans()[b];
    const Kind& kind = kinds[plan.kind];
    out += (b == 0 ? "\n    {" : ",\n    {") + ("\"name\": \"body-" + std::to_string(b + 1)) +
           "\",\n      \"mesh\": {" + kind.mesh + ", \"size\": " + shown(kind.size) +
           ", \"center\": [0, 0, 0]},\n      \"lattice\": {\"kept\": " +
           std::to_string(drawing.cells()) + "}";
    if (motions) out += ",\n      \"motion\": " + motion_text(plan.motion);
    out += "\n    }";
  }
  return out + "\n  ]\n}\n";
}

}  // namespace

std::string drawn_id(const DrawnSpec& spec) {
  const bool steps = parse_draw_rules(spec.rules, spec.rules_name).steps.has_value();
  return (steps ? "drawn-steps-" : "drawn-") + std::to_string(spec.seed) + "-" +
         std::to_string(spec.number);
}

Drawn draw_parameters(const DrawnSpec& spec) { return Drawing(spec).drawn(); }

Scene unmade_scene(const DrawnSpec& spec) {
  Scene scene;
  scene.id = drawn_id(spec);
  scene.drawn = draw_parameters(spec);
  scene.title = title_of(*scene.drawn);
  scene.frames = static_cast<std::size_t>(scene.drawn->parameters.at("frames"));
  scene.time_step = kTimeStep;
  return scene;
}

DrawnScene draw_scene(const DrawnSpec& spec, const fs::path& folder) {
  const std::string name = "the drawn scene " + drawn_id(spec);
  Drawing drawing(spec, folder);
  const std::vector<Kind> kinds = drawing.draw_kinds();
  DrawnScene out;
  out.scene = load_scene_text({scene_text(spec, drawing, kinds, false), name, folder});
  const auto offsets = Placing(drawing, out.scene, kinds).place();

  // Everything is turned, so that no axis is that of the coordinates.
  SeededRandom random = drawing.named("all");
  const std::array<Vec3, 2> turn = random.rotation();
  const auto half_turned = [](const Vec3& p, const Vec3& axis) -> Vec3 {
    return 2.0 * (axis.x() * p.x() + axis.y() * p.y() + axis.z() * p.z()) * axis - p;
  };
  for (std::size_t b = 0; b < offsets.size(); ++b) {
    RigidPath& path = drawing.plans()[b].motion.path;
    for (const Vec3& axis : turn) path.spins.push_back({axis, {{{0.0, 180.0}}, false}});
    for (std::size_t f = 0; f < drawing.frames(); ++f) {
      Vec3 offset = offsets[b][f];
      if (!drawing.drift().isZero(0.0)) offset += static_cast<double>(f) * drawing.drift();
      const Vec3 at = half_turned(half_turned(offset, turn[0]), turn[1]);
      for (int k = 0; k < 3; ++k)
        path.position[k].keys.push_back({static_cast<double>(f) * kTimeStep, at[k]});
    }
    out.scene.motions[b] = drawing.plans()[b].motion;
  }
  out.text = {scene_text(spec, drawing, kinds, true), name, folder};
  return out;
}

void check_drawn_mesh(const fs::path& file) {
  const mesh::LoadedMesh loaded = mesh::read_mesh_file(file);
  const std::string what = "--mesh " + text::in_quotes(file.string());
  if (!(bounding_box(loaded.mesh).extent().maxCoeff() > 0.0))
    throw InputError(what + " is a point and can meet nothing");
  LatticeSpec lattice;
  lattice.kind = LatticeSpec::Kind::kKept;
  lattice.kept = 50;
  lattice.padding = 0.02;
  try {
    build_shape(loaded.mesh, lattice);
  } catch (const InputError& error) {
    throw InputError(what + " cannot be put into a lattice: " + error.what());
  }
}

}  // namespace contactcheck::scene
