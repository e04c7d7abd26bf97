#include "reference/scene/draw_rules.h"

#include <algorithm>
#include <cmath>

#include "reference/text/id_check.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {
namespace {

constexpr std::size_t kMostTriangles = 10'000'000, kMostBodies = 1000;

struct RangeRule {
  const char* key;
  DrawRange DrawRules::*range;
  double low, high;  // what is allowed
  bool whole = false;
};

// Deformers beyond these turn a body inside out; the depths pass through it.
constexpr RangeRule kRangeRules[] = {
    {"triangles", &DrawRules::triangles, 12.0, kMostTriangles, true},
    {"cells", &DrawRules::cells, 1.0, 10000.0, true},
    {"bodies", &DrawRules::bodies, 2.0, kMostBodies, true},
    {"size_ratio", &DrawRules::size_ratio, 1.0, 1000.0},
    {"frames", &DrawRules::frames, 1.0, 10000.0, true},
    {"speed", &DrawRules::speed, 0.0, 1.0},
    {"contact_share", &DrawRules::contact_share, 0.0, 1.0},
    {"deformers", &DrawRules::deformers, 0.0, 8.0, true},
    {"twist", &DrawRules::twist, -360.0, 360.0},
    {"bend", &DrawRules::bend, -180.0, 180.0},
    {"taper", &DrawRules::taper, -0.9, 0.9},
    {"stretch", &DrawRules::stretch, -0.9, 9.0},
    {"apart_gap", &DrawRules::apart_gap, 1e-12, 100.0},
    {"near_gap", &DrawRules::near_gap, 1e-12, 1.0},
    {"graze_depth", &DrawRules::graze_depth, 1e-12, 1.0},
    {"touch_depth", &DrawRules::touch_depth, 1e-12, 1.0},
    {"deep_depth", &DrawRules::deep_depth, 1e-12, 1.0}};

DrawRange parse_range(const text::JsonField& field, const text::NumberRange& allowed,
                      bool whole = false) {
  if (!field.is(text::JsonValue::Kind::kArray) || field.value().items.size() != 2)
    field.refuse("an array of the lowest and the highest value");
  DrawRange range;
  const std::vector<text::JsonField> ends = field.items();
  for (std::size_t i = 0; i < 2; ++i) {
    double& end = i == 0 ? range.low : range.high;
    end = whole ? static_cast<double>(ends[i].whole(static_cast<std::size_t>(allowed.low),
                                                    static_cast<std::size_t>(allowed.high)))
                : ends[i].number(allowed);
  }
  if (!(range.low <= range.high))
    field.fail("is reversed: its lowest value " + text::shown(range.low) +
               " is above its highest, " + text::shown(range.high));
  return range;
}

std::vector<std::string> parse_names(const text::JsonField& field) {
  std::vector<std::string> names;
  for (const text::JsonField& item : field.items(1)) {
    const std::string name = item.text();
    if (std::find(names.begin(), names.end(), name) != names.end()) item.refuse("named once only");
    names.push_back(name);
  }
  return names;
}

DrawnSteps parse_steps(const text::JsonField& field) {
  field.only_keys({"most_swept", "self_share", "self_twist"});
  DrawnSteps steps;
  steps.most_swept = field.at("most_swept").number({1.0, false, 1e9, false});
  steps.self_share = field.at("self_share").number({0.0, false, 1.0, false});
  steps.self_twist = parse_range(field.at("self_twist"), {0.0, true, 360.0, false});
  return steps;
}

}  // namespace

DrawRules parse_draw_rules(const std::string& text, const std::string& document) {
  const text::JsonValue value = text::parse_json(text, document);
  const text::JsonField root(value, document);
  std::vector<std::string> keys = {"id",     "title",          "detectors", "meshes",
                                   "shares", "most_triangles", "steps"};
  for (const RangeRule& rule : kRangeRules) keys.emplace_back(rule.key);
  root.only_keys(keys);
  text::parse_id(root.at("id"));
  DrawRules rules;
  rules.title = root.has("title") ? root.at("title").text() : root.at("id").text();
  rules.detectors = parse_names(root.at("detectors"));
  rules.meshes = parse_names(root.at("meshes"));
  for (const text::JsonField& mesh : root.at("meshes").items()) text::parse_id(mesh);
  const text::JsonField shares = root.at("shares");
  shares.only_keys(std::vector<std::string>(kHappenings.begin(), kHappenings.end()));
  double sum = 0.0;
  for (std::size_t i = 0; i < kHappenings.size(); ++i) {
    if (shares.has(kHappenings[i]))
      rules.shares[i] = shares.at(kHappenings[i]).number({0.0, false, 1e6, false});
    sum += rules.shares[i];
  }
  if (!(sum > 0.0)) shares.fail("has no share above 0: nothing would happen");
  rules.most_triangles = root.at("most_triangles").whole(1, kMostTriangles);
  for (const RangeRule& rule : kRangeRules)
    rules.*rule.range =
        parse_range(root.at(rule.key), {rule.low, false, rule.high, false}, rule.whole);
  const double fewest = rules.bodies.high * rules.triangles.low;
  if (static_cast<double>(rules.most_triangles) < fewest)
    root.at("most_triangles")
        .refuse("at least " + text::shown(fewest) + ", so that " + text::shown(rules.bodies.high) +
                " bodies can have " + text::shown(rules.triangles.low) + " triangles each");
  if (!root.has("steps")) return rules;
  rules.steps = parse_steps(root.at("steps"));
  if (!(rules.speed.low > 0.0))
    root.at("speed").items()[0].refuse("above 0, since speeds of steps are drawn log-uniform");
  if (rules.frames.low < 2.0)
    root.at("frames").items()[0].refuse("at least 2: a step is from a frame to the next");
  return rules;
}

bool holds_draw_rules(const text::JsonValue& document) {
  return document.kind == text::JsonValue::Kind::kObject && document.find("shares") != nullptr;
}

}  // namespace contactcheck::scene
