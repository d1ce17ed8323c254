#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "bullet_bridge/co_simulation.h"
#include "bullet_bridge/contact_solver.h"
#include "bullet_bridge/debris.h"
#include "bullet_bridge/joint_loads.h"
#include "bullet_bridge/joints.h"
#include "bullet_bridge/piece.h"
#include "bullet_bridge/piece_index.h"
#include "bullet_bridge/push.h"
#include "bullet_bridge/shapes/shape_cache.h"
#include "bullet_bridge/solver_decorator.h"
#include "bullet_bridge/touch_prediction.h"
#include "core/operators/time_operator.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// What decided a change of representation, by name.
using Numbers = std::vector<std::pair<std::string, double>>;

// The state behind CoSimulation. Its stages stand in before_solve.cpp and after_move.cpp, in the
// order in which a tick runs them; those that deal with the game's side of it in game_view.cpp.
class CoSimulation::Impl : public TickHooks {
 public:
  Impl(btDiscreteDynamicsWorld& world, const CoSimulationSettings& settings)
      : world_(world), settings_(settings), decorator_(world, *this) {
    time_operator_.keep_boundary(&boundary_);
    time_operator_.watch_load(switching());
  }

  void before_solve(double dt) override;
  void after_solve(double dt) override;
  void after_move(double dt) override;

  std::size_t add(PhysicalModel model, Integration integration);
  void remove(std::size_t object);
  bool has_object(std::size_t object) const {
    return object < removed_.size() && !removed_[object];
  }
  void require_object(std::size_t object) const;  // throws InputError
  std::vector<btTypedConstraint*> constraints_on(std::size_t object) const;
  void apply_impulse(std::size_t object, const Vec3& impulse, const Vec3& at);
  void sync_points() const;
  std::vector<std::int32_t> points_of_object(std::size_t object) const;

  btDiscreteDynamicsWorld& world_;
  CoSimulationSettings settings_;
  // Rigid pieces' points are written when somebody asks for them.
  mutable Lattice lattice_;
  TimeOperator time_operator_{lattice_, Integrator::kSymplecticEuler, settings_.springs};
  std::vector<Integration> integration_;  // shape (objects)
  std::vector<bool> removed_;             // shape (objects)
  Environment environment_;
  BoundaryTracker boundary_;
  ContactSolver contacts_, late_contacts_;
  ShapeCache shapes_;  // of what rigid pieces are about to touch
  Debris debris_;
  PieceIndex::Pieces pieces_;  // ascending by id
  PieceIndex index_;
  JointLoads joint_loads_;
  std::vector<std::pair<const btCollisionObject*, const btCollisionObject*>> passing_;
  std::vector<NearBody> sweeping_;  // kinematic bodies and links on their way in this tick
  bool thawed_in_tick_ = false;
  bool air_before_ = false;                         // was there air in the last tick?
  std::unordered_set<const btRigidBody*> jointed_;  // of Bullet's world, at the tick's start
  struct Orphan {
    std::size_t object;
    std::shared_ptr<PieceBody> body;
  };
  std::vector<Orphan> orphans_;  // joints still name them
  struct Push {
    std::vector<std::int32_t> points;
    Impulse impulse;  // about their centre of mass
  };
  std::vector<Push> pushes_;      // of the game, for the next tick
  std::vector<PointLoad> loads_;  // of joints, for the next tick
  std::size_t next_piece_ = 0;
  double time_ = 0.0;
  double tick_ = 0.0;     // s, of the present tick
  bool in_tick_ = false;  // between the first hook and the last
  bool roles_stale_ = true;
  bool stepped_lattice_ = false;
  bool stepped_late_ = false;  // what the solver sent into a touch
  bool thawing_late_ = false;  // after the solver: it has given gravity and the game's forces
  std::size_t broken_in_tick_ = 0;
  std::optional<Diagnostic> failure_;
  std::vector<Diagnostic> notes_;
  Counters counters_;
  std::vector<SwitchRecord> switches_;
  std::vector<LatticeContact> lattice_contacts_;  // of the last tick
  std::vector<BreakRecord> breaks_;
  std::vector<std::int32_t> break_points_;  // first ends of the edges that broke in this tick
  std::vector<SplitRecord> splits_;

