#include "reference/cli/kept_work.h"

#include "core/types/check.h"
#include "reference/suite/run_identity.h"
#include "reference/text/lists.h"

namespace contactcheck::cli {

std::string identity_of(const std::string& lines) {
  return "version: " CONTACTCHECK_VERSION "\nprogram: " +
         suite::hash_of_file(std::filesystem::read_symlink("/proc/self/exe")) + "\n" + lines;
}

void require_nothing_lost(const std::filesystem::path& out, const KeptWork& kept,
                          const std::string& identity, bool resume, bool overwrite) {
  if (kept.left.empty() || overwrite) return;
  const std::string left = "--out " + out.string() + ": " + kept.left + " there";
  if (kept.identity != identity)
    throw InputError(left + ", of another one (other " +
                     text::joined(suite::differences(kept.identity, identity)) + "): " +
                     kept.command + "; --overwrite discards them, another --out keeps them");
  if (!resume) throw InputError(left + ": --resume takes them over, --overwrite discards them");
}

}  // namespace contactcheck::cli
