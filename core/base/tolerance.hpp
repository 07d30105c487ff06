#pragma once

/// Tolerances of the core, each with its unit and its reason.
namespace ridgeline {

/// Ends of an arc this close in its plane are the same point: the arc is a full circle [mm]. The
/// finest NC program has 1e-6 mm, solver noise is 1e-12 mm.
inline constexpr double coincident_ends = 1e-8;

/// Chords that one arc may be cut into: more is a tolerance given in the wrong unit.
inline constexpr int arc_steps_limit = 1'000'000;

}  // namespace ridgeline
