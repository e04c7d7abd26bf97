// The single contacts of a scene, for pictures: contacts/SCENE.json (schema
// contactcheck-contacts/1, fixtures/README.md). All of it comes from the judge.
#pragma once

#include <string>
#include <vector>

#include "reference/judge/judge.h"
#include "reference/judge/judged_scene.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// The true pairs of triangles of every frame that has any, self-contact included.
std::string truth_contacts(const JudgedScene& judged);

/// The missed and spurious contacts of a detector by frame; "" if no level was judged. Vertices
/// have the numbers of the meshes as given, before vertices were dropped.
std::string detector_contacts(const results::Run& run, const std::vector<Body>& bodies,
                              const std::vector<FrameDifferences>& differences);

/// Assembles the file from truth_contacts() and non-empty texts of detector_contacts().
std::string contacts_text(const std::string& scene, const std::string& truth,
                          const std::vector<std::string>& detectors);

/// The file's path inside the folder of a run: "contacts/SCENE.json".
std::string contacts_path(const std::string& scene);

}  // namespace contactcheck::judge
