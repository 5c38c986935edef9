#pragma once

/// Conventions that hold everywhere inside the program; readers and writers convert at the border.
///
/// | quantity        | convention                                                              |
/// |-----------------|-------------------------------------------------------------------------|
/// | units           | SI: m, kg, s, Pa, rad                                                   |
/// | stress          | tension positive                                                        |
/// | pore pressure u | compression positive; total = effective - u on the normal components    |
/// | Voigt order     | plane strain: xx yy zz xy; three dimensions: xx yy zz xy yz zx          |
/// | shear strain    | engineering, gamma_xy = 2 eps_xy                                        |
/// | plane strain    | out-of-plane strain is zero, out-of-plane stress zz is carried          |
/// | axes            | y (2D) or z (3D) points up; downstream is +x                            |
/// | angles          | rad                                                                     |
/// | eps_q           | sqrt(2/3 e:e), e the deviator of strain; in simple shear gamma/sqrt(3)   |
/// | time            | seconds from the start of the motion                                    |
/// | unset numbers   | NaN                                                                     |
namespace flowslide {

inline constexpr double kGravity = 9.81;        ///< [m/s2], the value of the paper's unit weights
inline constexpr double kAtmosphere = 101.3e3;  ///< [Pa]
inline constexpr double kPi = 3.14159265358979323846;

}  // namespace flowslide
