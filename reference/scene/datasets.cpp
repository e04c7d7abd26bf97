#include "reference/scene/datasets.h"

#include <optional>

#include "core/types/check.h"
#include "reference/scene/file_text.h"
#include "reference/scene/tar_archive.h"

namespace contactcheck {
namespace {

constexpr const char* kPackage = "libcgal-demo";
constexpr const char* kArchive = "usr/share/doc/libcgal-demo/data.tar.gz";

}  // namespace

const std::vector<std::string>& known_datasets() {
  static const std::vector<std::string> names = {
      "armadillo", "bunny00", "camel", "cow", "dino", "diplodocus", "elephant", "triceratops"};
  return names;
}

LoadedMesh load_dataset(const std::string& name, const std::vector<std::filesystem::path>& roots) {
  const std::filesystem::path archive = find_package_file(roots, kPackage, kArchive);
  const std::string member = "data/meshes/" + name + ".off";
  const std::optional<std::string> bytes = read_tar_member(archive, member);
  if (!bytes) {
    std::string known;
    for (const std::string& each : known_datasets()) known += (known.empty() ? "" : ", ") + each;
    throw InputError("libcgal-demo holds no mesh " + in_quotes(name) + "; among its meshes are " +
                     known + ".");
  }
  return read_mesh_bytes(SoupFormat::kOff, *bytes, "mesh " + in_quotes(name) + " of libcgal-demo");
}

}  // namespace contactcheck
