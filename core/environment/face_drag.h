#pragma once

#include "core/model/physical_model.h"

namespace limber {

// Force of the air on one face, N. Both sides of a face are alike: the result does not depend on
// the order of its corners. With u = wind - velocity of the face, A its area, n its unit normal,
// u_N = (u . n) n and u_T = u - u_N:
//   kQuadratic  rho A / 2 (C_N |u_N| u_N + C_T |u_T| u_T)   pressure drag and skin friction, each
//               with a coefficient of its own (Hoerner, Fluid-Dynamic Drag, 1965)
//   kLinear     A (C_N u_N + C_T u_T)     (Wejchert and Haumann, SIGGRAPH 1991)
//   kPressure   rho A / 2 C_N |u| u_N     along the normal, with the pressure of the full speed
// `area_vector` is A n, m^2; `relative_wind` u, m/s; `air_density` rho, kg/m^3. A face without area
// feels nothing. F . u >= 0 for coefficients of 0 and more: in still air no face gains energy.
Vec3 face_drag(const FaceAttributes& face, const Vec3& area_vector, const Vec3& relative_wind,
               double air_density);

// Does it feel air at all?
inline bool has_drag(const FaceAttributes& face) {
  const bool tangential = face.drag_law != DragLaw::kPressure && face.tangential_drag > 0.0;
  return face.normal_drag > 0.0 || tangential;
}

}  // namespace limber
