#include "demos/scripting/script_source.h"

#include <algorithm>
#include <cctype>
#include <fstream>

#include "core/model/errors.h"
#include "shipped_scenes.h"

namespace limber::demos {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file, std::size_t most_bytes) {
  std::error_code trouble;
  const auto size = fs::file_size(file, trouble);
  if (trouble) throw InputError({file.string(), "it cannot be read", "check the name and rights"});
  if (size > most_bytes) {
    throw InputError(
        {file.string(), "it is larger than a script may be", "split it into modules for require"});
  }
  std::ifstream in(file, std::ios::binary);
  std::string text(most_bytes, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in.is_open() || in.bad()) {
    throw InputError({file.string(), "it cannot be read", "check the name and rights"});
  }
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

bool is_within(const fs::path& folder, const fs::path& file) {
  const auto [in_folder, in_file] =
      std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return in_folder == folder.end();
}

bool is_module_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '.';
  });
}

}  // namespace

ScriptSource script_in_file(const fs::path& file, std::size_t most_bytes) {
  ScriptSource source;
  source.name = file.string();
  source.text = text_of(file, most_bytes);
  source.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  return source;
}

std::optional<ScriptSource> shipped_script(const std::string& name) {
  for (const auto& [shipped, text] : assets::kShippedScenes) {
    if (name == shipped) return ScriptSource{name, text, {}};
  }
  return {};
}

std::vector<std::string> shipped_scripts() {
  std::vector<std::string> names;
  for (const auto& scene : assets::kShippedScenes) names.emplace_back(scene.name);
  std::ranges::sort(names);
  return names;
}

ScriptSource drop_script() { return {assets::kDropScene.name, assets::kDropScene.text, {}}; }

fs::path file_beside(const ScriptSource& source, const std::string& name) {
  if (source.folder.empty()) {
    throw InputError({name, "a scene that ships with Limber has no folder to read it from",
                      "copy the scene into one, and run the copy"});
  }
  std::error_code trouble;
  const fs::path folder = fs::canonical(source.folder, trouble);
  const fs::path file = fs::canonical(source.folder / name, trouble);
  const bool within = !fs::path(name).is_absolute() && is_within(folder, file);
  // One message for both: scripts must not find out which files there are elsewhere.
  if (trouble || !within || !fs::is_regular_file(file, trouble)) {
    throw InputError({name, "there is no such file in the scene's folder",
                      "put it beside the script, or check the name"});
  }
  return file;
}

std::string module_path(const std::string& module) {
  if (!is_module_name(module)) {
    throw InputError({"require", "'" + module + "' is no name of a module",
                      "give letters, digits, _ and dots: parts.leaf is the file parts/leaf.lua"});
  }
  std::string path = module;
  std::ranges::replace(path, '.', '/');
  return path + ".lua";
}

}  // namespace limber::demos
