#include "jobs/predict_case.hpp"

#include <cmath>

#include "core/base/angle.hpp"
#include "jobs/predict_stock.hpp"

namespace ridgeline::jobs {
namespace {

using cutting::ChipWidth;
using cutting::CutterKind;
using cutting::LagLaw;
using cutting::Lookup;
using cutting::Method;
using cutting::Mixing;
using cutting::Stability;

constexpr Choices<CutterKind, 2> kinds{
    {{"ball", CutterKind::Ball}, {"square", CutterKind::Square}}};
constexpr Choices<LagLaw, 2> lags{
    {{"tangent", LagLaw::Tangent}, {"constant_lead", LagLaw::ConstantLead}}};
constexpr Choices<ChipWidth, 2> widths{{{"chip", ChipWidth::Chip}, {"edge", ChipWidth::Edge}}};
constexpr Choices<Lookup, 2> lookups{{{"linear", Lookup::Linear}, {"nearest", Lookup::Nearest}}};
constexpr Choices<Method, 3> methods{
    {{"iterate", Method::Iterate}, {"rigid", Method::Rigid}, {"time_domain", Method::TimeDomain}}};
constexpr Choices<Stability, 3> stabilities{
    {{"stable", Stability::Stable}, {"flip", Stability::Flip}, {"unstable", Stability::Unstable}}};

constexpr int most_teeth = 64;
constexpr int most_elements = 4096;
constexpr int most_samples = 65536;
constexpr double most_places = 1 << 22;  // samples times elements: what a chip search may look at

// "pitch_deg": the angle from each tooth to the next, which sum to 360.
std::vector<double> read_pitch(const Value& given, std::size_t z) {
  std::vector<double> pitch = given.numbers(inside(0, 360.0000001, "degrees"));
  if (pitch.size() != z) given.refuse("as many angles as there are teeth, " + std::to_string(z));
  double turn = 0;
  for (const double angle : pitch) turn += angle;
  if (std::abs(turn - 360) > 1e-6) given.refuse("angles that sum to 360 degrees");
  for (double& angle : pitch) angle = radians(angle * (360 / turn));
  return pitch;
}

cutting::Cutter read_cutter(const Value& value) {
  Object tool(value);
  cutting::Cutter cutter;
  cutter.kind = tool.required("kind").choice(kinds);
  cutter.r = tool.number("r", between(1e-3, 1e3, "mm"));
  cutter.pitch = cutting::equal_pitch(tool.required("z").integer(1, most_teeth));
  cutter.helix = radians(tool.number("helix_deg", between(-80, 80, "degrees"), 0));
  cutter.elements = tool.integer("nq", 1, most_elements, 256);
  cutter.q_end = radians(tool.number("q_end_deg", between(1, 179, "degrees"), 90));
  read_teeth(tool, cutter);
  tool.finish();
  return cutter;
}

tool::Coefficients read_coefficients(const Value& value) {
  constexpr Range area = between(-1e5, 1e5, "N/mm2");
  constexpr Range length = between(-1e5, 1e5, "N/mm");
  Object coef(value);
  tool::Coefficients k;
  k.Ktc = coef.number("Ktc", area);
  k.Krc = coef.number("Krc", area);
  k.Kac = coef.number("Kac", area, 0);
  k.Kte = coef.number("Kte", length, 0);
  k.Kre = coef.number("Kre", length, 0);
  k.Kae = coef.number("Kae", length, 0);
  coef.finish();
  return k;
}

cutting::Direction read_direction(Object& object, const std::string& axis) {
  const std::optional<Value> modes = object.optional("modes_" + axis);
  const std::optional<Value> measured = object.optional("frf_" + axis);
  if (modes && measured) object.exclude("modes_" + axis, "frf_" + axis);
  if (modes) return read_mode_rows(*modes);
  if (measured) return read_measured_response(*measured);
  object.refuse("modes_" + axis, "modes, or frf_" + axis + " in its place; [] is rigid");
}

cutting::Cut read_cut(Object& object) {
  cutting::Cut cut;
  cut.cutter = read_cutter(object.required("tool"));
  cut.samples = object.integer("N", 8, most_samples, 1024);
  if (static_cast<double>(cut.samples) * cut.cutter.elements > most_places) {
    object.refuse("N", "so small that N times nq is at most " + text(most_places));
  }
  cut.feed = object.number("feed_per_tooth", between(1e-6, cut.cutter.r / 2, "mm"));
  cut.phi = radians(object.number("phi_deg", between(-90, 90, "degrees"), 0));
  if (cut.cutter.kind == CutterKind::Square && cut.phi != 0) {
    object.refuse("phi_deg", "0 for a square mill");
  }
  cut.coefficients = read_coefficients(object.required("coef"));
  if (object.boolean("stock_limit", false)) cut.chip_end = cutting::ChipEnd::StockLimited;
  cut.earlier_teeth = object.integer("npast", 1, 16, 1);
  cut.lookup = object.choice("lookup", lookups, Lookup::Linear);
  read_stock(object.required("engagement"), cut);
  return cut;
}

}  // namespace

cutting::Modes read_mode_rows(const Value& value) {
  cutting::Modes modes;
  for (const Value& row : value.array(0, 64)) {
    const std::vector<Value> mode = row.array(3, 3);
    modes.push_back({mode[0].number(between(0.1, 1e6, "Hz")),
                     mode[1].number(inside(0, 1, "of critical damping")),
                     mode[2].number(between(1e-3, 1e9, "N/mm"))});
  }
  return modes;
}

// [[f, re, im], ...]: Hz and mm/N.
cutting::MeasuredResponse read_measured_response(const Value& value) {
  cutting::MeasuredResponse measured;
  for (const Value& row : value.array(2, 1'000'000)) {
    const std::vector<Value> line = row.array(3, 3);
    const double least = measured.frequency.empty() ? 0 : measured.frequency.back();
    const Range ascending{least, 1e6, "Hz, ascending", !measured.frequency.empty(), false};
    constexpr Range compliance = between(-1e3, 1e3, "mm/N");
    measured.frequency.push_back(line[0].number(ascending));
    measured.value.emplace_back(line[1].number(compliance), line[2].number(compliance));
  }
  return measured;
}

void read_teeth(Object& object, cutting::Cutter& cutter) {
  if (const std::optional<Value> pitch = object.optional("pitch_deg")) {
    cutter.pitch = read_pitch(*pitch, cutter.pitch.size());
  }
  if (const std::optional<Value> runout = object.optional("runout_mm")) {
    cutter.runout = runout->numbers(between(-cutter.r / 4, cutter.r / 4, "mm"));
    if (cutter.runout.size() != cutter.pitch.size()) {
      runout->refuse("one number for each tooth, " + std::to_string(cutter.pitch.size()));
    }
  }
  cutter.offset = object.number("offset_mm", between(0, cutter.r / 4, "mm"), 0);
  cutter.offset_angle = radians(object.number("offset_deg", between(-360, 360, "degrees"), 0));
  cutter.lag = object.choice("lag", lags, LagLaw::Tangent);
  cutter.chip_width = object.choice("tw_mode", widths, ChipWidth::Chip);
}

void read_case(const Value& value, cutting::Engagement& engagement) {
  Object object(value);
  engagement.cut = read_cut(object);
  engagement.compliance.x = read_direction(object, "x");
  engagement.compliance.y = read_direction(object, "y");
  object.finish();
  cutting::validate(engagement.cut);
  cutting::validate(engagement.compliance);
}

void read_options(const Value& value, cutting::Engagement& engagement) {
  constexpr Choices<Mixing, 2> mixings{
      {{"averages", Mixing::Averages}, {"secants", Mixing::Secants}}};
  Object object(value);
  cutting::IterateOptions& o = engagement.options;
  for (const char* key : {"beta", "stall", "adapt", "weights"}) {  // these say how averages change
    if (object.has(key)) o.mixing = Mixing::Averages;
  }
  o.mixing = object.choice("mixing", mixings, o.mixing);
  o.alpha = object.number("alpha", inside(0, 1, ""), o.alpha);
  o.beta = object.number("beta", between(1, 1e300, ""), o.beta);
  o.stall = object.integer("stall", 1, 1'000'000, o.stall);
  o.adapt = object.boolean("adapt", o.adapt);
  o.max_loops = object.integer("maxloops", 1, 10'000, o.max_loops);
  if (const std::optional<Value> weights = object.optional("weights")) {
    o.weights = weights->numbers(between(0, 1e6, ""));
    if (o.weights.empty()) weights->refuse("at least one weight");
  }
  if (const std::optional<Value> kappa = object.optional("kappa"); kappa && !kappa->is_null()) {
    o.kappa = kappa->number(inside(0, 1e6, ""));
  }
  engagement.time.max_revolutions =
      object.integer("max_revolutions", 2, 10'000, engagement.time.max_revolutions);
  engagement.time.tolerance =
      object.number("tolerance", inside(0, 1, ""), engagement.time.tolerance);
  // Fixed weights are there to study the iteration itself, so what it gives stands.
  engagement.fall_back = object.boolean("fall_back", o.adapt);
  object.finish();
}

cutting::Method read_method(Object& object) {
  return object.choice("method", methods, Method::Iterate);
}

std::string_view name(cutting::Method method) {
  return name_of(methods, method);
}
std::string_view name(Stability stability) {
  return name_of(stabilities, stability);
}

}  // namespace ridgeline::jobs
