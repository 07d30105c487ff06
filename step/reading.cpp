#include "step/reading.hpp"

#include <algorithm>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"
#include "jobs/units_product.hpp"
#include "jobs/units_shape.hpp"
#include "part/mouths.hpp"
#include "part/product.hpp"
#include "part/step.hpp"

namespace ridgeline::step {
namespace {

using Json = nlohmann::json;
using jobs::vector_document;

Eigen::Vector3d vector(const Json& v) {
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

Json placement_document(const geometry::Frame& frame) {
  return {{"origin", vector_document(frame.origin)},
          {"x", vector_document(frame.axes.col(0))},
          {"y", vector_document(frame.axes.col(1))},
          {"z", vector_document(frame.axes.col(2))}};
}

Json product(const Json& wish, std::string_view file) {
  std::optional<part::GivenAxis> given;
  if (wish.contains("axis")) {
    given.emplace().direction = vector(wish["axis"].at("direction"));
    if (wish["axis"].contains("point")) given->point = vector(wish["axis"]["point"]);
  }
  const part::TurnedPart found = part::read_product(file, given);
  return {{"product", jobs::product_document(found.product)},
          {"placement", placement_document(found.placement)}};
}

Json mouth_document(const part::Mouth& mouth, std::size_t number) {
  Json document = {{"name", "M" + std::to_string(number)},
                   {"kind", part::name(mouth.kind)},
                   {"wall",
                    {{"radius", mouth.wall_radius},
                     {"is_bore", mouth.is_bore},
                     {"point", vector_document(mouth.wall.point)},
                     {"axis", vector_document(mouth.wall.direction)}}},
                   {"position", vector_document(mouth.point)},
                   {"axis", vector_document(mouth.out)},
                   {"radius", mouth.radius},
                   {"crossing_angle", degrees(mouth.angle)},
                   {"eccentric_distance", mouth.eccentricity}};
  if (mouth.length > 0) {
    document["length"] = mouth.length;
    document["width"] = mouth.width;
    document["skew"] = degrees(mouth.skew);
  }
  if (!mouth.why.empty()) document["why"] = mouth.why;
  return document;
}

/// Every mouth of a hole in a round wall of the largest solid, in file coordinates.
Json mouths(std::string_view file) {
  const std::vector<part::Solid> solids = part::read_step(file);
  const part::Model& model = std::ranges::max_element(solids, {}, [](const part::Solid& solid) {
                               return solid.model().volume;
                             })->model();
  Json list = Json::array();
  for (const part::Mouth& mouth : part::mouths_of(model)) {
    list.push_back(mouth_document(mouth, list.size() + 1));
  }
  return {{"mouths", std::move(list)},
          {"low", vector_document(model.low)},
          {"high", vector_document(model.high)}};
}

Json found(const Json& wish, std::string_view file) {
  const std::string want = wish.at("want");
  if (want == "product") return product(wish, file);
  if (want == "stock") return {{"shape", jobs::region_document(part::read_stock(file))}};
  if (want == "mouths") return mouths(file);
  throw Error(ErrorCode::Internal, "the reader of STEP files knows no \"" + want + "\"");
}

Json refusal(ErrorCode code, const std::string& message, const ErrorDetails& details = {}) {
  return {{"error",
           {{"code", name(code)},
            {"message", message},
            {"value", details.value},
            {"limit", details.limit}}}};
}

}  // namespace

Json reading(const Json& wish, std::string_view file) noexcept {
  try {
    return found(wish, file);
  } catch (const Error& error) {
    return refusal(error.code(), error.what(), error.details());
  } catch (const std::bad_alloc&) {
    return refusal(ErrorCode::BadFile,
                   "the part file cannot be read: it needs more memory than "
                   "the " +
                       wish.value("gigabytes", Json()).dump() + " GB of a reader");
  } catch (const std::exception& error) {
    return refusal(ErrorCode::BadFile,
                   std::string("the part file cannot be read: ") + error.what());
  } catch (...) {  // Open CASCADE's own failures are no std::exception
    return refusal(ErrorCode::BadFile,
                   "the part file cannot be read: a failure of the translator without a message");
  }
}

}  // namespace ridgeline::step
