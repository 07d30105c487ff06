#pragma once

/// Tolerances of the core, each with its unit and its reason.
namespace ridgeline {

/// Ends of an arc this close in its plane are the same point: the arc is a full circle [mm]. The
/// finest NC program has 1e-6 mm, solver noise is 1e-12 mm.
inline constexpr double coincident_ends = 1e-8;

/// Chords that one arc may be cut into: more is a tolerance given in the wrong unit.
inline constexpr int arc_steps_limit = 1'000'000;

/// Largest difference of a given eccentric distance from the one of the positions [mm]: positions
/// are typed with up to six decimals.
inline constexpr double eccentricity_tolerance = 1e-6;

/// A hole whose side comes this near to the side of a body, relative to the body's radius, touches
/// it: the ridge then has a corner, or turns so sharply that no ball follows it.
inline constexpr double tangent_band = 1e-9;

/// Lengths of a part at or above this are a wrong unit or a typing error [mm].
inline constexpr double length_limit = 1e9;

}  // namespace ridgeline
