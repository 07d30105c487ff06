#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/angle.hpp"
#include "core/cutting/iterate.hpp"

namespace ridgeline::cutting::oracle {

/// Cases of every kind: cutters, strategies, convergence, warm start, options.
inline constexpr const char* cases[] = {"01-ball-down-milling-1-groove.json",
                                        "03-ball-third-pass-low-pass-kappa-2.json",
                                        "05-same-fixed-weights-not-converging.json",
                                        "06-warm-start-from-pass-2.json",
                                        "09-square-down-milling-helix-5.json",
                                        "11-extensions-stock-limited-chip-3-earlier-teeth.json"};

/// Reads the files of tests/oracle/error by hand: independent of the mapping in jobs/.
inline nlohmann::json file(const std::string& name) {
  std::ifstream in(std::string(RIDGELINE_TESTS) + "/oracle/error/" + name);
  return nlohmann::json::parse(in);
}

inline Eigen::Vector3d vector(const nlohmann::json& v) {
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

inline Modes modes(const nlohmann::json& rows) {
  Modes modes;
  for (const auto& row : rows) {
    modes.push_back({row.at(0).get<double>(), row.at(1).get<double>(), row.at(2).get<double>()});
  }
  return modes;
}

inline Cutter cutter(const nlohmann::json& tool, const nlohmann::json& engagement) {
  Cutter cutter;
  cutter.kind = tool.at("kind") == "ball" ? CutterKind::Ball : CutterKind::Square;
  cutter.r = tool.at("r").get<double>();
  cutter.pitch = equal_pitch(tool.at("z").get<int>());
  cutter.helix = radians(tool.at("helix_deg").get<double>());
  cutter.elements = tool.at("nq").get<int>();
  cutter.height = engagement.value("ap", 0.0);
  return cutter;
}

inline Cut cut(const nlohmann::json& c) {
  const nlohmann::json& engagement = c.at("engagement");
  const nlohmann::json& k = c.at("coef");
  Cut cut;
  cut.cutter = cutter(c.at("tool"), engagement);
  cut.coefficients = {k.at("Ktc").get<double>(), k.at("Kte").get<double>(),
                      k.at("Krc").get<double>(), k.at("Kre").get<double>(),
                      k.at("Kac").get<double>(), k.at("Kae").get<double>()};
  cut.n = vector(engagement.at("normal"));
  cut.feed = c.at("feed_per_tooth").get<double>();
  cut.phi = radians(c.value("phi_deg", 0.0));
  cut.samples = c.at("N").get<int>();
  cut.earlier_teeth = c.value("npast", 1);
  if (c.value("stock_limit", false)) cut.chip_end = ChipEnd::StockLimited;
  const double depth = engagement.value("c", engagement.value("a", 0.0));
  cut.stock.faces = {HalfSpace{cut.n, depth - cut.cutter.r}};
  for (const auto& groove : engagement.value("grooves", nlohmann::json::array())) {
    cut.stock.grooves.push_back({vector(groove), feed_direction(cut), cut.cutter.r});
  }
  return cut;
}

inline Compliance compliance(const nlohmann::json& c) {
  return {modes(c.at("modes_x")), modes(c.at("modes_y"))};
}

inline IterateOptions options(const nlohmann::json& o) {
  IterateOptions options;
  options.alpha = o.value("alpha", options.alpha);
  options.beta = o.value("beta", options.beta);
  options.adapt = o.value("adapt", options.adapt);
  options.max_loops = o.value("maxloops", options.max_loops);
  if (o.contains("kappa") && !o["kappa"].is_null()) options.kappa = o["kappa"].get<double>();
  return options;
}

}  // namespace ridgeline::cutting::oracle
