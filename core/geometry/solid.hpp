#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "core/geometry/material.hpp"
#include "core/geometry/trace.hpp"

namespace ridgeline::geometry {

/// One surface of the material: the wall of a cell or one of its planes.
struct Face {
  std::size_t cell = 0;              ///< 0: the outside, then the cavities
  std::optional<std::size_t> plane;  ///< absent: the wall
};

/// A stretch of a seam, the curve where two faces meet. Either the meetings of a wall's generators
/// with another face, by the parameter u of the wall's profile, or a straight line, by its length.
struct SeamPart {
  struct Generators {
    Face wall, other;
    int root = 0;  ///< which of the meetings of a generator with the other face
  };
  struct Line {
    Eigen::Vector3d point, direction;
  };
  std::variant<Generators, Line> curve;
  Face one, two;  ///< that meet
  double from = 0, to = 0;
};

/// The material with its boundary: faces and the seams between them. Work frame.
class Solid {
public:
  explicit Solid(const Workpiece& workpiece);

  const Material& material() const { return material_; }
  /// The workpiece lies within this of its position [mm].
  double reach() const { return reach_; }
  const std::vector<Face>& faces() const { return faces_; }

  /// Signed distance of a face from its air side: > 0 in the air.
  double height(const Face& face, const Eigen::Vector3d& p) const;

  /// Calls `found` with each point of a face that is nearest to p among its neighbours and is on
  /// the boundary of the material, nearer than `reach`.
  void feet(const Face& face, const Eigen::Vector3d& p, double reach,
            const std::function<void(const Eigen::Vector3d&)>& found) const;

  /// Is a point of a face or a seam on the boundary (in no cavity, not outside)?
  bool is_boundary(const Eigen::Vector3d& p) const;

  /// Is a point where the faces of a seam meet on both of them and on the boundary? (Beyond its
  /// cell a face is no face: the plane that ends a hole cuts the bore beside the hole in no seam.)
  bool is_on_seam(const SeamPart& part, const Eigen::Vector3d& p) const;

  /// Arcs along all seams, within seam_sag of them; the owner of a piece is its seam part.
  const Trace& seams() const { return seams_; }
  const std::vector<SeamPart>& seam_parts() const { return parts_; }

  /// Point of a seam at a parameter; nullopt where the faces do not meet.
  std::optional<Eigen::Vector3d> seam_at(const SeamPart& part, double parameter) const;

  /// The point of the material's boundary that is nearest to p, to seam_sag.
  struct Nearest {
    Eigen::Vector3d point;
    double distance = 0;
  };
  Nearest nearest(const Eigen::Vector3d& p) const;

  /// Distance to the material: in the air true to seam_sag, in the material as
  /// distance (exact in sign).
  double distance(const Eigen::Vector3d& p) const;

private:
  const Cell& cell(const Face& face) const;
  const Prism& wall(const Face& face) const;
  const Plane& plane(const Face& face) const;
  void add_meetings(const Face& one, const Face& two);
  void add_parallel_walls(const Face& one, const Face& two);
  void add_lengthwise_cut(const Face& curved, const Face& flat);
  void add_line(const Face& one, const Face& two, const Prism& prism, const Eigen::Vector2d& p);
  bool is_within_cell(const Face& face, const Eigen::Vector3d& p) const;
  void follow(const SeamPart& whole);
  void add(const SeamPart& part, const Eigen::Vector3d& a, const Eigen::Vector3d& b, int depth);
  std::optional<Eigen::Vector3d> boundary_at(const SeamPart& part, double parameter) const;

  Material material_;
  Eigen::Vector3d centre_;  ///< of the workpiece
  double reach_ = 0;        ///< the workpiece lies within this of the centre [mm]
  std::vector<Face> faces_;
  std::vector<SeamPart> parts_;
  std::vector<Piece> seam_pieces_;
  Trace seams_{{}};
};

/// Largest error of the arcs that follow seams [mm].
inline constexpr double seam_sag = 1e-5;

}  // namespace ridgeline::geometry
