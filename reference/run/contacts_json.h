// The contacts of a scene one by one, for pictures: contacts/SCENE.json (schema
// contactcheck-contacts/1, fixtures/README.md). Everything in it was found by the judge.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reference/compare/run_result.h"
#include "reference/run/judged_scene.h"

namespace contactcheck {

/// The true pairs of triangles of every frame that has any.
nlohmann::ordered_json truth_contacts(const JudgedScene& judged);

/// What a detector missed and made up, frame by frame; null where it was judged at no level.
nlohmann::ordered_json detector_contacts(const RunResult& run);

/// The file's text. `detectors`: a list of detector_contacts().
std::string contacts_text(const std::string& scene, const nlohmann::ordered_json& truth,
                          const nlohmann::ordered_json& detectors);

/// Where the file of a scene stands in the folder of a run: "contacts/SCENE.json".
std::string contacts_path(const std::string& scene);

}  // namespace contactcheck
