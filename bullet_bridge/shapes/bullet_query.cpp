#include "bullet_bridge/shapes/bullet_query.h"

#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "bullet_bridge/conversions.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

Penetration bullet_penetration(const btConvexShape& shape, const Vec3& point) {
  constexpr double kProbe = 1e-4;  // m, radius of the sphere that stands for the point
  const btSphereShape probe(kProbe);
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth_solver;
  btGjkPairDetector detector(&probe, &shape, &simplex, &depth_solver);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA.setIdentity();
  input.m_transformA.setOrigin(to_bullet(point));
  input.m_transformB.setIdentity();
  btPointCollector result;
  detector.getClosestPoints(input, result, nullptr);
  if (!result.m_hasResult) return {-1.0, Vec3::UnitY()};
  return {-(result.m_distance + kProbe), from_bullet(result.m_normalOnBInWorld)};
}

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
