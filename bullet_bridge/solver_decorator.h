#pragma once

#include <BulletDynamics/ConstraintSolver/btConstraintSolver.h>
#include <BulletDynamics/Dynamics/btActionInterface.h>

#include "bullet_bridge/precision.h"

class btDiscreteDynamicsWorld;

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// The three moments of a Bullet tick at which Limber works, in this order. dt is the tick, s.
class TickHooks {
 public:
  virtual ~TickHooks() = default;
  virtual void before_solve(double dt) = 0;  // contacts are known, no impulse is applied yet
  virtual void after_solve(double dt) = 0;   // velocities are final, positions have not moved
  virtual void after_move(double dt) = 0;    // bodies may be added and removed
};

// Stands before the world's own constraint solver and passes everything on; together with an action
// it calls the hooks. This takes none of the game's callback slots. The world and the hooks must
// outlive it; its destructor gives the world its solver back.
class SolverDecorator : public btConstraintSolver, public btActionInterface {
 public:
  SolverDecorator(btDiscreteDynamicsWorld& world, TickHooks& hooks);
  ~SolverDecorator() override;
  SolverDecorator(const SolverDecorator&) = delete;
  SolverDecorator& operator=(const SolverDecorator&) = delete;

  void prepareSolve(int bodies, int manifolds) override;
  btScalar solveGroup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                      int manifold_count, btTypedConstraint** constraints, int constraint_count,
                      const btContactSolverInfo& info, btIDebugDraw* drawer,
                      btDispatcher* dispatcher) override;
  void allSolved(const btContactSolverInfo& info, btIDebugDraw* drawer) override;
  void reset() override;
  btConstraintSolverType getSolverType() const override;

  void updateAction(btCollisionWorld* world, btScalar dt) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  btDiscreteDynamicsWorld& world_;
  TickHooks& hooks_;
  btConstraintSolver* inner_;
  bool world_owns_inner_;
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
