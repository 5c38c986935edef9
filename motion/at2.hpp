#pragma once
#include "motion/record.hpp"
#include "motion/record_text.hpp"

#include <cstddef>
#include <optional>
#include <string>

/// The AT2 format of the PEER ground-motion databases: four header lines, of which the last gives
/// the number of values and the time step, then the values, several to a line.
namespace flowslide {

struct At2Header {
  std::size_t npts = 0;
  double dt = kUnset;               ///< [s]
  std::optional<std::string> unit;  ///< of acceleration, in the spelling of core/units.hpp
  std::size_t unit_line = 0;        ///< that states it, from 0
  std::string title;                ///< event, date, station and component
  std::size_t data_line = 0;        ///< first line after the header, from 0
};

/// Whether one of the first lines has the word NPTS.
bool is_at2(const RecordText& text);

/// Knows the orders "NPTS= 4000, DT= .005 SEC", "DT= .005, NPTS= 4000", "4000 .005 NPTS, DT" and
/// "NPTS, DT: 4000 .005", with or without commas, on one line or on two. Throws InputError.
At2Header parse_at2_header(const RecordText& text);

/// Throws InputError; checks the number of values against the header.
Record parse_at2(const RecordText& text, const RecordFormat& format);

}  // namespace flowslide
