#pragma once

#include <memory>
#include <utility>

#include "bullet_bridge/co_simulation.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

struct StageBox {
  Vec3 half_extents;  // m
  Vec3 centre;        // m
  double mass = 0.0;  // kg, 0 for static
  double friction = 0.5;
  double restitution = 0.0;
};

// A small Bullet world of its own with Limber in it, for programs that have no world yet and do not
// want to include Bullet.
class Stage {
 public:
  Stage(const Vec3& gravity, const CoSimulationSettings& settings);
  ~Stage();
  Stage(Stage&&) noexcept;

  void add_floor(double friction);  // the plane y = 0
  int add_box(const StageBox& box);
  std::pair<Vec3, Mat3> box_pose(int box) const;  // centre, rotation

  CoSimulation& co_simulation();
  const CoSimulation& co_simulation() const;

  // One tick, s. Throws SimulationError when a lattice had to be stopped.
  void step(double tick);

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
