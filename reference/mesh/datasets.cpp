#include "reference/mesh/datasets.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/types/check.h"
#include "reference/text/file_text.h"

namespace contactcheck::mesh {
namespace {

constexpr std::size_t kBlock = 512;
constexpr std::uint64_t kLargestMember = 1ull << 30;  // bytes; the largest real one has 4 MB
using Block = std::array<char, kBlock>;

class Archive {
 public:
  explicit Archive(const std::filesystem::path& file)
      : name_("archive " + text::in_quotes(file.string())),
        stream_(gzopen(file.c_str(), "rb"), gzclose) {
    if (!stream_) throw InputError(name_ + " cannot be read.");
    gzbuffer(stream_.get(), 1u << 17);
  }

  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + " " + what); }

  void read(char* out, std::uint64_t size) {
    while (size > 0) {
      const auto piece = static_cast<unsigned>(std::min<std::uint64_t>(size, 1u << 20));
      const int got = gzread(stream_.get(), out, piece);
      if (got <= 0) fail("is damaged or ends early.");
      out += got;
      size -= static_cast<std::uint64_t>(got);
    }
  }

  void skip(std::uint64_t size) {
    std::array<char, 1 << 16> scratch;
    for (; size > 0; size -= std::min<std::uint64_t>(size, scratch.size())) {
      read(scratch.data(), std::min<std::uint64_t>(size, scratch.size()));
    }
  }

 private:
  std::string name_;
  std::unique_ptr<gzFile_s, int (*)(gzFile)> stream_;
};

std::string field(const Block& header, std::size_t begin, std::size_t size) {
  const char* first = header.data() + begin;
  return std::string(first, std::find(first, first + size, '\0'));
}

std::uint64_t octal(const Block& header, std::size_t begin, std::size_t size, const Archive& tar) {
  std::uint64_t value = 0;
  for (const char c : field(header, begin, size)) {
    if (c == ' ') continue;
    if (c < '0' || c > '7') tar.fail("is not a tar archive of a known form.");
    value = 8 * value + static_cast<std::uint64_t>(c - '0');
  }
  return value;
}

// The header's own sum counts its eight bytes as blanks.
bool checksum_agrees(const Block& header, const Archive& tar) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < kBlock; ++i) {
    sum += i >= 148 && i < 156 ? ' ' : static_cast<unsigned char>(header[i]);
  }
  return sum == octal(header, 148, 8, tar);
}

std::string full_name(const Block& header) {
  const std::string prefix = field(header, 257, 5) == "ustar" ? field(header, 345, 155) : "";
  return (prefix.empty() ? "" : prefix + "/") + field(header, 0, 100);
}

}  // namespace

std::optional<std::string> read_tar_member(const std::filesystem::path& archive,
                                           const std::string& member) {
  Archive tar(archive);
  Block header;
  for (;;) {
    tar.read(header.data(), kBlock);
    if (header[0] == '\0') return std::nullopt;  // the end mark: blocks of zeros
    if (!checksum_agrees(header, tar)) tar.fail("is damaged: a header's checksum is wrong.");
    const std::uint64_t size = octal(header, 124, 12, tar);
    if (size > kLargestMember) tar.fail("has a member of more than 1 GiB.");
    const bool regular = header[156] == '0' || header[156] == '\0';
    if (regular && full_name(header) == member) {
      std::string bytes(size, '\0');
      tar.read(bytes.data(), size);
      return bytes;
    }
    tar.skip((size + kBlock - 1) / kBlock * kBlock);
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
    std::string known;
    for (const std::string& each : known_datasets()) known += (known.empty() ? "" : ", ") + each;
    throw InputError("libcgal-demo holds no mesh " + text::in_quotes(name) +
                     "; among its meshes are " + known + ".");
  }
  return read_mesh_bytes(SoupFormat::kOff, *bytes,
                         "mesh " + text::in_quotes(name) + " of libcgal-demo");
}

}  // namespace contactcheck::mesh
