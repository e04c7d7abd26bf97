#include "reference/suite/kept_work.h"

#include <exception>
#include <system_error>
#include <utility>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/suite/job.h"
#include "reference/suite/run_identity.h"
#include "reference/text/lists.h"

namespace contactcheck::suite {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHead = "kept.json";

}  // namespace

std::string identity_of(const std::string& lines) {
  return program_lines(fs::read_symlink("/proc/self/exe")) + lines;
}

void require_nothing_lost(const KeptWork& kept, const WorkToDo& work) {
  if (kept.left.empty() || work.overwrite) return;
  const std::string left = "--out " + work.out.string() + ": " + kept.left + " there";
  if (kept.identity != work.identity)
    throw InputError(left + ", of another one (other " +
                     text::joined(differences(kept.identity, work.identity)) + "): " +
                     kept.command + "; --overwrite discards them, another --out keeps them");
  if (!work.resume)
    throw InputError(left + ": --resume takes them over, --overwrite discards them");
}

KeptParts::KeptParts(const WorkToDo& work, const std::string& folder,
                     const std::function<std::string(std::size_t parts)>& left)
    : folder_(work.out / folder) {
  KeptWork kept;
  std::size_t parts = 0;
  try {
    const Json head = Json::parse(read_text_file(folder_ / kHead));
    kept.identity = head.at("identity").get<std::string>();
    kept.command = head.at("command").get<std::string>();
    while (fs::exists(file(parts))) ++parts;
  } catch (const std::exception&) {
    // There are none, or they are no parts.
  }
  if (parts > 0) kept.left = left(parts);
  require_nothing_lost(kept, work);
  if (work.resume && kept.identity == work.identity) {
    found_ = parts;
    return;
  }
  clear();
  head_ = {{"identity", work.identity}, {"command", work.command}};
}

fs::path KeptParts::file(std::size_t part) const {
  return folder_ / (std::to_string(part + 1) + ".json");
}

std::optional<KeptParts::Json> KeptParts::take(const std::string& what) {
  if (next_ >= found_) return std::nullopt;
  try {
    Json json = Json::parse(read_text_file(file(next_)));
    if (json.at("what") == what) {
      ++next_;
      return std::move(json.at("part"));
    }
  } catch (const std::exception&) {
    // A damaged part counts as none.
  }
  found_ = next_;
  return std::nullopt;
}

void KeptParts::keep(const std::string& what, Json part) {
  if (!head_.is_null()) {
    std::error_code error;
    fs::create_directories(folder_, error);  // the writer says why that fails
    write_file_atomically(folder_ / kHead, head_.dump() + "\n");
    head_ = nullptr;
  }
  const Json json = {{"what", what}, {"part", std::move(part)}};
  write_file_atomically(file(next_),
                        json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  found_ = ++next_;
}

// What others have put there stays.
void KeptParts::clear() const {
  std::error_code ignored;
  for (std::size_t part = 0; fs::remove(file(part), ignored); ++part) {
  }
  fs::remove(folder_ / kHead, ignored);
  fs::remove(folder_, ignored);  // fails, as it should, where something is left
}

}  // namespace contactcheck::suite
