#pragma once

#include <numbers>
#include <vector>

namespace ridgeline::cutting {

enum class CutterKind { Ball, Square };
/// How far the edge lags behind its tip. Tangent: (12), psi = tan(q/2) tan(beta). ConstantLead:
/// psi = (1 - cos q) tan(beta), a ball ground with the lead of its shank. Square mills: z
/// tan(beta)/r.
enum class LagLaw { Tangent, ConstantLead };
/// What the coefficients are per: the width r dq of the chip, or the true length of the edge.
enum class ChipWidth { Chip, Edge };

/// The cutting part of a rotating tool. mm, rad. Turns clockwise seen from the spindle (M03).
/// Teeth are numbered so that tooth k + 1 is ahead of tooth k: the one that cut before it.
struct Cutter {
  CutterKind kind = CutterKind::Ball;
  double r = 0;                ///< radius [mm]
  double helix = 0;            ///< beta; ball: at q = 90 degrees [rad]
  std::vector<double> pitch;   ///< angle from tooth k to tooth k + 1; sums to 2 pi [rad]
  std::vector<double> runout;  ///< per tooth, how far its edge stands out beyond r [mm]; empty: 0
  double offset = 0;           ///< tool axis from spindle axis [mm]
  double offset_angle = 0;     ///< its direction at theta = 0, from -X towards +Y [rad]
  int elements = 256;          ///< per tooth
  double q_end =
      std::numbers::pi / 2;  ///< ball: the edges end here; a lollipop's beyond 90 degrees
  double height = 0;         ///< square: axial depth of cut a_p that the elements cover [mm]
  LagLaw lag = LagLaw::Tangent;
  ChipWidth chip_width = ChipWidth::Chip;

  bool operator==(const Cutter&) const = default;
};

/// z equal angles.
std::vector<double> equal_pitch(int z);

/// Number of teeth.
inline int teeth(const Cutter& cutter) {
  return static_cast<int>(cutter.pitch.size());
}

/// Every tooth is the one before turned by 2 pi / z.
bool is_periodic(const Cutter& cutter);

/// Angle of tooth k ahead of tooth 0; k may exceed the number of teeth [rad].
double tooth_angle(const Cutter& cutter, int k);

/// Radius on which tooth k cuts [mm].
double tooth_radius(const Cutter& cutter, int k);

/// Middle of one element of an edge.
struct Element {
  double sin_q = 1;
  double cos_q = 0;  ///< q: angle between the tool axis and the line from O' to the element
  double psi = 0;    ///< lag behind the tip of the edge [rad]
  double width = 0;  ///< t_w [mm]
  double z = 0;      ///< height above the tip [mm]
};

/// The elements of one tooth from the tip upwards, mid-point rule.
std::vector<Element> elements(const Cutter& cutter);

/// Lag of an edge of this cutter where the unit direction from O' has these sine and cosine of q; a
/// square mill lags by height.
double lag(const Cutter& cutter, double sin_q, double cos_q, double z);

/// The same with tan(helix) known. (12) in the form that holds at the tip:
/// (1 - cos q) / sin q = sin q / (1 + cos q) = tan(q/2).
inline double lag(const Cutter& cutter, double tan_beta, double sin_q, double cos_q, double z) {
  if (cutter.kind == CutterKind::Square) return z * tan_beta / cutter.r;
  if (cutter.lag == LagLaw::ConstantLead) return (1 - cos_q) * tan_beta;
  return sin_q / (1 + cos_q) * tan_beta;
}

/// Throws Error{BadInput}: field, value, unit, limit.
void validate(const Cutter& cutter);

}  // namespace ridgeline::cutting
