#include "tests/contact_scenes/scenes.h"

namespace limber::bullet::test {

std::vector<Scene> all_scenes() {
  std::vector<Scene> all;
  for (const auto& group :
       {mass_ratio_scenes, ball_scenes, vice_scenes, stack_scenes, needle_scenes, draping_scenes,
        coarse_scenes, landing_scenes, collision_scenes, crowd_scenes}) {
    for (Scene& scene : group()) all.push_back(std::move(scene));
  }
  return all;
}

}  // namespace limber::bullet::test
