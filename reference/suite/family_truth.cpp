#include "reference/suite/family_truth.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/judge/judge.h"
#include "reference/judge/judged_scene.h"
#include "reference/oracle/oracle.h"
#include "reference/suite/job.h"

namespace contactcheck::suite {
namespace {

using Json = nlohmann::ordered_json;

CaseTruth case_truth(const scene::Scene& scene, std::size_t frame, oracle::Oracle& oracle) {
  const auto vertices = scene::map_bodies(scene, scene.recorded[frame]);
  oracle::WantedTruth wanted;
  wanted.containment = scene.judges(Level::kContainment);
  wanted.self = any_self(scene.levels);
  oracle::Truth truth =
      oracle.judge(judge::make_frame(frame, 0.0, scene.recorded[frame], vertices), wanted);
  CaseTruth out;
  out.value = scene.family()->values[frame];
  out.bodies = truth.surface.bodies.size();
  out.containment = truth.containment.size();
  out.hash = results::hex(chain_hash(0, 0, truth.surface));
  out.triangles = std::move(truth.surface.triangles);
  for (const Level level : kSelfClasses) {
    if (!scene.judges(level)) continue;
    const auto pairs = judge::self_pairs(level, scene.bodies, truth.surface.self);
    out.self.insert(out.self.end(), pairs.begin(), pairs.end());
  }
  std::sort(out.self.begin(), out.self.end());
  return out;
}

Json case_json(const ExpectedCase& c) {
  Json out = {{"value", c.value},
              {"bodies", c.bodies},
              {"containment", c.containment},
              {"triangles", c.triangles}};
  if (c.self > 0) out["self"] = c.self;
  out["hash"] = c.hash;
  return out;
}

ExpectedCase parse_case(const Json& c) {
  return {c.at("value").get<std::string>(),       c.at("bodies").get<std::size_t>(),
          c.at("containment").get<std::size_t>(), c.at("triangles").get<std::size_t>(),
          c.value("self", std::size_t{0}),        c.at("hash").get<std::string>()};
}

// One case a line: a change is seen as the lines that changed.
std::string family_text(const std::string& id, const std::vector<ExpectedCase>& cases) {
  std::string out = "  " + Json(id).dump() + ": [\n";
  for (std::size_t c = 0; c < cases.size(); ++c)
    out += "    " + case_json(cases[c]).dump() + (c + 1 < cases.size() ? ",\n" : "\n");
  return out + "  ]";
}

}  // namespace

ExpectedCase summary_of(const CaseTruth& truth) {
  return {truth.value,       truth.bodies, truth.containment, truth.triangles.size(),
          truth.self.size(), truth.hash};
}

std::vector<CaseTruth> family_truth(const scene::Scene& scene) {
  CONTACTCHECK_INVARIANT(scene.family() != nullptr, "a family of cases");
  oracle::Oracle oracle(scene.bodies);
  std::vector<CaseTruth> out;
  for (std::size_t f = 0; f < scene.frames; ++f) out.push_back(case_truth(scene, f, oracle));
  return out;
}

ExpectedFamilies read_expected(const std::filesystem::path& file) {
  ExpectedFamilies out;
  try {
    const Json families = Json::parse(read_text_file(file));
    for (const auto& [id, cases] : families.items())
      for (const Json& c : cases) out[id].push_back(parse_case(c));
  } catch (const Json::exception& e) {
    throw InputError("expected answers " + file.string() + ": " + e.what());
  }
  return out;
}

void write_expected(const std::filesystem::path& file, const ExpectedFamilies& families) {
  std::string text = "{\n";
  for (const auto& [id, cases] : families)
    text += (text.size() > 2 ? ",\n" : "") + family_text(id, cases);
  write_file_atomically(file, text + "\n}\n");
}

}  // namespace contactcheck::suite
