#pragma once

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <TopoDS_Face.hxx>

#include "part/solid.hpp"

namespace ridgeline::part {

/// Area, sweep and the integrals of a face, by Green's theorem along its edges; closed form across
/// for surfaces of revolution and planes, Gauss points for others. Relative error below 1e-9 on the
/// former, as good as its parameter curves on the latter. `surface` reaches as far as the face.
void integrate(const TopoDS_Face& face, const BRepAdaptor_Surface& surface, Face& result);

/// Integral of f(p, dp) along a curve, by Gauss points between its knots.
double integral_along(const BRepAdaptor_Curve& curve, const Solid::Integrand& f);

}  // namespace ridgeline::part
