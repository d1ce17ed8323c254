#include "tests/support/lattices.h"

#include <gtest/gtest.h>

namespace limber::test {

PhysicalModel chain(const ChainShape& shape) {
  GeometricModelBuilder builder;
  builder.begin_subobject(shape.name);
  std::vector<PointId> ids;
  for (int i = 0; i < shape.points; ++i) {
    ids.push_back(builder.add_point(shape.origin + i * shape.spacing * shape.along));
  }
  for (int i = 1; i < shape.points; ++i) builder.edge(ids[i - 1], ids[i]);
  PhysicalModel model = with_default_attributes(builder.finish(), shape.name);
  for (PointAttributes& p : model.points) p.mass = shape.mass;
  for (EdgeAttributes& e : model.edges) e.stiffness = shape.stiffness;
  return model;
}

Lattice lattice_of(std::vector<PhysicalModel> models) {
  Lattice lattice;
  for (PhysicalModel& model : models) add_object(lattice, std::move(model));
  rebuild_active(lattice);
  return lattice;
}

Totals totals(const Lattice& lattice) {
  Totals sum;
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    const auto& [x, v] = lattice.motion[p];
    const double m = lattice.mass[p];
    sum.kinetic += 0.5 * m * v.dot(v);
    sum.momentum += m * v;
    sum.angular_momentum += m * x.cross(v);
    sum.momentum_scale += m * v.norm();
    sum.angular_momentum_scale += m * x.norm() * v.norm();
  }
  for (std::size_t e = 0; e < lattice.springs.size(); ++e) {
    if (lattice.breaking.edge_broken[e]) continue;
    const Spring& s = lattice.springs[e];
    const double length = (lattice.motion[s.a].position - lattice.motion[s.b].position).norm();
    sum.elastic += 0.5 * s.stiffness * (length - s.rest_length) * (length - s.rest_length);
  }
  return sum;
}

void expect_same_momenta(const Totals& before, const Totals& after, double share) {
  EXPECT_LE((after.momentum - before.momentum).norm(), share * before.momentum_scale);
  EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(),
            share * before.angular_momentum_scale);
}

Vec3 random_vector(std::mt19937& random, double size) {
  // Not a std distribution: their results differ between standard libraries.
  const auto component = [&] { return size * (2.0 * (random() / 4294967296.0) - 1.0); };
  const double x = component(), y = component(), z = component();
  return {x, y, z};
}

void shake(Lattice& lattice, unsigned seed, double speed_m_s) {
  std::mt19937 random(seed);
  for (PointMotion& point : lattice.motion) point.velocity += random_vector(random, speed_m_s);
}

}  // namespace limber::test
