#include "tests/metamorphic/corpus_subjects.h"

#include "tests/hard/corpus.h"

namespace contactcheck::test {

std::shared_ptr<const Subject> subject_of_family(const std::string& id) {
  const HardFamily& family = hard_family(id);
  Subject out{family.scene.bodies, {}, {}};
  for (std::size_t v = 0; v < family.truth.size(); ++v) {
    out.frames.push_back({family.scene.recorded[v], family.vertices[v]});
    out.labels.push_back(id + "@" + family.truth[v].value);
  }
  return std::make_shared<const Subject>(std::move(out));
}

const std::vector<std::shared_ptr<const Subject>>& corpus_subjects() {
  static const auto subjects = [] {
    std::vector<std::shared_ptr<const Subject>> out;
    for (const std::string& id : family_ids()) out.push_back(subject_of_family(id));
    return out;
  }();
  return subjects;
}

}  // namespace contactcheck::test
