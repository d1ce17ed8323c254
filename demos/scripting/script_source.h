#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/physical_model.h"

namespace limber::demos {

// Where a script comes from: a file, or the program itself, which has the scenes that ship compiled
// in.
struct ScriptSource {
  std::string name;  // for messages: the file as it was typed
  std::string text;
  std::filesystem::path folder;  // of the scene's modules and meshes; empty: compiled in
  // What the script gets as its argument; null: nothing.
  std::shared_ptr<const PhysicalModel> model = nullptr;
};

// Throws InputError for a file that cannot be read or is too large.
ScriptSource script_in_file(const std::filesystem::path& file, std::size_t most_bytes);

// The scene of this name that ships with Limber, and the names of all of them, ascending.
std::optional<ScriptSource> shipped_script(const std::string& name);
std::vector<std::string> shipped_scripts();

// The script that drops a model from a file; without the model, which is its argument.
ScriptSource drop_script();

// The file of this name in the folder of the source or below it. Throws InputError for a name that
// leads out of it (also by links), for a source without a folder, and for what is no file.
std::filesystem::path file_beside(const ScriptSource& source, const std::string& name);

// The module `a.b`: a/b.lua, beside the scene. Throws InputError for what is no name of one.
std::string module_path(const std::string& module);

}  // namespace limber::demos
