// Small recordings and their bytes, for the tests of the .ccr format.
#pragma once

#include <filesystem>
#include <string>

#include "core/deform/recording.h"

namespace contactcheck {

/// A new folder that is removed with everything in it.
class ScratchFolder {
 public:
  ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();
  const std::filesystem::path& path() const { return path_; }
  std::size_t file_count() const;

 private:
  std::filesystem::path path_;
};

TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi);
TriangleMesh one_triangle();

/// Three bodies in two shapes (a box in a 2 x 2 x 2 lattice twice, a bare triangle), two frames.
Recording sample_recording();
/// One bare triangle, one frame.
Recording bare_recording();

std::string read_bytes(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, const std::string& bytes);
std::string bytes_of(const Recording& recording);
/// Writes the bytes to a new file and reads that as a recording.
Recording recording_of(const std::string& bytes);

/// Little-endian values, written here without the code under test.
std::string u64_bytes(std::uint64_t value);
std::string u32_bytes(std::uint32_t value);
std::string f64_bytes(double value);
void set_u64(std::string& bytes, std::size_t at, std::uint64_t value);

/// 64-bit FNV-1a, written here without the code under test.
std::uint64_t reference_hash(const std::string& bytes);
/// Sets file size and trailing hash to what the bytes now ask for.
void seal(std::string& bytes);

}  // namespace contactcheck
