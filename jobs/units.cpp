#include "core/units/plan.hpp"
#include "jobs/kinds.hpp"
#include "jobs/part.hpp"
#include "jobs/units_drawing.hpp"
#include "jobs/units_edit.hpp"
#include "jobs/units_program.hpp"
#include "jobs/units_shape.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

enum class Operation { Plan, Edit, Show };
constexpr Choices<Operation, 3> operations{{
    {"plan", Operation::Plan},
    {"edit", Operation::Edit},
    {"show", Operation::Show},
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
  if (const auto parameters = job.optional("parameters"))
    plan.parameters = read_parameters(*parameters);
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

UnitsProgram run(Object& job, const Request& request) {
  switch (job.choice("operation", operations, Operation::Plan)) {
    case Operation::Plan: return planned(job, request);
    case Operation::Edit: return edited(job);
    case Operation::Show: {
      UnitsProgram whole = read_whole(job);
      job.finish();
      return whole;
    }
  }
  throw Error(ErrorCode::Internal, "an operation without a function");
}

}  // namespace

Answer units_program(const Request& request) {
  Object job{Value(request.document)};
  job.required("job");
  const UnitsProgram whole = run(job, request);
  Answer answer{.document = program_document(whole), .arrays = {}, .text = {}};
  if (request.format == "text") answer.text = units_text(whole.program);
  if (request.format == "svg") answer.text = units_svg(whole.program);
  if (request.format == "html") answer.text = units_html(whole.program);
  return answer;
}

}  // namespace ridgeline::jobs
