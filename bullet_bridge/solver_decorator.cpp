#include "bullet_bridge/solver_decorator.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {
namespace {

// setConstraintSolver() frees a solver that the world made itself; the flag that says so is
// protected (btDiscreteDynamicsWorld.cpp:1350 in 3.24).
struct Ownership : btDiscreteDynamicsWorld {
  static bool& of(btDiscreteDynamicsWorld& world) {
    return world.*(&Ownership::m_ownsConstraintSolver);
  }
};

}  // namespace

SolverDecorator::SolverDecorator(btDiscreteDynamicsWorld& world, TickHooks& hooks)
    : world_(world),
      hooks_(hooks),
      inner_(world.getConstraintSolver()),
      world_owns_inner_(Ownership::of(world)) {
  Ownership::of(world_) = false;
  world_.setConstraintSolver(this);
  world_.addAction(this);
}

SolverDecorator::~SolverDecorator() {
  world_.removeAction(this);
  world_.setConstraintSolver(inner_);
  Ownership::of(world_) = world_owns_inner_;
}

void SolverDecorator::prepareSolve(int bodies, int manifolds) {
  hooks_.before_solve(world_.getSolverInfo().m_timeStep);
  inner_->prepareSolve(bodies, manifolds);
}

btScalar SolverDecorator::solveGroup(btCollisionObject** bodies, int body_count,
                                     btPersistentManifold** manifolds, int manifold_count,
                                     btTypedConstraint** constraints, int constraint_count,
                                     const btContactSolverInfo& info, btIDebugDraw* drawer,
                                     btDispatcher* dispatcher) {
  return inner_->solveGroup(bodies, body_count, manifolds, manifold_count, constraints,
                            constraint_count, info, drawer, dispatcher);
}

void SolverDecorator::allSolved(const btContactSolverInfo& info, btIDebugDraw* drawer) {
  inner_->allSolved(info, drawer);
  hooks_.after_solve(info.m_timeStep);
}

void SolverDecorator::reset() { inner_->reset(); }

// Multi-body worlds cast a solver of type BT_MULTIBODY_SOLVER to their own class
// (btMultiBodyDynamicsWorld.cpp:206): the decorator is none.
btConstraintSolverType SolverDecorator::getSolverType() const {
  return BT_SEQUENTIAL_IMPULSE_SOLVER;
}

void SolverDecorator::updateAction(btCollisionWorld*, btScalar dt) { hooks_.after_move(dt); }

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
