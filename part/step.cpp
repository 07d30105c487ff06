#include "part/step.hpp"

#include <malloc.h>

#include <BRep_Tool.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <mutex>
#include <sstream>

#include "core/base/error.hpp"
#include "part/shape.hpp"

namespace ridgeline::part {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ErrorCode::BadFile, what, {.field = "/product_step"});
}

/// Open CASCADE keeps protocols and settings of its translators in globals.
std::mutex& translator() {
  static std::mutex mutex;
  return mutex;
}

/// What must stand in every exchange file, before a reader that forgives much sees it.
void check_envelope(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (text.substr(0, 3) == mark) text.remove_prefix(3);
  const std::size_t start = text.find_first_not_of(blanks);
  if (start == std::string_view::npos) refuse("the part file is empty");
  if (text.substr(start, 13) != "ISO-10303-21;" && text.substr(start, 12) != "ISO-10303-21") {
    refuse("the part file is no STEP file: it does not begin with ISO-10303-21");
  }
  if (text.find('\0') != std::string_view::npos) {
    refuse("the part file is no STEP file: it holds zero bytes");
  }
  if (text.find("DATA") == std::string_view::npos) {
    refuse("the part file is cut off: it has no DATA section");
  }
  if (text.find("END-ISO-10303-21") == std::string_view::npos) {
    refuse("the part file is cut off: END-ISO-10303-21 is missing");
  }
}

/// The name of the only PRODUCT of a file; empty when there are several or it is nothing but a
/// default of a translator.
std::string product_name(std::string_view text) {
  constexpr std::string_view key = "PRODUCT";
  std::string name;
  int count = 0;
  for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
    const std::size_t open = text.find_first_not_of(" \t\r\n", at + key.size());
    if (open == std::string_view::npos || text[open] != '(') continue;
    if (at > 0 && text[at - 1] != ' ' && text[at - 1] != '=') continue;
    const std::size_t quote = text.find_first_not_of(" \t\r\n", open + 1);
    if (quote == std::string_view::npos || text[quote] != '\'') continue;
    const std::size_t end = text.find('\'', quote + 1);
    if (end == std::string_view::npos) break;
    ++count;
    name = std::string(text.substr(quote + 1, std::min<std::size_t>(end - quote - 1, 64)));
  }
  constexpr std::string_view made_up = "Open CASCADE STEP translator";
  return count == 1 && !name.starts_with(made_up) ? name : std::string();
}

std::shared_ptr<const Solid::Shape> shape_of(const TopoDS_Solid& solid, const std::string& name) {
  auto shape = std::make_shared<Solid::Shape>();
  shape->solid = solid;
  shape->name = name;
  TopExp::MapShapes(solid, TopAbs_FACE, shape->faces);
  TopExp::MapShapes(solid, TopAbs_EDGE, shape->edges);
  TopExp::MapShapes(solid, TopAbs_VERTEX, shape->vertices);
  for (int i = 1; i <= shape->edges.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(shape->edges(i));
    shape->curves.push_back(BRep_Tool::Degenerated(edge)
                                ? BRepAdaptor_Curve()
                                : BRepAdaptor_Curve(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD))));
  }
  return shape;
}

void check_size(const Model& model) {
  const double extent = (model.high - model.low).maxCoeff();
  if (extent >= smallest_part && extent <= largest_part) return;
  const auto text = [](double x) { return std::to_string(x); };
  throw Error(ErrorCode::AbsurdSize,
              "the part is " + text(extent) + " mm long; from " + text(smallest_part) + " to " +
                  text(largest_part) + " mm is believed: is its length unit right?",
              {.field = "/product_step",
               .value = text(extent),
               .limit = text(smallest_part) + ".." + text(largest_part) + " mm"});
}

TopoDS_Shape transferred(std::string_view text) {
  std::istringstream stream{std::string(text)};
  STEPControl_Reader reader;
  const IFSelect_ReturnStatus status = reader.ReadStream("part", stream);
  if (status != IFSelect_RetDone) refuse("the part file is no readable STEP file");
  if (reader.NbRootsForTransfer() == 0) refuse("the part file holds no shape");
  reader.TransferRoots();
  return reader.NbShapes() == 0 ? TopoDS_Shape() : reader.OneShape();
}

}  // namespace

void prepare() {
  static const bool is_ready = [] {
    // A file takes some 10 MB in small pieces: asking the kernel for them 128 KB at a time, and
    // giving them back in between, costs a sixth of reading it.
    constexpr int step = 16 << 20;
    ::mallopt(M_TOP_PAD, step);
    ::mallopt(M_TRIM_THRESHOLD, 8 * step);
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
    STEPControl_Controller::Init();
    return true;
  }();
  static_cast<void>(is_ready);
}

std::vector<Solid> read_step(std::string_view text) {
  check_envelope(text);
  const std::scoped_lock lock(translator());
  try {
    prepare();
    const TopoDS_Shape shape = transferred(text);
    std::vector<Solid> solids;
    if (!shape.IsNull()) {
      const std::string name = product_name(text);
      for (TopExp_Explorer found(shape, TopAbs_SOLID); found.More(); found.Next()) {
        solids.emplace_back(shape_of(TopoDS::Solid(found.Current()), name));
      }
    }
    if (solids.empty()) refuse("the part file holds no solid");
    for (const Solid& solid : solids) check_size(solid.model());
    return solids;
  } catch (const Standard_Failure& failure) {
    refuse("the part file cannot be read: " + std::string(failure.GetMessageString()));
  }
}

}  // namespace ridgeline::part
