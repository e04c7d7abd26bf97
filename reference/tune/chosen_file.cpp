#include "reference/tune/chosen_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/text/file_text.h"

namespace contactcheck::tune {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Every ".." in it leads where it says.
bool has_no_links(const fs::path& folder) {
  return fs::canonical(folder) == fs::absolute(folder / ".").lexically_normal().parent_path();
}

// From the folder that the suite lies in, so that both may move together.
fs::path path_from(const fs::path& folder, const fs::path& file) {
  const fs::path absolute = fs::absolute(file).lexically_normal();
  const fs::path base = fs::absolute(folder).lexically_normal();
  const bool plain = has_no_links(folder) && has_no_links(absolute.parent_path());
  const fs::path relative = absolute.lexically_relative(base);
  const bool within = !relative.empty() && *relative.begin() != "..";
  return within || plain ? relative : absolute;
}

// What comes along is named by its id, from wherever its file was read.
bool named_by_id(const std::string& scene, const TuningRequest& request) {
  return scene == request.target && request.scene_file != fs::path(scene);
}

const TuneCandidate& chosen_of(const Tuning& tuning) {
  CONTACTCHECK_INVARIANT(tuning.chosen.has_value(), "a configuration is chosen");
  return tuning.candidates[tuning.confirmed[*tuning.chosen].candidate];
}

}  // namespace

fs::path chosen_file(const TuningRequest& request) { return request.out / "chosen.json"; }

std::string chosen_suite(const Tuning& tuning, const TuningRequest& request) {
  const std::string& scene = tuning.chosen_scene;
  const Json named = named_by_id(scene, request)
                         ? Json(scene)
                         : Json{{"file", path_from(request.out, scene).string()}};
  const Json suite = {{"id", "chosen"},
                      {"title", "Chosen by contactcheck tune for " + tuning.scene},
                      {"scenes", Json::array({named})},
                      {"detectors", Json::array({chosen_of(tuning).detector})}};
  return suite.dump(1) + "\n";
}

bool chosen_from_outside(const Tuning& tuning, const TuningRequest& request) {
  const std::string& name = chosen_of(tuning).detector;
  const std::string id = name.substr(0, name.find(':'));
  return request.commands.contains(id) || request.libraries.contains(id);
}

void remove_old_choice(const TuningRequest& request) {
  const fs::path file = chosen_file(request);
  std::error_code error;
  if (fs::equivalent(file, request.scene_file, error))
    throw InputError("--out: the scene " + text::in_quotes(file.string()) +
                     " lies where the choice is to be written");
  if (!fs::remove(file, error) && error)
    throw InputError("cannot remove the old " + text::in_quotes(file.string()) + ": " +
                     error.message());
}

}  // namespace contactcheck::tune
