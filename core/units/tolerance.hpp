#pragma once

namespace ridgeline::units {

/// Limits and curves nearer than this are one [mm]: above the noise of a STEP file (1e-7), below
/// what a machine resolves (1e-4).
constexpr double merge_tolerance = 1e-6;
/// Ends of contour edges that are one vertex [mm]: two merged curves and the slope between them.
constexpr double vertex_tolerance = 1e-5;
/// A turned region that is nowhere thicker than this is no work [mm]: a tenth of a machine's step.
constexpr double sliver_thickness = 1e-4;
/// Turned shapes that differ by less are equal [mm^3]; design 1.8-q.
constexpr double equal_volume = 1e-3;
/// Holes and faces whose parameters differ by less are equal [mm]; design 1.8-q.
constexpr double equal_parameter = 1e-6;
/// Cosine to the turning axis up to which a hole or a face lies across it.
constexpr double across_axis = 1e-6;

}  // namespace ridgeline::units
