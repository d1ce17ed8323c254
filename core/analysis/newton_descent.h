#pragma once

#include <Eigen/SparseCholesky>

#include "core/analysis/tangent_stiffness.h"

namespace limber {

// Internal to settle(): Newton's method on the elastic plus gravitational energy of a model, one
// step at a time. Changes the model's positions.
class NewtonDescent {
 public:
  NewtonDescent(PhysicalModel& model, const Vec3& gravity_m_s2);

  // Largest force that is left on a free point, N.
  double residual() const;
  // The largest tension or weight that a free point has to balance, N: the residual's scale.
  double load() const;
  // About what the finite digits of positions leave of the residual, N.
  double rounding() const;
  // No direction lowers the energy, apart from the rounding that mechanisms drown in.
  bool stable() const { return stable_; }

  // Solves for balance and goes there as far as the energy sinks. False where it does not.
  bool step();
  // Goes down the direction of most negative stiffness, if there is one: the way from an unstable
  // equilibrium.
  bool leave_saddle();
  // Newton's steps to the end of the digits: as long as each halves the residual at least.
  void polish();

 private:
  void linearise();
  void factorise();
  bool factorise_shifted(const SparseMatrix& stiffness, double share);
  bool descend(Eigen::VectorXd displacement);
  double allowed_share(const Eigen::VectorXd& displacement) const;
  double energy_change(const Eigen::VectorXd& displacement) const;
  void move(const Eigen::VectorXd& displacement);
  Vec3 part(const Eigen::VectorXd& x, PointId p) const;

  PhysicalModel& model_;
  Vec3 gravity_;
  FreePoints free_;                                            // F
  Eigen::VectorXd force_;                                      // shape (3F), N, unbalanced
  SparseMatrix stiffness_;                                     // shape (3F, 3F), N/m
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> cholesky_;  // of stiffness_ if that is stable
  bool stable_ = false;
};

}  // namespace limber
