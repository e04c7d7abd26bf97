#include "reference/suite/finished_scene.h"

#include "reference/suite/job.h"
#include "reference/suite/out_folder.h"

namespace contactcheck::suite {

FinishedScene finished_scene(const results::Index& rows, const std::string& id,
                             const std::filesystem::path& folder,
                             const std::filesystem::path& scratch) {
  FinishedScene out;
  out.scene = *rows.scene(id);
  for (const results::Run* run : rows.runs_of(id)) out.runs.push_back(*run);
  for (const results::Disagreement& disagreement : rows.results().disagreements) {
    if (disagreement.scene != id) continue;
    const std::filesystem::path copy =
        scratch / (id + ".taken" + std::to_string(out.disagreements.size()));
    copy_file_to(folder / disagreement.case_file, copy);
    out.disagreements.push_back(disagreement);
    out.disagreements.back().case_file = copy.string();
  }
  if (!out.scene.contacts.empty()) out.contacts = read_text_file(folder / out.scene.contacts);
  const auto hash = rows.results().identities.find(id);
  if (hash != rows.results().identities.end()) out.hash = hash->second;
  return out;
}

}  // namespace contactcheck::suite
