// What targets share whose reader takes a file: the file, and what a refusal of it may say.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "core/types/check.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::test {

/// A sentence for a terminal and a log: neither the input as a whole nor anything that a terminal
/// takes for an order. Names of files count as nothing: a temporary folder may lie deep.
inline void require_sentence(std::string message, const std::filesystem::path& folder = {}) {
  constexpr std::size_t kLongest = 1000;  // bytes
  if (!folder.empty())
    for (std::size_t at; (at = message.find(folder.string())) != std::string::npos;)
      message.erase(at, folder.string().size());
  bool plain = !message.empty() && message.size() <= kLongest;
  for (const char c : message) plain &= static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
  if (!plain) std::fprintf(stderr, "%s\n", message.c_str());
  require(plain, "a refusal is one line of 1000 bytes at most, without control characters");
}

/// The one file of a folder of its own.
class FuzzedFile {
 public:
  explicit FuzzedFile(std::string name) : name_(std::move(name)) {}

  std::filesystem::path write(const std::uint8_t* data, std::size_t size) const {
    return scratch_.write(name_, std::string(reinterpret_cast<const char*>(data), size));
  }
  /// Whoever read it has left nothing beside it.
  void require_alone() const {
    for (const auto& entry : std::filesystem::directory_iterator(scratch_.folder()))
      require(entry.path().filename() == name_, "reading a file creates none");
  }
  const std::filesystem::path& folder() const { return scratch_.folder(); }

 private:
  Scratch scratch_;
  std::string name_;
};

/// Gives the input to `read(path)` as that file: whatever happens, no file is left beside it, and a
/// refusal is a sentence.
template <typename Read>
void try_file(const FuzzedFile& file, const std::uint8_t* data, std::size_t size, Read&& read) {
  const std::filesystem::path path = file.write(data, size);
  try {
    read(path);
  } catch (const InputError& refusal) {
    require_sentence(refusal.what(), file.folder());
  }
  file.require_alone();
}

}  // namespace contactcheck::test
