// The contacts of a scene one by one, for pictures: contacts/SCENE.json (schema
// contactcheck-contacts/1, fixtures/README.md). Everything in it was found by the judge.
#pragma once

#include <string>
#include <vector>

#include "reference/judge/judge.h"
#include "reference/judge/judged_scene.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// The true pairs of triangles of every frame that has any.
std::string truth_contacts(const JudgedScene& judged);

/// What a detector missed and made up, frame by frame; "" where it was judged at no level. Vertices
/// by the numbers that they have in the meshes as they were given.
std::string detector_contacts(const results::Run& run, const std::vector<Body>& bodies,
                              const std::vector<FrameDifferences>& differences);

/// The file's text. `truth`: truth_contacts(); `detectors`: detector_contacts(), none empty.
std::string contacts_text(const std::string& scene, const std::string& truth,
                          const std::vector<std::string>& detectors);

/// Where the file of a scene stands in the folder of a run: "contacts/SCENE.json".
std::string contacts_path(const std::string& scene);

}  // namespace contactcheck::judge
