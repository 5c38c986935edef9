#pragma once
#include "model/field_store.hpp"

/// What a state of the shaking is made of, in files and in rows of a run that can be resumed.
namespace flowslide {

inline constexpr FieldLabel kDisplacementLabel{
    .unit = "m", .convention = "nodes, from the reference coordinates"};
inline constexpr FieldLabel kVelocityLabel{
    .unit = "m/s", .convention = "nodes, absolute", .nan = Nan::allowed};
inline constexpr FieldLabel kPorePressureLabel{.unit = "Pa",
                                               .convention = "nodes, compression positive"};
inline constexpr FieldLabel kStressLabel{
    .unit = "Pa", .convention = "element centres, effective, tension positive, xx yy zz xy"};
inline constexpr FieldLabel kStrainLabel{
    .unit = "-",
    .convention =
        "element centres, from the reference, extension positive, engineering shear, "
        "xx yy zz xy",
    .nan = Nan::allowed};

/// The one list of arrays of a frame: f(name, label, array, is_nodal).
template <class Frame, class F>
void visit_frame(Frame& frame, F&& f) {
  f("displacement", kDisplacementLabel, frame.displacement, true);
  f("velocity", kVelocityLabel, frame.velocity, true);
  f("pore_pressure", kPorePressureLabel, frame.pore_pressure, true);
  f("stress", kStressLabel, frame.stress, false);
  f("strain", kStrainLabel, frame.strain, false);
}

}  // namespace flowslide
