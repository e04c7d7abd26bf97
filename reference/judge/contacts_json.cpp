#include "reference/judge/contacts_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace contactcheck::judge {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "contactcheck-contacts/1";

// Where a level counts whole bodies, or a vertex with a body, -1 stands for the element.
constexpr int kNoElement = -1;

Json to_json(const ListedPairs& listed, NamedElements elements, const std::vector<Body>& bodies) {
  Json flat = Json::array();
  const auto add = [&](std::uint32_t body, Element kind, std::uint32_t element) {
    if (kind == Element::kVertex) element = bodies[body].shape->given.number_of(element);
    flat.push_back(body);
    flat.push_back(kind == Element::kNone ? Json(kNoElement) : Json(element));
  };
  for (const ElementPair& pair : listed.pairs) {
    add(pair.body_a, elements.first, pair.a);
    add(pair.body_b, elements.second, pair.b);
  }
  return {{"count", listed.count}, {"pairs", std::move(flat)}};
}

ListedPairs first_of(const std::vector<ElementPair>& pairs) {
  const std::size_t listed = std::min(kListedPairs, pairs.size());
  return {pairs.size(), {pairs.data(), pairs.data() + listed}};
}

}  // namespace

std::string truth_contacts(const JudgedScene& judged) {
  Json frames = Json::array();
  for (std::size_t f = 0; f < judged.truth.size(); ++f) {
    std::vector<ElementPair> triangles = judged.truth[f].surface.triangles;
    for (const SelfPair& p : judged.truth[f].surface.self)
      triangles.push_back({p.body, p.body, p.a, p.b});
    if (triangles.empty()) continue;
    Json frame = {{"frame", f}};
    frame.update(to_json(first_of(triangles), named_elements(Level::kTriangle, true), {}));
    frames.push_back(std::move(frame));
  }
  return frames.dump();
}

std::string detector_contacts(const results::Run& run, const std::vector<Body>& bodies,
                              const std::vector<FrameDifferences>& differences) {
  if (run.per_frame.truth.empty()) return "";
  const Level level = run.per_frame.level.value();
  Json frames = Json::array();
  for (const FrameDifferences& d : differences)
    frames.push_back({{"frame", d.frame},
                      {"missed", to_json(d.missed, named_elements(level, true), bodies)},
                      {"spurious", to_json(d.spurious, named_elements(level, false), bodies)}});
  const Json out = {
      {"detector", run.detector}, {"level", name_of(level)}, {"frames", std::move(frames)}};
  return out.dump();
}

std::string contacts_text(const std::string& scene, const std::string& truth,
                          const std::vector<std::string>& detectors) {
  const Json head = {{"schema", kSchema}, {"scene", scene}, {"limit", kListedPairs}};
  std::string text = head.dump();
  text.back() = ',';
  text += "\"truth\":" + truth + ",\"detectors\":[";
  for (std::size_t i = 0; i < detectors.size(); ++i) text += (i > 0 ? "," : "") + detectors[i];
  return text + "]}\n";
}

std::string contacts_path(const std::string& scene) { return "contacts/" + scene + ".json"; }

}  // namespace contactcheck::judge
