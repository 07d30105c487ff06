#include "core/units/plan.hpp"
#include "jobs/definitions.hpp"
#include "jobs/kinds.hpp"
#include "jobs/part.hpp"
#include "jobs/part_holes.hpp"
#include "jobs/part_mouths.hpp"
#include "jobs/units_drawing.hpp"
#include "jobs/units_edit.hpp"
#include "jobs/units_nc.hpp"
#include "jobs/units_page.hpp"
#include "jobs/units_product.hpp"
#include "jobs/units_program.hpp"
#include "jobs/units_shape.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

enum class Operation { Plan, Edit, Show, Nc, Holes };
constexpr Choices<Operation, 5> operations{{
    {"plan", Operation::Plan},
    {"edit", Operation::Edit},
    {"show", Operation::Show},
    {"nc", Operation::Nc},
    {"holes", Operation::Holes},
}};

Part read_part(Object& job, const Request& request) {
  const std::optional<Value> step = job.optional("product_step");
  const std::optional<Value> axis = job.optional("axis");
  if (step) {
    job.exclude("product_step", "product");
    return part_of_step(*step, axis, request.progress);
  }
  if (axis) axis->refuse("absent: part values lie on their axis already");
  return part_of_document(job.required("product"), request.definitions);
}

std::optional<units::GivenStock> read_stock(Object& job, const Progress& progress) {
  job.exclude("stock", "stock_step");
  if (const auto step = job.optional("stock_step")) return stock_of_step(*step, progress);
  const std::optional<Value> value = job.optional("stock");
  if (!value) return std::nullopt;
  Object object(*value);
  object.exclude("shape", "diameter");
  std::optional<units::GivenStock> stock;
  if (const auto shape = object.optional("shape")) {
    stock = read_region(*shape);
    if (units::is_empty(std::get<units::Region>(*stock))) shape->refuse("contours of an area");
  } else {
    units::StockCylinder cylinder;
    cylinder.diameter = object.number("diameter", above(0, 1e5, "mm"));
    cylinder.length = object.number("length", above(0, 1e5, "mm"));
    stock = cylinder;
  }
  object.finish();
  return stock;
}

UnitsProgram planned(Object& job, const Request& request) {
  units::PlanJob plan;
  if (const auto parameters = job.optional("parameters")) {
    plan.parameters = read_parameters(*parameters);
  }
  if (const auto split = job.optional("split")) plan.split = read_split(*split);
  Part part = read_part(job, request);
  plan.product = std::move(part.product);
  plan.stock = read_stock(job, request.progress);
  job.finish();
  return {units::plan(plan), std::move(part.placement), Json::array()};
}

UnitsProgram read_whole(Object& job) {
  return read_program(job.required("program"));
}

UnitsProgram edited(Object& job) {
  UnitsProgram whole = read_whole(job);
  job.exclude("edits", "undo");
  if (const auto count = job.optional("undo")) {
    job.finish();
    return undone(whole, *count);
  }
  const Value edits = job.required("edits");
  job.finish();
  whole.program = edited(whole.program, edits);
  whole.edits.push_back(edits.json());
  return whole;
}

UnitsProgram shown(Object& job) {
  UnitsProgram whole = read_whole(job);
  job.finish();
  return whole;
}

Answer nc_of(Object& job, std::string_view format) {
  const UnitsProgram whole = read_whole(job);
  const std::optional<Value> output = job.optional("output");
  job.finish();
  if (format != "json" && format != "nc") {
    refuse({.code = ErrorCode::Unsupported,
            .field = "",
            .value = std::string(format),
            .limit = "json or nc",
            .message = "the NC of a program has no format \"" + std::string(format) +
                       "\": ask for json or nc"});
  }
  return units_nc(whole.program, output, format);
}

/// "name": of the workpieces; "chamfer": {"tool", "width"} asks for the jobs of the edges too.
Answer holes_of(Object& job, const Request& request) {
  std::string name = "part";
  if (const std::optional<Value> given = job.optional("name")) name = given->name();
  std::optional<ChamferWish> wish;
  if (const std::optional<Value> chamfer = job.optional("chamfer")) {
    Object object(*chamfer);
    const Value tool = object.required("tool");
    resolve_tool(tool, request.definitions);
    wish = ChamferWish{tool.json(), object.number("width", above(0, 1000, "mm"))};
    object.finish();
  }
  const std::optional<Value> step = job.optional("product_step");
  const Json mouths = step ? mouths_of_step(*step, request.progress) : Json::object();
  Json document;
  try {
    const Part part = read_part(job, request);
    document = hole_edges(part, name, wish);
    document["part"] = {
        {"kind", "part"}, {"name", name}, {"product", product_document(part.product)}};
    if (!part.placement.is_null()) document["part"]["placement"] = part.placement;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::NotTurned || !step) throw;
    document = block_edges(mouths, name, wish);
  }
  job.finish();
  document["mouths"] = mouths.value("mouths", Json::array());
  return {.document = std::move(document), .arrays = {}, .text = {}};
}

UnitsProgram run(Operation operation, Object& job, const Request& request) {
  if (operation == Operation::Plan) return planned(job, request);
  if (operation == Operation::Edit) return edited(job);
  return shown(job);
}

}  // namespace

Answer units_program(const Request& request) {
  Object job{Value(request.document)};
  job.required("job");
  const Operation operation = job.choice("operation", operations, Operation::Plan);
  if (operation == Operation::Nc) return nc_of(job, request.format);
  if (operation == Operation::Holes) return holes_of(job, request);
  if (request.format == "nc") {
    refuse({.code = ErrorCode::Unsupported,
            .field = "/operation",
            .value = "absent",
            .limit = "nc",
            .message = "the format nc is of the operation \"nc\", which takes a program"});
  }
  const UnitsProgram whole = run(operation, job, request);
  Answer answer{.document = program_document(whole), .arrays = {}, .text = {}};
  if (request.format == "text") answer.text = units_text(whole.program);
  if (request.format == "svg") answer.text = units_svg(whole.program);
  if (request.format == "html") answer.text = units_page(whole, answer.document);
  return answer;
}

}  // namespace ridgeline::jobs
