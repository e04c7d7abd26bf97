// What an interrupted command has left in its folder, and what the next one may do with it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace contactcheck::suite {

/// The identity of what a command does: lines "name: value" about this program, and `lines`.
std::string identity_of(const std::string& lines);

struct KeptWork {
  std::string left;      ///< "an interrupted check has left 5 checked frames"; empty: nothing
  std::string identity;  ///< of what was done
  std::string command;   ///< that did it
};

/// What may become of kept work.
struct WorkToDo {
  std::filesystem::path out;
  std::string identity, command;
  bool resume = false, overwrite = false;
};

/// @throws InputError, one sentence: what is there would be lost, since it is not of this identity
/// or is not to be resumed, and is not to be overwritten
void require_nothing_lost(const KeptWork& kept, const WorkToDo& work);

/// The parts that a command has finished, one after another, in a folder of --out until all are
/// done. Each is there as a whole or not at all.
class KeptParts {
 public:
  using Json = nlohmann::ordered_json;

  /// `folder`: its name in --out. `left`: says how many there are. @throws InputError when some
  /// would be lost
  KeptParts(const WorkToDo& work, const std::string& folder,
            const std::function<std::string(std::size_t parts)>& left);

  /// The number of parts that were there and may be taken.
  std::size_t found() const { return found_; }
  /// The next part, if it was kept and `what` names it. After the first that was not, none is.
  std::optional<Json> take(const std::string& what);
  /// Keeps the next part. @throws InputError when it cannot be written
  void keep(const std::string& what, Json part);
  /// After the last one. Removes them, and the folder unless other files are in it.
  void clear() const;

 private:
  std::filesystem::path file(std::size_t part) const;

  std::filesystem::path folder_;
  Json head_;  // not written yet: where nothing is kept, nothing is left behind
  std::size_t found_ = 0, next_ = 0;
};

}  // namespace contactcheck::suite
