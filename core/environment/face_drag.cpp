#include "core/environment/face_drag.h"

namespace limber {

// Only u_N = (u . n) n and the area are used: both are the same for n and -n.
Vec3 face_drag(const FaceAttributes& face, const Vec3& area_vector, const Vec3& relative_wind,
               double air_density) {
  const double area = area_vector.norm();
  if (area == 0.0) return Vec3::Zero();
  const Vec3 n = area_vector / area;
  const Vec3 u_N = relative_wind.dot(n) * n;
  const Vec3 u_T = relative_wind - u_N;
  const double half_rho_A = 0.5 * air_density * area;
  switch (face.drag_law) {
    case DragLaw::kQuadratic:
      return half_rho_A *
             (face.normal_drag * u_N.norm() * u_N + face.tangential_drag * u_T.norm() * u_T);
    case DragLaw::kLinear:
      return area * (face.normal_drag * u_N + face.tangential_drag * u_T);
    case DragLaw::kPressure:
      return half_rho_A * face.normal_drag * relative_wind.norm() * u_N;
  }
  return Vec3::Zero();
}

}  // namespace limber
