#include "reference/mesh/datasets.h"

#include <archive.h>
#include <archive_entry.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>

#include "core/types/check.h"
#include "reference/text/file_text.h"
#include "reference/text/lists.h"

namespace contactcheck::mesh {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::vector<std::filesystem::path> data_roots() {
  const std::string own = environment("CONTACTCHECK_DATA");
  if (!own.empty()) return {own};
  std::vector<std::filesystem::path> roots = {"/"};
  const std::string cache = environment("XDG_CACHE_HOME"), home = environment("HOME");
  if (!cache.empty()) {
    roots.push_back(std::filesystem::path(cache) / "contactcheck");
  } else if (!home.empty()) {
    roots.push_back(std::filesystem::path(home) / ".cache" / "contactcheck");
  }
  return roots;
}

std::filesystem::path find_package_file(const std::vector<std::filesystem::path>& roots,
                                        const std::string& package, const std::string& path) {
  std::string searched;
  for (const std::filesystem::path& root : roots) {
    std::filesystem::path file = root / path;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
    searched += (searched.empty() ? "" : " or ") + text::in_quotes(file.string());
  }
  throw InputError("the Debian package " + package + " is missing (no file " + searched +
                   "): install it with \"apt-get install " + package +
                   "\", or run .ci/setup, which also unpacks it where /usr/share/doc is left out.");
}

std::optional<std::string> read_tar_member(const std::filesystem::path& file,
                                           const std::string& member) {
  constexpr std::size_t kLargest = std::size_t{256} << 20;  // bytes; the largest real one has 4 MB
  constexpr std::size_t kBlock = std::size_t{1} << 17;
  const std::string name = "archive " + text::in_quotes(file.string());
  const std::unique_ptr<archive, int (*)(archive*)> tar(archive_read_new(), archive_read_free);
  archive_read_support_filter_gzip(tar.get());
  archive_read_support_format_tar(tar.get());
  const auto fault = [&](const char* what) {
    const char* why = archive_error_string(tar.get());
    return InputError(name + what + (why == nullptr ? "." : std::string(": ") + why + "."));
  };
  if (archive_read_open_filename(tar.get(), file.c_str(), kBlock) != ARCHIVE_OK)
    throw fault(" cannot be read");
  for (archive_entry* entry = nullptr;;) {
    const int found = archive_read_next_header(tar.get(), &entry);
    if (found == ARCHIVE_EOF) return std::nullopt;
    if (found != ARCHIVE_OK) throw fault(" is damaged or ends early");
    const char* path = archive_entry_pathname(entry);
    if (path == nullptr || path != member || archive_entry_filetype(entry) != AE_IFREG) continue;
    // What there is and not what the header says: it may claim any size.
    std::string bytes;
    for (std::size_t end = 0;; bytes.resize(end)) {
      bytes.resize(end + kBlock);
      const la_ssize_t read = archive_read_data(tar.get(), bytes.data() + end, kBlock);
      if (read < 0) throw fault(" is damaged or ends early");
      if (read == 0) {
        bytes.resize(end);
        break;
      }
      end += static_cast<std::size_t>(read);
      if (end > kLargest) throw InputError(name + " has a member of more than 256 MiB.");
    }
    if (archive_entry_size(entry) != static_cast<std::int64_t>(bytes.size()))
      throw fault(" is damaged or ends early");
    return bytes;
  }
}

namespace {

constexpr const char* kMeshPackage = "libcgal-demo";
constexpr const char* kArchive = "usr/share/doc/libcgal-demo/data.tar.gz";

}  // namespace

const std::vector<std::string>& known_datasets() {
  static const std::vector<std::string> names = {
      "armadillo", "bunny00", "camel", "cow", "dino", "diplodocus", "elephant", "triceratops"};
  return names;
}

LoadedMesh load_dataset(const std::string& name, const std::vector<std::filesystem::path>& roots) {
  const std::filesystem::path archive = find_package_file(roots, kMeshPackage, kArchive);
  const std::string member = "data/meshes/" + name + ".off";
  const std::optional<std::string> bytes = read_tar_member(archive, member);
  if (!bytes) {
    throw InputError("libcgal-demo holds no mesh " + text::in_quotes(name) +
                     "; among its meshes are " + text::joined(known_datasets()) + ".");
  }
  return read_mesh_bytes(SoupFormat::kOff, *bytes,
                         "mesh " + text::in_quotes(name) + " of libcgal-demo");
}

}  // namespace contactcheck::mesh
