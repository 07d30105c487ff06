#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/cutting/cut.hpp"
#include "core/cutting/response.hpp"

namespace ridgeline::cutting {

/// Where and how deep an earlier tooth went along the same line from O': static chip thickness and
/// the angle theta_o at which it was there, as a place between two samples.
struct Earlier {
  double ts = 0;            ///< (6), (17) [mm]
  double frac = 0;          ///< theta_o is this far from sample `before` to the next
  std::int32_t before = 0;  ///< in [0, N)
  double delay = 0;         ///< theta - theta_o, not wrapped [samples]
};

/// All that stays the same for one element at one angle while the deflection changes.
struct Chip {
  Eigen::Vector3d N;   ///< unit, O' -> edge
  Eigen::Vector3d Fe;  ///< K_e part of the force on the tool [N]
  Eigen::Vector3d Fc;  ///< K_c part per chip thickness [N/mm]
  double depth = 0;    ///< r + (r N).n: machining error (27) without deflection [mm]
  double r = 0;        ///< radius of its tooth [mm]
  double base = 0;     ///< height of the point of the axis that N starts from, from O' [mm]
  Earlier earlier;     ///< the tooth before
  std::int32_t element = 0;
  bool is_inside = false;  ///< in the stock wherever the deflection of the table may be
};

/// g(U) = g0 + gx Ux + gy Uy + curve |U_perp|^2 <= 0: the element is in the material of one face.
struct Term {
  double g0 = 0;
  double gx = 0;
  double gy = 0;
};

/// Curved part of a term, the same for all chips. |U_perp|^2 = |U|^2 - (U.a)^2.
struct Curve {
  double sign = 0;  ///< 0 plane, +1 material inside a cylinder, -1 outside
  double ax = 0;
  double ay = 0;
};

/// The chips of one tooth, by sample: row i is chips[first[i]] .. chips[first[i + 1]].
struct ToothChips {
  std::vector<std::int32_t> first;
  std::vector<Chip> chips;
  std::vector<Term> terms;       ///< faces, then grooves, of each chip
  std::vector<Earlier> earlier;  ///< second, third, ... tooth back of each chip
};

/// The deflections that a table serves: each within `reach` of `centre` at its sample.
struct Around {
  double reach = 0;         ///< [mm]
  Deflections centre = {};  ///< of one tooth period of equal teeth; empty: none at all
  bool is_still = false;    ///< no deflection at all, as of a rigid tool: theta_o is not needed
};

/// What every table of one cutter and number of samples has.
struct Turn {
  std::vector<Element> elements;
  std::vector<double> sin_theta, cos_theta;  ///< of each sample
};

/// Every chip that can be cut while the deflection stays within `around`. A periodic cutter needs
/// one tooth only: tooth k at sample i is tooth 0 at sample i + k N / z.
struct ChipTable {
  Cut cut;
  Around around;
  int pitch_samples = 0;  ///< N / z when one tooth stands for all, else 0
  std::vector<ToothChips> teeth;
  std::vector<Curve> curves;  ///< of each term
  Turn turn;
};

/// Builds the table: (6), (7), (11)..(13), (17), (22), directions of (14)..(16). `cut` is valid.
/// `spent`: a table no longer needed, whose memory is used again; along a path that saves more time
/// than the geometry takes.
ChipTable chip_table(const Cut& cut, Around around, ChipTable spent = {});

}  // namespace ridgeline::cutting
