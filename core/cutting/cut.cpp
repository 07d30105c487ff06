#include "core/cutting/cut.hpp"

#include <cmath>
#include <numbers>

#include "core/cutting/require.hpp"

namespace ridgeline::cutting {
namespace {

void require_unit(std::string_view field, const Eigen::Vector3d& v) {
  require_between(field, v.norm(), 1 - 1e-6, 1 + 1e-6, "in length");
}

void validate(const Face& face) {
  constexpr double far = 1e6;
  if (const auto* plane = std::get_if<HalfSpace>(&face)) {
    require_unit("/case/engagement/faces/normal", plane->n);
    require_between("/case/engagement/faces/height", plane->h, -far, far, "mm");
    return;
  }
  const Round& round = std::get<Round>(face);
  require_unit("/case/engagement/faces/axis", round.axis);
  require_between("/case/engagement/faces/radius", round.R, 1e-3, far, "mm");
  require_between("/case/engagement/faces/centre", round.centre.norm(), 0, far, "mm from O'");
}

void validate(const tool::Coefficients& c) {
  constexpr double stiffest = 1e5;
  for (const double k : {c.Ktc, c.Krc, c.Kac}) {
    require_between("/case/coef", k, -stiffest, stiffest, "N/mm2");
  }
  for (const double k : {c.Kte, c.Kre, c.Kae}) {
    require_between("/case/coef", k, -stiffest, stiffest, "N/mm");
  }
}

}  // namespace

Eigen::Vector3d feed_direction(const Cut& cut) {
  return {0, std::cos(cut.phi), -std::sin(cut.phi)};
}

void validate(const Cut& cut) {
  constexpr int least_samples = 8;
  constexpr int most_samples = 65536;
  constexpr int most_teeth_back = 16;
  validate(cut.cutter);
  validate(cut.coefficients);
  require_unit("/case/engagement/normal", cut.n);
  require_between("/case/feed_per_tooth", cut.feed, 1e-6, cut.cutter.r / 2, "mm");
  require_between("/case/phi_deg", cut.phi, -std::numbers::pi / 2, std::numbers::pi / 2, "rad");
  require_between("/case/N", cut.samples, least_samples, most_samples, "samples");
  require_between("/case/npast", cut.earlier_teeth, 1, most_teeth_back, "teeth");
  if (cut.cutter.kind == CutterKind::Square && cut.phi != 0) {
    throw Error(ErrorCode::Unsupported,
                "phi_deg: a square mill must feed at right angles to its axis",
                {.field = "/case/phi_deg", .limit = "0 for a square mill"});
  }
  for (const Face& face : cut.stock.faces) validate(face);
  for (const Round& groove : cut.stock.grooves) validate(Face(groove));
  if (cut.stock.map) validate(*cut.stock.map);
  if (cut.stock.faces.empty() && !cut.stock.map) {
    throw Error(ErrorCode::BadInput, "engagement: neither a face nor a height map bounds the stock",
                {.field = "/case/engagement"});
  }
}

}  // namespace ridgeline::cutting
