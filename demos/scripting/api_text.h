#pragma once

#include <string>

namespace limber::demos {

// The reference of everything that scripts can use, as Markdown: docs/scripting_reference.md.
std::string api_reference();

// The same for editors: annotations of the Lua language server (LuaLS), for completion and hints.
std::string api_stubs();

}  // namespace limber::demos
