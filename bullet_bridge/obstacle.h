#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bullet_bridge/lattice_surface.h"
#include "bullet_bridge/shadow_body.h"
#include "bullet_bridge/shapes/contact_shape.h"
#include "bullet_bridge/shapes/point_track.h"
#include "core/contact/friction_spring.h"
#include "core/contact/passive_contact.h"
#include "core/contact/penalty.h"
#include "core/dynamics/lattice.h"

namespace limber::bullet {
inline namespace LIMBER_BULLET_PRECISION {

// Where a lattice is pressed: at a point, or on a face between its corners. `inverse_mass`: 1/kg,
// for a force there. `velocity_after`: at the substep's end, by the forces summed so far.
struct PointPlace {
  std::int32_t point = -1;

  std::int32_t lawgiver() const { return point; }
  Vec3 position(const Lattice& lattice) const { return lattice.motion[point].position; }
  Vec3 velocity(const Lattice& lattice) const { return lattice.motion[point].velocity; }
  Vec3 velocity_after(const Lattice& lattice, double dt) const;
  double inverse_mass(const Lattice& lattice) const { return lattice.inverse_mass[point]; }
  void add_force(Lattice& lattice, const Vec3& force) const;
};
struct FacePlace {
  std::array<std::int32_t, 3> corners = {-1, -1, -1};
  Vec3 weights = Vec3::Constant(1.0 / 3.0);  // barycentric

  std::int32_t lawgiver() const { return corners[0]; }
  Vec3 position(const Lattice& lattice) const;
  Vec3 velocity(const Lattice& lattice) const;
  Vec3 velocity_after(const Lattice& lattice, double dt) const;
  double inverse_mass(const Lattice& lattice) const;
  void add_force(Lattice& lattice, const Vec3& force) const;
};

// What may have come near a body until candidates are listed the next time.
struct ListingReach {
  double least = 0.0;  // m, whatever the point does
  double time = 0.0;   // s, at the point's own speed
};

// What the points of one object and a body did to one another.
struct ObjectPush {
  std::int32_t object = 0;  // of the lattice
  double impulse = 0.0;     // N s, the size of all of it
  double hardest = 0.0;     // N s, of one place since pairs were listed
  Vec3 at = Vec3::Zero();   // m, of that place
};

// Some of an obstacle's pairs: those of points, then those of faces, by their numbers.
struct ObstacleShare {
  std::vector<std::int32_t> points, faces;  // ascending

  std::size_t size() const { return points.size() + faces.size(); }
};

// A body of Bullet's world as the lattice meets it in one tick: points, and faces between them,
// against the parts of its shape. Each pair remembers through which side it came in, from tick to
// tick; nothing that came in on one side leaves on another.
class Obstacle {
 public:
  // `low`, `high`: the box in the world, m, outside of which nothing will meet it in this tick;
  // `way`: m that it is about to move in it.
  Obstacle(const btCollisionObject& object, int shadow, const ShadowBody& body, const Vec3& low,
           const Vec3& high, double way, ShapeCache& cache);

  const btCollisionObject& object() const { return *object_; }
  int shadow() const { return shadow_; }

  // Takes over what pairs of the last tick remember of the same body, unless it has been put
  // elsewhere or has another shape.
  void remember(Obstacle&& last_tick);

  // Takes over the pairs of other points and faces with the same body.
  void add_pairs(Obstacle&& others);

  // The contacts that press these points (ascending), and faces of theirs, alone: for as long as
  // their piece is rigid.
  Obstacle memory_of(std::span<const std::int32_t> points) const;
  bool remembers() const { return !points_.empty() || !faces_.empty(); }

  // Takes them up again as far as the piece still lies there. A rigid piece lies on the surface,
  // where Bullet puts it, a lattice as deep as its contacts bear the load: they take its points for
  // as deep as they were, so that it does not fall by that much. Before list().
  void take_up(const Obstacle& memory, const Lattice& lattice, const ShadowBody& body);

  // Lists the pairs that may touch until the next listing, for substeps of dt.
  void list(const Lattice& lattice, const LatticeSurface& surface, const ShadowBody& body,
            const ListingReach& reach, double dt);

  // Are some of its parts known to Bullet's general query alone, which is for one thread?
  bool asks_bullet() const;

  // Of the listed pairs, by a label of their points, which is the same for all corners of a face:
  // adds how many there are to `pairs`, by label; gives them to `shares`, by what the label is of.
  void count_pairs(std::span<const std::int32_t> label_of_point,
                   std::vector<std::size_t>& pairs) const;
  void share_out(std::span<const std::int32_t> label_of_point,
                 std::span<const std::int32_t> share_of_label,
                 std::vector<ObstacleShare>& shares) const;

  // Adds the forces of those pairs of the share that touch, equal and opposite, to points and
  // shadow. In a substep, each pair once; of a body that is not movable shares may press at once
  // that have no point in common, of a movable one all pairs are one share.
  void press(Lattice& lattice, const LatticeSurface& surface, ShadowBody& body,
             const ObstacleShare& share, double dt);

  // Adds the normal forces of the last substep of dt, N, to `loads`, shape (P): a face's to its
  // first corner.
  void add_loads(double dt, std::vector<double>& loads) const;

  // What pushed it in this tick, ascending by object; what comes counts for the next one.
  std::vector<ObjectPush> take_pushes(const Lattice& lattice);

  // Marks the points, shape (P), at which what has sunk in is on its way out still.
  void mark_yielding(std::vector<std::uint8_t>& points) const;

 private:
  // Of a place and a part.
  template <class Place>
  struct Pair {
    std::int32_t of;     // point, or face
    std::int64_t part;   // its id
    std::size_t listed;  // where the part is in parts_
    PointTrack track;
    double offset;              // m of penetration that was there when the pair was first seen
    Vec3 shift = Vec3::Zero();  // m, in the obstacle's frame: the place counts as being there
    Place pressed;              // in the last substep, if its books are open
    Vec3 normal;                // along which, world
    PenaltyContact law;         // until the next listing
    PassiveContact books;
    FrictionSpring friction;
    double pushed = 0.0;  // N s, since pushes were gathered
    bool holds = false;   // it has pressed since it came in
    bool yields = false;  // it is deeper than what it bears would have it

    void let_go();
  };
  using PointPair = Pair<PointPlace>;
  struct FacePair : Pair<FacePlace> {
    std::array<std::int32_t, 3> corners = {-1, -1, -1};
    Mat3 last = Mat3::Zero();  // the corners when it was last looked at, in the obstacle's frame, m
    double clear = 0.0;        // m: it does not press before a corner has moved so far from there
    bool sheet = false;
  };

  Vec3 to_frame(const ShadowBody& body, const Vec3& point) const;
  Mat3 corners_in_frame(const Lattice& lattice, const ShadowBody& body,
                        const std::array<std::int32_t, 3>& corners) const;
  Vec3 direction_to_frame(const ShadowBody& body, const Vec3& direction) const;
  void change_frame(PointTrack& track) const;
  template <class P>
  void lie_again(P& pair, const Vec3& real, std::vector<P>& pairs) const;
  template <class P>
  P known_or_new(const P* known, std::int32_t of, std::size_t listed, const Vec3& local) const;
  void list_points(const Lattice& lattice, const ShadowBody& body, const ListingReach& reach,
                   double dt);
  void list_faces(const Lattice& lattice, const LatticeSurface& surface, const ShadowBody& body,
                  const ListingReach& reach, double dt);
  void press_point(Lattice& lattice, const LatticeSurface& surface, ShadowBody& body,
                   PointPair& pair, double dt);
  void press_face(Lattice& lattice, ShadowBody& body, FacePair& pair, double dt);
  PenaltyContact law_at(const Lattice& lattice, std::int32_t point, const ContactPart& part,
                        double dt) const;
  template <class Place>
  double effective_mass(const Lattice& lattice, const ShadowBody& body, const Place& place,
                        const Vec3& normal) const;
  template <class Place>
  double gain_of(const Lattice& lattice, const ShadowBody& body, const Place& place,
                 const Vec3& normal) const;
  template <class Place>
  void settle(const Lattice& lattice, const ShadowBody& body, Pair<Place>& pair, double dt) const;
  template <class Place>
  double bear(const Lattice& lattice, const ShadowBody& body, Pair<Place>& pair,
              const PenaltyContact& law, double depth, double dt) const;
  template <class P>
  void gather_pushes(const Lattice& lattice, std::vector<P>& pairs);
  template <class Place>
  void push(Lattice& lattice, ShadowBody& body, Pair<Place>& pair, const Place& place,
            const Penetration& contact, double dt);

  const btCollisionObject* object_;
  int shadow_;
  const void* shape_;
  int shape_revision_;  // of a compound's children
  Vec3 position_;       // of the body at the tick's start, m
  Mat3 rotation_;
  double way_;                      // m, that it is about to move in this tick
  bool at_rest_;                    // immovable and not moving: parts are in world coordinates
  std::vector<ContactPart> parts_;  // otherwise in the body's frame
  std::vector<PointPair> points_;   // ascending by `of`; its parts in the order of parts_
  std::vector<FacePair> faces_;     // likewise
  std::vector<ObjectPush> pushes_;  // in this tick so far, ascending by object
  int sharers_ = 1;                 // contacts that pushed the body in the last substep
  int pushed_ = 0;                  // in this one
};

}  // namespace LIMBER_BULLET_PRECISION
}  // namespace limber::bullet
