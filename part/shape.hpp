#pragma once

#include <BRepAdaptor_Curve.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Solid.hxx>
#include <memory>
#include <string>
#include <vector>

#include "part/solid.hpp"

namespace ridgeline::part {

/// The numbers of faces, edges and vertices in the model are their places in these maps, less 1.
struct Solid::Shape {
  TopoDS_Solid solid;
  std::string name;
  TopTools_IndexedMapOfShape faces;
  TopTools_IndexedMapOfShape edges;
  TopTools_IndexedMapOfShape vertices;
  std::vector<BRepAdaptor_Curve> curves;  ///< of every edge, in its own direction
  /// Prepared by the first question whether the solid contains a point, since preparing it costs as
  /// much as many answers; one thread at a time.
  mutable std::unique_ptr<BRepClass3d_SolidClassifier> classifier;
};

inline Eigen::Vector3d vector(const gp_Pnt& p) {
  return {p.X(), p.Y(), p.Z()};
}
inline Eigen::Vector3d vector(const gp_Dir& d) {
  return {d.X(), d.Y(), d.Z()};
}
inline Eigen::Vector3d vector(const gp_Vec& v) {
  return {v.X(), v.Y(), v.Z()};
}

}  // namespace ridgeline::part
