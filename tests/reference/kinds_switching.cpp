// Group 9: what turning a lattice into a rigid body and back keeps, through the library's
// placement of models and core/dynamics/rigid_motion.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/reference/build.h"
#include "tests/reference/cubic.h"
#include "tests/reference/kinds.h"
#include "tests/reference/readings.h"

namespace limber::reference {
namespace {

// The undeformed lattice about its centre of mass, with the masses of the case.
PhysicalModel reference_lattice(const Json& params) {
  PhysicalModel model = cubic_model(params);
  if (params.contains("masses") && !params["masses"].is_null()) {
    for (PointId p : ids_of(model.points)) model.points[p].mass = params["masses"].at(p.index());
  }
  centre(model);
  return model;
}

Vec3 angular_momentum_about_origin(const RigidMotion& body) {
  return body.angular_momentum + body.centre.cross(body.momentum());
}

Json quaternion_of(const Mat3& rotation) {  // (w, x, y, z), w >= 0
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  return {q.w(), q.x(), q.y(), q.z()};
}

Eigen::Quaterniond quaternion(const Json& wxyz) {
  return Eigen::Quaterniond(wxyz.at(0), wxyz.at(1), wxyz.at(2), wxyz.at(3)).normalized();
}

// ---- rigid to flexible -------------------------------------------------------------------------

// Absolute where nothing is wanted.
double relative_error(const Vec3& found, const Vec3& wanted) {
  const double size = wanted.norm();
  return (found - wanted).norm() / (size > 0.0 ? size : 1.0);
}

// Pose and motion found from the points against those that made them; the largest of the four.
double roundtrip_error(const Json& params, const Lattice& lattice,
                       const std::vector<Vec3>& reference) {
  const RigidMotion body = rigid_motion(lattice);
  const Mat3 rotation = best_rotation(lattice.motion, reference, lattice.mass, all_points(lattice));
  const double turned = Eigen::AngleAxisd(rotation * quaternion(params.at("q")).inverse()).angle();
  return std::max({relative_error(body.centre, vec3(params.at("x"))),
                   relative_error(body.velocity, vec3(params.at("v"))),
                   relative_error(body.angular_velocity, vec3(params.at("omega"))), turned});
}

Json rigid_to_flexible(const Case& c) {
  PhysicalModel model = reference_lattice(c.params);
  const std::vector<Vec3> reference = model.geometry.points.raw();
  place(model, quaternion(c.params.at("q")).toRotationMatrix(), vec3(c.params.at("x")));
  set_in_motion(model, vec3(c.params.at("v")), vec3(c.params.at("omega")));
  const Lattice lattice = compiled(std::move(model));
  const RigidMotion body = rigid_motion(lattice);
  return {{"positions", to_json(positions(lattice))},
          {"velocities", to_json(velocities(lattice))},
          {"P", to_json(body.momentum())},
          {"L_origin", to_json(angular_momentum_about_origin(body))},
          {"kinetic_energy", reference::kinetic_energy(lattice)},
          {"elastic_energy", reference::elastic_energy(lattice)},
          {"inertia_world", to_json(body.inertia)},
          {"omega_recoverable", to_json(body.angular_velocity)},
          {"roundtrip", roundtrip_error(c.params, lattice, reference)}};
}

// ---- flexible to rigid -------------------------------------------------------------------------

// Below this share of the largest singular value the points, or their reference, are flat.
constexpr double kFlat = 1e-9;

int sign_of_determinant(const RigidFit& fit) {
  const Vec3& s = fit.singular_values;
  if (std::abs(s[2]) <= kFlat * s[0]) return 0;
  return s[2] < 0.0 ? -1 : 1;
}

// Angular velocity of the undeformed shape with the same angular momentum.
Vec3 omega_of_shape(const PhysicalModel& shape, const Mat3& rotation, const Vec3& L) {
  const Mat3 inertia = rigid_motion(compiled(shape)).inertia;
  return angular_velocity_of(rotation * inertia * rotation.transpose(), L);
}

Json flexible_to_rigid(const Case& c) {
  const PhysicalModel shape = reference_lattice(c.params);
  Lattice lattice = compiled(shape);
  const Json &x = c.params.at("positions"), &v = c.params.at("velocities");
  for (std::size_t p = 0; p < lattice.motion.size(); ++p) {
    lattice.motion[p] = {vec3(x.at(p)), vec3(v.at(p))};
  }
  const RigidMotion body = rigid_motion(lattice);
  const RigidFit fit =
      rigid_fit(lattice.motion, shape.geometry.points.raw(), lattice.mass, all_points(lattice));
  const Vec3& L = body.angular_momentum;
  const Vec3 omega_reference = omega_of_shape(shape, fit.rotation, L);
  const double kinetic = reference::kinetic_energy(lattice);
  const double elastic = reference::elastic_energy(lattice);
  const double of_centre = 0.5 * body.mass * body.velocity.squaredNorm();
  const double of_reference = 0.5 * L.dot(omega_reference);
  return {{"com", to_json(body.centre)},
          {"P", to_json(body.momentum())},
          {"v", to_json(body.velocity)},
          {"L_com", to_json(L)},
          {"R", to_json(fit.rotation)},
          {"q", quaternion_of(fit.rotation)},
          {"signed_singular_values", to_json(fit.singular_values)},
          {"det_sign", sign_of_determinant(fit)},
          {"rms_shape_residual", fit.residual},
          {"omega_conserving_L_with_reference_shape", to_json(omega_reference)},
          {"omega_best_fit_deformed", to_json(body.angular_velocity)},
          {"T_total", kinetic},
          {"T_com", of_centre},
          {"T_rot_reference_shape", of_reference},
          {"T_rot_deformed", body.kinetic_energy() - of_centre},
          {"T_vibration", kinetic - body.kinetic_energy()},
          {"U_elastic", elastic},
          {"energy_change_to_reference_shape", of_centre + of_reference - kinetic - elastic},
          {"energy_change_keep_deformed", body.kinetic_energy() - kinetic - elastic}};
}

// ---- a dilated lattice -------------------------------------------------------------------------

Json dilated_spin(const Case& c) {
  const PhysicalModel shape = reference_lattice(c.params);
  PhysicalModel dilated = shape;
  for (Vec3& x : dilated.geometry.points) x *= 1.0 + c.params.at("s").get<double>();
  const Vec3 omega = vec3(c.params.at("omega"));
  set_in_motion(dilated, Vec3::Zero(), omega);
  const Lattice lattice = compiled(dilated);
  const RigidMotion before = rigid_motion(lattice);
  const RigidFit fit =
      rigid_fit(lattice.motion, shape.geometry.points.raw(), lattice.mass, all_points(lattice));
  const Vec3 after = omega_of_shape(shape, fit.rotation, before.angular_momentum);
  return {{"L", to_json(before.angular_momentum)},
          {"omega_after", to_json(after)},
          {"T_before", reference::kinetic_energy(lattice)},
          {"T_after", 0.5 * after.dot(before.angular_momentum)}};
}

}  // namespace

Kinds switching_kinds() {
  return {{"rigid_to_flexible", rigid_to_flexible},
          {"flexible_to_rigid", flexible_to_rigid},
          {"dilated_spin", dilated_spin}};
}

}  // namespace limber::reference
