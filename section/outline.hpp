#pragma once
#include "model/outline.hpp"

#include <optional>
#include <span>

/// Plane geometry of outlines; points in m.
namespace flowslide {

/// Signed, positive if counter-clockwise [m2].
double outline_area(std::span<const Vec2> outline);

/// Where the interiors of the segments ab and cd cross, if they do so at an angle.
std::optional<Vec2> crossing(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

/// A place where two sides of the closed outline cross or a point lies on another side.
std::optional<Vec2> self_contact(std::span<const Vec2> outline);

/// Parameter of the nearest point of the line through a and b (0 at a, 1 at b), and the distance.
struct Projection {
  double parameter, distance;
};
Projection project(Vec2 a, Vec2 b, Vec2 point);

double distance(Vec2 a, Vec2 b);

}  // namespace flowslide
