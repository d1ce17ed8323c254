#include "demos/render/povray.h"

#include <fmt/format.h>

#include <fstream>

#include "core/model/errors.h"
#include "demos/render/child_process.h"

namespace limber::demos {
namespace {

constexpr const char* kScene = "scene.pov";
constexpr const char* kPicture = "image.png";

// Its own settings allow it to read and write everywhere we go only in the folder it runs in.
constexpr Program kPovray = {"POV-Ray", "povray", "povray"};

}  // namespace

void require_povray() {
  const ScratchFolder folder;
  run_program(kPovray, {"--version"}, folder.path());
}

std::string trace_png(const std::string& pov_text, const PictureSize& size) {
  const ScratchFolder folder;
  std::ofstream(folder.path() / kScene, std::ios::binary) << pov_text;
  // No display, 8-bit PNG, recursive anti-aliasing without jitter: the same pixels every time.
  run_program(
      kPovray,
      {fmt::format("+I{}", kScene), fmt::format("+O{}", kPicture), fmt::format("+W{}", size.width),
       fmt::format("+H{}", size.height), "-D", "-P", "+FN8", "+A0.2", "+AM2", "+R2", "-J"},
      folder.path());
  std::string png = bytes_of(folder.path() / kPicture);
  if (!png.empty()) return png;
  throw SimulationError({kPovray.name, "it wrote no picture",
                         "check the free memory and the room in the temporary folder"});
}

}  // namespace limber::demos
