#include "core/path/pieces.hpp"

#include "core/path/arc.hpp"

namespace ridgeline::path {
namespace {

geometry::Spiral spiral_of(const ArcShape& arc) {
  return {.centre = arc.centre,
          .x = arc.first,
          .y = arc.second,
          .z = arc.third,
          .r0 = arc.start_radius,
          .r1 = arc.end_radius,
          .w0 = arc.start_angle,
          .w1 = arc.start_angle + arc.sweep,
          .h0 = 0,
          .h1 = arc.rise};
}

}  // namespace

std::vector<geometry::Piece> pieces_of(const Motion& motion, const Eigen::Vector3d& offset,
                                       const Progress& progress) {
  std::vector<geometry::Piece> pieces;
  pieces.reserve(motion.moves.size());
  Eigen::Vector3d from = motion.start;
  for (std::size_t i = 0; i < motion.moves.size(); ++i) {
    progress.step(i, motion.moves.size(), "moves");
    const Move& move = motion.moves[i];
    geometry::Piece piece;
    piece.a = from + offset;
    piece.b = move.to + offset;
    piece.owner = i;
    if (move.arc) {
      geometry::Spiral spiral = spiral_of(arc_shape(from, move));
      spiral.centre += offset;
      geometry::add_spiral(pieces, spiral, piece);
    } else if (piece.a != piece.b) {
      pieces.push_back(piece);
    }
    from = move.to;
  }
  return pieces;
}

}  // namespace ridgeline::path
