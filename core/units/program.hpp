#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/units/contour.hpp"
#include "core/units/product.hpp"

namespace ridgeline::units {

/// Tight: D = 2 r_max + radial allowance. Document: document 004, equation (1), sqrt(2) too large
/// for a round part.
enum class StockRule { Tight, Document };

/// S101.
struct Parameters {
  double radial_allowance = 4;  ///< on the diameter [mm]
  double end_allowance = 2;     ///< on each end [mm]
  StockRule stock_rule = StockRule::Tight;
  double smallest_boring_bar = 10;  ///< diameter: narrower bores are drilled [mm]
};

/// S104: where process 1 (main spindle) hands over to process 2 (sub spindle).
struct Split {
  double outer = 0;  ///< Z [mm]
  double inner = 0;
  double outer_overlap = 0;  ///< [mm]
  double inner_overlap = 0;
};

/// Numbers are the machining order of equal processes where the order table does not say otherwise.
enum class UnitKind {
  FaceFront,
  FaceBack,
  BarOuter,
  BarInner,
  Groove,
  Hole,
  FaceMill,
  Unexplained
};
enum class State { Auto, Edited, Frozen, Kept };

/// SNo: tool and cutting conditions of one step.
struct ToolRow {
  std::string tool;
  int number = 0;
  double nominal_diameter = 0;     ///< of a drill or mill [mm]
  double nose_radius = 0;          ///< of a turning tool [mm]
  std::string pattern;             ///< "rough", "finish", "groove", "drill", "contour", ...
  double depth_of_cut = 0;         ///< [mm]
  double finish_allowance = 0;     ///< left for the next step [mm]
  double cutting_speed = 0;        ///< [mm/s]
  double feed_per_revolution = 0;  ///< [mm]
};

/// One spindle, continuous work. FIG is `shape`; what the unit really has to remove is `region`.
struct Unit {
  int number = 0;  ///< place in the program, from 1
  UnitKind kind = UnitKind::BarOuter;
  int process = 1;
  State state = State::Auto;
  Point start;                 ///< machining start point of bars; start of faces
  std::vector<Segment> shape;  ///< bars: chain of the product side, in feed order; faces: diagonal
  bool is_closed = false;      ///< the shape is an outline instead
  Region region;               ///< what it removes, turned
  Region core;                 ///< region without the declared extension over the split
  std::optional<Hole> hole;
  std::optional<MilledFace> face;
  std::optional<Remainder> remainder;
  std::optional<std::size_t> feature;  ///< place in the product's holes, faces or remainders
  std::vector<ToolRow> tools;
  double volume = 0;               ///< removed, with the extension [mm^3]
  std::vector<std::string> notes;  ///< warnings of this unit
};

/// All in mm^3. units - overlap_declared - overlap_undeclared + left + unexplained = stock -
/// product.
struct Volumes {
  double stock = 0;
  double product = 0;
  double turned = 0;  ///< T = stock - S
  double units = 0;   ///< sum over all units but unexplained ones
  double overlap_declared = 0;
  double overlap_undeclared = 0;
  double left = 0;  ///< nobody removes it, with a note that says why
  double unexplained = 0;
};

/// A unit that the operator took out: its work is not given to a unit of the same kind again.
struct Removed {
  UnitKind kind = UnitKind::BarOuter;
  int process = 1;
  Region region;
  std::optional<std::size_t> feature;
};

struct Program {
  Parameters parameters;
  Product product;
  Region stock;
  Split split;
  std::vector<Unit> units;
  std::vector<Removed> removed;
  Volumes volumes;
  std::vector<std::string> notes;  ///< what could not be built, and why
};

}  // namespace ridgeline::units