 private:
  // Stages of a tick, in order.
  void thaw_what_will_be_hit(double dt);
  void thaw_what_lattices_hit(double dt);
  void blow_on_proxies(double dt);
  Vec3 blow_on(const Piece& piece, double dt);
  void gather_loads(double dt);
  void step_lattices(double dt);
  void step(const std::vector<Piece*>& flexible, ContactSolver& contacts,
            ContactSolver::Gravity gravity, double dt);
  void show_velocities(double dt);
  void take_joints(double dt);
  void read_contacts();
  void catch_up_with_deflected(double dt);
  void step_late(const std::vector<Piece*>& others, double dt);
  void fly_free_proxies(double dt);
  void split_broken_pieces();
  void split(const Piece& piece, std::vector<std::vector<std::int32_t>> groups);
  void show_lattices();
  void name_pieces_of_breaks();
  void freeze_calm_pieces(double dt);
  void note_carried_load(Piece& piece, std::span<const double> pressed) const;
  void step_debris(double dt);
  void count_time(double dt);

  // What lattices may touch in this tick, in the order of the world.
  struct Surroundings {
    std::vector<NearBody> bodies;
    std::vector<Piece*> carried;  // rigid pieces
  };
  Surroundings surroundings_of(const std::vector<Piece*>& flexible, double dt) const;
  std::vector<NearBody> bodies_near(const Piece& piece, double dt) const;
  int substeps_for(double dt);
  double substeps_wanted(double dt) const;
  void make_stiffest_implicit(double dt);
  double substeps_wanted_by(std::size_t object, double dt) const;
  [[noreturn]] void refuse_step(double substeps) const;
  std::vector<Vec3> velocities_of(const std::vector<Piece*>& pieces) const;
  void follow_parabola(const std::vector<Piece*>& pieces, const std::vector<Vec3>& before,
                       double substep);
  void note(const StepReport& report);
  void note_contacts(ContactSolver& contacts);
  bool switching() const { return settings_.representation == Representation::kSwitching; }
  void consider_pairs(double dt);
  void consider_pair(Piece& piece, const btCollisionObject& other, double dt);
  void consider_touch(Piece& piece, const btCollisionObject& other, double dt);
  void consider_sweep(const NearBody& mover, double dt);
  void consider_lattice_hit(const Piece& flexible, Piece& proxy, double dt);
  void swing_round(const Piece& piece, const btCollisionObject& other, PredictedTouch& touch,
                   double dt);
  bool material_meets(Piece& piece, const btCollisionObject& other, double limit,
                      const PredictedTouch& touch, double dt);
  void thaw_piece(Piece& piece, const std::string& cause, Numbers numbers);
  void freeze_piece(Piece& piece, const std::string& cause, Numbers numbers);
  void clear_unwanted_manifolds();
  void refresh_roles(const std::vector<Piece*>& carried);
  void set_role(const Piece& piece, PointRole role);
  std::vector<Piece*> flexible_pieces() { return index_.flexible(pieces_); }
  std::vector<std::vector<std::int32_t>> connected_groups(const Piece& piece);
  bool becomes_debris(std::span<const std::int32_t> points) const;
  // `born_in`: the middle of the piece they came off, if they did.
  void turn_to_debris(std::span<const std::int32_t> points,
                      const std::optional<Vec3>& born_in = {});
  Piece& add_piece(std::size_t object, std::vector<std::int32_t> points);
  void start(Piece& piece);
  void take_changes_of_game(Piece& piece, double dt);
  bool jointed(const Piece& piece) const;
  void wake_what_hangs_on(const Piece& piece);
  std::vector<std::int32_t> points_at_joints(const Piece& piece) const;
  std::optional<std::size_t> heir_among(const Piece& piece,
                                        const std::vector<std::vector<std::int32_t>>& groups);
  std::size_t group_at(const std::vector<std::vector<std::int32_t>>& groups,
                       const Vec3& place) const;
  void disable(btTypedConstraint& joint, std::size_t object);
  void keep_for_joints(std::size_t object, std::shared_ptr<PieceBody> body);
  void require_removable(std::size_t object) const;
  void judge_impulse(Piece& piece, double dt, double share, double weight);
  Calmness look_at(const Piece& piece) const;
  Numbers numbers_of(const Piece& piece, const Calmness& seen) const;

  SolverDecorator decorator_;  // last: attaches when all is ready, detaches first
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
