#pragma once

namespace ridgeline::tool {

/// What a material and an edge do to each other: force on an element of width t_w at chip thickness
/// t is (K_e + K_c t) t_w, document 001 (14)..(16). t tangential, r radial, a axial (along the edge
/// towards the tip). K_c [N/mm2], K_e [N/mm].
struct Coefficients {
  double Ktc = 0;
  double Kte = 0;
  double Krc = 0;
  double Kre = 0;
  double Kac = 0;
  double Kae = 0;
};

}  // namespace ridgeline::tool
