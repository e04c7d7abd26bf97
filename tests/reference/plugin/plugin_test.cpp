#include "reference/plugin/plugin.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/suite/job.h"
#include "reference/text/shell_word.h"
#include "tests/reference/plugin/plugin_run.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::plugin {
namespace {

using testing::HasSubstr;

Plugin command_plugin(const std::string& id) {
  Plugin plugin;
  plugin.source = {PluginKind::kCommand, "./mine --fast"};
  plugin.content = "0x1";
  plugin.declaration.id = id;
  plugin.declaration.semantics.levels = {Level::kBody};
  plugin.declaration.semantics.questions = {Question::kBody};
  return plugin;
}

TEST(Plugin, RecordIsReadAsItWasWritten) {
  const std::string record = to_json(command_plugin("mine")).dump();
  EXPECT_EQ(to_json(plugin_from_text(record)).dump(), record);
}

TEST(Plugin, ContentFollowsTheFilesBytes) {
  const test::Scratch scratch;
  const std::string library = scratch.write("libmine.so", "one").string();
  const std::string script = scratch.write("mine.py", "one").string();
  const PluginSource by_library = {PluginKind::kLibrary, library};
  const PluginSource by_command = {PluginKind::kCommand, "python3 " + script};
  const std::string first_library = content_of(by_library), first_command = content_of(by_command);
  EXPECT_EQ(content_of(by_library), first_library);
  EXPECT_NE(content_of({PluginKind::kCommand, "python3 -B " + script}), first_command);
  scratch.write("libmine.so", "two");
  scratch.write("mine.py", "two");
  EXPECT_NE(content_of(by_library), first_library);
  EXPECT_NE(content_of(by_command), first_command) << "its script has changed";
}

TEST(Plugin, ContentFollowsAScriptWhoseNameIsQuoted) {
  const test::Scratch scratch;
  const std::string script = scratch.write("two words/mine.py", "one").string();
  const PluginSource source = {PluginKind::kCommand, "python3 " + text::in_shell(script)};
  const std::string first = content_of(source);
  scratch.write("two words/mine.py", "two");
  EXPECT_NE(content_of(source), first);
}

TEST(Plugin, ContentIsPartOfTheSettingsThatResumeCompares) {
  suite::RunSettings settings, other;
  settings.plugins = other.plugins = {to_json(command_plugin("mine")).dump()};
  EXPECT_EQ(suite::named_settings(settings), suite::named_settings(other));
  Plugin changed = command_plugin("mine");
  changed.content = "0x2";
  other.plugins = {to_json(changed).dump()};
  EXPECT_NE(suite::named_settings(settings), suite::named_settings(other));
}

TEST(Plugin, TakesNoNameThatIsAnothers) {
  const auto sentence = [](const std::string& id) {
    return test::sentence_of([&] {
      DetectorCatalog catalog = adapters::standard_catalog();
      add_plugin(command_plugin(id), catalog);
    });
  };
  EXPECT_EQ(sentence("mine"), "");
  EXPECT_THAT(sentence("embree"), HasSubstr("another detector's name"));
  for (const char* kept : {"bullet-mine", "fcl", "embree-2", "libccd-epa", "oracle"})
    EXPECT_THAT(sentence(kept), HasSubstr("a name that is kept for")) << kept;
}

TEST(Plugin, NamedByItsIdTakesItsOptions) {
  Plugin plugin = command_plugin("mine");
  OptionInfo leaf;
  leaf.name = "leaf";
  leaf.default_value = "4";
  leaf.min = 1;
  leaf.max = 8;
  plugin.declaration.options = {leaf};
  const DetectorCatalog catalog =
      with_plugins(adapters::standard_catalog(), {to_json(plugin).dump()});
  EXPECT_EQ(catalog.parse("mine:leaf=8").name, "mine:leaf=8");
  EXPECT_EQ(catalog.parse("mine:leaf=4").name, "mine");
  EXPECT_THROW(catalog.parse("mine:leaf=9"), InputError);
}

}  // namespace
}  // namespace contactcheck::plugin
