#include "reference/suite/shard_record.h"

#include "reference/suite/run_identity.h"

namespace contactcheck::suite {

results::Shard shard_record(const SuiteRequest& request) {
  const ShardOfRun& part = *request.shard;
  results::Shard out;
  out.index = part.shard.index;
  out.of = part.shard.of;
  out.command = without_shard_flag(request.command, part.shard);
  out.program = hash_of_file(request.executable);
  // Plug-ins stand in the results themselves: their records name folders of one machine.
  for (const auto& setting : named_settings(request.settings))
    if (setting.first != "plugins") out.settings.push_back(setting);
  out.goals = request.goals;
  for (const SceneTask& task : part.run)
    out.scenes.push_back({task.id, task.detectors, task.references, task.content});
  return out;
}

results::Texts file_hashes(const NamedFiles& files) {
  results::Texts out;
  for (const auto& [name, file] : files) out[name] = hash_of_file(file);
  return out;
}

}  // namespace contactcheck::suite
