#include "reference/defects/sightings.h"

#include <nlohmann/json.hpp>

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

constexpr SightingKind kWrongAnswers[] = {SightingKind::kMissed, SightingKind::kSpurious};

const Json& scene_of(const Json& results, const Json& run) {
  for (const Json& scene : results.at("scenes"))
    if (scene.at("id") == run.at("scene")) return scene;
  return results.at("scenes").at(results.at("scenes").size());  // throws: there is none
}

Sighting sighting_in(const Json& run) {
  return {run.at("detector").get<std::string>(), run.at("scene").get<std::string>(),
          SightingKind::kMissed, kNoCase};
}

void add_answers(const Json& values, const Json& run, SightingsOfRun& out) {
  Sighting s = sighting_in(run);
  for (const SightingKind kind : kWrongAnswers) {
    s.kind = kind;
    const Json& counts = run.at("per_frame").at(name_of(kind));
    for (std::size_t frame = 0; frame < counts.size(); ++frame) {
      s.value = values.at(frame).get<std::string>();
      out.possible.insert(s);
      if (counts[frame] != 0) out.seen.insert(s);
    }
  }
}

// The case at which a detector failed; behind the last one where none is known.
std::size_t failed_case(const Json& values, const Json& run) {
  if (run.at("status") != "error" || !run.contains("failed_frame")) return values.size();
  return run.at("failed_frame").get_ref<const Json::number_unsigned_t&>();
}

// It would have failed at an earlier case, were that one bad too; of the later ones nobody knows.
void add_errors(const Json& values, const Json& run, SightingsOfRun& out) {
  Sighting s = sighting_in(run);
  s.kind = SightingKind::kError;
  out.possible.insert(s);  // with no case to blame
  const std::size_t failed = failed_case(values, run);
  for (std::size_t i = 0; i <= failed && i < values.size(); ++i) {
    s.value = values[i].get<std::string>();
    out.possible.insert(s);
  }
  if (run.at("status") != "error") return;
  s.value = failed < values.size() ? values[failed].get<std::string>() : kNoCase;
  out.seen.insert(s);
}

}  // namespace

const char* name_of(SightingKind kind) {
  switch (kind) {
    case SightingKind::kMissed:
      return "missed";
    case SightingKind::kSpurious:
      return "spurious";
    case SightingKind::kError:
      return "error";
  }
  return "";
}

SightingsOfRun sightings_of(const Json& results) {
  SightingsOfRun out;
  for (const Json& run : results.at("runs")) {
    const Json& scene = scene_of(results, run);
    if (scene.contains("unjudged")) continue;  // no detector was asked
    const bool family = scene.contains("family");
    const Json values = family ? scene.at("family").at("values") : Json::array();
    const bool answered = run.at("status") == "ok";
    if (answered || run.at("status") == "error") add_errors(values, run, out);
    if (answered && family && !run.at("per_frame").value("level", "").empty())
      add_answers(values, run, out);
  }
  return out;
}

}  // namespace contactcheck
